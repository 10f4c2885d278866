//! Branches: the bifurcation diagram, and the periods.

use crate::branches::family::Bodies;
use crate::branches::result::Leg;
use crate::branches::stability;
use crate::branches::sweep::{SweepPoint, Sweeps};
use crate::{Branches, Followed, Origin, Sample, motion_between};
use motiform_continuation::{Connection, End, Special};
use motiform_figures::axes::AxisKind;
use motiform_figures::{BranchDiagram, BranchDots, BranchMark, BranchPart, Chart, Glyph};
use motiform_lab::draw::{Figures, words};
use motiform_study::plan::Named;
use motiform_study::quantity::motion;
use motiform_study::{BranchPlan, Error, Quantity, Shown};

/// The quantity of a diagram against the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ordinate {
    /// Mean speed.
    Speed,
    /// Mean turning rate; undefined where the body stops.
    TurningRate,
    /// Largest size of the shape.
    Size,
    /// The same with its sign: anticlockwise above 0.
    SignedTurningRate,
    /// Net rotation per period.
    NetRotation,
    /// The same with its sign.
    SignedNetRotation,
    /// Period.
    Period,
}

impl Ordinate {
    const fn quantity(self) -> &'static Quantity {
        match self {
            Self::Speed => &motion::SPEED,
            Self::TurningRate | Self::SignedTurningRate => &motion::TURNING_RATE,
            Self::Size => &motion::SIZE,
            Self::NetRotation | Self::SignedNetRotation => &motion::NET_ROTATION,
            Self::Period => &motion::PERIOD,
        }
    }

    /// The quantity with its sign where the mirror is no symmetry: then left and right are different motions.
    const fn of_model(self, mirror: bool) -> Self {
        match (self, mirror) {
            (Self::TurningRate, false) => Self::SignedTurningRate,
            (Self::NetRotation, false) => Self::SignedNetRotation,
            (as_given, _) => as_given,
        }
    }

    /// Its value at a connection. There the orbit is at its saddle for all but a vanishing part of the time, so that means over time are
    /// those of the saddle. `None` for numbers without a limit, as the period, and where the saddle is not known.
    pub fn at(self, connection: &Connection) -> Option<f64> {
        let saddle = connection.saddle.as_ref()?;
        match self {
            Self::Speed => Some(saddle.velocity[0].hypot(saddle.velocity[1])),
            Self::TurningRate => Some(saddle.turning_rate.abs()),
            Self::SignedTurningRate => Some(saddle.turning_rate),
            _ => None,
        }
    }

    /// Its value in a simulation; nothing where the two would not be comparable.
    fn sampled(self, point: &SweepPoint) -> Option<f64> {
        match self {
            Self::Speed => point.speed.map(|speed| speed[0]),
            Self::TurningRate => point.turning_rate.map(f64::abs),
            Self::SignedTurningRate => point.turning_rate,
            Self::Size => point.size,
            Self::NetRotation | Self::SignedNetRotation | Self::Period => None,
        }
    }

    fn read(self, sample: &Sample) -> Option<f64> {
        let reading = &sample.reading;
        match self {
            // the cell has none where its boundary cannot be closed
            Self::Speed => Some(reading.speed[0]).filter(|speed| speed.is_finite()),
            // where left and right are mirror images, one of them is followed
            Self::TurningRate => reading.turning_rate.map(f64::abs),
            Self::SignedTurningRate => reading.turning_rate,
            Self::Size => Some(reading.size),
            Self::SignedNetRotation => reading.net_rotation,
            Self::NetRotation => reading.net_rotation.map(f64::abs),
            Self::Period => reading.period,
        }
    }
}

/// `branches` (the diagram) and, where motions repeat, `period`, in these units; nothing for branches without points.
///
/// # Errors
/// An unknown model, or numbers that no axis can hold.
pub fn branch_figures(
    plan: &BranchPlan,
    found: &Branches,
    ordinate: Ordinate,
    units: &Shown,
) -> Result<Figures, Error> {
    let mut all: Figures = Vec::new();
    for (name, ordinate) in [("branches", ordinate), ("period", Ordinate::Period)] {
        let figure = diagram_in(plan, found, ordinate, units)?;
        if !figure.is_empty() {
            all.push((name, Box::new(figure)));
        }
    }
    Ok(all)
}

/// The diagram of branches, in model units; empty where no branch has points.
///
/// # Errors
/// An unknown model.
pub fn diagram(plan: &BranchPlan, found: &Branches, ordinate: Ordinate) -> Result<Chart, Error> {
    diagram_in(plan, found, ordinate, &Shown::default())
}

