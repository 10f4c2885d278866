//! Every kind of figure once, from data of a small formula: what the gallery draws and what the reference pictures show.

use std::f64::consts::TAU;

use motiform_figures::palette::{BLUE, CATEGORIES, VERMILION};
use motiform_figures::{
    BandCurve, BandFigure, BandPoint, BoundaryLine, BranchDiagram, BranchDots, BranchMark, BranchPart, Cell,
    Curve, CurveMap, CurveStyle, ErrorBarFigure, ErrorBarSeries, ExpectedLine, Figure, Glyph, Interval,
    LineStyle, MapCurve, MapEnd, MapInset, MapMark, MapPlace, Measured, OutlineStamp, Panel, Panels,
    PathFigure, PathPoint, PhaseDiagram, PlaceMap, ReturnMapFigure, SectionLine, SeriesFigure,
    SpaceTimeFigure, SpectrumCurve, SpectrumFigure, SurvivalCurve, SurvivalFigure, SurvivalStep, TrackPanel,
    TrackPanels,
};

/// A figure and its name.
pub(crate) type Kind = (&'static str, Box<dyn Figure>);

/// One figure of each kind.
pub(crate) fn kinds() -> Vec<Kind> {
    vec![
        ("path", Box::new(path(400, 14))),
        ("path-section", Box::new(section())),
        ("path-crowded", Box::new(path(60_000, 0))),
        ("series", Box::new(series())),
        ("return-map", Box::new(return_map())),
        ("space-time", Box::new(space_time())),
        ("spectrum", Box::new(spectrum(1e-3))),
        ("spectrum-deep", Box::new(spectrum(1e-26))),
        ("phase-tiles", Box::new(phase_diagram(9, 6))),
        ("phase-mosaic", Box::new(phase_diagram(60, 50))),
        ("strip", Box::new(strip())),
        ("branches", Box::new(branches(false))),
        ("period", Box::new(branches(true))),
        ("curves", Box::new(curves(None, false))),
        ("curves-over", Box::new(curves(Some(phase_diagram(40, 30)), false))),
        ("atlas", Box::new(curves(Some(phase_diagram(64, 64)), true))),
        ("bands", Box::new(bands(false))),
        ("bands-logarithmic", Box::new(bands(true))),
        ("error-bars", Box::new(exponents())),
        ("error-bars-logarithmic", Box::new(rest_times())),
        ("survival", Box::new(survival())),
        ("places", Box::new(places())),
        ("tracks", Box::new(tracks())),
        ("panels", Box::new(panels())),
    ]
}

fn words() -> Vec<String> {
    vec![
        "Tensor model, in model units: *γ* = 1, *κ*_2 = 0.9, *κ*_3 = 0.1; all other parameters 0.".to_owned(),
        "The first 100 time units are not shown.".to_owned(),
    ]
}

fn axis(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count.max(2) - 1) as f64).collect()
}

/// Like white noise, a function of the index.
fn noise(i: usize) -> f64 {
    (1e4 * (12.9898 * i as f64).sin()).fract().abs() + 0.05
}

fn ellipse([x, y]: [f64; 2], radius: f64, turn: f64) -> Vec<[f64; 2]> {
    let vertex = |angle: f64| {
        let r = radius * (1.0 - 0.2 * (2.0 * angle).cos() + 0.12 * (3.0 * angle).cos());
        [x + r * (angle + turn).cos(), y + r * (angle + turn).sin()]
    };
    axis(0.0, TAU, 80).into_iter().map(vertex).collect()
}

fn path(count: usize, stamps: usize) -> PathFigure {
    let turns = if stamps > 0 { 30.0 } else { 3000.0 };
    let at = |t: f64| [t * 30.0 / turns, 4.0 * (t / 3.0).sin()];
    let point = |t: f64| PathPoint { t, x: at(t)[0], y: at(t)[1] };
    let stamp = |t: f64| OutlineStamp { t, points: ellipse(at(t), 1.0, (t / 3.0).cos()) };
    PathFigure {
        title: "Zigzag motion, *κ*_2 = 0.9, *κ*_3 = 0.1".into(),
        caption: words(),
        segments: vec![axis(0.0, turns, count).into_iter().map(point).collect()],
        outlines: axis(0.0, turns, stamps).into_iter().map(stamp).collect(),
        ..PathFigure::default()
    }
}

fn section() -> PathFigure {
    let at = |t: f64| (4.0 + (1.7 * t).cos(), 0.9 * t);
    let point = |t: f64| PathPoint { t, x: at(t).0 * at(t).1.cos(), y: at(t).0 * at(t).1.sin() };
    let line = SectionLine {
        from: [-3.0, 3.0],
        to: [3.0, 3.0],
        label: "section *y* = 3".into(),
        crossings: (0..9).map(|i| [-2.4 + 0.6 * f64::from(i), 3.0]).collect(),
    };
    PathFigure {
        title: "Section of a quasi-periodic orbit".into(),
        segments: vec![axis(0.0, 40.0, 3000).into_iter().map(point).collect()],
        section: Some(line),
        ..path(2, 0)
    }
}

