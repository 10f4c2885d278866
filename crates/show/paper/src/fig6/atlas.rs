//! The atlas of the cell: all steady motions that are connected to the circle, stable or not, over the length.

use super::super::claims::check;
use super::super::context::Context;
use super::lengths::study;
use motiform_diagrams::draw::{Ordinate, branch_diagram};
use motiform_diagrams::{Branches, Followed, SpecialEntry, stretches};
use motiform_dynamics::sample::sort_by_number;
use motiform_figures::report::{Claim, ReportFigure};
use motiform_study::branches::{Along, BranchPlan, BranchSettings};
use motiform_study::{Error, Stride, Towards};
use std::sync::Arc;

/// The lengths; the quick version ends in the middle.
const RANGE: (f64, f64) = (6.0, 32.0);
const QUICK: f64 = 16.0;

/// Modes of the shape.
const MODES: usize = 21;

/// More branches than there are.
const MOST: usize = 100;

/// Measured before, by another program: kind, length, digits given.
const KNOWN: [(&str, f64, f64); 7] = [
    ("pitchfork", 12.278_498, 1e-6),
    ("hopf", 12.973_310, 1e-6),
    ("pitchfork", 14.920_437, 1e-6),
    ("hopf", 20.833_828, 1e-6),
    ("fold", 21.889_648, 1e-6),
    ("pitchfork", 22.415_619, 1e-6),
    ("hopf", 31.520_732, 1e-6),
];

/// The branches, and what was planned.
pub(super) struct Atlas {
    plan: BranchPlan,
    found: Arc<Branches>,
    /// The largest length.
    end: f64,
}

impl Atlas {
    /// Follows the circle from the length 6, and what begins on its branch.
    pub(super) fn follow(context: &Context<'_>) -> Result<Self, Error> {
        let mut study = study(RANGE.0, MODES)?;
        context.choose("Motions of the cell", "Steady motions of the cell").clone_into(&mut study.title);
        let (end, steady) = (context.choose(RANGE.1, QUICK), context.choose(false, true));
        let along = Along { name: "length".to_owned(), from: RANGE.0, to: end };
        let stride = Stride {
            steady,
            from_stable: !steady,
            doublings: Some(0), // the cascade at 29.360 takes 1e-3 of the length, and each of its orbits a third of an hour
            direction: Towards::Up,
            ..Stride::default()
        };
        let settings = BranchSettings { branches: MOST, stride, ..BranchSettings::over(along) };
        let plan = BranchPlan::new(&study, &settings)?;
        let found = context.follow(&plan)?;
        Ok(Self { plan, found, end })
    }

    /// The diagrams.
    pub(super) fn figures(&self, context: &Context<'_>) -> Result<Vec<ReportFigure>, Error> {
        let words = [
            (
                Ordinate::Speed,
                "**The atlas of the cell.** Every steady motion that is connected to the circle, stable or not: mean speed over the \
                 length. Motionless shapes lie on the axis.",
            ),
            (Ordinate::Size, "The same branches: size of the shape, which is 0 for the circle."),
        ];
        let figure = |(ordinate, caption)| {
            let drawn = context.sheet(branch_diagram(&self.plan, &self.found, ordinate)?)?;
            Ok(ReportFigure::new(drawn, caption))
        };
        words.into_iter().map(figure).collect()
    }

    /// The claims that follow from it; the coexistence of motions is seen in the whole range alone.
    pub(super) fn claims(&self, context: &Context<'_>) -> Vec<Claim> {
        let mut all = vec![self.known(context), self.multiples(context)];
        if self.end == RANGE.1 {
            all.push(self.stable(context));
        }
        all
    }

    /// Special points of the branches of steady motions, each once, by length.
    fn special(&self) -> Vec<SpecialEntry> {
        let is_steady = |followed: &Followed| {
            followed.samples().next().is_some_and(|sample| sample.point.motion.orbit().is_none())
        };
        let steady = self.found.branches.iter().enumerate().filter(|(_, followed)| is_steady(followed));
        let mut all: Vec<SpecialEntry> = steady.flat_map(|(number, _)| self.found.special(number)).collect();
        sort_by_number(&mut all, |a| a.parameter);
        all.dedup_by(|a, b| a.kind == b.kind && (a.parameter - b.parameter).abs() < 1e-6);
        all
    }

