//! The search for equilibria: random starts, and deflation from sizes that follow from the equations.

use super::FoundBy;
use super::families::Families;
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::equilibrium::{Deflation, Units, balances};
use motiform_dynamics::escape::norm;
use motiform_dynamics::sample::sort_by_number;
use motiform_dynamics::{Model, Semilinear, Watch};
use motiform_models::ModelInfo;
use motiform_study::Random;
use motiform_study::initial::{Uniform, random_shape};
use std::f64::consts::{PI, TAU};

/// Random starts are drawn with these sizes in turn, in the unit of the equations.
const SIZES: [f64; 6] = [0.01, 0.1, 0.3, 1.0, 2.0, 4.0];

/// Deflated searches begin with this stream of random numbers: the streams below are those of the random starts.
const DEFLATED: u64 = 1 << 40;

/// The same for the rays along which the terms of the equations are compared.
const RAYS: u64 = 1 << 41;

/// The same for the sizes of single coordinates of a deflated search.
const UNEVEN: u64 = 1 << 42;

/// Number of rays.
const RAY_COUNT: u64 = 8;

/// Deflated searches begin with sizes from this factor below the smallest balance of terms to this factor above the largest.
const BEYOND: f64 = 10.0;

/// The reach of deflation in successive sixteens of searches, in units of the size of the start.
const REACHES: [f64; 4] = [0.3, 1.0, 3.0, 10.0];

/// Deflation ends when so many equilibria are known: there may be infinitely many.
const MOST: usize = 400;

/// An equilibrium, the way to it, and the number of random starts that led there.
pub(super) struct Found {
    pub(super) equilibrium: RelativeEquilibrium,
    pub(super) by: FoundBy,
    pub(super) hits: usize,
    /// Dimension of the family that it stands for; 0 where it is alone.
    pub(super) family: usize,
}

/// A search for equilibria. Everything in it follows from the seed.
pub(super) struct Search<'m> {
    info: &'static ModelInfo,
    model: &'m dyn Model,
    seed: u64,
    known: Deflation,
    families: Families,
    found: Vec<Found>,
}

impl<'m> Search<'m> {
    pub(super) fn new(info: &'static ModelInfo, model: &'m dyn Model, seed: u64) -> Self {
        let (known, families) = (Deflation::of(model), Families::default());
        Self { info, model, seed, known, families, found: Vec::new() }
    }

    /// The equilibria found, the most stable first.
    pub(super) fn finish(mut self) -> Vec<Found> {
        sort_by_number(&mut self.found, |a| a.equilibrium.growth());
        self.found
    }

    /// Newton's method from the circle and from `starts` random shapes. `None` if the watch stopped it.
    pub(super) fn starts(&mut self, starts: usize, watch: &dyn Watch) -> Option<()> {
        let unit = Units::of(self.model).length;
        for start in 0..=starts {
            if watch.stopped() {
                return None;
            }
            let guess = match start {
                0 => vec![0.0; self.model.dim()],
                _ => random_shape(self.model, SIZES[start % SIZES.len()] * unit, self.seed, start as u64),
            };
            if let Some(new) = RelativeEquilibrium::find(self.model, &guess) {
                let hit = usize::from(start > 0);
                match self.place_of(&new) {
                    Some(place) => self.again(place, new, hit),
                    None => self.add(new, FoundBy::Starts, hit),
                }
            }
            watch.progress((start + 1) as f64 / (starts + 1) as f64);
        }
        Some(())
    }

    /// Mirror images of what was found, then deflated searches until `patience` of them in turn find nothing. `None` if the watch
    /// stopped it.
    pub(super) fn deflate(&mut self, patience: usize, watch: &dyn Watch) -> Option<()> {
        self.mirror(0);
        let (low, high) = self.sizes();
        let (mut place, mut idle) = (0, 0);
        while idle < patience {
            if watch.stopped() {
                return None;
            }
            let before = self.found.len();
            self.exhaust(place, &self.guess(place, low, high));
            idle = if self.found.len() > before { 0 } else { idle + 1 };
            place += 1;
            watch.progress(idle as f64 / patience as f64);
        }
        Some(())
    }

    /// Deflated searches from one start, until it leads to nothing new.
    fn exhaust(&mut self, place: u64, guess: &[f64]) {
        let reach = norm(guess) * REACHES[place as usize / 16 % REACHES.len()];
        while self.found.len() < MOST {
            let place = self.found.len();
            let Some(new) = self.known.find(self.model, guess, reach) else { return };
            self.add(new, FoundBy::Deflation, 0);
            self.mirror(place);
        }
    }

    /// The place in the list of an equilibrium that is known, or of the family that it belongs to.
    fn place_of(&mut self, new: &RelativeEquilibrium) -> Option<usize> {
        let is_new = |known: &Found| self.known.is_same(self.model, &known.equilibrium, new);
        let known = self.found.iter().position(is_new);
        known.or_else(|| self.families.place_of(self.model, new))
    }

    /// Notes that a known equilibrium was found again, perhaps better.
    fn again(&mut self, place: usize, new: RelativeEquilibrium, hit: usize) {
        let known = &mut self.found[place];
        known.hits += hit;
        if known.family == 0 && self.known.is_better(self.model, &new, &known.equilibrium) {
            known.equilibrium = new;
        }
    }

