//! Runs with g4 alone, with the quartic potential that bounds it, and with g5 instead.

use super::super::claims::claim;
use super::super::context::Context;
use super::super::fig6;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::KROGSTAD4;
use motiform_dynamics::{
    ExponentialOrbit, Outcome, Request, Semilinear, Sink, StepControl, StopOnly, System, VectorField,
};
use motiform_figures::report::Claim;
use motiform_figures::{Chart, Drawn, ErrorBarSeries, Measured};
use motiform_models::cell::{CellField, CellParameters};
use motiform_study::Error;
use motiform_study::initial::Uniform;
use std::f64::consts::TAU;

/// Lengths where the cell swims straight, in circles, irregularly, and where it rests on a three-fold shape.
const LENGTHS: [f64; 4] = [9.0, 12.6, 21.6, 25.0];

/// At rest: the rate of change of phi at the end.
const STILL: f64 = 1e-7;

/// `g4 phi_s phi_ss + q phi_s^2 phi_ss` with the linear terms; `q` > 0 is the potential `(q/12) int phi_s^4`.
struct Bounded {
    field: CellField<f64>,
    k: f64,
    quartic: f64,
    /// Sine and cosine at the points: enough of them for products of three.
    waves: Vec<(f64, f64)>,
}

impl Bounded {
    fn new(length: f64, [g4, g5]: [f64; 2], quartic: f64) -> Self {
        let parameters = CellParameters { length, g4, g5, ..CellParameters::default() };
        let modes = fig6::modes_for(length);
        let points = 4 * modes + 1;
        let waves = (0..points).map(|j| libm::sincos(TAU * j as f64 / points as f64)).collect();
        Self { field: CellField::new(&parameters, modes), k: TAU / length, quartic, waves }
    }

    /// `phi_s` and `phi_ss` at the points.
    fn slopes(&self, u: &[f64]) -> Vec<[f64; 2]> {
        let points = self.waves.len();
        let at = |j: usize| {
            let mut sum = [0.0; 2];
            for (n, mode) in (1..).zip(u.chunks_exact(2)) {
                let (sin, cos) = self.waves[(n * j) % points];
                let k = self.k * n as f64;
                // 2 Re(i k phi_n e) and 2 Re(-k^2 phi_n e)
                sum[0] -= 2.0 * k * (mode[1] * cos + mode[0] * sin);
                sum[1] -= 2.0 * k * k * (mode[0] * cos - mode[1] * sin);
            }
            sum
        };
        (0..points).map(at).collect()
    }

    /// `(1/L) int (-phi_ss^2/2 + phi_sss^2/2 + g4 phi_s^3/6 + q phi_s^4/12) ds`, whose gradient the flow without g5 follows.
    fn potential(&self, u: &[f64], g4: f64) -> f64 {
        let linear = |(sigma, mode): (&f64, &[f64])| -sigma * (mode[0] * mode[0] + mode[1] * mode[1]);
        let slopes = self.slopes(u);
        let cubic = |[s, _]: &[f64; 2]| g4 * s * s * s / 6.0 + self.quartic * s.powi(4) / 12.0;
        let sum: f64 = slopes.iter().map(cubic).sum();
        self.field.rates().iter().zip(u.chunks_exact(2)).map(linear).sum::<f64>() + sum / slopes.len() as f64
    }
}

impl System for Bounded {
    fn dim(&self) -> usize {
        self.field.dim()
    }
}

impl VectorField<f64> for Bounded {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.nonlinear(t, u, du);
        for ((rates, modes), sigma) in du.chunks_exact_mut(2).zip(u.chunks_exact(2)).zip(self.field.rates()) {
            rates[0] += sigma * modes[0];
            rates[1] += sigma * modes[1];
        }
    }
}

impl Semilinear<f64> for Bounded {
    fn linear(&self, lambda: &mut [f64]) {
        Semilinear::<f64>::linear(&self.field, lambda);
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.field.nonlinear(t, u, du);
        if self.quartic == 0.0 {
            return;
        }
        let slopes = self.slopes(u);
        let points = slopes.len();
        for (n, rate) in (1..).zip(du.chunks_exact_mut(2)) {
            for (j, [first, second]) in slopes.iter().enumerate() {
                let (sin, cos) = self.waves[(n * j) % points];
                let term = self.quartic * first * first * second / points as f64;
                rate[0] += term * cos;
                rate[1] -= term * sin;
            }
        }
    }
}

/// The results of a run.
#[derive(Clone)]
struct Ran {
    length: f64,
    outcome: Outcome,
    /// Largest rate of change at the end.
    moving: f64,
    /// The potential at equal times.
    potential: Vec<f64>,
    /// Its largest size.
    top: f64,
}

impl Ran {
    /// Returns `true` if the potential never grows (beyond the accuracy of the run).
    fn descends(&self) -> bool {
        self.potential.windows(2).all(|pair| pair[1] <= pair[0] + 1e-6 * self.top)
    }
}

/// Keeps the potential at equal times.
struct Descent<'a> {
    body: &'a Bounded,
    g4: f64,
    potential: Vec<f64>,
}

impl Sink for Descent<'_> {
    fn sample(&mut self, _t: f64, u: &[f64]) {
        self.potential.push(self.body.potential(u, self.g4));
    }
}

