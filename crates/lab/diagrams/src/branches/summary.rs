//! Branches in a few numbers: what `--json` prints and `summary.json` holds.

use super::origin::Origin;
use super::result::{Branches, Followed, Leg, Sample};
use super::stretches::{neutral_stretches, stretches};
use motiform_analysis::RelativeEquilibrium;
use motiform_continuation::{
    Broken, Certificate, Coefficient, Connection, End, Joins, NormalForm, Passed, PeriodLaw, Point, Special,
    nine,
};
use motiform_study::BranchPlan;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// A place where a branch changes or ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SpecialEntry {
    /// `hopf`, `fold`, `pitchfork`, `branch-point`, `continuum`, `symmetry-breaking`, `period-doubling`, `torus`, `touch`, or the ends
    /// `homoclinic`, `heteroclinic` and `connection`.
    pub kind: &'static str,
    /// The value of the parameter.
    pub parameter: f64,
    /// Bound of its error.
    pub error: Option<f64>,
    /// The evidence for its kind, where it was solved for.
    pub certificate: Option<Certificate>,
    /// The leading coefficient of the normal form with its name: `l1` of a Hopf bifurcation, for a critical vector of length 1; `quadratic`
    /// of a fold and where branches cross; `cubic` where a symmetry is broken or the period doubled.
    pub coefficient: Option<(&'static str, Coefficient)>,
    /// Period of the motion, or of the one that begins (model time).
    pub period: Option<f64>,
    /// Bound of the error of the period of an orbit.
    pub period_error: Option<f64>,
    /// `supercritical` where what begins is stable in the critical directions, or `subcritical`: from the sign of the coefficient.
    /// `undecided` where that is smaller than its error or not known.
    pub criticality: Option<&'static str>,
    /// Why it is undecided.
    pub undecided: Option<String>,
    /// The symmetry that a pitchfork breaks: `mirror`, or `rotations`.
    pub breaks: Option<&'static str>,
    /// The connection that the orbit approaches, at the ends `homoclinic`, `heteroclinic` and `connection`.
    pub connection: Option<Connection>,
    /// The branch that begins or lies there, from 0.
    pub branch: Option<usize>,
    /// Why none was found, where one was looked for.
    pub without: Option<String>,
    /// The other branches that do, where a shape loses its rotations in more than one way.
    pub others: Vec<usize>,
}

impl SpecialEntry {
    fn value(&self, parameter: &str) -> Value {
        let mut object = Map::new();
        object.insert("kind".to_owned(), self.kind.into());
        object.insert(parameter.to_owned(), self.parameter.into());
        object.extend(self.error.map(|error| ("error".to_owned(), error.into())));
        let words = [("criticality", self.criticality), ("breaks", self.breaks)];
        object.extend(self.period.map(|period| ("period".to_owned(), period.into())));
        object.extend(self.period_error.map(|error| ("period_error".to_owned(), error.into())));
        object.extend(words.into_iter().filter_map(|(key, word)| Some((key.to_owned(), word?.into()))));
        object.extend(self.undecided.as_ref().map(|why| ("undecided".to_owned(), why.as_str().into())));
        if let Some((name, coefficient)) = self.coefficient {
            object.insert("normal_form".to_owned(), name.into());
            if name == "l1" {
                object.insert("first_lyapunov".to_owned(), coefficient.value.into());
            }
            object.insert("coefficient".to_owned(), coefficient.value.into());
            object.insert("coefficient_error".to_owned(), coefficient.error.into());
        }
        if let Some(certificate) = self.certificate {
            object.insert("test".to_owned(), json!(certificate.test));
            object.insert("residual".to_owned(), certificate.residual.into());
            object.insert("transversality".to_owned(), certificate.transversality.into());
        }
        self.connection.iter().for_each(|connection| put_connection(&mut object, connection));
        object.extend(self.branch.map(|branch| ("branch".to_owned(), branch.into())));
        object.extend(self.without.as_ref().map(|why| ("without".to_owned(), why.as_str().into())));
        if !self.others.is_empty() {
            object.insert("others".to_owned(), json!(self.others));
        }
        object.into()
    }
}

