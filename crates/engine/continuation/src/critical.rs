//! The condition that holds along a curve of special points, as a function that vanishes there.

use super::levels::Level;
use super::special::Special;
use motiform_dynamics::sample::sort_by_number;

/// Levels closer than this part of the largest one are the same.
const TWINS: f64 = 1e-12;

/// The critical condition along a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Condition {
    /// An eigenvalue 0, or a multiplier +1.
    Steady,
    /// A multiplier -1.
    Flip,
    /// A pair of eigenvalues `+-i omega`, or of multipliers `exp(+-i angle)`.
    Pair,
}

/// The condition, in the class of deviations where it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Critical {
    pub(super) condition: Condition,
    pub(super) class: usize,
    /// `true` if the levels are those of multipliers.
    pub(super) orbits: bool,
    /// The unit of levels.
    pub(super) rate: f64,
}

/// The condition at one place.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// Vanishes where the condition holds, and is smooth there.
    pub(super) value: f64,
    /// Distance of the critical multiplier from where it belongs (of a pair: its mean growth); of eigenvalues in units of the rate of the
    /// equations.
    pub(super) off: f64,
    /// Of a pair: `omega^2`, or the cosine of the angle. They pass 0, or +-1, where the pair becomes real.
    pub(super) angle: f64,
    /// The ranks of the critical levels in their class.
    pub(super) members: Vec<usize>,
}

impl Critical {
    /// The critical condition at a special point.
    pub(super) fn of(
        special: Special,
        levels: &[Vec<Level>],
        (orbits, rate): (bool, f64),
    ) -> Option<(Self, Reading)> {
        let (condition, angle) = match special {
            Special::Fold | Special::Pitchfork { .. } | Special::BranchPoint => (Condition::Steady, 0.0),
            Special::PeriodDoubling | Special::SymmetryBreaking => (Condition::Flip, 0.0),
            Special::Hopf(hopf) => (Condition::Pair, hopf.frequency * hopf.frequency),
            Special::Torus { angle } => (Condition::Pair, libm::cos(angle)),
            Special::Continuum | Special::Unresolved { .. } | Special::Touch { .. } => return None,
        };
        let read = |class| {
            let critical = Self { condition, class, orbits, rate };
            critical.read(levels, angle).map(|reading| (critical, reading))
        };
        let off =
            |reading: &Reading| reading.value.abs() / rate + (reading.angle - angle).abs() / (rate * rate);
        let all = (0..levels.len()).filter_map(read);
        all.min_by(|a, b| off(&a.1).total_cmp(&off(&b.1)))
    }

    /// The condition's value; of several pairs the one whose angle was `angle`.
    pub(super) fn read(&self, levels: &[Vec<Level>], angle: f64) -> Option<Reading> {
        let levels = levels.get(self.class)?;
        match self.condition {
            Condition::Steady => self.steady(levels, if self.orbits { 1.0 } else { 0.0 }),
            Condition::Flip => self.steady(levels, -1.0),
            Condition::Pair => self.pair(levels, angle),
        }
    }

    fn number(&self, level: &Level) -> (f64, f64) {
        if !self.orbits {
            return (level.growth, level.angle);
        }
        let (sin, cos) = libm::sincos(level.angle);
        let modulus = libm::exp(level.growth);
        (modulus * cos, if self.is_real(level) { 0.0 } else { modulus * sin })
    }

    fn is_real(&self, level: &Level) -> bool {
        level.angle == 0.0 || self.orbits && level.angle.abs() == std::f64::consts::PI
    }

    /// The product of the two smallest `lambda - centre`: where both vanish, each alone is not smooth. Its sign is that of the product of
    /// all, so that it stays when another one becomes the second smallest.
    fn steady(&self, levels: &[Level], centre: f64) -> Option<Reading> {
        let number = |level: &Level| {
            let (re, im) = self.number(level);
            (re - centre, im)
        };
        let size = |&rank: &usize| {
            let (re, im) = number(&levels[rank]);
            libm::hypot(re, im)
        };
        let mut order: Vec<usize> = (0..levels.len()).collect();
        sort_by_number(&mut order, size);
        let first = *order.first()?;
        let (re, im) = number(&levels[first]);
        let value = match order.get(1) {
            None => re,
            Some(_) if im != 0.0 => re * re + im * im,
            Some(&second) => match number(&levels[second]) {
                (other, 0.0) => re * other,
                (other, im) => re * (other * other + im * im),
            },
        };
        let rest = order.iter().skip(2).map(|&rank| number(&levels[rank])).filter(|one| one.1 == 0.0);
        let value = rest.fold(value, |value, (re, _)| value * re.signum());
        let off = size(&first) / if self.orbits { 1.0 } else { self.rate };
        Some(Reading { value, off, angle: 0.0, members: vec![first] })
    }

