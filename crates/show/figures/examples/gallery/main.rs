//! Draws every kind of figure from data of a small formula, extreme shapes included, to look at; each kind
//! also in a column of 86 mm and on a slide.
//!
//! `cargo run --release -p motiform-figures --example gallery -- FOLDER`

mod kinds;

use std::f64::consts::TAU;
use std::path::Path;

use motiform_figures::palette::CATEGORIES;
use motiform_figures::{
    Animation, Camera, Chart, DEFAULT_SCALE, Frame, Medium, OutlineStamp, PathFigure, PathPoint, SectionLine,
    SpaceTimeFigure, SpectrumCurve, Style, Width, png,
};

/// Drawing may fail, writing may fail: an example just says which.
type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A position as a function of time.
type Orbit = fn(f64) -> [f64; 2];

fn main() -> Outcome {
    let folder = std::env::args().nth(1).ok_or("give a folder to write to")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    paths(folder)?;
    save(folder, "return_map_dense", &kinds::return_map(20_000).svg()?)?;
    fields(folder)?;
    spectra(folder)?;
    maps(folder)?;
    sizes(folder)?;
    films(folder)
}

/// Every kind at the sizes of its reference pictures.
fn sizes(folder: &Path) -> Outcome {
    let column = Style { width: Some(Width::Millimetres(86.0)), ..Style::default() };
    let slide = Style { medium: Some(Medium::Slide), ..Style::default() };
    for (size, style) in [("86mm", column), ("slide", slide)] {
        for (name, mut figure) in kinds::kinds() {
            let svg = style.draw(figure.as_mut())?.svg;
            std::fs::write(folder.join(format!("{name}-{size}.png")), png(&svg, style.png_scale(), &[])?)?;
        }
    }
    Ok(())
}

/// Maps of few and of many cells.
fn maps(folder: &Path) -> Outcome {
    for (columns, rows) in [(12, 6), (16, 6), (40, 40), (64, 64), (200, 200), (3, 2)] {
        save(folder, &format!("phase_{columns}x{rows}"), &kinds::phase_diagram(columns, rows).svg()?)?;
    }
    for columns in [12, 130] {
        save(folder, &format!("strip_{columns}"), &kinds::strip(columns).svg()?)?;
    }
    Ok(())
}

fn save(folder: &Path, name: &str, svg: &str) -> Outcome {
    let start = std::time::Instant::now();
    std::fs::write(folder.join(format!("{name}.svg")), svg)?;
    std::fs::write(
        folder.join(format!("{name}.png")),
        png(svg, DEFAULT_SCALE, &[("Software", "motiform")])?,
    )?;
    std::fs::write(folder.join(format!("{name}.pdf")), motiform_figures::pdf(svg)?)?;
    println!("{name}: svg {} kB, files written in {:.0?}", svg.len() / 1000, start.elapsed());
    Ok(())
}

fn paths(folder: &Path) -> Outcome {
    let cases: [(&str, Orbit, f64, usize, usize, f64); 10] = [
        ("zigzag_wide", |t| [t, 4.0 * (t / 6.0).sin()], 150.0, 3000, 18, 2.0),
        ("zigzag_tall", |t| [6.0 * (t / 8.0).sin(), t], 160.0, 3000, 12, 4.0),
        ("circle", |t| [3.0 * t.cos(), 3.0 * t.sin()], 6.0, 500, 8, 0.7),
        (
            "rosette",
            |t| [(3.0 + (2.618 * t).cos()) * t.cos(), (3.0 + (2.618 * t).cos()) * t.sin()],
            900.0,
            100_000,
            0,
            0.0,
        ),
        ("line", |t| [0.1 * t, -t], 180.0, 2, 6, 6.0),
        ("horizontal", |t| [t, 0.0], 60.0, 50, 5, 1.0),
        ("point", |_| [2.5, -1.0], 0.0, 1, 1, 0.3),
        ("bare_point", |_| [0.0, 0.0], 0.0, 1, 0, 0.0),
        ("tiny", |t| [0.02 * (t / 3.0).cos() * 1e-4, 0.011 * (t / 2.0).sin() * 1e-4], 30.0, 4000, 0, 0.0),
        ("blow_up", |t| [(0.12 * t).exp() * t.cos(), (0.12 * t).exp() * t.sin()], 60.0, 4000, 14, 60.0),
    ];
    for (name, orbit, t_end, count, stamps, radius) in cases {
        save(folder, name, &path_figure(name, orbit, t_end, count, stamps, radius).svg()?)?;
    }
    save(folder, "section", &section().svg()?)
}

