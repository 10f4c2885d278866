//! Fig. 3: quasi-periodic motion: an annulus, and return maps that are curves.

mod curve;

use super::claims::{check, claim};
use super::context::Context;
use curve::{Piece, pieces};
use motiform_analysis::regime::Regime;
use motiform_analysis::symmetry::wrap;
use motiform_analysis::{correlation_dimension, return_pairs};
use motiform_figures::report::{Claim, ReportFigure, Section};
use motiform_figures::{Chart, ErrorBarSeries, Measured};
use motiform_lab::draw;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{Dataset, Error, Study};
use std::f64::consts::TAU;

const ABOUT: &str = "The shape repeats after a period, turned by an angle that is not a rational \
    fraction of a full turn: in the plane the path is a rosette that fills an annulus. With rotations divided out, the motion \
    is a stable periodic orbit, the 'modulated wave'; the second frequency is that of the rotation alone. \
    The return map on a half line from the centre of the path, which is crossed once in every turn, is a \
    closed curve. On the paper's line *y* = 3, with the centre of the path put on the origin, it cannot be \
    one: turns whose crest lies below the line do not cross it. Upward and downward crossings are different \
    sections and are kept apart.";

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let study = context.preset("fig3", |study| {
        study.run.t_end = 40_000.0; // the paper's line is crossed rarely
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
        return_map(&dataset),
        radial_map(context, &radial),
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
        figures: context.drawn(&|| drawn(context, &dataset, &radial))?,
        claims,
        ..Section::default()
    })
}

/// The same motion, cut by the half line from the centre of the path.
fn through_the_centre(study: &Study) -> Study {
    let half_line = ReturnMapSettings { y: 0.0, x_min: 0.0, x_max: 1e3, centre: true };
    Study { return_map: Some(half_line), ..study.clone() }
}

fn drawn(context: &Context<'_>, dataset: &Dataset, radial: &Dataset) -> Result<Vec<ReportFigure>, Error> {
    let mut figures = Vec::new();
    for (name, drawn) in draw::drawn(dataset, context.style)? {
        match name {
            "path" => {
                let words = "The beginning of the path: a rosette.";
                figures.push(ReportFigure::new(drawn, words).of_paper("3(a)"));
            }
            "return-map" => figures.push(by_direction(context, dataset)?.of_paper("3(b)")),
            _ => {}
        }
    }
    let map = draw::drawn(radial, context.style)?.into_iter().find(|(name, _)| *name == "return-map");
    figures.extend(map.map(|(_, drawn)| {
        ReportFigure::new(
            drawn,
            "The return map on the half line from the centre of the path (*y* = 0, *x* > 0), which the paper does not show: *x* is the \
             distance from the centre.",
        )
    }));
    Ok(figures)
}

/// The return map on the paper's line, for each direction of crossing.
fn by_direction(context: &Context<'_>, dataset: &Dataset) -> Result<ReportFigure, Error> {
    let series = |(label, rising): (&str, bool)| ErrorBarSeries {
        label: label.to_owned(),
        points: map(dataset, rising).into_iter().map(|[x, y]| Measured { x, y, error: 0.0 }).collect(),
        joined: false,
    };
    let figure = Chart {
        title: "Return map of *x* on *y* = 3".to_owned(),
        x_label: "*x*_*n*".to_owned(),
        y_label: "*x*_{*n*+1}".to_owned(),
        ..Chart::default()
    }
    .with([("crossed upwards", true), ("crossed downwards", false)].map(series));
    let words = "The return map of *x* on the paper's line -3 < *x* < 3, *y* = 3, from one crossing to the \
        next one in the same direction. It consists of open arcs: an arc ends where the path only touches \
        the line, or where the next turn stays below it.";
    Ok(ReportFigure::new(context.sheet(figure)?, words))
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
    let how = "distances from the time average of the path; both halves of the recording have the same radii to 1 %, the inner \
               one is not 0, and the outer one is larger by more than 5 % (a circle has one radius)";
    let says = "Fig. 3(a): a quasi-periodic path.";
    claim(&[131], says, finds, how, inner > 0.05 * outer && outer > 1.05 * inner && off < 0.01 * outer)
}

fn anticlockwise(dataset: &Dataset) -> Claim {
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let (vx, vy) = (column("v1"), column("v2"));
    let headings: Vec<f64> = vx.iter().zip(vy).map(|(vx, vy)| libm::atan2(*vy, *vx)).collect();
    let turned: f64 = headings.windows(2).map(|pair| wrap(pair[1] - pair[0])).sum();
    let time = column("t").last().copied().unwrap_or(f64::NAN);
    let finds = format!("mean turning rate {:+.6} rad per time unit", turned / time);
    let how = "the heading's net change over the recording; positive is counterclockwise. The mirror image exists as well: the start \
               was chosen so";
    claim(&[131], "Rotating in the counterclockwise direction.", finds, how, turned > 0.0)
}

