//! The active cell with few modes is the tensor model: exactly, and where its rectangular motion lies.

use super::super::claims::claim;
use super::super::context::Context;
use super::super::fig6::Branch;
use motiform_dynamics::VectorField as _;
use motiform_figures::report::Claim;
use motiform_models::cell::reduction::{Slaved, amplitudes, reduce};
use motiform_models::cell::{CellField, CellParameters};
use motiform_models::tensor::{Coefficients, FourierField};
use motiform_study::Error;
use motiform_study::initial::Uniform;

/// Random states per length.
const STATES: usize = 1000;
const LENGTHS: [f64; 4] = [7.0, 13.0, 21.6, 29.2];

/// The field of the truncated cell against the tensor model's.
pub(super) fn exact(context: &Context<'_>) -> Claim {
    let mut random = Uniform::new(1, 0);
    let mut worst: f64 = 0.0;
    for length in LENGTHS {
        let parameters = CellParameters { length, ..CellParameters::default() };
        let (cell, tensor) =
            (CellField::new(&parameters, 3), FourierField::all(reduce(&parameters, Slaved::Nothing)));
        for _ in 0..STATES {
            let shape: [f64; 6] = std::array::from_fn(|_| random.draw());
            let (mut rate, mut expected) = ([0.0; 6], [0.0; 6]);
            cell.eval(0.0, &shape, &mut rate);
            tensor.eval(0.0, &amplitudes(&shape), &mut expected);
            let size = expected.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let off = amplitudes(&rate).iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            worst = worst.max(off / size);
        }
    }
    let worst = context.number(worst);
    claim(
        &[172, 174],
        "With the modes 1, 2 and 3 alone, the active cell has essentially the same equations as the tensor model.",
        format!(
            "they are the same: with coefficients given by *L* alone the two fields differ by at most {worst:.0e} of their size"
        ),
        "Cell field with three modes against the tensor model's field in *w_n* = *i*^{1-n} *φ_n*, at 1000 \
        random states for each of four lengths (7 to 29.2).",
        worst < 1e-14,
    )
}

/// The lengths between which the cycle of the whole model exists and attracts.
fn whole(context: &Context<'_>) -> Result<[f64; 2], Error> {
    let whole = Branch::settled(context, 16.0, 12)?;
    let end = whole.edge(12.0, |_, found| found.is_stable())?;
    let mut inside = Branch::settled(context, 16.0, 12)?;
    for length in [15.6, 15.2, 14.8, 14.4, 14.0] {
        if let Some(next) = inside.at(length)? {
            inside = next;
        }
    }
    let start =
        inside.edge(12.0, |cell, found| found.saddle(cell).is_some_and(|saddle| saddle.attracts()))?;
    Ok([start, end].map(|edge| edge.unwrap_or(f64::NAN)))
}

/// The same with the reductions.
pub(super) fn edges(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let [start, end] =
        context.kept.once("edges of the cycle", || whole(context))?.map(|edge| context.number(edge));
    let two = reduced(Slaved::ThirdAndFourth);
    let three = reduced(Slaved::Fourth);
    Ok(vec![claim(
        &[173],
        "If the modes higher than *n* = 3 relax rapidly, the modes 1, 2 and 3 may be retained alone.",
        format!(
            "the heteroclinic cycle attracts for *L* = {start:.2} to {end:.2} in the whole model, {:.2} to \
            {:.2} with modes 1 to 3 (mode 4 slaved), {:.2} to {:.2} with modes 1 and 2 (3 and 4 slaved)",
            three.0, three.1, two.0, two.1
        ),
        "*λ*_+ + *λ*_− < 0 < *λ*_+ at the two-fold shape. Slaved modes follow the others to quadratic \
        order. The window exists in all three, its lower edge within 0.5.",
        [two, three].iter().all(|(from, to)| from < to && (from - start).abs() < 0.5),
    )])
}

/// First and last length at which the cycle of a reduction attracts, by a walk in length.
fn reduced(slaved: Slaved) -> (f64, f64) {
    let attracts = |length: f64| {
        let c = reduce(&CellParameters { length, ..CellParameters::default() }, slaved);
        rates(&c).is_some_and(|(out, inward)| out > 0.0 && out + inward < 0.0)
    };
    let lengths = || (12_570..18_800).map(|thousandths| f64::from(thousandths) / 1000.0);
    let first = lengths().find(|length| attracts(*length)).unwrap_or(f64::NAN);
    let last = lengths().find(|length| *length > first && !attracts(*length)).unwrap_or(f64::NAN);
    (first, last)
}

/// `lambda_+` and `lambda_-` at the pure mode `w_2 = r`: the larger and the smaller of the leading eigenvalues of
/// `(w_1, w_3)`, along and across the mirror axis.
fn rates(c: &Coefficients<f64>) -> Option<(f64, f64)> {
    let r = (c.kappa2 / c.d22).sqrt();
    let leading = |sign: f64| {
        let (a, b) = (c.gamma + c.d12 * r * r + sign * c.e11 * r, c.e13 * r + sign * c.e14 * r * r);
        let (p, q) = (c.e32 * r + sign * c.e33 * r * r, -c.kappa3 + c.d32 * r * r);
        let (half, product) = (0.5 * (a + q), a * q - b * p);
        half + (half * half - product).max(0.0).sqrt()
    };
    let (one, other) = (leading(1.0), leading(-1.0));
    r.is_finite().then_some((one.max(other), one.min(other)))
}
