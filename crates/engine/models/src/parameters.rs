//! The registry of parameters: one declaration drives the struct, the study schema, `--help` and the documentation.

use crate::error::{Error, nearest};
use crate::spelling::canonical;

/// One parameter of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterSpec {
    /// The paper's name in ASCII, used everywhere.
    pub name: &'static str,
    /// Notation in figures: letters between `*` are italic, `_` starts a subscript.
    pub symbol: &'static str,
    /// The default value.
    pub default: f64,
    /// The range of interest (axes and sliders).
    pub range: (f64, f64),
    /// `true` if that range was chosen, not guessed from the default value.
    pub ranged: bool,
    /// The allowed values.
    pub allowed: (f64, f64),
    /// `true` if only whole numbers are allowed.
    pub whole: bool,
    /// The equation in which it occurs.
    pub equation: &'static str,
    /// The term it multiplies and its effect, in one sentence.
    pub meaning: &'static str,
}

/// The parameters of a model, with their registry.
pub trait Parameters: Copy + Default {
    /// Name of the model, for messages.
    const MODEL: &'static str;

    /// The registry, in the order of [`Parameters::values`].
    fn specs() -> &'static [ParameterSpec];

    /// All values, in registry order.
    fn values(&self) -> Vec<f64>;

    /// Sets the value at a registry index, unchecked.
    fn set_at(&mut self, index: usize, value: f64);

    /// Sets a parameter by name.
    ///
    /// # Errors
    /// [`Error::UnknownParameter`] with the nearest name, [`Error::OutOfRange`].
    fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let index = index_of(Self::specs(), Self::MODEL, name)?;
        let (min, max) = Self::specs()[index].allowed;
        if !(min..=max).contains(&value) {
            return Err(Error::OutOfRange { name: name.to_owned(), value, min, max });
        }
        self.set_at(index, value);
        Ok(())
    }
}

/// Place of a parameter in a registry.
///
/// # Errors
/// [`Error::UnknownParameter`] with the nearest name.
pub fn index_of(specs: &[ParameterSpec], model: &'static str, name: &str) -> Result<usize, Error> {
    specs.iter().position(|spec| spec.name == name).ok_or_else(|| Error::UnknownParameter {
        name: name.to_owned(),
        model,
        nearest: Some(canonical(specs, name))
            .filter(|meant| *meant != name)
            .or_else(|| nearest(name, specs.iter().map(|spec| spec.name)))
            .and_then(|found| specs.iter().map(|spec| spec.name).find(|&known| known == found)),
        known: specs.iter().map(|spec| spec.name).collect(),
    })
}

/// The range given after `within`, or any number of sensible size.
#[doc(hidden)]
pub const fn allowed(within: &[(f64, f64)]) -> (f64, f64) {
    match within {
        [range, ..] => *range,
        [] => (-1e6, 1e6),
    }
}

/// Returns `true` if a parameter was declared as a whole number.
#[doc(hidden)]
pub const fn is_whole(kind: &[&str]) -> bool {
    !kind.is_empty()
}

/// Declares a parameter struct together with its registry: `name = default in low .. high`, the range of interest, and
/// if the model does not allow every number, `within smallest .. largest`; a whole number is declared `as whole`.
#[macro_export]
macro_rules! parameters {
    (
        $(#[$doc:meta])* $name:ident for $model:literal {
            $( $field:ident = $default:literal in $low:literal .. $high:literal
               $( within $smallest:literal .. $largest:literal )? $( as $whole:ident )?,
               $symbol:literal, $equation:literal, $meaning:literal; )*
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $( #[doc = $meaning] pub $field: f64, )*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $( $field: $default, )* }
            }
        }

        impl $crate::parameters::Parameters for $name {
            const MODEL: &'static str = $model;

            fn specs() -> &'static [$crate::parameters::ParameterSpec] {
                const SPECS: &[$crate::parameters::ParameterSpec] = &[ $(
                    $crate::parameters::ParameterSpec {
                        name: stringify!($field),
                        symbol: $symbol,
                        default: $default,
                        range: ($low, $high),
                        ranged: true,
                        allowed: $crate::parameters::allowed(&[$( ($smallest, $largest) )?]),
                        whole: $crate::parameters::is_whole(&[$( stringify!($whole) )?]),
                        equation: $equation,
                        meaning: $meaning,
                    },
                )* ];
                SPECS
            }

            fn values(&self) -> Vec<f64> {
                vec![ $( self.$field, )* ]
            }

            fn set_at(&mut self, index: usize, value: f64) {
                let fields = [ $( &mut self.$field, )* ];
                for (place, field) in fields.into_iter().enumerate() {
                    if place == index {
                        *field = value;
                    }
                }
            }
        }
    };
}
pub use parameters;
