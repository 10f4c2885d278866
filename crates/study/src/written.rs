//! Values of settings: how each type is written in a study file, and given as JSON.

use crate::branches::{Along, origin};
use crate::curves::{CurveKind, Plane};
use crate::scan::Axis;
use crate::toml_reader;
use crate::{Error, Towards};
use motiform_analysis::Regime;
use serde_json::{Value, json};

/// A type of values of settings.
pub(crate) trait Written: Sized {
    /// The schema of the value.
    fn kind() -> Value;

    /// A value of a study file.
    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error>;

    /// A value as JSON; otherwise what was expected.
    fn given(value: &Value) -> Result<Self, &'static str>;
}

impl Written for f64 {
    fn kind() -> Value {
        json!({ "type": "number", "format": "double" })
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        value.number()
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        value.as_f64().filter(|number| number.is_finite()).ok_or("a finite number")
    }
}

impl Written for u64 {
    fn kind() -> Value {
        json!({ "type": "integer", "format": "uint64", "minimum": 0 })
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        value.whole()
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        value.as_u64().ok_or("a whole number of at least 0")
    }
}

impl Written for bool {
    fn kind() -> Value {
        json!({ "type": "boolean" })
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        value.switch()
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        value.as_bool().ok_or("true or false")
    }
}

/// Types that are written as a text, with their readers.
macro_rules! texts {
    ($($type:ty: $parse:expr),* $(,)?) => {$(
        impl Written for $type {
            fn kind() -> Value {
                json!({ "type": "string" })
            }

            fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
                $parse(&value.text()?).map_err(|error: Error| value.error(error))
            }

            fn given(value: &Value) -> Result<Self, &'static str> {
                value.as_str().and_then(|text| $parse(text).ok()).ok_or("a text")
            }
        }
    )*};
}

texts! {
    String: |text: &str| Ok::<_, Error>(text.to_owned()),
    Along: Along::parse,
    Plane: Plane::parse,
    Regime: origin,
    Towards: Towards::find,
}

impl Written for Vec<Axis> {
    fn kind() -> Value {
        json!({ "type": "array", "items": { "type": "string" } })
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        let axes = value.texts()?.iter().map(|text| Axis::parse(text)).collect::<Result<_, Error>>();
        axes.map_err(|error| value.error(error))
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        let texts = value.as_array().map(Vec::as_slice).unwrap_or_default();
        let axis = |text: &Value| Axis::parse(text.as_str()?).ok();
        texts.iter().map(axis).collect::<Option<_>>().ok_or("a list of axes")
    }
}

impl Written for Vec<CurveKind> {
    fn kind() -> Value {
        json!({ "type": "array", "items": { "type": "string" } })
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        let names = value.text().map(|one| vec![one]).or_else(|_| value.texts())?;
        CurveKind::list(&names.join(",")).map_err(|error| value.error(error))
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        value
            .as_str()
            .and_then(|text| CurveKind::list(text).ok())
            .ok_or("kinds of curves, separated by commas")
    }
}

impl<T: Written> Written for Option<T> {
    fn kind() -> Value {
        T::kind()
    }

    fn read(value: &toml_reader::Value<'_>) -> Result<Self, Error> {
        T::read(value).map(Some)
    }

    fn given(value: &Value) -> Result<Self, &'static str> {
        T::given(value).map(Some)
    }
}
