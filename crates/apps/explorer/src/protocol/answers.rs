//! The messages of the server, as JSON.

use super::SectionKind;
use super::typescript::{Fields, Typed, interface, messages, words};
use motiform_study::plan::Named;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Named numbers.
pub(crate) type Values = Map<String, Value>;

words! {
    /// Dashes of a line of the theory.
    Dashes as "LineStyle" {
        Solid = "solid",
        Dashed = "dashed",
        Dotted = "dotted",
        DashDotted = "dash-dotted",
        LongDashed = "long-dashed",
    }
}

messages! {
    #[derive(Serialize, Deserialize)]
    Parameter {
        name: String,
        symbol: String,
        default: f64,
        range: [f64; 2],
        allowed: [f64; 2],
        equation: String,
        meaning: String,
        whole: bool,
    }
    #[derive(Serialize, Deserialize)]
    Coordinate { name: String, meaning: String, }
    #[derive(Serialize, Deserialize)]
    Observable { name: String, symbol: String, meaning: String, }
    /// An axis of the map: a parameter or a coordinate of the start, and the part of it that is shown.
    #[derive(Serialize, Deserialize)]
    Side as "Axis" { name: String, low: f64, high: f64, }
    /// The part of parameter space that the map shows; without `y` it is a strip.
    #[derive(Serialize, Deserialize)]
    Plane { x: Side, y: Option<Side>, }
    #[derive(Serialize, Deserialize)]
    Model {
        name: String,
        title: String,
        equations: String,
        source: String,
        budget: f64,
        look: f64,
        parameters: Vec<Parameter>,
        coordinates: Vec<Coordinate>,
        observables: Vec<Observable>,
        plane: Plane,
        noise: f64,
        editable: bool,
    }
    #[derive(Serialize, Deserialize)]
    Preset {
        name: String,
        model: String,
        title: String,
        about: String,
        free: Vec<String>,
        parameters: Values,
        speed: f64,
        plane: Option<Plane>,
        section: SectionKind,
    }
    #[derive(Serialize, Deserialize)]
    Regime {
        name: String, words: String, colour: String, area: String, tint: String, glyph: String, hand: Option<String>,
        meaning: String,
    }
    /// Models, presets and regimes, in the order of lists and legends; then the regimes by the sense in which bodies turn.
    #[derive(Serialize, Deserialize)]
    Registry { models: Vec<Model>, presets: Vec<Preset>, regimes: Vec<Regime>, turning: Vec<Regime>, }
    /// A tracked cell, and the model that was fitted to it: time from the first frame, x, y, R0, then the parts of z2, z3, .. of each
    /// frame.
    #[derive(Serialize)]
    Tracked { model: String, name: String, length: String, time: String, frames: Vec<Vec<f64>>, }
    /// The first message; `restart` is the command that starts this server again.
    #[derive(Serialize)]
    Hello { version: &'static str, restart: String, registry: Registry, tracked: Option<Tracked>, }
    /// A new body.
    #[derive(Serialize)]
    Begun {
        revision: u32,
        model: String,
        preset: Option<String>,
        title: String,
        about: String,
        parameters: Named,
        noise: f64,
        sample: f64,
        speed: f64,
        speeds: [f64; 2],
        observables: Vec<Observable>,
    }
    /// The motion was changed: these parameters and this noise from now on.
    #[derive(Serialize)]
    Changed { revision: u32, parameters: Named, noise: f64, }
    /// The motion is being named.
    #[derive(Serialize)]
    NamingBegun { revision: u32, }
    /// The name of the motion, with the numbers that are defined.
    #[derive(Serialize)]
    MotionNamed as "Named" { revision: u32, regime: &'static str, why: String, numbers: Values, }
    /// A running Lyapunov exponent with the half width of its 95 % interval.
    #[derive(Serialize)]
    Exponent { value: f64, error: Option<f64>, }
    /// The largest exponents, averaged so far.
    #[derive(Serialize)]
    Exponents { revision: u32, time: f64, exponents: Vec<Exponent>, done: bool, }
    #[derive(Serialize)]
    Spectrum { name: &'static str, symbol: &'static str, power: Vec<f64>, }
    #[derive(Serialize)]
    Returns { section: SectionKind, label: String, y: Option<f64>, points: Vec<[f64; 2]>, }
    /// Power spectra and the return map of the motion since the last change.
    #[derive(Serialize)]
    Strips { revision: u32, samples: usize, frequencies: Vec<f64>, spectra: Vec<Spectrum>, returns: Returns, }
    /// The return map of the motion from now on, up to this time; `complete`: as many returns as were asked for.
    #[derive(Serialize)]
    ReturnsTold as "ReturnsAhead" { revision: u32, time: f64, complete: bool, returns: Returns, }
    /// The motion that a body of the swarm ends in.
    #[derive(Serialize)]
    Member { revision: u32, body: usize, regime: &'static str, }
    /// The centres of cells along one axis: `first + i step`.
    #[derive(Serialize)]
    Grid { name: String, first: f64, step: f64, count: usize, }
    /// A line of the theory in the plane of the map.
    #[derive(Serialize)]
    Line { label: String, style: Dashes, points: Vec<[f64; 2]>, }
    /// A map begins; its cells follow.
    #[derive(Serialize)]
    MapStart { epoch: u32, x: Grid, y: Option<Grid>, lines: Vec<Line>, }
    /// Progress of a map: cells, and cells per second.
    #[derive(Serialize)]
    Progress { epoch: u32, done: usize, total: usize, rate: f64, }
    /// A map is complete.
    #[derive(Serialize)]
    Mapped { epoch: u32, cells: usize, computed: usize, seconds: f64, }
    /// The verdict on a cell; no regime and no words where it is not computed yet.
    #[derive(Serialize)]
    Evidence {
        epoch: u32,
        cell: [u16; 2],
        parameters: Values,
        regime: Option<&'static str>,
        why: String,
        numbers: Option<Values>,
    }
    /// Branches begin: along this parameter, the others as they are.
    #[derive(Serialize)]
    BranchesBegun as "BranchesStart" { epoch: u32, along: Side, parameters: Named, }
    /// A branch, point by point; `between[k]` and `stable[k]`: the motion, and its stability, between the points k and k + 1. `unstable`
    /// and `neutral`: the numbers of growth rates above 0, and of those that are 0 within their errors. A period of 0: none.
    #[derive(Serialize)]
    BranchTold as "Branch" {
        epoch: u32,
        branch: usize,
        origin: Option<[usize; 2]>,
        parameter: Vec<f64>,
        speed: Vec<f64>,
        period: Vec<f64>,
        motion: Vec<&'static str>,
        unstable: Vec<usize>,
        neutral: Vec<usize>,
        between: Vec<&'static str>,
        stable: Vec<bool>,
    }
    /// A special point, and where it is on its branch; `leads`: the branch that begins or lies there. `speed`: of a connection, where the
    /// branch ends beyond its last point.
    #[derive(Serialize)]
    SpecialPoint {
        branch: usize,
        point: usize,
        kind: &'static str,
        parameter: f64,
        speed: Option<f64>,
        period: Option<f64>,
        criticality: Option<&'static str>,
        breaks: Option<&'static str>,
        leads: Option<usize>,
    }
    /// The special points of all branches so far.
    #[derive(Serialize)]
    Specials { epoch: u32, points: Vec<SpecialPoint>, }
    /// Progress of the branches, 0 to 1, and the one under way.
    #[derive(Serialize)]
    FollowProgress as "Following" { epoch: u32, done: f64, branch: usize, }
    /// No more branches: `left` points were left at which more may begin; `why` says what made it impossible.
    #[derive(Serialize)]
    FollowEnd as "Followed" { epoch: u32, branches: usize, left: usize, seconds: f64, why: Option<String>, }
    /// The orbit that the body was placed on at time `t`, over one period, relative to `position`; the next one is turned by `rotation`.
    #[derive(Serialize)]
    OrbitTold as "Orbit" {
        revision: u32,
        parameters: Named,
        unstable: usize,
        t: f64,
        position: [f64; 2],
        time: f64,
        rotation: f64,
        points: Vec<[f64; 2]>,
    }
    /// The body goes on no further until the next change.
    #[derive(Serialize)]
    Ended { revision: u32, outcome: &'static str, text: String, }
    /// The present study as a command and in Python.
    #[derive(Serialize)]
    Share { command: String, python: String, }
    /// The present study as a study file with its equations.
    #[derive(Serialize)]
    Source { text: String, }
    /// The text of a page became this model.
    #[derive(Serialize)]
    Defined { model: Model, }
    /// The text of a page is no study: what is wrong, and where (line and column from 1, `length` characters).
    #[derive(Serialize)]
    Mistake { line: usize, column: usize, length: usize, problem: String, }
    /// A message that cannot be answered.
    #[derive(Serialize)]
    Refused { id: Option<u32>, why: String, }
}

/// Declares the answers: the enum, and their TypeScript.
macro_rules! answers {
    ($($variant:ident($payload:ident) = $tag:literal,)*) => {
        /// Everything that the server says as text.
        #[derive(Clone, Debug, PartialEq, Serialize)]
        #[serde(tag = "is")]
        pub(crate) enum Said {
            $(#[serde(rename = $tag)] $variant($payload),)*
        }

        $(impl From<$payload> for Said {
            fn from(payload: $payload) -> Self {
                Self::$variant(payload)
            }
        })*

        /// The interfaces of all answers, and their union.
        pub(crate) fn answers() -> String {
            let mut text = String::new();
            $(text += &interface(&<$payload>::name(), <$payload>::DOCS, Some(format!("is: \"{}\"", $tag)), &<$payload>::fields());
            text.push('\n');)*
            text += "/** Everything the server says as text. */\nexport type Answer =";
            $(text += &format!("\n  | {}", <$payload>::name());)*
            text + ";\n"
        }
    };
}
answers! {
    Hello(Hello) = "hello",
    Begun(Begun) = "begun",
    Changed(Changed) = "changed",
    Naming(NamingBegun) = "naming",
    Named(MotionNamed) = "named",
    Exponents(Exponents) = "exponents",
    Strips(Strips) = "strips",
    Returns(ReturnsTold) = "returns",
    Member(Member) = "member",
    Map(MapStart) = "map",
    Progress(Progress) = "progress",
    Mapped(Mapped) = "mapped",
    Evidence(Evidence) = "evidence",
    Branches(BranchesBegun) = "branches",
    Branch(BranchTold) = "branch",
    Specials(Specials) = "specials",
    Following(FollowProgress) = "following",
    Followed(FollowEnd) = "followed",
    Orbit(OrbitTold) = "orbit",
    Ended(Ended) = "ended",
    Share(Share) = "share",
    Source(Source) = "source",
    Defined(Defined) = "defined",
    Mistake(Mistake) = "mistake",
    Refused(Refused) = "refused",
}

/// The interfaces of what answers are made of.
pub(crate) fn parts() -> String {
    macro_rules! all {
        ($($type:ident)*) => {
            [$(interface(&<$type>::name(), <$type>::DOCS, None, &<$type>::fields())),*]
        };
    }
    let parts = all! {
        Parameter Coordinate Observable Side Plane Model Preset Regime Registry Tracked Exponent Spectrum Returns
        Grid Line SpecialPoint
    };
    parts.join("\n") + "\n" + &Dashes::declaration()
}