    /// The mean growth of the pair.
    fn pair(&self, levels: &[Level], angle: f64) -> Option<Reading> {
        let mut all = Vec::new();
        let real: Vec<usize> = (0..levels.len()).filter(|&rank| self.is_real(&levels[rank])).collect();
        for (i, &a) in real.iter().enumerate() {
            all.extend(real[i + 1..].iter().filter_map(|&b| self.real_pair(levels, a, b)));
        }
        for (rank, level) in levels.iter().enumerate() {
            if level.angle > 0.0 && !self.is_real(level) {
                let angle = if self.orbits { libm::cos(level.angle) } else { level.angle * level.angle };
                let twin = levels.iter().position(|other| other.angle == -level.angle);
                let members = std::iter::once(rank).chain(twin).collect();
                all.push(self.growing(level.growth, angle, members));
            }
        }
        let away = |reading: &Reading| {
            let (value, turned) =
                (reading.value / self.rate, (reading.angle - angle).abs() / (self.rate * self.rate));
            value * value + turned * (1.0 + turned)
        };
        all.into_iter().min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    fn real_pair(&self, levels: &[Level], a: usize, b: usize) -> Option<Reading> {
        let (x, y) = (self.number(&levels[a]).0, self.number(&levels[b]).0);
        let value = 0.5 * (levels[a].growth + levels[b].growth);
        let members = vec![a, b];
        if !self.orbits {
            return Some(self.growing(value, -0.25 * (x - y) * (x - y), members));
        }
        (x * y > 0.0).then(|| self.growing(value, 0.5 * (x + y) / (x * y).sqrt(), members))
    }

    fn growing(&self, value: f64, angle: f64, members: Vec<usize>) -> Reading {
        let off = value.abs() / if self.orbits { 1.0 } else { self.rate };
        Reading { value, off, angle, members }
    }

    /// A number that changes its sign with every eigenvalue but the critical ones that keeps the motion's symmetry and passes 0, and is
    /// smooth: the product of `lambda / |(lambda, omega)|` over real ones, `|lambda|^2 / (|lambda|^2 + omega^2)` over pairs.
    pub(super) fn poles(&self, levels: &[Vec<Level>], reading: &Reading) -> f64 {
        let own = |rank: usize| self.class == 0 && reading.members.contains(&rank);
        let square = reading.angle.abs();
        let part = |level: &Level| {
            let size = level.growth * level.growth + level.angle * level.angle;
            let part = size / (size + square);
            // each of a pair counts as the root
            if self.is_real(level) { part.sqrt() * level.growth.signum() } else { part.sqrt() }
        };
        let kept = levels.first().into_iter().flatten().enumerate();
        kept.filter(|(rank, _)| !own(*rank)).map(|(_, level)| part(level)).product()
    }

    /// The levels that are not critical: how many real ones and how many others grow, and the growth of those closest to 0; NaN where
    /// there are none. A circle at rest has each level in all directions: its copies in other classes are critical too.
    ///
    /// Beside an eigenvalue 0 the growth of another one is that of both together: it is smooth where that vanishes, too, while round-off
    /// splits a double 0 into two real eigenvalues or a pair.
    pub(super) fn others(&self, levels: &[Vec<Level>], reading: &Reading) -> [(usize, f64); 2] {
        let mut out = [(0, f64::NAN); 2];
        let largest = levels.iter().flatten().fold(0.0, |most: f64, level| most.max(level.growth.abs()));
        let own = |rank: usize| levels.get(self.class).and_then(|levels| levels.get(rank));
        let critical: Vec<&Level> = reading.members.iter().filter_map(|&rank| own(rank)).collect();
        let copies = |level: &Level| {
            let same = |own: &&Level| (own.growth - level.growth).abs().max((own.angle - level.angle).abs());
            !self.orbits && critical.iter().any(|own| same(own) <= TWINS * largest)
        };
        let beside = |class: usize| {
            let split = self.condition == Condition::Steady && !self.orbits && class == self.class;
            if split { critical.first().copied() } else { None }
        };
        for (class, levels) in levels.iter().enumerate() {
            for (rank, level) in levels.iter().enumerate() {
                if class == self.class && reading.members.contains(&rank)
                    || class != self.class && copies(level)
                {
                    continue;
                }
                let own = beside(class);
                let of_critical = own.is_some_and(|own| own.angle != 0.0 && level.angle == -own.angle);
                let real = of_critical || self.is_real(level);
                let growth = level.growth + own.filter(|_| real).map_or(0.0, |own| own.growth);
                let (count, least) = &mut out[usize::from(!real)];
                *count += usize::from(growth > 0.0);
                if least.is_nan() || growth.abs() < least.abs() {
                    *least = growth;
                }
            }
        }
        out
    }
}
