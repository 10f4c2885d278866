//! Fig. 3: quasi-periodic motion: an annulus, and a return map that is a closed curve.

use super::claims::{check, claim};
use super::context::Context;
use motiform_analysis::regime::Regime;
use motiform_analysis::{Dimension, correlation_dimension, return_pairs};
use motiform_lab::{analyse, draw};
use motiform_report::{Claim, ReportFigure, Section};
use motiform_study::study::ReturnMapSettings;
use motiform_study::{Dataset, Error, Plan, Study};
use std::f64::consts::TAU;

const ABOUT: &str = "The shape repeats after a period, turned by an angle that is no rational part of a turn: in the plane the path \
is a rosette that fills an annulus. With rotations divided out, the motion is a stable periodic orbit, the 'modulated wave'; the \
second frequency is that of the rotation alone. The return map on a line through the annulus, put on the centre of the path, is a \
closed curve.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let study = context.preset("fig3", |study| {
        study.run.t_end = context.choose(40_000.0, 15_000.0);
        study.run.rtol = 1e-11;
        Ok(())
    })?;
    let dataset = context.simulate(&study)?;
    let radial = context.simulate(&through_the_centre(&study))?;
    let verdict = context.classify(&study)?;
    let (period, rotation) = (verdict.period.unwrap_or(f64::NAN), verdict.net_rotation.unwrap_or(f64::NAN));
    let says = "This circular motion does not have a single frequency but has a multi-frequency with irrational ratio, and therefore \
                the motion is quasi-periodic, for *γ* = 0.02 and *κ*_2 = -0.06.";
    let finds = format!(
        "{}: the reduced motion has the period {period:.5} and the net rotation {rotation:.6} rad = {:.6} turns",
        verdict.regime,
        rotation / TAU
    );
    let how = "the classifier: Newton's method on a return, all multipliers inside the unit circle, a net rotation that is not 0";
    let named =
        claim(&[102], says, finds, how, verdict.regime == Regime::QuasiPeriodic && rotation.abs() > 0.01);
    let claims = vec![
        named,
        annulus(&dataset),
        anticlockwise(&dataset),
        return_map(&dataset)?,
        radial_map(&radial)?,
        exponent(context, &study)?,
    ];
    let parameters = [
        ("parameters", "*κ*_2 = -0.06, *γ* = 0.02, *a*_1 = 1, *b*_1 = 0.5, *b*_3 = 1".to_owned()),
        ("method", "dop853, relative tolerance 10^{-11}".to_owned()),
        ("recording", format!("{} time units after {}", study.run.t_end, study.run.transient)),
    ];
    Ok(Section {
        title: "Fig. 3: quasi-periodic motion".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters.map(|(name, value)| (name.to_owned(), value)).to_vec(),
        figures: drawn(&dataset, &radial)?,
        claims,
        ..Section::default()
    })
}

/// The same motion, cut by the half line from the centre of the path.
fn through_the_centre(study: &Study) -> Study {
    let half_line = ReturnMapSettings { y: 0.0, x_min: 0.0, x_max: 1e3, centre: true };
    let mut through = Study { return_map: Some(half_line), ..study.clone() };
    through.run.t_end = 40_000.0; // it is crossed rarely
    through
}

fn drawn(dataset: &Dataset, radial: &Dataset) -> Result<Vec<ReportFigure>, Error> {
    let mut figures = Vec::new();
    for (name, drawn) in draw::drawn(dataset)? {
        match name {
            "path" => figures.push(ReportFigure::new(drawn, "(a) The beginning of the path: a rosette.")),
            "return-map" => {
                figures.push(ReportFigure::new(drawn, "(b) The return map of *x* on the paper's line."));
            }
            _ => {}
        }
    }
    let map = draw::drawn(radial)?.into_iter().find(|(name, _)| *name == "return-map");
    figures.extend(map.map(|(_, drawn)| {
        ReportFigure::new(
            drawn,
            "The return map on the half line from the centre of the path (*y* = 0, *x* > 0), which the paper does not show: *x* is the \
             distance from the centre.",
        )
    }));
    Ok(figures)
}

/// Smallest and largest distance from the centre of the path.
fn radii(x: &[f64], y: &[f64]) -> [f64; 2] {
    let radii = x.iter().zip(y).map(|(x, y)| libm::hypot(*x, *y));
    radii.fold([f64::INFINITY, 0.0], |[low, high], r| [f64::min(low, r), f64::max(high, r)])
}

