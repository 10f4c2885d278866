//! All messages between page and server, declared once: the Rust types here, and
//! `crates/apps/explorer/web/src/protocol.ts`, which is made from them (a test compares).
//!
//! This file has the requests that a page may send; everything else is refused.

mod answers;
mod typescript;

pub(crate) use answers::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use typescript::{Fields as _, line, messages, words};

/// Longest message in bytes.
pub const LONGEST: usize = 32 * 1024;

words! {
    /// Where the return map is taken: at the maxima of the speed, or where the path crosses a line.
    SectionKind as "Section" {
        /// At the maxima of the speed.
        Speed = "speed",
        /// Where the path crosses a line.
        Path = "path",
    }
}

words! {
    /// Where the bodies of a swarm begin: at random shapes; near the shape of the body; at that shape, each with noise of its own.
    SwarmStart as "SwarmStart" {
        /// At random shapes of all sizes.
        Starts = "starts",
        /// Near the shape of the body.
        Near = "near",
        /// At the shape of the body.
        Noises = "noises",
    }
}

/// Declares the messages of the page, each with its content, its variants and their verbs: the types, the enum, and its TypeScript.
macro_rules! asks {
    ($(
        $(#[doc = $doc:literal])* $(#[derive($($derived:ident),*)])? #[serde($($whole:tt)*)]
        $name:ident $(as $alias:literal)? = $($variant:ident $verb:literal),+ { $($fields:tt)* }
    )*) => {
        messages! {$(
            $(#[doc = $doc])* $(#[derive($($derived),*)])? #[serde($($whole)*)] $name $(as $alias)? { $($fields)* }
        )*}

        /// A message of the page; see `PROTOCOL.md`.
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(tag = "do")]
        pub(crate) enum Ask {
            $($(#[serde(rename = $verb)] $variant($name),)+)*
        }

        /// All types of messages.
        const VERBS: &[&str] = &[$($($verb),+),*];

        /// The union of all messages of the page.
        fn wishes() -> String {
            let mut text = "/** Everything the page says. */\nexport type Wish =".to_owned();
            $($(text += &format!("\n  | {}", line(&format!("do: \"{}\"", $verb), &<$name>::fields()));)+)*
            text + ";\n\n/** A new body; `null` leaves the start to the preset. */\nexport type Begin = Extract<Wish, { do: \"begin\" }>;\n"
        }
    };
}

asks! {
    /// A new body; `null` leaves the start to the preset.
    #[derive(Default, Deserialize)]
    #[serde(deny_unknown_fields)]
    Begin = Begin "begin" {
        model: String,
        preset: Option<String>,
        #[serde(default)]
        parameters: BTreeMap<String, f64>,
        state: Option<Vec<f64>>,
        position: Option<[f64; 2]>,
        #[serde(default)]
        t: f64,
        noise: Option<f64>,
        #[serde(default = "one")]
        seed: u64,
    }
    /// These parameters from now on; the state stays.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Set = Set "set" { parameters: BTreeMap<String, f64>, }
    /// White noise of this amplitude from now on.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Noise = Noise "noise" { amplitude: f64, }
    /// Moves the body on by this model time.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Advance = Advance "advance" { dt: f64, }
    /// A return map; its line lies at this y above the centre of the path.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    Section as "Strip" = Strips "strips" {
        section: SectionKind,
        #[serde(default)]
        y: Option<f64>,
    }
    /// The map of a window, about `count` cells along each axis.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    MapWindow = Map "map" { epoch: u32, x: Side, y: Option<Side>, count: u16, }
    /// The verdict on a cell of a map.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Cell = Evidence "evidence" { epoch: u32, cell: [u16; 2], }
    /// Branches of the present motion along a parameter, at most so many.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Follow = Follow "follow" { epoch: u32, along: Side, branches: u16, }
    /// Places the body on a point of a branch.
    #[derive(Copy, Deserialize)]
    #[serde(deny_unknown_fields)]
    BranchPoint = Place "place" { epoch: u32, branch: usize, point: usize, }
    /// The body begins again, with these coordinates of the start of maps; everything else is as there.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Start = Start "start" { coordinates: BTreeMap<String, f64>, }
    /// A random kick of the shape, by this part of its size.
    #[derive(Copy, Deserialize)]
    #[serde(deny_unknown_fields)]
    Kick = Kick "kick" {
        #[serde(default = "fifth")]
        strength: f64,
    }
    /// Whatever is given is changed, everything else stays.
    #[derive(Default, Deserialize)]
    #[serde(deny_unknown_fields)]
    Put = Put "put" {
        #[serde(default)]
        parameters: BTreeMap<String, f64>,
        state: Option<Vec<f64>>,
        position: Option<[f64; 2]>,
        velocity: Option<[f64; 2]>,
        t: Option<f64>,
        noise: Option<f64>,
    }
    /// The outline of this shape is pulled to a point relative to the position.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Pull = Pull "pull" { state: Vec<f64>, to: [f64; 2], }
    /// So many returns ahead, at once.
    #[derive(Copy, Deserialize)]
    #[serde(deny_unknown_fields)]
    ReturnsAhead as "Ahead" = Returns "returns" {
        section: SectionKind,
        #[serde(default)]
        y: Option<f64>,
        count: u16,
    }
    /// So many further bodies at the place of the body; none: the swarm ends. `spread`: how far off they are that begin near it, relative
    /// to the size of the shape.
    #[derive(Copy, Deserialize)]
    #[serde(deny_unknown_fields)]
    Swarm = Swarm "swarm" { bodies: u16, from: SwarmStart, spread: f64, }
    /// A file to keep.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Export = Export "export" {
        id: u32,
        what: String,
        #[serde(default = "speed")]
        section: SectionKind,
        #[serde(default)]
        y: Option<f64>,
    }
    /// A study file as text: from now on the model "edited".
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Define = Define "define" { text: String, }
    /// Nothing but the verb.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    Bare = Restart "restart", Unmap "unmap", Unfollow "unfollow", Source "source", Share "share" {}
}

fn one() -> u64 {
    1
}

fn fifth() -> f64 {
    0.2
}

fn speed() -> SectionKind {
    SectionKind::Speed
}

/// A message of the page that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Request(pub(crate) Ask);

impl Request {
    /// Reads a message.
    ///
    /// # Errors
    /// The fault of the message, in one sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        Ask::parse(text).map(Self)
    }
}