fn series() -> SeriesFigure {
    let times = axis(0.0, 200.0, 1500);
    let curve = |label: &str, colour, f: fn(f64) -> Option<f64>| Curve {
        label: label.into(),
        colour,
        values: times.iter().map(|t| f(*t)).collect(),
    };
    let speed = curve("", BLUE, |t| Some(0.8 + 0.1 * (t / 3.0).sin()));
    let turning = curve("", BLUE, |t| ((t / 30.0).sin() < 0.95).then(|| 0.02 * (t / 6.0).sin()));
    let first = curve("|*U*| of the model", BLUE, |t| Some(12_000.0 * (t / 9.0).cos().powi(2)));
    let second = curve("|*V*|", VERMILION, |t| Some(9000.0 * (t / 17.0).sin().powi(2)));
    SeriesFigure {
        title: "Zigzag motion".into(),
        panels: vec![
            Panel { label: "speed |***v***|".into(), curves: vec![speed] },
            Panel { label: "turning rate".into(), curves: vec![turning] },
            Panel { label: "size".into(), curves: vec![first, second] },
        ],
        notes: vec!["The turning rate is undefined where the body is at rest.".into()],
        caption: words(),
        times,
        ..SeriesFigure::default()
    }
}

fn return_map() -> ReturnMapFigure {
    let mut x = 0.3;
    let mut step = || {
        let old = x;
        x = 3.9 * x * (1.0 - x);
        [6.0 * old - 3.0, 6.0 * x - 3.0]
    };
    ReturnMapFigure {
        title: "Return map of the section *y* = 3".into(),
        caption: words(),
        points: (0..400).map(|_| step()).collect(),
        ..ReturnMapFigure::default()
    }
}

fn space_time() -> SpaceTimeFigure {
    let (columns, rows) = (120, 64);
    let value = |i: usize| {
        let (t, s) = ((i % columns) as f64, (i / columns) as f64 / rows as f64);
        0.9 * (0.11 * t).sin() * (TAU * s).cos() + 0.6 * (2.0 * TAU * s + 0.1 * t).sin()
    };
    SpaceTimeFigure {
        title: "Active cell: *φ*(*s*, *t*)".into(),
        caption: words(),
        times: (1000.0, 1600.0),
        places: (0.0, 21.6),
        columns,
        rows,
        values: (0..columns * rows).map(value).collect(),
        ..SpaceTimeFigure::default()
    }
}

fn spectrum(floor: f64) -> SpectrumFigure {
    let frequencies = axis(0.0, 5.0, 900);
    let power = |i: usize, f: f64| noise(i) * (floor + 1.0 / (1.0 + (30.0 * f).powi(4))) / (1.0 + f);
    let peak = |f: f64| 1e-4 / ((f - 0.4).powi(2) + 1e-3);
    let curve = |n: usize| SpectrumCurve {
        label: format!("mode {}", n + 1),
        colour: CATEGORIES[n],
        power: frequencies
            .iter()
            .enumerate()
            .map(|(i, f)| power(i + n, *f) + n as f64 * floor * peak(*f))
            .collect(),
    };
    SpectrumFigure {
        title: "Power spectrum".into(),
        caption: words(),
        curves: (0..2).map(curve).collect(),
        frequencies,
        ..SpectrumFigure::default()
    }
}

/// Regimes in wavy regions, two motions where they overlap.
fn shares(x: f64, y: f64) -> Vec<(String, f64)> {
    let names = ["motionless", "straight", "circular", "rectangular", "quasi-periodic", "zigzag", "chaotic"];
    let u = 2.2 * (x + 1.5) + 0.7 * (5.0 * y).sin();
    let name = |u: f64| names[(u.max(0.0) as usize).min(names.len() - 1)].to_owned();
    if name(u) == name(u + 0.25) {
        vec![(name(u), 1.0)]
    } else {
        vec![(name(u), 0.625), (name(u + 0.25), 0.375)]
    }
}

fn phase_diagram(columns: usize, rows: usize) -> PhaseDiagram {
    let (x, y) = (axis(-1.5, 1.5, columns), axis(0.0, 1.0, rows));
    let line = |label: &str, style, f: fn(f64) -> f64| BoundaryLine {
        label: label.into(),
        style,
        points: axis(-3.0, 3.0, 200).into_iter().map(|x| [x, f(x)]).collect(),
    };
    PhaseDiagram {
        title: "Motions over *κ*_2 and *κ*_3".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: "*κ*_3".into(),
        cells: y
            .iter()
            .flat_map(|y| x.iter().map(|x| Cell { x: *x, y: *y, shares: shares(*x, *y) }))
            .collect(),
        x,
        y,
        lines: vec![
            line("drift bifurcation", LineStyle::Solid, |x| x),
            line("Hopf", LineStyle::Dashed, |x| 0.8 - 0.4 * x * x),
        ],
    }
}

