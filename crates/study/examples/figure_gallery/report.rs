//! A report with every kind of verdict.

use std::path::Path;

use motiform_study::report::{Claim, Picture, Report, ReportFigure, Section, Source, Verdict};

use super::diagrams::phase_diagram;
use super::{Outcome, return_map};

pub(super) fn write(folder: &Path) -> Outcome {
    let report = Report {
        title: "A report on *κ*_2 and *κ*_3".into(),
        about:
            "Every figure and every claim, computed anew.\n\nAll data come from a formula of this example."
                .into(),
        sections: vec![phases()?, chaos()?],
        sentences: Vec::new(),
    };
    let html = report.html();
    println!("report: {} kB, all hold: {}", html.len() / 1000, report.all_hold());
    Ok(std::fs::write(folder.join("report.html"), html)?)
}

fn phases() -> Result<Section, Box<dyn std::error::Error>> {
    let parameter = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    Ok(Section {
        title: "Phase diagram over *κ*_2 and *κ*_3 (Fig. 3)".into(),
        about: "Which motion occurs where, from 8 initial states each.".into(),
        parameters: vec![
            parameter("*γ*", "1"),
            parameter("*a*_1", "-1"),
            parameter("*b*_1, *b*_2", "-0.5, 0.3"),
            parameter("method", "Runge–Kutta 4(5)"),
            parameter("relative tolerance", "10^{-9}"),
        ],
        figures: vec![ReportFigure {
            caption: "Regimes; lines: where the straight motion loses its stability.".into(),
            picture: Picture::Svg(phase_diagram(12, 6).svg()?),
        }],
        claims: vec![
            Claim {
                source: Source::Ours,
                says: "The straight motion loses its stability at *κ*_2 = *κ*_3.".into(),
                finds: "At *κ*_2 = 0.5000 ± 0.0002 for *κ*_3 = 0.5.".into(),
                how: "sign of the largest real part, bisected to 10^{-4}; agreement within 10^{-3}".into(),
                verdict: Verdict::Holds,
            },
            Claim {
                source: Source::Ours,
                says: "Zigzag motion has the period 36.2.".into(),
                finds: "35.9 model times.".into(),
                how: "mean distance of 50 crossings; agreement within 0.5 %".into(),
                verdict: Verdict::Differs {
                    explanation: "The printed *d*_2 is rounded to one digit; 0.83 instead of 0.8 gives 36.2."
                        .into(),
                },
            },
        ],
    })
}

fn chaos() -> Result<Section, Box<dyn std::error::Error>> {
    Ok(Section {
        title: "Chaotic motion (Fig. 4)".into(),
        about: "The return map of the section *y* = 3.".into(),
        figures: vec![ReportFigure {
            caption: "*x*_{*n*+1} against *x*_*n*.".into(),
            picture: Picture::Svg(return_map(3000).svg()?),
        }],
        claims: vec![Claim {
            source: Source::Ours,
            says: "The largest Lyapunov exponent is 0.012.".into(),
            finds: "*λ*_1 = 0.0003 ± 0.0004.".into(),
            how: "tangent flow over 10^{6} model times; 95 % interval".into(),
            verdict: Verdict::Fails {
                explanation: "The interval holds 0: no chaos is found at these values.".into(),
            },
        }],
        ..Section::default()
    })
}