/// The messages as TypeScript: the page's `protocol.ts`.
pub fn typescript() -> String {
    let head = format!(
        "/** What the page and the server say to each other, as JSON; see PROTOCOL.md. Made from `src/protocol`: do not edit. */\n\n\
         /** Bytes of the longest message of the page. */\nexport const LONGEST = {LONGEST};\n\n\
         /** Named numbers. */\nexport type Values = Record<string, number>;\n"
    );
    [head.as_str(), &SectionKind::declaration(), &SwarmStart::declaration(), &parts(), &answers(), &wishes()]
        .join("\n")
}

impl Ask {
    /// Reads a message.
    ///
    /// # Errors
    /// The fault of the message, in one sentence.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|_| Self::wrong(text).to_owned())
    }
}

impl Ask {
    /// The fault of a message, in words of its own: nothing of the message is repeated.
    fn wrong(text: &str) -> &'static str {
        let Ok(value) = serde_json::from_str::<serde_json::Value>(text) else {
            return "this message is not JSON, or has a number that is not finite";
        };
        match value.get("do").and_then(serde_json::Value::as_str) {
            None => "a message is an object with its type in do",
            Some(verb) if VERBS.contains(&verb) => {
                "a field of this message is missing, of the wrong type, or unknown"
            }
            Some(_) => "there is no message of this type",
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn messages_are_what_the_protocol_says() {
        let advance = Ask::parse(r#"{"do":"advance","dt":0.4}"#).unwrap();
        assert_eq!(advance, Ask::Advance(Advance { dt: 0.4 }));
        let begin = r#"{"do":"begin","model":"tensor","preset":"fig5a","parameters":{"kappa2":0.8},"state":null,
            "position":null,"t":0,"noise":0,"seed":1}"#;
        let Ask::Begin(begin) = Ask::parse(begin).unwrap() else { unreachable!() };
        assert_eq!((begin.preset.as_deref(), begin.parameters["kappa2"]), (Some("fig5a"), 0.8));
        let map = r#"{"do":"map","epoch":7,"x":{"name":"length","low":6,"high":32},"y":null,"count":64}"#;
        assert!(matches!(Ask::parse(map).unwrap(), Ask::Map(MapWindow { y: None, .. })));
        assert_eq!(Ask::parse(r#"{"do":"kick"}"#).unwrap(), Ask::Kick(Kick { strength: 0.2 }));
        assert_eq!(Ask::parse(r#"{"do":"restart"}"#).unwrap(), Ask::Restart(Bare {}));
        let put = r#"{"do":"put","position":[1,2]}"#;
        let position = Some([1.0, 2.0]);
        assert_eq!(Ask::parse(put).unwrap(), Ask::Put(Put { position, ..Put::default() }));
        let strips = Ask::parse(r#"{"do":"strips","section":"path","y":3.0}"#).unwrap();
        assert_eq!(strips, Ask::Strips(Section { section: SectionKind::Path, y: Some(3.0) }));
    }

    /// `MOTIFORM_UPDATE=1 cargo test -p motiform-explorer protocol` writes it again.
    #[test]
    fn the_page_has_these_messages() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/src/protocol.ts");
        if std::env::var_os("MOTIFORM_UPDATE").is_some() {
            std::fs::write(path, typescript()).unwrap();
        }
        assert!(
            std::fs::read_to_string(path).unwrap() == typescript(),
            "protocol.ts is not what the declarations give"
        );
    }

    /// PROTOCOL.md explains every message, and no other.
    #[test]
    fn every_message_is_explained() {
        let text = include_str!("../../PROTOCOL.md");
        let declared = typescript();
        for (word, before, after) in [("do", "{\"do\":\"", "\""), ("is", "{\"is\":\"", "\"")] {
            let listed: std::collections::BTreeSet<&str> =
                text.split(before).skip(1).filter_map(|rest| rest.split(after).next()).collect();
            let known: std::collections::BTreeSet<&str> = declared
                .split(&format!("{word}: \""))
                .skip(1)
                .filter_map(|rest| rest.split('"').next())
                .collect();
            assert_eq!(listed, known);
        }
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
            let why = Ask::parse(bad).unwrap_err();
            assert!(
                !why.contains("expected") && !why.contains("column") && !why.contains("passwd"),
                "{bad}: {why}"
            );
        }
    }
}