fn strip() -> PhaseDiagram {
    let x = axis(0.0, 1.3, 24);
    PhaseDiagram {
        title: "Motions over *K*".into(),
        caption: words(),
        x_label: "*K*".into(),
        cells: x.iter().map(|x| Cell { x: *x, y: 0.0, shares: shares(2.2 * x - 1.4, 0.4) }).collect(),
        x,
        ..PhaseDiagram::default()
    }
}

fn branches(logarithmic: bool) -> BranchDiagram {
    let part = |regime: &str, stable, from: f64, to: f64, f: fn(f64) -> f64| BranchPart {
        regime: regime.into(),
        stable,
        points: axis(from, to, 60).into_iter().map(|x| [x, f(x)]).collect(),
    };
    let mark = |label: &str, glyph, at| BranchMark { label: label.into(), glyph, at };
    BranchDiagram {
        title: "Zigzag motion, along *κ*_2".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: if logarithmic { "period" } else { "mean speed" }.into(),
        logarithmic,
        x: [0.3, 1.6],
        parts: vec![
            part("straight", true, 0.3, 0.7, |_| 1.0),
            part("straight", false, 0.7, 1.6, |_| 1.0),
            part("zigzag", true, 0.7, 1.3, |x| 1.0 - 0.6 * (x - 0.7).sqrt()),
            part("chaotic", false, 1.3, 1.6, |x| 0.535 - 0.3 * (x - 1.3)),
            part("circular", false, 0.5, 1.2, |x| 40.0 * (x - 0.49).powi(-2)),
        ],
        dots: vec![BranchDots {
            label: "simulated, upwards".into(),
            up: true,
            points: axis(0.3, 1.6, 27).into_iter().map(|x| [x, 0.9]).collect(),
        }],
        marks: vec![
            mark("Hopf", Glyph::Disc, [0.7, 1.0]),
            mark("symmetry breaking", Glyph::Square, [1.3, 0.535]),
        ],
    }
}

fn curves(under: Option<PhaseDiagram>, named: bool) -> CurveMap {
    let curve = |label: &str, style, bounds, f: fn(f64) -> f64| MapCurve {
        label: label.into(),
        style,
        bounds,
        points: axis(-1.5, 1.5, 90).into_iter().map(|x| [x, f(x)]).collect(),
    };
    let shown =
        under.as_ref().map_or([0.0, 0.0], |under| [under.x[under.x.len() - 3], under.y[under.y.len() / 2]]);
    let zigzag = axis(0.0, 12.0, 80).into_iter().map(|t| [t, 2.0 * t.sin()]).collect();
    CurveMap {
        title: "Curves of bifurcations".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: "*κ*_3".into(),
        x: [-1.5, 1.5],
        y: [0.0, 1.0],
        under,
        named,
        insets: vec![MapInset { cell: shown, paths: vec![zigzag] }],
        curves: vec![
            curve("Hopf, supercritical", CurveStyle::Line(LineStyle::Solid), true, |x| 0.5 + 0.3 * x),
            curve("Hopf, subcritical", CurveStyle::Line(LineStyle::LongDashed), true, |x| 0.7 - 0.2 * x * x),
            curve("fold", CurveStyle::Thick, true, |x| 0.2 + 0.1 * x * x),
            curve("torus", CurveStyle::DashDotDotted, false, |x| 0.9 - 0.1 * x),
        ],
        ends: vec![MapEnd { label: "homoclinic".into(), at: [1.1, 0.3] }],
        marks: vec![
            MapMark { label: "Bautin".into(), at: [0.48, 0.65] },
            MapMark { label: "Bogdanov-Takens".into(), at: [-0.9, 0.24] },
        ],
    }
}

fn bands(logarithmic: bool) -> BandFigure {
    let f = |x: f64| if logarithmic { x * x / (1.0 + 0.2 * x) } else { (-0.3 * x).exp() * x.cos() };
    let point = |x: f64| BandPoint { x, y: f(x), low: 0.8 * f(x) - 0.02, high: 1.2 * f(x) + 0.02 };
    BandFigure {
        title: "Mean-square displacement".into(),
        caption: words(),
        x_label: "lag".into(),
        y_label: "MSD".into(),
        curves: vec![BandCurve {
            label: "60 bodies".into(),
            points: axis(0.1, 12.0, 60).into_iter().map(point).collect(),
        }],
        lines: vec![ExpectedLine {
            label: "persistent walk".into(),
            style: LineStyle::Dashed,
            points: vec![[0.1, f(0.1)], [12.0, f(12.0)]],
        }],
        zero_line: !logarithmic,
        logarithmic_x: logarithmic,
        logarithmic_y: logarithmic,
    }
}

