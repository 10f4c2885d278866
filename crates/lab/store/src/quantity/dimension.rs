//! Dimensions: powers of length and time, and angles.

/// The dimension of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Powers of length and time, 0 for numbers and texts; with an angle in radians as a factor or without.
    Powers {
        /// Power of length.
        length: i8,
        /// Power of time.
        time: i8,
        /// Radians.
        angle: bool,
    },
    /// None in common: of several quantities, or of a size of velocity and shape together.
    Mixed,
}

impl Dimension {
    /// Numbers and texts.
    pub const NUMBER: Self = Self::of(0, 0);
    /// Angles.
    pub const ANGLE: Self = Self::Powers { length: 0, time: 0, angle: true };
    /// Lengths.
    pub const LENGTH: Self = Self::of(1, 0);
    /// Squares of lengths.
    pub const AREA: Self = Self::of(2, 0);
    /// Times.
    pub const TIME: Self = Self::of(0, 1);
    /// Rates and frequencies.
    pub const RATE: Self = Self::of(0, -1);
    /// Speeds.
    pub const SPEED: Self = Self::of(1, -1);
    /// Rates of change of an angle.
    pub const TURNING: Self = Self::Powers { length: 0, time: -1, angle: true };
    /// Coefficients of diffusion.
    pub const DIFFUSION: Self = Self::of(2, -1);
    /// None in common.
    pub const MIXED: Self = Self::Mixed;

    /// Powers of length and time.
    pub const fn of(length: i8, time: i8) -> Self {
        Self::Powers { length, time, angle: false }
    }

    /// The dimension of a density over this quantity.
    #[must_use]
    pub const fn inverse(self) -> Self {
        match self {
            Self::Powers { length, time, .. } => Self::of(-length, -time),
            Self::Mixed => Self::Mixed,
        }
    }

    /// The value in these units of length and time of what is 1 in their own; 1 without a common dimension.
    pub fn factor(self, sizes: [f64; 2]) -> f64 {
        let Self::Powers { length, time, .. } = self else { return 1.0 };
        sizes[0].powi(length.into()) * sizes[1].powi(time.into())
    }

    /// The unit by these names of length and time (markup): `µm/min`, `1/min`, `rad/min`, `µm^2`; empty where there is none.
    pub fn unit(self, names: [&str; 2]) -> String {
        let Self::Powers { length, time, angle } = self else { return String::new() };
        let part = |sign: i8| {
            let powers = names.into_iter().zip([sign * length, sign * time]).filter(|entry| entry.1 > 0);
            let power =
                |(name, power)| if power == 1 { String::from(name) } else { format!("{name}^{power}") };
            let radians = (angle && sign > 0).then(|| "rad".to_owned());
            radians.into_iter().chain(powers.map(power)).collect::<Vec<_>>().join("\u{a0}")
        };
        match (part(1), part(-1)) {
            (above, below) if below.is_empty() => above,
            (above, below) if above.is_empty() => format!("1/{below}"),
            (above, below) => format!("{above}/{below}"),
        }
    }

    /// The unit of a model in words: `model length per model time`; empty where there is none.
    pub fn words(self) -> String {
        let unit = self.unit(["model length", "model time"]);
        match unit.strip_prefix("1/") {
            Some(below) => format!("inverse {below}"),
            None => unit.replace('/', " per "),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Dimension;

    #[test]
    fn units_have_sizes_and_names() {
        let all = [Dimension::LENGTH, Dimension::SPEED, Dimension::RATE, Dimension::of(2, 1)];
        assert_eq!(all.map(|one| one.unit(["µm", "min"])), ["µm", "µm/min", "1/min", "µm^2\u{a0}min"]);
        assert_eq!(all.map(|one| one.factor([20.0, 0.1])), [20.0, 200.0, 10.0, 40.0]);
        let angles = [Dimension::ANGLE, Dimension::TURNING, Dimension::NUMBER, Dimension::MIXED];
        assert_eq!(angles.map(|one| one.unit(["µm", "min"])), ["rad", "rad/min", "", ""]);
        assert_eq!(angles.map(|one| one.factor([20.0, 0.5])), [1.0, 2.0, 1.0, 1.0]);
        assert_eq!(Dimension::SPEED.words(), "model length per model time");
        assert_eq!(
            [Dimension::RATE.words(), Dimension::TURNING.words()],
            ["inverse model time", "rad per model time"]
        );
        assert_eq!(Dimension::SPEED.inverse(), Dimension::of(-1, 1));
    }
}