/// The diagram of branches, in these units.
fn diagram_in(
    plan: &BranchPlan,
    found: &Branches,
    ordinate: Ordinate,
    units: &Shown,
) -> Result<Chart, Error> {
    let info = plan.info()?;
    let mirror = Bodies::new(plan)?.model(plan.start_value())?.symmetry().mirror;
    let ordinate = ordinate.of_model(mirror);
    let along = &plan.computation.along;
    let spec = info.parameters().iter().find(|spec| spec.name == along.name);
    let diagram = BranchDiagram {
        x: [along.from, along.to],
        parts: found.branches.iter().flat_map(|followed| all_parts(found, followed, ordinate)).collect(),
        dots: found.sweeps.iter().flat_map(|sweeps| dots(sweeps, ordinate)).collect(),
        marks: found.branches.iter().flat_map(|followed| marks(followed, ordinate)).collect(),
    };
    let period = ordinate == Ordinate::Period;
    let mut caption = caption(plan, found, mirror, ordinate, units)?;
    let connects =
        |followed: &Followed| followed.legs.iter().any(|leg| matches!(leg.end, End::Homoclinic(_)));
    if period && found.branches.iter().any(connects) {
        caption.push(
            "Connections stand at the longest period that was computed; it grows without bound.".to_owned(),
        );
    }
    if diagram.leaves(AxisKind::of(period)) {
        caption.push(
            "Unstable motions whose values are far from those of all others leave the frame.".to_owned(),
        );
    }
    let chart = Chart {
        title: if period { format!("{}: periods", plan.title()) } else { plan.title() },
        caption,
        x_label: spec.map_or_else(|| along.name.clone(), |spec| spec.symbol.to_owned()),
        y_label: units.axis(ordinate.quantity()),
        logarithmic_y: period,
        ..Chart::default()
    };
    let factor = units.factor(ordinate.quantity().dimension);
    Ok(chart.with(Some(diagram).filter(|diagram| !diagram.parts.is_empty())).scaled([1.0, factor]))
}

/// The samples of both sweeps.
fn dots(sweeps: &Sweeps, ordinate: Ordinate) -> Vec<BranchDots> {
    let points = |all: &[SweepPoint]| -> Vec<[f64; 2]> {
        all.iter().filter_map(|point| Some([point.parameter, ordinate.sampled(point)?])).collect()
    };
    let all = [(true, "simulated, upwards", &sweeps.up), (false, "simulated, downwards", &sweeps.down)];
    let dots = all.map(|(up, label, all)| BranchDots { label: label.to_owned(), up, points: points(all) });
    dots.into_iter().filter(|dots| !dots.points.is_empty()).collect()
}

fn caption(
    plan: &BranchPlan,
    found: &Branches,
    mirror: bool,
    ordinate: Ordinate,
    units: &Shown,
) -> Result<Vec<String>, Error> {
    let c = &plan.computation;
    let fixed = c.start.parameters.0.iter().filter(|entry| entry.0 != c.along.name).cloned().collect();
    let count = match found.branches.len() {
        1 => "One branch".to_owned(),
        count => format!("{count} branches"),
    };
    let once = match (mirror, found.branches.len()) {
        (false, _) => "",
        (true, 1) => ", drawn once for all its mirror images",
        (true, _) => ", each drawn once for all its mirror images",
    };
    let left = match found.left + found.doublings_left {
        0 => String::new(),
        1 => "; one point at which more may begin was left".to_owned(),
        left => format!("; {left} points at which more may begin were left"),
    };
    let samples = if found.sweeps.is_some() {
        format!(" Simulated at {} values, each run from the end of the one before.", c.samples)
    } else {
        String::new()
    };
    let unfinished = if found.complete { "" } else { " Interrupted: not all of them are followed." };
    Ok(vec![
        words::named_in(plan.info()?, &Named(fixed), &[&c.along.name], &c.ties, units),
        format!(
            "{count} by pseudo-arclength continuation{once}{left}.{}{samples}{unfinished}",
            gaps(found, ordinate)
        ),
    ])
}

/// Why points are left out of a diagram of speeds.
fn gaps(found: &Branches, ordinate: Ordinate) -> String {
    let undefined = |sample: &&Sample| sample.reading.speed[0].is_nan();
    let all = found.branches.iter().flat_map(Followed::samples).filter(undefined);
    match (ordinate, all.count()) {
        (Ordinate::Speed, 1) => {
            " One point without a speed is left out: the boundary of its shape cannot be closed.".to_owned()
        }
        (Ordinate::Speed, count @ 2..) => {
            format!(
                " {count} points without a speed are left out: the boundary of their shapes cannot be closed."
            )
        }
        _ => String::new(),
    }
}