/// The summary as JSON: `{"branches": [{"motion", "origin", "stable", "special", "ends", "end", ...}], ...}`.
pub fn summary(plan: &BranchPlan, found: &Branches) -> Value {
    let c = &plan.computation;
    let entries = found.branches.iter().enumerate();
    json!({
        "model": c.start.model,
        "parameters": c.start.parameters,
        "along": c.along,
        "complete": found.complete,
        "origins_left": found.left,
        "doublings_left": found.doublings_left,
        "branches": entries.map(|(number, followed)| entry(plan, found, number, followed)).collect::<Vec<_>>(),
    })
}

fn entry(plan: &BranchPlan, found: &Branches, number: usize, followed: &Followed) -> Value {
    let name = &plan.computation.along.name;
    let named = followed.named();
    let ends: Vec<String> = followed.legs.iter().map(Leg::ending).collect();
    let special: Vec<Value> = found.special(number).iter().map(|entry| entry.value(name)).collect();
    let mut object = json!({ "motion": named.map(|part| part.motion) });
    let mut put = |key: &str, value: Value| object[key] = value;
    if let Some(form) = named.and_then(|part| part.form) {
        put("form", json!(form));
    }
    if let Some(course) = named.and_then(|part| part.course) {
        put("course", json!(course));
    }
    if let parts @ [_, _, ..] = &followed.parts()[..] {
        put("parts", json!(parts));
    }
    put("origin", json!(followed.origin));
    put("points", followed.samples().count().into());
    put("stable", json!(stretches(found, followed)));
    let neutral = neutral_stretches(followed);
    if !neutral.is_empty() {
        put("neutral", json!(neutral));
    }
    if followed.family() > 0 {
        put("family", followed.family().into());
    }
    put("special", special.into());
    put("end", ends.last().cloned().unwrap_or_default().into());
    put("ends", json!(ends));
    object
}

impl Leg {
    /// Its end, in words.
    pub fn ending(&self) -> String {
        match (&self.end, self.samples.last()) {
            (End::RangeLeft, Some(last)) => format!("{} at {}", self.end, nine(last.point.parameter)),
            _ => self.end.to_string(),
        }
    }
}

impl Branches {
    /// The special points of a branch in its order, ends at connections among them.
    pub fn special(&self, number: usize) -> Vec<SpecialEntry> {
        let Some(followed) = self.branches.get(number) else { return Vec::new() };
        let mut all: Vec<Vec<SpecialEntry>> = followed
            .legs
            .iter()
            .enumerate()
            .map(|(leg, done)| {
                let points = done.samples.iter().enumerate();
                let inside = points.filter_map(|(point, sample)| self.entry(number, leg, point, sample));
                inside.chain(end(done)).collect()
            })
            .collect();
        if let [back, _, ..] = &mut all[..] {
            back.reverse();
        }
        all.concat()
    }

    fn entry(&self, branch: usize, leg: usize, point: usize, sample: &Sample) -> Option<SpecialEntry> {
        let special = sample.point.special?;
        let done = &self.branches[branch].legs[leg];
        let ends = done.meets_at(point);
        let origin =
            if ends { Origin::Meets { branch, leg } } else { Origin::Special { branch, leg, point } };
        let there = self.links.iter().filter(|link| link.origin == origin).filter_map(|link| link.branch);
        let mut there: Vec<usize> = there.collect();
        if there.len() > 1 || sample.point.critical > 1 || matches!(special, Special::Touch { .. }) {
            there.retain(|next| *next != branch); // where all branches are looked for its own is found as well
        }
        let next = || self.criticality(branch, leg, point, &there, origin);
        let (criticality, undecided) = judged(&sample.point, next);
        Some(SpecialEntry {
            kind: special.name(),
            parameter: sample.point.parameter,
            error: sample.point.certificate.map(|certificate| certificate.error),
            certificate: sample.point.certificate,
            coefficient: coefficient(&sample.point),
            period: match special {
                Special::Hopf(hopf) => Some(hopf.period()),
                _ => sample.reading.period,
            },
            period_error: period_error(&sample.point),
            criticality,
            undecided,
            connection: None,
            breaks: match special {
                Special::Pitchfork { breaks: Broken::Mirror } => Some("mirror"),
                Special::Pitchfork { breaks: Broken::Rotations } => Some("rotations"),
                _ => None,
            },
            branch: there.first().copied(),
            without: self.without(origin, there.is_empty()),
            others: there.into_iter().skip(1).collect(),
        })
    }

