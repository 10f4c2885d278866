//! Maps and diagrams over parameters.

use super::{axis, ellipse, noise, words};
use motiform_figures::{
    BranchDiagram, BranchDots, BranchMark, BranchPart, Cell, Chart, CurveMap, CurveStyle, ExpectedLine,
    Glyph, LineStyle, MapCurve, MapEnd, MapInset, MapMark, MapPlace, PhaseDiagram, PlaceMap, Stability,
};

/// Regimes in wavy regions, two motions where they overlap.
pub(super) fn shares(x: f64, y: f64) -> Vec<(String, f64)> {
    let names = ["motionless", "straight", "circular", "rectangular", "quasi-periodic", "zigzag", "chaotic"];
    let u = 2.2 * (x + 1.5) + 0.7 * (5.0 * y).sin();
    let name = |u: f64| names[(u.max(0.0) as usize).min(names.len() - 1)].to_owned();
    if name(u) == name(u + 0.25) {
        vec![(name(u), 1.0)]
    } else {
        vec![(name(u), 0.625), (name(u + 0.25), 0.375)]
    }
}

pub(crate) fn phase_diagram(columns: usize, rows: usize) -> PhaseDiagram {
    let (x, y) = (axis(-1.5, 1.5, columns), axis(0.0, 1.0, rows));
    let line = |label: &str, style, f: fn(f64) -> f64| ExpectedLine {
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

pub(crate) fn strip(columns: usize) -> PhaseDiagram {
    let x = axis(0.0, 1.3, columns);
    PhaseDiagram {
        title: "Motions over *K*".into(),
        caption: words(),
        x_label: "*K*".into(),
        cells: x.iter().map(|x| Cell { x: *x, y: 0.0, shares: shares(2.2 * x - 1.4, 0.4) }).collect(),
        x,
        ..PhaseDiagram::default()
    }
}

pub(super) fn branches(logarithmic: bool) -> Chart {
    let part = |regime: &str, stable, from: f64, to: f64, f: fn(f64) -> f64| BranchPart {
        regime: regime.into(),
        stability: if stable { Stability::Stable } else { Stability::Unstable },
        points: axis(from, to, 60).into_iter().map(|x| [x, f(x)]).collect(),
    };
    let mark = |label: &str, glyph, at| BranchMark { label: label.into(), glyph, at };
    Chart {
        title: "Zigzag motion, along *κ*_2".into(),
        caption: words(),
        x_label: "*κ*_2".into(),
        y_label: if logarithmic { "period" } else { "mean speed" }.into(),
        logarithmic_y: logarithmic,
        ..Chart::default()
    }
    .with([BranchDiagram {
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
    }])
}

pub(super) fn curves(under: Option<PhaseDiagram>, named: bool) -> CurveMap {
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

pub(super) fn places() -> PlaceMap {
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