/// The parts of a branch, drawn from the special point where it begins to the connection at which it ends.
fn all_parts(found: &Branches, followed: &Followed, ordinate: Ordinate) -> Vec<BranchPart> {
    let mut all = parts(followed, ordinate);
    let (back, ahead) = match &followed.legs[..] {
        [] => (None, None),
        [only] => (None, Some(only)),
        [back, .., ahead] => (Some(back), Some(ahead)),
    };
    if let (Some(at), Some(first)) = (back.and_then(|leg| connection(leg, ordinate)), all.first_mut()) {
        first.points.insert(0, at);
    }
    if let (Some(at), Some(last)) = (ahead.and_then(|leg| connection(leg, ordinate)), all.last_mut()) {
        last.points.push(at);
    }
    if let (Some(at), [_], Some(first)) =
        (birth(found, followed.origin, ordinate), &followed.legs[..], all.first_mut())
    {
        first.points.insert(0, at);
    }
    all
}

/// The special point where a branch begins, as a point of the new branch.
fn birth(found: &Branches, origin: Origin, ordinate: Ordinate) -> Option<[f64; 2]> {
    let Origin::Special { branch, leg, point } = origin else { return None };
    let sample = &found.branches[branch].legs[leg].samples[point];
    let value = match (ordinate, sample.point.special?) {
        (Ordinate::Period, Special::PeriodDoubling) => 2.0 * sample.reading.period?,
        (_, special) => begun(sample, special, ordinate).or_else(|| ordinate.read(sample))?,
    };
    Some([sample.point.parameter, value])
}

/// The period of the orbits that begin at a Hopf point.
fn begun(sample: &Sample, special: Special, ordinate: Ordinate) -> Option<f64> {
    match special {
        Special::Hopf(hopf) if ordinate == Ordinate::Period && sample.reading.period.is_none() => {
            Some(hopf.period())
        }
        _ => None,
    }
}

/// The parts of a branch, each with its stability and motion.
fn parts(followed: &Followed, ordinate: Ordinate) -> Vec<BranchPart> {
    let samples: Vec<&Sample> = followed.samples().collect();
    let mut all: Vec<BranchPart> = Vec::new();
    let mut open = false;
    for pair in samples.windows(2) {
        let at = |sample: &Sample| Some([sample.point.parameter, ordinate.read(sample)?]);
        let (Some(from), Some(to)) = (at(pair[0]), at(pair[1])) else {
            open = false;
            continue;
        };
        let (regime, stability) = (motion_between(pair[0], pair[1]).name(), stability(pair[0], pair[1]));
        match all.last_mut().filter(|last| open && last.regime == regime && last.stability == stability) {
            Some(last) => last.points.push(to),
            None => all.push(BranchPart { regime: regime.to_owned(), stability, points: vec![from, to] }),
        }
        open = true;
    }
    all
}

/// The connection at which a leg ends; a number that it has no limit of is marked at the last one computed.
fn connection(leg: &Leg, ordinate: Ordinate) -> Option<[f64; 2]> {
    let End::Homoclinic(connection) = &leg.end else { return None };
    let last = ordinate.read(leg.samples.last()?)?;
    Some([connection.parameter, ordinate.at(connection).unwrap_or(last)])
}

/// The special points of a branch, and the connections that it ends at.
fn marks(followed: &Followed, ordinate: Ordinate) -> Vec<BranchMark> {
    let mut all = Vec::new();
    for leg in &followed.legs {
        for sample in &leg.samples {
            let Some(special) = sample.point.special else { continue };
            // at a Hopf point of a steady motion the orbit that begins has a period
            let Some(y) = begun(sample, special, ordinate).or_else(|| ordinate.read(sample)) else {
                continue;
            };
            let (label, glyph) = mark(special);
            all.push(BranchMark { label: label.to_owned(), glyph, at: [sample.point.parameter, y] });
        }
        if let (Some(at), End::Homoclinic(end)) = (connection(leg, ordinate), &leg.end) {
            let glyph = if end.name() == "homoclinic" { Glyph::Cross } else { Glyph::Bowtie };
            all.push(BranchMark { label: end.name().to_owned(), glyph, at });
        }
    }
    all
}

fn mark(special: Special) -> (&'static str, Glyph) {
    match special {
        Special::Fold => ("fold", Glyph::Star),
        Special::Pitchfork { .. } => ("pitchfork", Glyph::Diamond),
        Special::Continuum => ("continuum", Glyph::Plus),
        Special::Hopf(_) => ("Hopf", Glyph::Disc),
        Special::PeriodDoubling => ("period doubling", Glyph::Triangle),
        Special::SymmetryBreaking => ("symmetry breaking", Glyph::Square),
        Special::Torus { .. } => ("torus", Glyph::Ring),
        Special::Unresolved { .. } => ("not located", Glyph::Question),
        Special::Touch { .. } => ("touch", Glyph::Question),
        _ => ("branch point", Glyph::DownTriangle),
    }
}