fn exponents() -> ErrorBarFigure {
    let point = |i: usize| {
        let x = 0.35 + 0.01 * i as f64;
        Measured { x, y: 0.05 * (x - 0.48).max(0.0).sqrt(), error: 0.0015 + 0.002 * noise(i) }
    };
    let below = |i: usize| Measured { x: 0.35 + 0.01 * i as f64, y: -0.01 - 3e-4 * i as f64, error: 5e-4 };
    let series = |label: &str, points, joined| ErrorBarSeries { label: label.into(), points, joined };
    ErrorBarFigure {
        title: "Lyapunov exponents".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: "*λ*".into(),
        series: vec![
            series("*λ*_1", (0..30).map(point).collect(), true),
            series("*λ*_2", (0..30).map(below).collect(), false),
        ],
        zero_line: true,
        ..ErrorBarFigure::default()
    }
}

fn rest_times() -> ErrorBarFigure {
    let point = |i: usize| {
        let sigma = 10f64.powf(-8.0 + 0.5 * i as f64);
        Measured { x: sigma, y: 40.0 - 3.1 * sigma.ln() + 4.0 * noise(i), error: 3.0 }
    };
    ErrorBarFigure {
        title: "Mean rest time".into(),
        caption: words(),
        x_label: "noise amplitude *σ*".into(),
        y_label: "mean rest time".into(),
        series: vec![ErrorBarSeries {
            label: "runs".into(),
            points: (0..12).map(point).collect(),
            joined: false,
        }],
        intervals: vec![Interval { x: 1e-5, low: 60.0, high: 90.0 }],
        lines: vec![ExpectedLine {
            label: "slope -1/*λ*_u".into(),
            style: LineStyle::Dashed,
            points: vec![[1e-9, 104.2], [1.0, 40.0]],
        }],
        logarithmic_x: true,
        ..ErrorBarFigure::default()
    }
}

fn survival() -> SurvivalFigure {
    let curve = |label: &str, count: usize, mean: f64| {
        let step = |i: usize| {
            let share = (count - i) as f64 / count as f64;
            let error = 1.96 * (share * (1.0 - share) / count as f64).sqrt();
            SurvivalStep { t: -mean * share.ln(), share, low: share - error, high: (share + error).min(1.0) }
        };
        SurvivalCurve {
            label: label.into(),
            steps: (0..count).map(step).collect(),
            end: mean * (count as f64).ln(),
        }
    };
    SurvivalFigure {
        title: "How long chaos lasts".into(),
        caption: words(),
        x_label: "*t* (1000)".into(),
        curves: vec![curve("*κ*_2 = 0.9", 90, 1.3), curve("*κ*_2 = 0.95", 30, 2.9)],
        lines: vec![ExpectedLine {
            label: "exponential law".into(),
            style: LineStyle::Dashed,
            points: vec![[0.0, 1.0], [6.5, (-5f64).exp()]],
        }],
        ..SurvivalFigure::default()
    }
}

fn places() -> PlaceMap {
    let place = |name: &str, at: [f64; 2]| MapPlace {
        name: name.into(),
        at,
        region: ellipse(at, 0.1, 0.4),
        cloud: (0..20).map(|i| [at[0] + 0.2 * noise(i) - 0.1, at[1] + 0.1 * noise(i + 50) - 0.05]).collect(),
    };
    PlaceMap {
        title: "Two cells on the plane of Fig. 4".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: "*κ*_3".into(),
        under: phase_diagram(40, 30),
        region_label: "95 % region".into(),
        cloud_label: "samples".into(),
        places: vec![place("cell 1", [0.2, 0.5]), place("cell 2", [-0.8, 0.3])],
    }
}

fn tracks() -> TrackPanels {
    let panel = |k: u32| {
        let way = |t: f64| [t, (t / (2.0 + f64::from(k))).sin()];
        TrackPanel {
            name: format!("cell {k}, 0 to 120 min"),
            path: vec![axis(0.0, 12.0, 60).into_iter().map(way).collect()],
            outlines: axis(0.0, 12.0, 6).into_iter().map(|t| ellipse(way(t), 1.0, t)).collect(),
        }
    };
    TrackPanels {
        title: "Outlines".into(),
        caption: words(),
        unit: "µm".into(),
        columns: 2,
        panels: (1..=4).map(panel).collect(),
    }
}

fn panels() -> Panels {
    Panels::new(1, vec![Box::new(series()), Box::new(branches(false)), Box::new(bands(true))])
}