fn path_figure(name: &str, orbit: Orbit, t_end: f64, count: usize, stamps: usize, radius: f64) -> PathFigure {
    let time = |i: usize, n: usize| t_end * i as f64 / (n.max(2) - 1) as f64;
    let point = |t| PathPoint { t, x: orbit(t)[0], y: orbit(t)[1] };
    let stamp = |t| OutlineStamp { t, points: outline(orbit(t), heading(orbit, t), radius, 120) };
    PathFigure {
        title: format!("{}, *κ*_2 = 0.9, *κ*_3 = 0.1", name.replace('_', " ")),
        caption: vec![
            "Full tensor model: *γ* = 1, *a*_1 = -1, *b*_1 = -0.5, *b*_2 = 0.3, *d*_1 = 0.1, *d*_2 = 0.8, all other \
             coefficients 0."
                .into(),
            "Runge–Kutta 4(5), relative tolerance 10^{-9}; outlines at true scale, *R*_0 = 1.".into(),
        ],
        segments: vec![(0..count).map(|i| point(time(i, count))).collect()],
        outlines: (0..stamps).map(|i| stamp(time(i, stamps))).collect(),
        ..PathFigure::default()
    }
}

fn films(folder: &Path) -> Outcome {
    let zigzag: Orbit = |t| [0.3 * t, 2.0 * (t / 6.0).sin()];
    let circle: Orbit = |t| [3.0 * (0.2 * t).cos(), 3.0 * (0.2 * t).sin()];
    let cases = [
        ("zigzag", zigzag, Camera::Auto),
        ("zigzag_follow", zigzag, Camera::Follow),
        ("circle", circle, Camera::Auto),
    ];
    for (name, orbit, camera) in cases {
        let time = |i: usize| 0.5 * i as f64;
        let frame =
            |t| Frame { t, centre: orbit(t), outline: outline(orbit(t), heading(orbit, t), 1.0, 128) };
        let film =
            Animation { frames: (0..200).map(|i| frame(time(i))).collect(), camera, ..Animation::default() };
        let start = std::time::Instant::now();
        let apng = film.apng()?;
        println!("film {name}: 200 frames, {} kB in {:.0?}", apng.len() / 1000, start.elapsed());
        std::fs::write(folder.join(format!("film_{name}.png")), apng)?;
    }
    Ok(())
}

fn heading(orbit: Orbit, t: f64) -> f64 {
    let (a, b) = (orbit(t - 1e-4), orbit(t + 1e-4));
    (b[1] - a[1]).atan2(b[0] - a[0])
}

/// An ellipse with a three-fold part.
fn outline(centre: [f64; 2], heading: f64, radius: f64, count: usize) -> Vec<[f64; 2]> {
    let vertex = |i: usize| {
        let angle = TAU * i as f64 / count as f64;
        let r = radius * (1.0 - 0.2 * (2.0 * angle).cos() + 0.12 * (3.0 * angle).cos());
        [centre[0] + r * (angle + heading).cos(), centre[1] + r * (angle + heading).sin()]
    };
    (0..count).map(vertex).collect()
}

fn section() -> PathFigure {
    let orbit: Orbit =
        |t| [(4.0 + (1.7 * t).cos()) * (0.9 * t).cos(), (4.0 + (1.7 * t).cos()) * (0.9 * t).sin()];
    let mut figure = path_figure("section", orbit, 40.0, 4000, 0, 0.0);
    let pairs = figure.segments[0].windows(2).filter(|w| w[0].y < 3.0 && w[1].y >= 3.0 && w[0].x.abs() < 3.0);
    let crossings = pairs.map(|w| [0.5 * (w[0].x + w[1].x), 3.0]).collect();
    figure.title = "Section of a quasi-periodic orbit".into();
    figure.section = Some(SectionLine {
        from: [-3.0, 3.0],
        to: [3.0, 3.0],
        label: "section *y* = 3, |*x*| < 3".into(),
        crossings,
    });
    figure
}

