//! What a page may ask. Everything else is refused.

use serde::Deserialize;
use std::collections::BTreeMap;

/// Longest message in bytes.
pub(crate) const LONGEST: usize = 32 * 1024;

/// A message of the page; see `PROTOCOL.md`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum Ask {
    Begin(Begin),
    Set { parameters: BTreeMap<String, f64> },
    Noise { amplitude: f64 },
    Kick {},
    Restart {},
    Advance { dt: f64 },
    Strips(Section),
    Map(MapWindow),
    Unmap {},
    Evidence { epoch: u32, cell: [u16; 2] },
    Share {},
    Export(Export),
}

/// A new body.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Begin {
    pub(crate) model: String,
    pub(crate) preset: Option<String>,
    #[serde(default)]
    pub(crate) parameters: BTreeMap<String, f64>,
    pub(crate) state: Option<Vec<f64>>,
    pub(crate) position: Option<[f64; 2]>,
    #[serde(default)]
    pub(crate) t: f64,
    #[serde(default)]
    pub(crate) noise: f64,
    #[serde(default = "one")]
    pub(crate) seed: u64,
}

fn one() -> u64 {
    1
}

/// Where the return map is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SectionKind {
    /// At the maxima of the speed.
    Speed,
    /// Where the path crosses a line.
    Path,
}

/// A return map.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Section {
    pub(crate) section: SectionKind,
    /// The line lies at this y above the centre of the path.
    #[serde(default)]
    pub(crate) y: Option<f64>,
}

/// An axis of the map.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Side {
    pub(crate) name: String,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// The map of a window.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MapWindow {
    pub(crate) epoch: u32,
    pub(crate) x: Side,
    pub(crate) y: Option<Side>,
    pub(crate) count: u16,
}

/// A file to keep.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Export {
    pub(crate) id: u32,
    pub(crate) what: String,
    #[serde(default = "speed")]
    pub(crate) section: SectionKind,
    #[serde(default)]
    pub(crate) y: Option<f64>,
}

fn speed() -> SectionKind {
    SectionKind::Speed
}

impl Ask {
    /// Reads a message.
    ///
    /// # Errors
    /// What is wrong with it, in one sentence.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| format!("this message says nothing: {error}"))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn messages_are_what_the_protocol_says() {
        let advance = Ask::parse(r#"{"do":"advance","dt":0.4}"#).unwrap();
        assert_eq!(advance, Ask::Advance { dt: 0.4 });
        let begin = r#"{"do":"begin","model":"tensor","preset":"fig5a","parameters":{"kappa2":0.8},"state":null,
            "position":null,"t":0,"noise":0,"seed":1}"#;
        let Ask::Begin(begin) = Ask::parse(begin).unwrap() else { unreachable!() };
        assert_eq!((begin.preset.as_deref(), begin.parameters["kappa2"]), (Some("fig5a"), 0.8));
        let map = r#"{"do":"map","epoch":7,"x":{"name":"length","low":6,"high":32},"y":null,"count":64}"#;
        assert!(matches!(Ask::parse(map).unwrap(), Ask::Map(MapWindow { y: None, .. })));
        assert_eq!(Ask::parse(r#"{"do":"kick"}"#).unwrap(), Ask::Kick {});
        let strips = Ask::parse(r#"{"do":"strips","section":"path","y":3.0}"#).unwrap();
        assert_eq!(strips, Ask::Strips(Section { section: SectionKind::Path, y: Some(3.0) }));
    }

    #[test]
    fn anything_else_is_refused() {
        for bad in [
            "",
            "nonsense",
            "[]",
            "{}",
            r#"{"do":"open","path":"/etc/passwd"}"#,
            r#"{"do":"advance"}"#,
            r#"{"do":"advance","dt":"0.4"}"#,
            r#"{"do":"advance","dt":1e999}"#,
            r#"{"do":"advance","dt":NaN}"#,
            r#"{"do":"advance","dt":0.4,"more":1}"#,
            r#"{"do":"evidence","epoch":1,"cell":[-1,0]}"#,
            r#"{"do":"set","parameters":{"kappa2":null}}"#,
            r#"{"do":"export","id":1,"what":"map.svg","section":"elsewhere"}"#,
        ] {
            assert!(Ask::parse(bad).is_err(), "{bad}");
        }
    }
}
