//! All good subsets of one equation's coefficients by branch and bound.

use super::TIE;
use super::conditional::Conditional;
use motiform_dynamics::sample::sort_by_number;

/// Most nodes of the search.
const MOST_NODES: usize = 2_000_000;
/// Number of sets from which on worse ones are forgotten while searching.
const MANY: usize = 4096;

/// A set, by what is not in it.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    pub(crate) dropped: Vec<usize>,
    pub(crate) score: f64,
}

/// The sets within [`TIE`] of the best, the best first.
pub(crate) struct Found {
    pub(crate) choices: Vec<Choice>,
    pub(crate) complete: bool,
}

struct Search<'a> {
    /// Coefficients, those with the largest ratio to their error first.
    places: &'a [usize],
    penalty: f64,
    best: f64,
    nodes: usize,
    choices: Vec<Choice>,
}

/// The good subsets of the coefficients in `places`.
pub(crate) fn search(rest: &Conditional, places: &[usize], penalty: f64) -> Found {
    let ratio = |i: usize| rest.estimates[i].abs() / rest.covariance[(i, i)].max(f64::MIN_POSITIVE).sqrt();
    let mut places = places.to_vec();
    sort_by_number(&mut places, |&a| -ratio(a));
    let own = rest.of(&places);
    let best = greedy(&own, penalty);
    let mut search = Search { places: &places, penalty, best, nodes: 0, choices: Vec::new() };
    search.visit(0, &own, &mut Vec::new(), 0);
    search.forget();
    sort_by_number(&mut search.choices, |a| a.score);
    Found { choices: search.choices, complete: search.nodes < MOST_NODES }
}

/// Score of the set that is left when the cheapest coefficient is dropped as long as that pays: the first bound.
fn greedy(own: &Conditional, penalty: f64) -> f64 {
    let n = own.estimates.len();
    let (mut rest, mut left) = (own.clone(), (0..n).collect::<Vec<_>>());
    let mut best = penalty * n as f64;
    while !left.is_empty() {
        let cost = |i: usize| {
            let (estimate, variance) = (rest.estimates[i], rest.covariance[(i, i)]);
            if variance > 0.0 { estimate * estimate / variance } else { 0.0 }
        };
        sort_by_number(&mut left, |&a| -cost(a));
        if let Some(cheapest) = left.pop() {
            rest.drop(cheapest);
        }
        best = best.min(rest.cost + penalty * left.len() as f64);
    }
    best
}

impl Search<'_> {
    /// Decides on coefficient `depth`. Costs only grow when more is dropped, so a partial score is a bound.
    fn visit(&mut self, depth: usize, rest: &Conditional, dropped: &mut Vec<usize>, kept: usize) {
        self.nodes += 1;
        let score = rest.cost + self.penalty * kept as f64;
        if score > self.best + TIE || self.nodes > MOST_NODES {
            return;
        }
        if depth == self.places.len() {
            self.best = self.best.min(score);
            self.choices.push(Choice { dropped: dropped.clone(), score });
            if self.choices.len() > MANY {
                self.forget();
            }
            return;
        }
        let mut without = rest.clone();
        without.drop(depth);
        dropped.push(self.places[depth]);
        self.visit(depth + 1, &without, dropped, kept);
        dropped.pop();
        self.visit(depth + 1, rest, dropped, kept + 1);
    }

    fn forget(&mut self) {
        let limit = self.best + TIE;
        self.choices.retain(|choice| choice.score <= limit);
    }
}
