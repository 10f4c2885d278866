//! The motions and their names in Armbruster, Guckenheimer and Holmes (1988), Physica D 29, 257.

use super::super::claims::claim;
use super::super::context::Context;
use super::super::fig6;
use super::steady::Steady;
use motiform_analysis::equilibrium::Saddle;
use motiform_analysis::{Regime, Verdict};
use motiform_figures::report::Claim;
use motiform_study::{Error, Study};

/// A term: what the paper says, where it is looked for, and what makes it so.
struct Term {
    says: &'static str,
    how: &'static str,
    /// (kappa2, gamma), followed from the first to the last.
    tensor: &'static [(f64, f64)],
    /// Lengths, likewise.
    cell: &'static [f64],
    holds: fn(&Steady) -> bool,
    finds: fn(&Steady) -> String,
}

const TERMS: [Term; 5] = [
    Term {
        says: "The motionless circle is the trivial solution.",
        how: "Settled state at rest; nothing of the shape is above its error; all eigenvalues negative.",
        tensor: &[(0.1, -0.05)],
        cell: &[6.0],
        holds: |s| s.motion.regime() == Regime::Motionless && s.motion.symmetry.circle && s.is_stable(),
        finds: |s| format!("size {:.0e}, leading eigenvalue {:.3}", s.size, s.growth.value),
    },
    Term {
        says: "The deformed motionless domain is the pure mode.",
        how: "A deformed shape that is its own mirror image, does not move and does not turn; stable.",
        tensor: &[(-0.02, -0.15)],
        cell: &[16.0],
        holds: |s| {
            let motion = &s.motion;
            let deformed = motion.has_axis() && !motion.symmetry.circle;
            motion.regime() == Regime::Motionless && deformed && s.is_stable()
        },
        finds: |s| {
            let speed = s.motion.speed.value;
            format!("size {:.3}, speed {speed:.0e}, mirror defect {:.0e}", s.size, s.asymmetry)
        },
    },
    Term {
        says: "The straight motion is the standing wave.",
        how: "A shape that is its own mirror image, moves and does not turn; stable.",
        tensor: &[(0.18, 0.1)],
        cell: &[9.0],
        holds: |s| s.motion.regime() == Regime::Straight && s.motion.has_axis() && s.is_stable(),
        finds: |s| {
            format!(
                "speed {:.2e}, turning rate {:.0e}, mirror defect {:.0e}",
                s.motion.speed.value, s.motion.turning_rate.value, s.asymmetry
            )
        },
    },
    Term {
        says: "The circular motion is the travelling wave.",
        how: "A shape that differs from its mirror image and turns at a constant rate; stable.",
        tensor: &[(0.02, 0.1)],
        cell: &[12.6],
        holds: |s| s.motion.regime() == Regime::Circular && !s.motion.has_axis() && s.is_stable(),
        finds: |s| {
            let turning = s.motion.turning_rate.value.abs();
            format!("turning rate {turning:.3}, mirror defect {:.3}", s.asymmetry)
        },
    },
    Term {
        says: "The rectangular motion is the heteroclinic cycle.",
        how: "The pure mode, followed into the region of the rectangular motion: one growing direction, and *λ*_+ + *λ*_− < 0.",
        tensor: &[(-0.1, -0.3), (-0.1, -0.04)],
        cell: &[16.0, 15.6, 15.2, 14.8, 14.4, 14.0, 13.7, 13.4, 13.2],
        holds: |s| {
            s.motion.regime() == Regime::Motionless && s.saddle.is_some_and(|saddle| saddle.attracts())
        },
        finds: |s| {
            s.saddle.map_or("no saddle".to_owned(), |Saddle { out, inward, .. }| {
                format!("*λ*_+ = {out:.4}, *λ*_− = {inward:.4}")
            })
        },
    },
];

/// The parameters of the modulated wave and of the rectangular motion: (kappa2, gamma), length.
const MODULATED: ((f64, f64), f64) = ((-0.14, 0.05), 21.8);
const RECTANGULAR: ((f64, f64), f64) = ((-0.1, -0.04), 13.2);

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let mut claims: Vec<Claim> = context.each(&TERMS, |term| term.check(context))?;
    let places = [MODULATED, RECTANGULAR];
    let studies: Vec<Study> = places
        .iter()
        .map(|(point, length)| Ok([tensor(context, *point)?, cell(*length)?]))
        .collect::<Result<Vec<_>, Error>>()?
        .concat();
    let verdicts: Vec<Verdict> = context.each(&studies, |study| context.classify(study))?;
    if let [a, b, c, d] = &verdicts[..] {
        claims.extend([modulated(a, b), runs(c, d)]);
    }
    Ok(claims)
}