fn fields(folder: &Path) -> Outcome {
    type Field = fn(f64, f64) -> f64;
    type Case = (&'static str, Field, (f64, f64), usize, usize);
    let wave: Field = |t, s| {
        let slow = (0.021 * t).sin() + 0.3 * (0.055 * t).cos();
        0.9 * slow * (TAU * s).cos() + 0.6 * (2.0 * TAU * s + 0.02 * t).sin()
    };
    let cases: [Case; 6] = [
        ("field", wave, (1000.0, 1600.0), 3000, 128),
        ("field_coarse", wave, (0.0, 300.0), 40, 16),
        ("field_wide", |t, s| 1e-5 * wave_packet(t, s), (0.0, 2e5), 20_000, 64),
        ("field_flat", |_, _| 0.0, (0.0, 100.0), 200, 64),
        ("field_positive", |t, s| 3e4 * (2.0 + (0.1 * t).sin() * (TAU * s).sin()), (0.0, 100.0), 400, 64),
        ("field_instant", |_, s| (TAU * s).sin(), (5.0, 5.0), 1, 64),
    ];
    for (name, field, times, columns, rows) in cases {
        let time = |i: usize| times.0 + (times.1 - times.0) * i as f64 / columns as f64;
        let value = |i: usize| field(time(i % columns), (i / columns) as f64 / rows as f64);
        let figure = SpaceTimeFigure {
            title: format!("Active cell model, *L* = 21.6: {}", name.replace('_', " ")),
            caption: vec!["ETDRK4, 48 modes, d*t* = 0.05.".into()],
            times,
            places: (0.0, 21.6),
            columns,
            rows,
            values: (0..columns * rows).map(value).collect(),
            ..SpaceTimeFigure::default()
        };
        save(folder, name, &figure.svg()?)?;
    }
    Ok(())
}

fn wave_packet(t: f64, s: f64) -> f64 {
    (-((t - 1e5) / 3e4).powi(2)).exp() * (TAU * s + 5e-4 * t).sin()
}

fn spectra(folder: &Path) -> Outcome {
    type Power = fn(usize, f64) -> f64;
    let line: Power =
        |i, f| kinds::noise(i) * 1e-4 / (1.0 + (30.0 * f).powi(4)) + 1e-6 / ((f - 0.1).powi(2) + 1e-6);
    let red: Power = |i, f| kinds::noise(i) / (1.0 + (100.0 * f).powi(2));
    let weak: Power = |i, f| 1e-3 * kinds::noise(i + 7) / (1.0 + (20.0 * f).powi(2));
    let cases: [(&str, usize, f64, Vec<Power>); 5] = [
        ("spectrum", 4096, 10.0, vec![line]),
        ("spectrum_eight_decades", 100_000, 50.0, vec![red, weak]),
        ("spectrum_single_peak", 256, 5.0, vec![|i, _| if i == 31 { 3.0 } else { 0.0 }]),
        ("spectrum_flat", 4, 3.0, vec![|_, _| 2e-5]),
        ("spectrum_deep", 2000, 100.0, vec![|i, f| kinds::noise(i) * ((-f).exp() + 1e-32)]),
    ];
    for (name, count, last, curves) in cases {
        let frequencies: Vec<f64> = (0..count).map(|i| last * i as f64 / (count - 1) as f64).collect();
        let curve = |(n, f): (usize, &Power)| SpectrumCurve {
            label: format!("|*v*|, *κ*_2 = 0.{n}"),
            colour: CATEGORIES[n],
            power: frequencies.iter().enumerate().map(|(i, x)| f(i, *x)).collect(),
        };
        let curves = curves.iter().enumerate().map(curve).collect();
        let figure = Chart {
            title: name.replace('_', " "),
            caption: vec!["Welch's method: Hann window, 8192 samples a segment, half overlapping.".into()],
            ..Chart::spectra(frequencies, curves)
        };
        save(folder, name, &figure.svg()?)?;
    }
    Ok(())
}
