//! Requested title, caption, width and look of a figure, instead of the defaults.

use super::error::{FigureError, Result, check_range};
use super::figure::{Drawn, Figure};
use super::portable::DEFAULT_SCALE;
use super::room::Room;
use super::text::Label;
use std::str::FromStr;

/// Where a figure is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Medium {
    /// In a column of a journal, 86 mm wide: title and caption are left to the text.
    Journal,
    /// On a slide of 1920 pixels, with its title: the caption is left to the speaker.
    Slide,
}

/// Title, caption and width of figures.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Style {
    /// Where they are shown. It sets the width, the title and the caption that are not given below.
    pub medium: Option<Medium>,
    /// Title in place of the figure's own (markup; an empty one leaves the line out).
    pub title: Option<String>,
    /// Leaves the caption out.
    pub no_caption: bool,
    /// Width of the sheet. On paper it is laid out for this width, with text of 8.5 pt and more, indices of 7 pt
    /// and more, and lines of at least .5 pt; in pixels it is scaled.
    pub width: Option<Width>,
}

/// A width of a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Width {
    /// On paper, in millimetres, 30 to 2000: a PNG has 300 dots per inch.
    Millimetres(f64),
    /// On a screen, in pixels, 50 to 10000: a PNG has as many.
    Pixels(f64),
    /// On a slide of 1920 pixels, 960 pt wide: text of 18 pt and more.
    Slide,
}

/// Units of a drawing per point on paper: its text of 12 units has 8.6 pt, indices in it 7 pt.
pub(crate) const PER_POINT: f64 = 1.4;

/// Width of a column of a journal in millimetres.
const COLUMN: f64 = 86.0;

/// Units across a slide of 960 pt, and from its top to its bottom: text of 12 units has 18 pt.
const SLIDE: [f64; 2] = [640.0, 360.0];

/// Heights of a frame that are tried where a figure is higher than a slide.
const LOWER: [f64; 8] = [300.0, 270.0, 240.0, 215.0, 190.0, 165.0, 140.0, 120.0];

impl Width {
    /// The medium that sheets of this width are laid out for.
    pub fn room(self) -> Room {
        match self {
            Self::Millimetres(size) => Room::of(size / 25.4 * 72.0 * PER_POINT),
            Self::Pixels(_) => Room::OWN,
            Self::Slide => Room::of(SLIDE[0]),
        }
    }
}

/// Reads `86mm`, `8.6cm`, `3.4in`, `1200px` or `slide`.
impl FromStr for Width {
    type Err = FigureError;

    fn from_str(text: &str) -> Result<Self> {
        if text == "slide" {
            return Ok(Self::Slide);
        }
        let unknown = || FigureError::Width { text: text.to_owned() };
        let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let number: f64 = digits.trim().parse().map_err(|_| unknown())?;
        match &text[digits.len()..] {
            "px" => check_range("width in pixels", number, 50.0, 1e4).map(|()| Self::Pixels(number)),
            unit => {
                let millimetres = match unit {
                    "mm" => number,
                    "cm" => 10.0 * number,
                    "in" => 25.4 * number,
                    _ => return Err(unknown()),
                };
                check_range("width in mm", millimetres, 30.0, 2000.0).map(|()| Self::Millimetres(millimetres))
            }
        }
    }
}

impl Style {
    /// Draws a figure with these words, at this size.
    ///
    /// # Errors   those of the figure
    pub fn draw(&self, figure: &mut dyn Figure) -> Result<Drawn> {
        let left = self.words(figure);
        let width = self.width();
        let room = width.map_or(Room::OWN, Width::room);
        let whole = figure.sheet(room)?.finish();
        let (svg, data) = match width {
            Some(Width::Slide) => (on_slide(figure, room, whole)?, figure.data()),
            _ => (whole, figure.data()),
        };
        let svg = width.map_or_else(|| svg.clone(), |width| resized(&svg, width));
        Ok(Drawn { svg, data, caption: left })
    }

    /// Title and caption as they are drawn; the text of both, if a medium leaves them out and there is any.
    fn words(&self, figure: &mut dyn Figure) -> Option<String> {
        let (title, caption) = figure.words();
        let plain = |markup: &String| Label::parse(markup).terminal();
        let left = [&*title].into_iter().chain(&*caption).filter(|words| !words.is_empty()).map(plain);
        let left: Vec<String> = left.collect();
        let left = self.medium.filter(|_| !left.is_empty()).map(|_| left.join("\n") + "\n");
        match (&self.title, self.medium) {
            (Some(given), _) => title.clone_from(given),
            (None, Some(Medium::Journal)) => title.clear(),
            _ => {}
        }
        if self.no_caption || left.is_some() {
            caption.clear();
        }
        left
    }

