//! Every kind of figure looks like its reference picture, in a column of a journal and on a slide.
//!
//! `MOTIFORM_UPDATE=1 cargo test --release -p motiform-figures --test all references` draws the pictures
//! again; look at them before they go in.

use crate::kinds::kinds;
use motiform_figures::{Animation, Camera, Drawn, Figure, Frame, Medium, Style, Width, png};
use std::io::Cursor;
use std::path::PathBuf;

/// Width of a reference in pixels.
const WIDE: f64 = 300.0;

/// Side of the blocks over which pictures are compared, in pixels.
const BLOCK: usize = 8;

/// Largest mean difference of a block, of 255 levels of grey.
const TOLERANCE: f64 = 3.0;

/// Levels of grey in a reference: 16.
const STEP: u8 = 17;

/// A grey picture, row after row.
#[derive(Debug, Clone, PartialEq)]
struct Grey {
    width: usize,
    pixels: Vec<u8>,
}

impl Grey {
    /// A colour or grey PNG, its first frame.
    fn read(png: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(Cursor::new(png));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("a header");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("an image");
        let each = frame.color_type.samples();
        let grey = |colour: &[u8]| match colour {
            [r, g, b, ..] => ((2 * u32::from(*r) + 5 * u32::from(*g) + u32::from(*b)) / 8) as u8,
            other => other[0],
        };
        let level = |value: u8| value.saturating_add(STEP / 2) / STEP * STEP;
        let pixels = bytes[..frame.buffer_size()].chunks_exact(each).map(grey).map(level).collect();
        Self { width: frame.width as usize, pixels }
    }

    fn of(svg: &str) -> Self {
        let width = svg.split(" width=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a width");
        let number: f64 = width.trim_end_matches("mm").parse().expect("a number");
        let wide = if width.ends_with("mm") { number * 96.0 / 25.4 } else { number };
        Self::read(&png(svg, WIDE / wide, &[]).expect("a picture"))
    }