fn annulus(dataset: &Dataset) -> Claim {
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let (x, y) = (column("x"), column("y"));
    let half = x.len() / 2;
    let [inner, outer] = radii(x, y);
    let halves = [radii(&x[..half], &y[..half]), radii(&x[half..], &y[half..])];
    let off =
        halves.iter().flat_map(|[low, high]| [(low - inner).abs(), (high - outer).abs()]).fold(0.0, f64::max);
    let finds = format!(
        "the path fills an annulus with radii {inner:.4} and {outer:.4}; its halves agree to {:.1e}",
        off / outer
    );
    let how = "distances from the time average of the path; both halves of the recording have the same radii to 1 %, and the inner \
               one is not 0";
    let says = "Fig. 3(a): a quasi-periodic path.";
    claim(&[131], says, finds, how, inner > 0.05 * outer && off < 0.01 * outer)
}

fn anticlockwise(dataset: &Dataset) -> Claim {
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let (vx, vy) = (column("v1"), column("v2"));
    let headings: Vec<f64> = vx.iter().zip(vy).map(|(vx, vy)| libm::atan2(*vy, *vx)).collect();
    let step = |pair: &[f64]| {
        let turn = pair[1] - pair[0];
        turn - TAU * (turn / TAU).round()
    };
    let turned: f64 = headings.windows(2).map(step).sum();
    let time = column("t").last().copied().unwrap_or(f64::NAN);
    let finds = format!("mean turning rate {:+.6} rad per time unit", turned / time);
    let how = "the heading's net change over the recording; positive is counterclockwise. The mirror image exists as well: the start \
               was chosen so";
    claim(&[131], "Rotating in the counterclockwise direction.", finds, how, turned > 0.0)
}

fn return_map(dataset: &Dataset) -> Result<Claim, Error> {
    let (dimension, points) = dimension_of_map(dataset)?;
    let finds = format!(
        "correlation dimension {:.3} ± {:.3} of {points} points (*x*_*n*, *x*_{{*n*+1}})",
        dimension.value, dimension.spread
    );
    let how = "Grassberger and Procaccia on crossings of -3 < *x* < 3, *y* = 3 in either direction; a closed curve has 1, a periodic \
               motion 0, chaos more than 1.2; within 0.2 of 1";
    let says = "In order to confirm that the motion is quasi-periodic, we have analyzed the return map of the *x*-component every time \
                that the domain crosses the line -3 < *x* < 3 and *y* = 3.";
    Ok(claim(&[103, 132], says, finds, how, (dimension.value - 1.0).abs() < 0.2))
}

fn radial_map(dataset: &Dataset) -> Result<Claim, Error> {
    let (dimension, points) = dimension_of_map(dataset)?;
    let finds =
        format!("correlation dimension {:.3} ± {:.3} of {points} points", dimension.value, dimension.spread);
    let how = "as for the paper's line, on the half line *y* = 0, *x* > 0 from the centre of the path; within 0.2 of 1";
    let says = "The return map does not depend on the line: through the centre of the path it is a closed curve as well.";
    Ok(check(says, finds, how, (dimension.value - 1.0).abs() < 0.2))
}

/// The correlation dimension of the return map of x, and its number of points.
fn dimension_of_map(dataset: &Dataset) -> Result<(Dimension, usize), Error> {
    let xs = dataset.crossings.as_ref().and_then(|table| table.get("x")).unwrap_or(&[]);
    let pairs: Vec<Vec<f64>> = return_pairs(xs).into_iter().map(|pair| pair.to_vec()).collect();
    Ok((correlation_dimension(&pairs, 1e-6)?, pairs.len()))
}

fn exponent(context: &Context<'_>, study: &Study) -> Result<Claim, Error> {
    let span = context.choose(40_000.0, 8_000.0);
    let run = analyse::lyapunov(&Plan::new(study)?, 1, (Some(3000.0), Some(span)), &context.quiet())?;
    if context.watch.stopped() {
        return Err(Error::Interrupted);
    }
    let Some(first) = run.exponents.first() else { return Err(Error::Interrupted) };
    let finds = format!("*λ*_1 = {:.1e} ± {:.1e} over {span} time units", first.value, first.error);
    let how = "QR on the tangent flow; zero within twice its 95 % error, and below 10^{-3}: two neutral directions, time and rotation, \
               and no other";
    let holds = first.value.abs() < (2.0 * first.error).max(1e-4) && first.value.abs() < 1e-3;
    Ok(check("Quasi-periodic, so not chaotic: the largest Lyapunov exponent is 0.", finds, how, holds))
}