    /// The width that is asked for, or that of the medium.
    fn width(&self) -> Option<Width> {
        let own = self.medium.map(|medium| match medium {
            Medium::Journal => Width::Millimetres(COLUMN),
            Medium::Slide => Width::Slide,
        });
        self.width.or(own)
    }

    /// Pixels of a PNG per unit of the SVG.
    pub fn png_scale(&self) -> f64 {
        match self.width() {
            None => DEFAULT_SCALE,
            Some(Width::Millimetres(_)) => 300.0 / 96.0, // a unit is 1/96 inch
            Some(Width::Pixels(_) | Width::Slide) => 1.0,
        }
    }
}

/// The sheet with the highest frame that leaves it no higher than a slide; as it is, where its frame has a shape of its own.
fn on_slide(figure: &dyn Figure, room: Room, whole: String) -> Result<String> {
    let fits = |svg: &str| sized(svg).is_none_or(|(_, [_, height], _)| height <= SLIDE[1]);
    if fits(&whole) {
        return Ok(whole);
    }
    for height in LOWER {
        let lower = figure.sheet(room.with_height(height))?.finish();
        if fits(&lower) {
            return Ok(lower);
        }
    }
    Ok(whole)
}

/// The first tag of a sheet up to its width, its size, and what follows.
fn sized(svg: &str) -> Option<(&str, [f64; 2], &str)> {
    let (before, rest) = svg.split_once(" width=\"")?;
    let (width, rest) = rest.split_once("\" height=\"")?;
    let (height, rest) = rest.split_once('"')?;
    Some((before, [width.parse().ok()?, height.parse().ok()?], rest))
}

/// The same sheet at another size: the first tag says both its size and the part of the plane that it shows.
fn resized(svg: &str, width: Width) -> String {
    let sheet = || {
        let (before, [old_width, old_height], rest) = sized(svg)?;
        let ratio = old_height / old_width;
        let (size, unit) = match width {
            Width::Millimetres(size) => (size, "mm"),
            Width::Pixels(size) => (size, ""),
            Width::Slide => (1920.0, ""),
        };
        let height = (size * ratio * 100.0).round() / 100.0;
        Some(format!("{before} width=\"{size}{unit}\" height=\"{height}{unit}\"{rest}"))
    };
    sheet().unwrap_or_else(|| svg.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Chart;

    fn figure() -> Chart {
        let names = ["*x*_*n*", "*x*_{*n*+1}"].map(str::to_owned);
        Chart {
            title: "Own title".into(),
            caption: vec!["Own caption.".into()],
            ..Chart::return_map(names, vec![[0.0, 1.0], [1.0, 0.5]])
        }
    }

    #[test]
    fn widths_have_units() {
        let read = |text: &str| text.parse::<Width>().expect("a width");
        assert_eq!(read("86mm"), Width::Millimetres(86.0));
        assert_eq!(read("8.6 cm"), Width::Millimetres(86.0));
        assert_eq!(read("3.5in"), Width::Millimetres(25.4 * 3.5));
        assert_eq!(read("1200px"), Width::Pixels(1200.0));
        for bad in ["86", "mm", "", "1e9mm", "-5px", "nanmm", "3furlong"] {
            assert!(bad.parse::<Width>().is_err(), "{bad}");
        }
    }

    #[test]
    fn words_are_replaced_and_the_sheet_has_the_width() {
        let style = Style {
            title: Some("Another".into()),
            no_caption: true,
            width: Some(Width::Millimetres(86.0)),
            ..Style::default()
        };
        let drawn = style.draw(&mut figure()).expect("a figure");
        assert!(drawn.svg.contains(">Another<") && !drawn.svg.contains("Own"), "{}", drawn.svg);
        assert!(drawn.svg.contains(" width=\"86mm\""));
        let png = crate::png(&drawn.svg, style.png_scale(), &[]).expect("a picture");
        let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a header");
        assert_eq!(reader.info().width, 1016); // 86 mm at 300 dots per inch, rounded up
        let plain = Style::default().draw(&mut figure()).expect("a figure");
        assert_eq!(plain.svg, figure().svg().expect("a figure"));
    }

    #[test]
    fn a_figure_without_words_leaves_none_to_the_text() {
        let style = Style { medium: Some(Medium::Journal), ..Style::default() };
        let left = |figure: &mut Chart| style.draw(figure).expect("a figure").caption;
        assert_eq!(left(&mut figure()).as_deref(), Some("Own title\nOwn caption.\n"));
        let mut bare = Chart { title: String::new(), caption: Vec::new(), ..figure() };
        assert_eq!(left(&mut bare), None);
    }

    #[test]
    fn pixels_are_those_of_the_picture() {
        let style = Style { width: Some(Width::Pixels(700.0)), ..Style::default() };
        let drawn = style.draw(&mut figure()).expect("a figure");
        let png = crate::png(&drawn.svg, style.png_scale(), &[]).expect("a picture");
        let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a header");
        assert_eq!(reader.info().width, 700);
    }
}