    /// Why no branch was found at a point beside which one was looked for.
    fn without(&self, origin: Origin, nothing: bool) -> Option<String> {
        let link = self.links.iter().find(|link| nothing && link.origin == origin)?;
        Some(link.why.clone().unwrap_or_else(|| "Newton's method finds none near this point".to_owned()))
    }

    /// Criticality: the branch that begins at a point is stable in the critical direction, or not.
    fn criticality(
        &self,
        branch: usize,
        leg: usize,
        point: usize,
        there: &[usize],
        origin: Origin,
    ) -> Option<&'static str> {
        let [next] = there else { return None };
        let next = self.branches.get(*next).filter(|next| next.origin == origin)?;
        let first = next.legs.first()?.samples.first()?.point.parameter;
        is_supercritical(&self.branches[branch].legs[leg], point, first).map(critical)
    }
}

/// The normal form at a special point as far as it is known, with the coefficient's name.
fn normal_form(point: &Point) -> Option<(&'static str, NormalForm)> {
    let leading = point.certificate.and_then(|certificate| certificate.normal_form);
    match point.special? {
        Special::Hopf(hopf) => Some(("l1", hopf.first_lyapunov)),
        Special::Fold => leading.map(|form| ("quadratic", form)),
        Special::BranchPoint if point.is_unstated_pitchfork() => leading.map(|form| ("cubic", form)),
        Special::BranchPoint => leading.map(|form| ("quadratic", form)),
        _ => leading.map(|form| ("cubic", form)),
    }
}

/// The error of the period of an orbit at a special point.
fn period_error(point: &Point) -> Option<f64> {
    let (orbit, certificate) = (point.motion.orbit()?, point.certificate?);
    Some(certificate.time_error * orbit.period() / orbit.time)
}

fn coefficient(point: &Point) -> Option<(&'static str, Coefficient)> {
    let (name, form) = normal_form(point)?;
    Some((name, form.coefficient()?))
}

/// Said of folds and crossings whose leading coefficient is 0 within its error.
const VANISHES: &str = "the terms of second order vanish within their error: those of higher order decide";

/// Why no normal form tells what begins at a point, where that is so.
fn doubt(point: &Point) -> Option<String> {
    match point.special? {
        Special::Touch { seen, within } => {
            let rest = if seen == "hopf" || point.motion.orbit().is_some() {
                "; what may begin here is not looked for"
            } else {
                ""
            };
            Some(format!(
                "a growth comes to 0 and back: either two special points of the kind {seen}, closer than {within:.1e} in the parameter, \
                 or a crossing of branches{rest}"
            ))
        }
        Special::BranchPoint | Special::Pitchfork { .. }
            if point.critical > 1 && point.motion.orbit().is_none() =>
        {
            Some(format!(
                "{} directions are critical here: there may be more branches than are found",
                point.critical
            ))
        }
        _ if point.critical > 1 => Some(format!(
            "{} directions are critical here: not all motions that begin here are followed",
            point.critical
        )),
        _ => None,
    }
}

/// The criticality by the sign of the coefficient, or `undecided` and why. Where there is no coefficient the one branch that begins may say
/// it, by the side to which it goes.
fn judged(point: &Point, next: impl Fn() -> Option<&'static str>) -> (Option<&'static str>, Option<String>) {
    if let Some(why) = doubt(point) {
        return (Some("undecided"), Some(why));
    }
    let form = normal_form(point).map(|form| form.1);
    let silent = match point.special {
        None | Some(Special::Fold | Special::Continuum | Special::Unresolved { .. }) => true,
        Some(Special::BranchPoint) => !point.is_unstated_pitchfork(),
        _ => false,
    };
    if silent {
        let vanishes = matches!(form, Some(NormalForm::Coefficient(found)) if found.is_negative().is_none());
        return (vanishes.then_some("undecided"), vanishes.then(|| VANISHES.to_owned()));
    }
    let known = match form {
        Some(NormalForm::Coefficient(found) | NormalForm::Cubic(found)) => match found.is_negative() {
            Some(is_negative) => Ok(critical(is_negative)),
            None => Err("the coefficient is not three times its error".to_owned()),
        },
        Some(NormalForm::Undetermined(why)) => next().ok_or_else(|| why.to_string()),
        None => next().ok_or_else(|| "no coefficient is computed for it".to_owned()),
    };
    known.map_or_else(|why| (Some("undecided"), Some(why)), |word| (Some(word), None))
}