/// The parameters of the reduced tensor model, and where each model is looked at.
pub(super) fn parameters() -> Vec<(String, String)> {
    let text = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    vec![
        text(
            "tensor model, reduced",
            "*a*_1 = 1, *b*_1 = 0.5, *b*_3 = 1, no *U* (Fig. 1); *κ*_2 and *γ* as given",
        ),
        text("tensor model, full", "Fig. 5(a): *κ*_2 = 0.9, *κ*_3 = 0.1"),
        text("active cell", "as in Fig. 6; *L* as given"),
    ]
}

impl Term {
    fn check(&self, context: &Context<'_>) -> Result<Claim, Error> {
        let points =
            self.tensor.iter().map(|point| tensor(context, *point)).collect::<Result<Vec<_>, _>>()?;
        let modes = self.cell.iter().map(|length| fig6::modes_for(*length)).max().unwrap_or(8);
        let lengths =
            self.cell.iter().map(|length| fig6::study(*length, modes)).collect::<Result<Vec<_>, _>>()?;
        let found = [("tensor", &points), ("cell", &lengths)]
            .map(|(model, studies)| Steady::along(context, &format!("{model} {}", self.says), studies));
        let [tensor, cell] = found;
        let found = [tensor?, cell?];
        let words = found.iter().map(|s| s.as_ref().map_or("not found".to_owned(), self.finds));
        let words: Vec<String> = words.collect();
        let (kappa2, gamma) = self.tensor.last().copied().unwrap_or((f64::NAN, f64::NAN));
        let length = self.cell.last().copied().unwrap_or(f64::NAN);
        let finds = format!(
            "tensor model at *κ*_2 = {kappa2}, *γ* = {gamma}: {}; active cell at *L* = {length}: {}",
            words[0], words[1]
        );
        Ok(claim(
            &[170],
            self.says,
            finds,
            self.how,
            found.iter().all(|s| s.as_ref().is_some_and(self.holds)),
        ))
    }
}

fn tensor(context: &Context<'_>, (kappa2, gamma): (f64, f64)) -> Result<Study, Error> {
    context.preset("fig1", |study| {
        study.set("kappa2", kappa2)?;
        study.set("gamma", gamma)
    })
}

fn cell(length: f64) -> Result<Study, Error> {
    fig6::study(length, fig6::modes_for(length))
}

fn modulated(tensor: &Verdict, cell: &Verdict) -> Claim {
    let ((kappa2, gamma), length) = MODULATED;
    let words = |v: &Verdict| {
        let (period, rotation) = (v.period.unwrap_or(f64::NAN), v.net_rotation.unwrap_or(f64::NAN));
        format!("{}, period {period:.1}, net rotation {:.1} degrees", v.regime, rotation.to_degrees())
    };
    claim(
        &[170],
        "The quasi-periodic motion is the modulated wave.",
        format!(
            "tensor model at *κ*_2 = {kappa2}, *γ* = {gamma}: {}; active cell at *L* = {length}: {} (in *W*_2, where mode 3 takes part)",
            words(tensor),
            words(cell)
        ),
        "Newton's method on the return of the reduced shape: it repeats, turned by a net rotation.",
        [tensor, cell].iter().all(|v| v.regime == Regime::QuasiPeriodic),
    )
}

fn runs(tensor: &Verdict, cell: &Verdict) -> Claim {
    let ((kappa2, gamma), length) = RECTANGULAR;
    let rests = |v: &Verdict| {
        let sum: f64 = v.rests.iter().sum();
        format!("{}, {} rests of {:.0} on average", v.regime, v.rests.len(), sum / v.rests.len() as f64)
    };
    claim(
        &[4, 184, 185],
        "The rectangular motion is common to both models (straight, circular, quasi-periodic: above; chaos and zigzag: below).",
        format!(
            "tensor model at *κ*_2 = {kappa2}, *γ* = {gamma}: {}; active cell at *L* = {length}: {}",
            rests(tensor),
            rests(cell)
        ),
        "Runs from random starts, named by the same classifier.",
        [tensor, cell].iter().all(|v| v.regime == Regime::Rectangular),
    )
}