    fn add(&mut self, equilibrium: RelativeEquilibrium, by: FoundBy, hits: usize) {
        self.known.add(self.model, &equilibrium);
        let family = equilibrium.family_dimension(self.model);
        if family > 0 {
            self.families.begin(self.found.len(), &equilibrium);
        }
        self.found.push(Found { equilibrium, by, hits, family });
    }

    /// Adds the mirror images of all from this place on.
    fn mirror(&mut self, first: usize) {
        let last = if self.model.symmetry().mirror { self.found.len() } else { first };
        for place in first..last {
            let mut image = self.found[place].equilibrium.shape.clone();
            self.model.mirror(&mut image);
            let Some(new) = RelativeEquilibrium::find(self.model, &image) else { continue };
            if self.place_of(&new).is_none() {
                self.add(new, FoundBy::Mirror, 0);
            }
        }
    }

    /// The smallest and the largest start of deflated searches: about the sizes at which terms of the equations balance. A tenth of the
    /// balances at both ends is left out: they belong to rays along which a term nearly vanishes.
    fn sizes(&self) -> (f64, f64) {
        let rays: Vec<Vec<f64>> = (0..RAY_COUNT).map(|ray| self.of_size(1.0, 1.0, RAYS + ray)).collect();
        let sizes = balances(self.model, &rays);
        let at = |place: usize| sizes.get(place).copied().unwrap_or(self.info.size);
        (at(sizes.len() / 10) / BEYOND, at(sizes.len() * 9 / 10) * BEYOND)
    }

    fn of_size(&self, min: f64, max: f64, stream: u64) -> Vec<f64> {
        Random::Sizes { min, max }.shape(self.info, self.model, self.seed, stream)
    }

    /// The start of a deflated search: a random shape, every other one with decaying modes as small as the
    /// others make them, and every fourth between two known equilibria. In every other one of the former the
    /// coordinates have sizes of their own, over two decades; of four, two are symmetric.
    fn guess(&self, place: u64, low: f64, high: f64) -> Vec<f64> {
        let mut random = Uniform::new(self.seed, UNEVEN + place);
        if place / 4 % 4 == 2 && self.found.len() > 1 {
            return self.between(&mut random);
        }
        let mut shape = self.of_size(low, high, DEFLATED + place);
        if place % 2 == 1 {
            shape.iter_mut().for_each(|x| *x *= libm::exp10(random.draw() - 1.0));
        }
        if place / 4 % 2 == 1 {
            slaved(self.model, &mut shape);
        }
        if place / 2 % 2 == 1 { symmetric(self.model, shape, &mut random) } else { shape }
    }

    /// A shape on the line through two known equilibria, one of them turned at random.
    fn between(&self, random: &mut Uniform) -> Vec<f64> {
        let last = self.found.len() - 1;
        let mut pick = || {
            let place = 0.5 * (1.0 + random.draw()) * self.found.len() as f64;
            self.found[(place as usize).min(last)].equilibrium.shape.clone()
        };
        let (one, mut other) = (pick(), pick());
        let part = 0.5 + random.draw();
        self.model.rotate(PI * random.draw(), &mut other);
        one.iter().zip(&other).map(|(x, y)| part * x + (1.0 - part) * y).collect()
    }
}

/// Divides each coordinate by `1 + |lambda|/growth`, with its rate and the largest one: what decays faster
/// than anything grows follows the others, and is small in equilibria. Nothing changes where the linear part
/// lets nothing grow.
fn slaved(model: &dyn Model, shape: &mut [f64]) {
    let mut rates = vec![0.0; shape.len()];
    Semilinear::<f64>::linear(model, &mut rates);
    let growth = rates.iter().copied().fold(0.0, f64::max);
    if growth > 0.0 {
        shape.iter_mut().zip(&rates).for_each(|(x, rate)| *x /= 1.0 + rate.abs() / growth);
    }
}

/// The shape averaged over the turns by a k-th of a circle and, for `k = 1` and half of the others, with its mirror image, in its old size.
///
/// Newton's method stays among shapes with the symmetry of its start: they have a fraction of the unknowns, and many equilibria are among
/// them. Small k are drawn more often.
fn symmetric(model: &dyn Model, shape: Vec<f64>, random: &mut Uniform) -> Vec<f64> {
    let symmetry = model.symmetry();
    let most = if symmetry.rotations { model.highest_mode().max(1) as f64 } else { 1.0 };
    let fold = libm::pow(most, 0.5 * (1.0 + random.draw())).round();
    let mirrored = symmetry.mirror && (fold == 1.0 || random.draw() > 0.0);
    let mut sum = vec![0.0; shape.len()];
    for part in 0..fold as usize {
        let mut turned = shape.clone();
        model.rotate(TAU / fold * part as f64, &mut turned);
        sum.iter_mut().zip(&turned).for_each(|(sum, x)| *sum += x);
    }
    if mirrored {
        let mut image = sum.clone();
        model.mirror(&mut image);
        sum.iter_mut().zip(&image).for_each(|(sum, x)| *sum += x);
    }
    let (old, new) = (norm(&shape), norm(&sum));
    if new <= 1e-9 * old {
        return shape; // no shape but the circle is as symmetric
    }
    sum.iter_mut().for_each(|x| *x *= old / new);
    sum
}