    /// With 16 levels of grey.
    fn png(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let height = self.pixels.len() / self.width;
        let mut encoder = png::Encoder::new(&mut out, self.width as u32, height as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Four);
        encoder.set_compression(png::Compression::High);
        let row = |row: &[u8]| -> Vec<u8> {
            row.chunks(2)
                .map(|two| (two[0] / STEP) << 4 | two.get(1).map_or(0, |other| other / STEP))
                .collect()
        };
        let packed: Vec<u8> = self.pixels.chunks_exact(self.width).flat_map(row).collect();
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&packed).expect("an image");
        writer.finish().expect("a file");
        out
    }

    /// The block with the largest mean difference, and this difference; none for pictures of other sizes.
    fn difference(&self, other: &Self) -> Option<([usize; 2], f64)> {
        let height = self.pixels.len() / self.width;
        if self.width != other.width || self.pixels.len() != other.pixels.len() {
            return None;
        }
        let mean = |[x, y]: [usize; 2]| {
            let (right, bottom) = ((x + BLOCK).min(self.width), (y + BLOCK).min(height));
            let places = (y..bottom).flat_map(|row| (x..right).map(move |column| row * self.width + column));
            let sum: f64 = places.map(|i| f64::from(self.pixels[i].abs_diff(other.pixels[i]))).sum();
            sum / (BLOCK * BLOCK) as f64
        };
        let corners =
            (0..height).step_by(BLOCK).flat_map(|y| (0..self.width).step_by(BLOCK).map(move |x| [x, y]));
        corners.map(|at| (at, mean(at))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn looks_like(&self, other: &Self) -> bool {
        self.difference(other).is_some_and(|(_, most)| most <= TOLERANCE)
    }
}

/// The sizes at which figures are looked at: a column of a journal with title and caption, and a slide.
fn sizes() -> [(&'static str, Style); 2] {
    let column = Style { width: Some(Width::Millimetres(86.0)), ..Style::default() };
    [("86mm", column), ("slide", Style { medium: Some(Medium::Slide), ..Style::default() })]
}

fn drawn(figure: &mut dyn Figure, style: &Style) -> String {
    let Drawn { svg, .. } = style.draw(figure).expect("a figure");
    svg
}

fn film() -> Grey {
    let outline = |t: f64| {
        (0..40)
            .map(|i| (0.157 * f64::from(i)).sin_cos())
            .map(|(s, c)| [t + 0.8 * c, t.sin() + 0.5 * s])
            .collect()
    };
    let frame = |i: u32| 0.3 * f64::from(i);
    let frames = (0..30).map(frame).map(|t| Frame { t, centre: [t, t.sin()], outline: outline(t) }).collect();
    let film = Animation { frames, size: 300, camera: Camera::Fixed, ..Animation::default() };
    Grey::read(&film.apng().expect("a film"))
}

fn pictures() -> Vec<(String, Grey)> {
    let mut all = vec![("film".to_owned(), film())];
    for (size, style) in sizes() {
        let draw = |(name, mut figure): crate::kinds::Kind| {
            (format!("{name}-{size}"), Grey::of(&drawn(figure.as_mut(), &style)))
        };
        all.extend(kinds().into_iter().map(draw));
    }
    all
}

#[test]
fn every_kind_of_figure_looks_like_its_reference() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/references");
    let update = std::env::var_os("MOTIFORM_UPDATE").is_some();
    let mut wrong = Vec::new();
    for (name, picture) in pictures() {
        let path = folder.join(format!("{name}.png"));
        let known = std::fs::read(&path).ok().map(|bytes| Grey::read(&bytes));
        if known.as_ref().is_some_and(|known| known.looks_like(&picture)) {
            continue;
        }
        if update {
            std::fs::create_dir_all(&folder).expect("a folder");
            std::fs::write(&path, picture.png()).expect("a file");
            continue;
        }
        wrong.push(match known.map(|known| known.difference(&picture)) {
            None => format!("{name}: there is no reference"),
            Some(None) => format!("{name}: it has another size"),
            Some(Some((at, most))) => format!("{name}: at {at:?} it differs by {most:.0} levels of grey"),
        });
    }
    assert!(wrong.is_empty(), "{}\nMOTIFORM_UPDATE=1 draws the references again", wrong.join("\n"));
}

/// The same drawing with the label number `number` moved by a letter.
fn label_moved(svg: &str, number: usize) -> Option<String> {
    let (at, _) = svg.match_indices("<text x=\"").nth(number)?;
    let from = at + "<text x=\"".len();
    let to = from + svg[from..].find('"')?;
    let x: f64 = svg[from..to].parse().ok()?;
    Some(format!("{}{}{}", &svg[..from], x + 8.0, &svg[to..]))
}

/// The same drawing without its longest line.
fn line_lost(svg: &str) -> Option<String> {
    let lines =
        svg.match_indices("<path ").map(|(from, _)| (from, from + svg[from..].find("/>").unwrap_or(0) + 2));
    let (from, to) = lines.max_by_key(|(from, to)| to - from)?;
    Some(format!("{}{}", &svg[..from], &svg[to..]))
}

/// Of the labels of a figure each third is moved, from the first one on.
const EACH: usize = 3;

#[test]
fn a_moved_label_and_a_lost_line_are_seen() {
    for (size, style) in sizes() {
        for (name, mut figure) in kinds() {
            let svg = drawn(figure.as_mut(), &style);
            let own = Grey::of(&svg);
            assert!(
                own.looks_like(&own) && Grey::read(&own.png()) == own,
                "{name}: a reference is what was drawn"
            );
            let labels = svg.matches("<text x=\"").count();
            for number in (0..labels).step_by(EACH) {
                let moved = label_moved(&svg, number).expect("a label");
                assert!(
                    !own.looks_like(&Grey::of(&moved)),
                    "{name} at {size}: label {number} of {labels} is moved"
                );
            }
            let lost = line_lost(&svg).expect("a line");
            assert!(!own.looks_like(&Grey::of(&lost)), "{name} at {size}: a line is lost");
        }
    }
}