fn run(context: &Context<'_>, length: f64, g: [f64; 2], quartic: f64) -> Result<Ran, Error> {
    let body = Bounded::new(length, g, quartic);
    let mut random = Uniform::new(3, 0);
    let start: Vec<f64> = (0..body.dim()).map(|_| 0.01 * random.draw()).collect();
    let control = StepControl::Adaptive { rtol: 1e-8, atol: 1e-11 };
    let mut orbit = ExponentialOrbit::new(&body, &KROGSTAD4, control, 0.0, &start)?;
    // with g5 the shapes never settle: what they do is seen soon
    let time = context.choose(6000.0, if g[1] == 0.0 { 2000.0 } else { 600.0 });
    let request = Request {
        sample_every: Some(10.0),
        escape_norm: 1e4,
        watch: &StopOnly(context.watch),
        ..Request::until(time, body.dim())
    };
    let mut descent = Descent { body: &body, g4: g[0], potential: Vec::new() };
    let outcome = drive(&mut orbit, &request, &mut descent)?;
    if matches!(outcome, Outcome::Interrupted { .. }) || context.watch.stopped() {
        return Err(Error::Interrupted);
    }
    let potential = descent.potential;
    let mut rate = vec![0.0; body.dim()];
    body.eval(0.0, motiform_dynamics::Integration::state(&orbit), &mut rate);
    let moving = rate.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    Ok(Ran { length, outcome, moving, potential, top: f64::NAN })
}

/// Sentences 57 and 58, and the figure of the potentials.
pub(super) fn claim_of(context: &Context<'_>) -> Result<(Vec<Claim>, Drawn), Error> {
    let one = |length: f64, g: [f64; 2], quartic: f64| {
        let ran = context
            .kept
            .once(&format!("potential {length} {g:?} {quartic}"), || run(context, length, g, quartic))?;
        let top = ran.potential.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        Ok(Ran { moving: context.number(ran.moving), top: context.number(top), ..ran })
    };
    let all = |g: [f64; 2], quartic: f64| context.each(&LENGTHS, |length| one(*length, g, quartic));
    let (free, bounded, active) = (all([1.0, 0.0], 0.0)?, all([1.0, 0.0], 1.0)?, all([0.0, -1.0], 0.0)?);
    let figure = picture(context, &bounded, &active)?;
    Ok((vec![unbounded(&free, &bounded), simple(&bounded, &active)], figure))
}

fn unbounded(free: &[Ran], bounded: &[Ran]) -> Claim {
    let words = free.iter().map(|ran| match ran.outcome {
        Outcome::Escaped { t, .. } => format!("*L* = {}: blows up at *t* = {t:.1}", ran.length),
        _ => format!(
            "*L* = {}: bounded, potential {:.3}",
            ran.length,
            ran.potential.last().unwrap_or(&f64::NAN)
        ),
    });
    let escaped = free.iter().filter(|ran| matches!(ran.outcome, Outcome::Escaped { .. })).count();
    claim(
        &[57],
        "To make the potential functional bounded below, we need to add ∫ d*s* (∂_s*φ*)^4.",
        format!(
            "without it {}; with it (*φ*_s^2*φ*_ss added, factor 1) all {} runs stay bounded",
            words.collect::<Vec<_>>().join("; "),
            bounded.len()
        ),
        "random small starts with *g*_4 = 1, *g*_5 = 0; without the quartic potential at least one run \
        leaves every bound, with it none, and the potential stays below 100",
        escaped > 0
            && bounded.iter().all(|ran| ran.outcome.is_complete() && ran.top < 100.0 && ran.top > 1e-6),
    )
}

fn simple(bounded: &[Ran], active: &[Ran]) -> Claim {
    let words = |runs: &[Ran]| {
        let one = |ran: &Ran| format!("{:.0e} at *L* = {}", ran.moving, ran.length);
        runs.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    claim(
        &[58],
        "Therefore this nonlinearity does not cause any asymptotic complex dynamics such as domain oscillation.",
        format!(
            "with *g*_4 = 1 and the quartic potential the potential falls all the time and the shape comes \
            to rest: largest rate of change of a mode at the end {}; with *g*_5 = -1 instead {}",
            words(bounded),
            words(active)
        ),
        "the same runs: rates of change below 10^{-7} and a potential that never grows; with *g*_5 at \
         least two of the shapes still change",
        bounded.iter().all(|ran| ran.moving < STILL && ran.descends())
            && active.iter().filter(|ran| ran.moving > 1e3 * STILL).count() >= 2,
    )
}

fn picture(context: &Context<'_>, bounded: &[Ran], active: &[Ran]) -> Result<Drawn, Error> {
    let series = |ran: &Ran, label: String| ErrorBarSeries {
        label,
        points: (0..)
            .zip(&ran.potential)
            .step_by(2)
            .take(80)
            .map(|(i, y)| Measured { x: 10.0 * f64::from(i), y: *y, error: 0.0 })
            .collect(),
        joined: true,
    };
    let figure = Chart {
        x_label: "*t*".to_owned(),
        y_label: "potential per length".to_owned(),
        zero_line: true,
        ..Chart::default()
    }
    .with([
        series(&bounded[2], format!("*g*_4 = 1 with quartic potential, *L* = {}", bounded[2].length)),
        series(&active[2], format!("*g*_5 = -1, *L* = {}", active[2].length)),
    ]);
    context.sheet(figure)
}