    fn nearest(&self, context: &Context<'_>, kind: &str, length: f64) -> f64 {
        let off = self.special().into_iter().filter(|entry| entry.kind == kind);
        context.number(off.map(|entry| (entry.parameter - length).abs()).fold(f64::INFINITY, f64::min))
    }

    fn known(&self, context: &Context<'_>) -> Claim {
        let within = KNOWN.iter().filter(|known| known.1 < self.end);
        let off: Vec<(&str, f64, f64, f64)> = within
            .map(|&(kind, length, digits)| (kind, length, digits, self.nearest(context, kind, length)))
            .collect();
        check(
            "Measured before this project, by an independent program: where steady motions of the cell begin, change and end.",
            off.iter()
                .map(|(kind, length, _, off)| format!("{kind} {length}: {off:.0e}"))
                .collect::<Vec<_>>()
                .join(", "),
            &format!(
                "{HOW}. The distance from the nearest special point of that kind is less than the last digit given"
            ),
            off.iter().all(|&(_, _, digits, off)| off < digits),
        )
    }

    /// The shape of a cell of length `n L` that consists of `n` equal parts is the shape of the length `L` `n` times, with the same rates.
    /// (Of its orbits only those are followed that begin where a stable motion loses its stability.)
    fn multiples(&self, context: &Context<'_>) -> Claim {
        let mut all = Vec::new();
        for entry in self.special().into_iter().filter(|entry| entry.parameter < 0.5 * self.end) {
            for n in 2..=5 {
                let length = f64::from(n) * entry.parameter;
                if length < self.end {
                    all.push(self.nearest(context, entry.kind, length));
                }
            }
        }
        let worst = all.iter().copied().fold(0.0, f64::max);
        let claim = check(
            "A cell of *n* equal parts behaves as one part does: what happens to a steady motion at the length *L* happens at *nL* too.",
            format!(
                "for each of {} multiples of special points within the range there is one of the same kind, {worst:.0e} away at most",
                all.len()
            ),
            &format!(
                "{HOW}. An exact symmetry of the equation, which nothing in the computation knows; {MODES} modes leave 1e-6"
            ),
            !all.is_empty() && worst < 1e-5,
        );
        context.resting_on(all.len(), "multiples", claim)
    }

    /// The claim on the ranges of stable motions, and on the coexistence of steady ones.
    fn stable(&self, context: &Context<'_>) -> Claim {
        let found = &self.found;
        let ranges = found.branches.iter().flat_map(|followed| {
            let motion = followed.named().map_or("", |part| part.motion.name());
            stretches(found, followed).into_iter().map(move |range| (motion, range))
        });
        let mut ranges: Vec<(&str, [f64; 2])> = ranges.collect();
        sort_by_number(&mut ranges, |a| a.1[0]);
        let words = |(motion, [low, high]): &(&str, [f64; 2])| format!("{motion} from {low:.4} to {high:.4}");
        let moving = |motion: &str| motion == "straight" || motion == "circular";
        let beside = |(motion, [low, high]): &(&str, [f64; 2])| {
            moving(motion)
                && ranges.iter().any(|(other, rest)| !moving(other) && rest[0] < *high && *low < rest[1])
        };
        check(
            "Beyond *W*_1 a cell may move steadily although random starts come to rest: which it does depends on its start.",
            ranges.iter().map(words).collect::<Vec<_>>().join("; "),
            &format!("{HOW}; stable: all eigenvalues but those of the symmetry have negative real parts"),
            context.number(ranges.iter().filter(|range| beside(range)).count() as f64) >= 2.0,
        )
    }
}

const HOW: &str = "the circle is followed from *L* = 6 by pseudo-arclength, through folds and whether or \
    not it is stable; special points are solved for, and every steady motion that begins there is followed \
    too";
