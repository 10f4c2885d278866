//! Plain values: numbers, texts, switches, as a study file, an option or Python gives them.

use crate::Error;
use serde_json::Value;

/// A value of a setting, with the way to say what is wrong with it.
pub(crate) trait Plain {
    /// A finite number.
    fn number(&self) -> Result<f64, Error>;

    /// A whole number of at least 0.
    fn whole(&self) -> Result<u64, Error>;

    /// `true` or `false`.
    fn switch(&self) -> Result<bool, Error>;

    /// A text.
    fn text(&self) -> Result<String, Error>;

    /// A list of texts.
    fn texts(&self) -> Result<Vec<String>, Error>;

    /// An error of its text, with its place if it has one.
    fn refused(&self, error: Error) -> Error;
}

/// A number that JSON cannot have, and has as `null`.
const NOT_FINITE: &str = "inf or nan";

/// The value of a setting as JSON.
pub(crate) struct Json<'v> {
    /// The setting.
    pub(crate) key: &'static str,
    /// Its value.
    pub(crate) value: &'v Value,
}

impl Json<'_> {
    fn known<T>(&self, value: Option<T>, remedy: &'static str) -> Result<T, Error> {
        value.ok_or_else(|| Error::Setting { key: self.key, value: self.value.to_string(), remedy })
    }
}

impl Plain for Json<'_> {
    fn number(&self) -> Result<f64, Error> {
        let remedy = "give a finite number";
        if self.value.is_null() {
            return Err(Error::Setting { key: self.key, value: NOT_FINITE.to_owned(), remedy });
        }
        self.known(self.value.as_f64().filter(|number| number.is_finite()), remedy)
    }

    fn whole(&self) -> Result<u64, Error> {
        self.known(self.value.as_u64(), "give a whole number of at least 0")
    }

    fn switch(&self) -> Result<bool, Error> {
        self.known(self.value.as_bool(), "give true or false")
    }

    fn text(&self) -> Result<String, Error> {
        self.known(self.value.as_str().map(str::to_owned), "give a text")
    }

    fn texts(&self) -> Result<Vec<String>, Error> {
        let texts = self.value.as_array().map(|all| all.iter().map(|one| one.as_str().map(str::to_owned)));
        self.known(texts.and_then(Iterator::collect), "give a list of texts")
    }

    fn refused(&self, error: Error) -> Error {
        error
    }
}
