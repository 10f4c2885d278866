//! Values of settings: how each type is read, from whatever gives it, and written in a study file.

use crate::branches::{Along, origin};
use crate::curves::{CurveKind, Plane};
use crate::plain::Plain;
use crate::scan::Axis;
use crate::{Error, Towards};
use motiform_analysis::Regime;
use serde_json::{Value, json};

/// A type of values of settings.
pub(crate) trait Written: Sized {
    /// The schema of the value.
    fn kind() -> Value;

    /// Reads a value.
    fn read(value: &dyn Plain) -> Result<Self, Error>;

    /// The value in a study file, if there is one; the number that TOML does not have.
    fn written(&self) -> Result<Option<toml::Value>, String>;
}

/// Types that are plain values.
macro_rules! plain {
    ($($type:ty: $kind:tt, $read:path, $write:expr;)*) => {$(
        impl Written for $type {
            fn kind() -> Value {
                json!($kind)
            }

            fn read(value: &dyn Plain) -> Result<Self, Error> {
                $read(value)
            }

            fn written(&self) -> Result<Option<toml::Value>, String> {
                $write(self).map(Some)
            }
        }
    )*};
}

plain! {
    f64: { "type": "number", "format": "double" }, Plain::number, |value: &f64| Ok((*value).into());
    u64: { "type": "integer", "format": "uint64", "minimum": 0 }, Plain::whole, whole;
    bool: { "type": "boolean" }, Plain::switch, |value: &bool| Ok((*value).into());
    Vec<Axis>: { "type": "array", "items": { "type": "string" } }, axes, |all: &Self| list(all.iter().map(Axis::to_text));
    Vec<CurveKind>: { "type": "array", "items": { "type": "string" } }, kinds, |all: &Self| list(all.iter().map(|kind| kind.name()));
}

fn whole(value: &u64) -> Result<toml::Value, String> {
    i64::try_from(*value).map(Into::into).map_err(|_| value.to_string())
}

fn list(texts: impl Iterator<Item = impl Into<toml::Value>>) -> Result<toml::Value, String> {
    Ok(texts.map(Into::into).collect::<Vec<toml::Value>>().into())
}

fn axes(value: &dyn Plain) -> Result<Vec<Axis>, Error> {
    let axes = value.texts()?.iter().map(|text| Axis::parse(text)).collect::<Result<_, Error>>();
    axes.map_err(|error| value.refused(error))
}

fn kinds(value: &dyn Plain) -> Result<Vec<CurveKind>, Error> {
    let names = value.text().map(|one| vec![one]).or_else(|_| value.texts())?;
    CurveKind::list(&names.join(",")).map_err(|error| value.refused(error))
}

/// Types that are written as a text: their readers and writers.
macro_rules! texts {
    ($($type:ty: $parse:expr, $write:expr;)*) => {$(
        impl Written for $type {
            fn kind() -> Value {
                json!({ "type": "string" })
            }

            fn read(value: &dyn Plain) -> Result<Self, Error> {
                $parse(&value.text()?).map_err(|error: Error| value.refused(error))
            }

            fn written(&self) -> Result<Option<toml::Value>, String> {
                Ok(Some($write(self).into()))
            }
        }
    )*};
}

texts! {
    String: |text: &str| Ok::<_, Error>(text.to_owned()), Self::clone;
    Along: Along::parse, |along: &Self| format!("{}={:?}:{:?}", along.name, along.from, along.to);
    Plane: Plane::parse, Self::to_string;
    Regime: origin, |regime: &Self| regime.name();
    Towards: Towards::parse, |sides: &Self| sides.name();
}

impl<T: Written> Written for Option<T> {
    fn kind() -> Value {
        T::kind()
    }

    fn read(value: &dyn Plain) -> Result<Self, Error> {
        T::read(value).map(Some)
    }

    fn written(&self) -> Result<Option<toml::Value>, String> {
        self.as_ref().map_or(Ok(None), T::written)
    }
}