const fn critical(is_supercritical: bool) -> &'static str {
    if is_supercritical { "supercritical" } else { "subcritical" }
}

/// `true` if the branch that begins at a point of a leg, and is seen first at the parameter `first`, lies on the side where the leg has
/// more growing directions: then it is stable in the critical direction.
fn is_supercritical(leg: &Leg, point: usize, first: f64) -> Option<bool> {
    let ordinary = |sample: &&Sample| sample.point.special.is_none();
    let before = leg.samples[..point].iter().rev().find(ordinary)?;
    let after = leg.samples[point + 1..].iter().find(ordinary)?;
    let here = leg.samples[point].point.parameter;
    let beside = |sample: &Sample| (sample.point.parameter - here) * (first - here) > 0.0;
    let (same, other) = match (beside(before), beside(after)) {
        (true, false) => (before, after),
        (false, true) => (after, before),
        _ => return None, // the leg turns back here
    };
    Some(same.point.unstable > other.point.unstable)
}

/// The evidence for a connection: its kind, the law of the time, and the saddle with its eigenvalues.
fn put_connection(object: &mut Map<String, Value>, connection: &Connection) {
    let mut put = |key: &str, value: Value| object.insert(key.to_owned(), value);
    put("connection", connection.kind().name().into());
    put("joins", connection.joins.map(Joins::name).into());
    let (law, numbers): (&str, &[(&str, f64)]) = match connection.law {
        PeriodLaw::Logarithmic { rate } => ("logarithmic", &[("rate", rate)]),
        PeriodLaw::Oscillating { rate, frequency } => {
            ("oscillating", &[("rate", rate), ("frequency", frequency)])
        }
        PeriodLaw::Resonant { amplitude } => ("resonant", &[("amplitude", amplitude)]),
        PeriodLaw::SquareRoot { amplitude } => ("square-root", &[("amplitude", amplitude)]),
        _ => ("", &[]),
    };
    put("law", law.into());
    numbers.iter().for_each(|(name, number)| {
        put(name, (*number).into());
    });
    if let [(name, _)] = numbers {
        put(&format!("{name}_error"), connection.law_error.into());
    }
    put("remaining", connection.remaining.into());
    if let Some(quantity) = connection.quantity() {
        put("saddle_quantity", quantity.into());
        put("saddle_quantity_error", connection.quantity_error().into());
    }
    if let Some([grows, decays]) = connection.sides() {
        put("leading_growing", json!(grows));
        put("leading_decaying", json!(decays));
    }
    if let Some(saddle) = &connection.saddle {
        put("saddle", told(saddle));
    }
    if let Some(attraction) = connection.attraction() {
        put("attraction", attraction.into());
        put("saddles", connection.passed.iter().map(passed).collect());
    }
}

fn told(saddle: &RelativeEquilibrium) -> Value {
    json!({
        "eigenvalues": saddle.eigenvalues,
        "turning_rate": saddle.turning_rate,
        "speed": saddle.speed(),
        "shape": saddle.shape,
    })
}

/// A saddle of a heteroclinic cycle.
fn passed(passed: &Passed) -> Value {
    let mut object = told(&passed.saddle);
    object["leading_growing"] = json!(passed.sides[0]);
    object["leading_decaying"] = json!(passed.sides[1]);
    object["saddle_quantity"] = passed.quantity().into();
    object["saddle_quantity_error"] = passed.quantity_error().into();
    object["share"] = passed.share.into();
    object
}

/// The end of a leg, where it is a place of its own.
fn end(leg: &Leg) -> Option<SpecialEntry> {
    let End::Homoclinic(connection) = &leg.end else { return None };
    Some(SpecialEntry {
        kind: connection.name(),
        parameter: connection.parameter,
        error: Some(connection.error),
        connection: Some(connection.as_ref().clone()),
        ..SpecialEntry::default()
    })
}