fn return_map(dataset: &Dataset) -> Claim {
    let both = [true, false].map(|rising| map(dataset, rising));
    let found = both.each_ref().map(|points| pieces(points));
    let words = |(name, (points, pieces)): (&str, (&Vec<[f64; 2]>, &Vec<Piece>))| {
        let curves: Vec<&Piece> = pieces.iter().filter(|piece| piece.is_curve()).collect();
        let closed = curves.iter().filter(|piece| piece.is_closed()).count();
        let on: usize = curves.iter().map(|piece| piece.points).sum();
        format!(
            "{name}: {on} of {} points lie on {} arcs, {closed} of them closed",
            points.len(),
            curves.len()
        )
    };
    let finds: Vec<String> =
        ["crossed upwards", "downwards"].into_iter().zip(both.iter().zip(&found)).map(words).collect();
    let how = "crossings of -3 < *x* < 3, *y* = 3 from each to the next one in the same direction, at least \
        50 of each; the shortest tree through the points (*x*_*n*, *x*_{*n*+1}), cut where neighbours are \
        more than a tenth of the extent apart: at least 90 % of the points lie on at most four pieces that \
        are rows of points. An area, scattered points and a periodic motion are none. The paper does not \
        say that the curve is closed, and on this line it is not: turns whose crest lies below it do not \
        cross it. Closedness is judged on the half line, in the next check";
    let says = "In order to confirm that the motion is quasi-periodic, we have analyzed the return map of the *x*-component every time \
                that the domain crosses the line -3 < *x* < 3 and *y* = 3.";
    let holds = both.iter().zip(&found).all(|(points, pieces)| {
        let curves: Vec<&Piece> = pieces.iter().filter(|piece| piece.is_curve()).collect();
        let on: usize = curves.iter().map(|piece| piece.points).sum();
        points.len() >= 50
            && on as f64 >= 0.9 * points.len() as f64
            && curves.len() <= 4
            && spread(points) > 0.1
    });
    claim(&[103, 132], says, finds.join("; "), how, holds)
}

/// Closed, and a curve: an open arc has the dimension of a curve as well, so it alone decides nothing.
fn radial_map(context: &Context<'_>, dataset: &Dataset) -> Claim {
    let points = map(dataset, true);
    let pairs: Vec<Vec<f64>> = points.iter().map(|pair| pair.to_vec()).collect();
    let (dimension, pieces) = (correlation_dimension(&pairs, 1e-6).ok(), pieces(&points));
    let value = context.number(dimension.map_or(f64::NAN, |found| found.value));
    let spread = dimension.map_or(f64::NAN, |found| found.spread);
    let words = match pieces[..] {
        [piece] => format!(
            "one row of {} of {} points, whose ends are {:.3} of its extent apart; neighbours on it are up to {:.3} apart",
            piece.along, piece.points, piece.ends, piece.widest
        ),
        _ => format!("{} pieces", pieces.len()),
    };
    let finds = format!("{words}; correlation dimension {value:.3} ± {spread:.3}");
    let how = "crossings of *y* = 0, *x* > 0 from the centre of the path, upwards; the shortest tree \
        through the points (*x*_*n*, *x*_{*n*+1}) is one row of at least 90 % of them, whose ends are at \
        most 1.5 times as far apart as its furthest neighbours: an open arc fails this; and Grassberger and \
        Procaccia's dimension is within 0.2 of 1";
    let says = "On a line that every turn crosses once, the half line from the centre of the path, the return map is a closed curve.";
    let closed = matches!(pieces[..], [piece] if piece.is_closed()) && points.len() >= 200;
    check(says, finds, how, closed && (value - 1.0).abs() < 0.2)
}

/// The return map of x from one crossing to the next one in the same direction.
fn map(dataset: &Dataset, rising: bool) -> Vec<[f64; 2]> {
    let column = |name: &str| dataset.crossings.as_ref().and_then(|table| table.get(name)).unwrap_or(&[]);
    let own = column("x").iter().zip(column("rising")).filter(|(_, up)| (**up > 0.5) == rising);
    return_pairs(&own.map(|(x, _)| *x).collect::<Vec<_>>())
}

/// The largest distance of points from their first one.
fn spread(points: &[[f64; 2]]) -> f64 {
    let first = points.first().copied().unwrap_or_default();
    points.iter().map(|p| libm::hypot(p[0] - first[0], p[1] - first[1])).fold(0.0, f64::max)
}

fn exponent(context: &Context<'_>, study: &Study) -> Result<Claim, Error> {
    let span = context.choose(40_000.0, 8_000.0);
    let run = context.lyapunov(study, 1, (3000.0, span))?;
    let Some(first) = run.exponents.first() else { return Err(Error::Interrupted) };
    let finds = format!("*λ*_1 = {:.1e} ± {:.1e} over {span} time units", first.value, first.error);
    let how = "QR on the tangent flow; zero within twice its 95 % error, and below 10^{-3}: two neutral directions, time and rotation, \
               and no other";
    let holds = first.value.abs() < (2.0 * first.error).max(1e-4) && first.value.abs() < 1e-3;
    Ok(check("Quasi-periodic, so not chaotic: the largest Lyapunov exponent is 0.", finds, how, holds))
}
