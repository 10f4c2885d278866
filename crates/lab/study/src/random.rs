//! Random initial states: their sizes and directions.

use crate::initial::Uniform;
use crate::plan::check;
use crate::scales::SMALL_BESIDE;
use crate::{Error, Scales};
use motiform_dynamics::Model;
use motiform_dynamics::digits::given;
use motiform_models::ModelInfo;
use serde::{Deserialize, Serialize};

/// The distribution of random initial states.
///
/// # Checked by  tests/all/starts.rs: sizes, directions, text; tests/all/random.rs: the bits of small starts
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Random {
    /// Coordinate i uniform in `-size w_i..size w_i`, independently, with the model's weights `w_i` ([`ModelInfo::weight`]: 1 for the
    /// tensor
    /// model and equations given as text, 1/n^2 for mode n of the cell, whose speed would otherwise be that of modes that die at once).
    /// Small states start near the circle and follow its unstable directions: all orbits may follow the same one.
    Within(f64),
    /// Sizes that sample basins: the norm r of the coordinates is log-uniform, `ln r` uniform in `ln min..ln max`, and the direction is
    /// isotropic: coordinates `r w_i g_i / |w g|` with normal `g_i` and the model's weights `w_i` (the same for both coordinates of
    /// a harmonic, so that all orientations are alike).
    Sizes {
        /// Smallest norm, above 0.
        min: f64,
        /// Largest norm.
        max: f64,
    },
}

impl Random {
    /// The default distribution of a single start.
    pub const SMALL: Self = Self::Within(0.01);

    /// Small starts of a model at all of these parameters: a hundredth of the size at which terms balance, if that is no ordinary one.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub fn small(info: &ModelInfo, all: &[Vec<f64>]) -> Result<Self, Error> {
        Ok(Scales::starts(info, all, &SMALL_BESIDE)?.map_or(Self::SMALL, |size| Self::Within(0.01 * size)))
    }

    /// The default distribution of several starts: from a hundredth of the typical size of a model to the full size.
    pub const fn basins(size: f64) -> Self {
        Self::Sizes { min: size / 100.0, max: size }
    }

    /// Reads `0.3` ([`Random::Within`]) or `0.01:1` ([`Random::Sizes`]).
    ///
    /// # Errors
    /// [`Error::Setting`] for another text, and the errors of [`Random::check`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        let wrong = || Error::Setting {
            key: "random",
            value: text.to_owned(),
            remedy: "give one size, like 0.3, or the smallest and the largest, like 0.01:1",
        };
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
        let random = match text.split_once(':') {
            Some((min, max)) => Self::Sizes { min: number(min)?, max: number(max)? },
            None => Self::Within(number(text)?),
        };
        random.check()?;
        Ok(random)
    }

    /// Rejects invalid sizes.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn check(&self) -> Result<(), Error> {
        match *self {
            Self::Within(size) => check("random", size, size >= 0.0, "give a size of at least 0"),
            Self::Sizes { min, max } => {
                check("random", min, min > 0.0, "give a smallest size above 0")?;
                check("random", max, max >= min, "give a largest size of at least the smallest one")
            }
        }
    }

    /// The largest size.
    pub fn largest(&self) -> f64 {
        match *self {
            Self::Within(size) => size,
            Self::Sizes { max, .. } => max,
        }
    }

    /// The distribution as text: `uniform within ±0.01`, `of size 0.01 to 1, log-uniform`.
    pub fn words(&self) -> String {
        match *self {
            Self::Within(size) => format!("uniform within ±{}", given(size)),
            Self::Sizes { min, max } if min == max => format!("of size {}", given(min)),
            Self::Sizes { min, max } => format!("of size {} to {}, log-uniform", given(min), given(max)),
        }
    }

    /// The coordinates of the start with this seed and stream, `count` of them.
    pub fn coordinates(&self, info: &ModelInfo, count: usize, seed: u64, stream: u64) -> Vec<f64> {
        let mut random = Uniform::new(seed, stream);
        match *self {
            Self::Within(size) => {
                (0..count).map(|place| size * (info.weight)(place) * random.draw()).collect()
            }
            Self::Sizes { min, max } => {
                let size = min * libm::exp(0.5 * (1.0 + random.draw()) * libm::log(max / min));
                let direction: Vec<f64> =
                    (0..count).map(|place| (info.weight)(place) * normal(&mut random)).collect();
                let norm = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
                direction.into_iter().map(|x| size * x / norm).collect()
            }
        }
    }

    /// The same in the model's representation.
    pub fn shape(&self, info: &ModelInfo, model: &dyn Model, seed: u64, stream: u64) -> Vec<f64> {
        let coordinates = self.coordinates(info, model.coordinates().len(), seed, stream);
        model.encoded(&coordinates)
    }
}

impl From<f64> for Random {
    fn from(size: f64) -> Self {
        Self::Within(size)
    }
}

impl std::fmt::Display for Random {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Within(size) => write!(f, "{size}"),
            Self::Sizes { min, max } => write!(f, "{min}:{max}"),
        }
    }
}

/// A normal number: Box and Muller (1958), Ann. Math. Stat. 29, 610. The radius needs a number above 0, and 1 - (0..1) is one.
fn normal(random: &mut Uniform) -> f64 {
    let radius = (-2.0 * libm::log(1.0 - 0.5 * (1.0 + random.draw()))).sqrt();
    radius * libm::cos(std::f64::consts::PI * random.draw())
}
