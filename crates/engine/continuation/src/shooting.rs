//! The flow over the parts of an orbit.

use super::family::Neighbours;
use super::point::Obstruction;
use super::problem::Failure;
use super::variation::{Variation, slope_at};
use motiform_analysis::implicit_flow;
use motiform_analysis::linear::norm;
use motiform_analysis::periodic::Flow;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Integration, Outcome, Request, Semilinear, Watch};

/// A shape that grows by this factor, or to so many units of shapes, has left every bound.
const UNBOUND: f64 = 1e6;

/// The flow over one part of an orbit.
pub(super) struct Segment {
    /// The shape at its end.
    pub(super) end: Vec<f64>,
    /// `f` there.
    pub(super) slope: Vec<f64>,
    /// `D Phi`, column by column.
    pub(super) tangents: Vec<f64>,
    /// `d Phi / dp`, for every parameter.
    pub(super) by_parameter: Vec<f64>,
    /// Steps that it took.
    pub(super) steps: u64,
}

/// The flow from `start` over `span` with all its derivatives.
pub(super) fn segment(
    neighbours: &Neighbours,
    start: &[f64],
    span: f64,
    flow: &Flow,
    watch: &dyn Watch,
) -> Result<Segment, Failure> {
    if matches!(flow.method, Method::Exponential(_)) {
        return Ok(stiff_segment(neighbours, start, (span, None), watch)?.0);
    }
    let dim = start.len();
    let variation = Variation::new(neighbours);
    let mut state = Vec::new();
    variation.start(start, &mut state);
    let mut orbit = begun(&variation, &state, flow)?;
    arrive(orbit.as_mut(), span, (state.len(), dim), (flow, neighbours.length), watch)?;
    Ok(read(neighbours, (start, orbit.state()), taken(orbit.as_ref())))
}

/// The flow from each of the nodes, each over `span`, with all its derivatives. The integration goes on from one to the next with the step
/// that it has: at the start of a vector that is 0 the first step would be far too short, and a dozen steps be spent on making it longer.
pub(super) fn segments<'x>(
    neighbours: &Neighbours,
    nodes: impl Iterator<Item = &'x [f64]>,
    span: f64,
    flow: &Flow,
    watch: &dyn Watch,
) -> Result<Vec<Segment>, Failure> {
    if matches!(flow.method, Method::Exponential(_)) {
        let mut step = None;
        let next = |node| {
            let (segment, next) = stiff_segment(neighbours, node, (span, step), watch)?;
            step = Some(next);
            Ok(segment)
        };
        return nodes.map(next).collect();
    }
    let variation = Variation::new(neighbours);
    let (mut state, mut going, mut before) = (Vec::new(), None, 0);
    let mut out = Vec::new();
    for (count, node) in nodes.enumerate() {
        variation.start(node, &mut state);
        let mut orbit = match going.take() {
            None => begun(&variation, &state, flow)?,
            Some(orbit) => orbit,
        };
        if count > 0 {
            orbit.restart(&state);
        }
        let (end, sizes) = ((count + 1) as f64 * span, (state.len(), node.len()));
        arrive(orbit.as_mut(), end, sizes, (flow, neighbours.length), watch)?;
        let steps = taken(orbit.as_ref());
        out.push(read(neighbours, (node, orbit.state()), steps - before));
        before = steps;
        going = Some(orbit);
    }
    Ok(out)
}

/// Steps taken so far, and those that were tried in vain.
fn taken(orbit: &(dyn Integration + '_)) -> u64 {
    let work = orbit.counters();
    work.steps + work.rejected
}

/// The reading of start and end of a variation that took so many steps.
fn read(neighbours: &Neighbours, (start, end): (&[f64], &[f64]), steps: u64) -> Segment {
    let dim = start.len();
    let (shape, vectors) = end.split_at(dim);
    let by_parameter = Variation::by_parameter(neighbours, start, vectors);
    let tangents = vectors[..dim * dim].iter().map(|x| x / neighbours.length).collect();
    let slope = neighbours.body.rates(shape);
    Segment { end: shape.to_vec(), slope, tangents, by_parameter, steps }
}

/// The same by the implicit method, whose steps do not shorten with the stiff parts of vectors, from the first step to try; and the step
/// that it would take next.
fn stiff_segment(
    neighbours: &Neighbours,
    start: &[f64],
    (span, first): (f64, Option<f64>),
    watch: &dyn Watch,
) -> Result<(Segment, f64), Failure> {
    let body = neighbours.body.as_ref();
    let (dim, count) = (start.len(), neighbours.sides.len());
    let mut vectors = vec![0.0; dim * (dim + count)];
    (0..dim).for_each(|i| vectors[dim * i + i] = 1.0);
    let forced = |u: &[f64]| neighbours.sides.iter().map(|sides| slope_at(sides, u)).collect();
    let flowed = implicit_flow(body, start, &vectors, &forced, (span, first), watch).map_err(failure)?;
    let slope = body.rates(&flowed.end);
    let by_parameter = flowed.vectors[dim * dim..].to_vec();
    let mut tangents = flowed.vectors;
    tangents.truncate(dim * dim);
    Ok((Segment { end: flowed.end, slope, tangents, by_parameter, steps: flowed.steps }, flowed.step))
}

fn failure(outcome: Outcome) -> Failure {
    match outcome {
        Outcome::Interrupted { .. } => Failure::Stopped,
        other => Failure::Obstructed(Obstruction::Flow(other)),
    }
}

/// The shape after `span`; `length` is the unit of shapes.
pub(super) fn shape_after(
    body: &dyn Equivariant,
    start: &[f64],
    span: f64,
    (flow, length): (&Flow, f64),
    watch: &dyn Watch,
) -> Result<Vec<f64>, Failure> {
    if matches!(flow.method, Method::Exponential(_)) {
        let flowed = implicit_flow(body, start, &[], &|_| Vec::new(), (span, None), watch);
        return flowed.map(|flowed| flowed.end).map_err(failure);
    }
    run(body, start, (span, start.len()), (flow, length), watch)
}

fn run<F: Semilinear<f64> + ?Sized>(
    field: &F,
    start: &[f64],
    (span, watched): (f64, usize),
    (flow, length): (&Flow, f64),
    watch: &dyn Watch,
) -> Result<Vec<f64>, Failure> {
    let mut orbit = begun(field, start, flow)?;
    arrive(orbit.as_mut(), span, (start.len(), watched), (flow, length), watch)?;
    Ok(orbit.state().to_vec())
}

fn begun<'b, F: Semilinear<f64> + ?Sized>(
    field: &'b F,
    start: &[f64],
    flow: &Flow,
) -> Result<Box<dyn Integration + 'b>, Failure> {
    let orbit = flow.method.shape_orbit(field, flow.control, 0.0, start);
    orbit.map_err(|error| Failure::from(motiform_analysis::Error::from(error)))
}

/// Goes on until the time `end`; of the `dim` entries the first `watched` may not grow without bound.
fn arrive(
    orbit: &mut (dyn Integration + '_),
    end: f64,
    (dim, watched): (usize, usize),
    (flow, length): (&Flow, f64),
    watch: &dyn Watch,
) -> Result<(), Failure> {
    let escape_norm = UNBOUND * norm(&orbit.state()[..watched]).max(length);
    let request =
        Request { max_steps: flow.max_steps, watched, watch, escape_norm, ..Request::until(end, dim) };
    let outcome = drive(orbit, &request, &mut ())
        .map_err(|error| Failure::from(motiform_analysis::Error::from(error)))?;
    if outcome.is_complete() { Ok(()) } else { Err(failure(outcome)) }
}
