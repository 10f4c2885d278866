//! Changes that leave the motion as it is.

use super::request::{Request, write};
use super::subjects::{Subject, System};
use super::texts::Text;
use crate::common::Folder;

/// A mode more, whose phase nothing fixes.
pub(crate) const FREE_PHASE: &str = "a free phase";

/// The changed requests of a subject that starts on its motion.
pub(crate) fn changes(folder: &Folder, subject: &Subject, settled: &Request) -> Vec<(&'static str, Request)> {
    let mut all: Vec<(&'static str, Request)> = Vec::new();
    for seed in [5, 9, 12] {
        all.push(("a start nearby", nearby(settled, seed)));
    }
    let tolerances: &[f64] = if settled.model == "cell" { &[1e-7, 1e-8] } else { &[1e-8, 1e-10, 1e-12] };
    for &rtol in tolerances {
        all.push(("another tolerance", Request { rtol: Some(rtol), ..settled.clone() }));
    }
    for angle in [1.1, -2.6] {
        all.push(("rotated", map(settled, |n, z| rotated(z, sense(settled) * f64::from(n) * angle))));
    }
    if !matches!(&subject.system, System::Text(text) if text.handed) {
        all.push(("mirrored", map(settled, |_, z| mirrored(settled, z))));
    }
    match &subject.system {
        System::BuiltIn("cell") => all.extend(cell(subject, settled)),
        System::BuiltIn(_) => all.extend(text_of(folder, settled, &Text::tensor(subject))),
        System::Text(text) => all.extend(own(folder, settled, text)),
    }
    all
}

/// Every entry changed by up to one part in a thousand.
fn nearby(request: &Request, seed: u64) -> Request {
    let mut changed = request.clone();
    changed.seed = seed;
    for (k, (_, value)) in changed.initial.iter_mut().enumerate() {
        *value *= 1.0 + 1e-3 * (1.7 * (k as f64 + 1.0) * seed as f64).sin();
    }
    changed
}

/// The sense in which the amplitude of mode n turns.
fn sense(request: &Request) -> f64 {
    if request.model == "cell" { 1.0 } else { -1.0 }
}

fn rotated((re, im): (f64, f64), angle: f64) -> (f64, f64) {
    let (sin, cos) = angle.sin_cos();
    (cos * re - sin * im, cos * im + sin * re)
}

/// y to -y: complex conjugation of an amplitude; of a mode of the cell's angle its negative.
fn mirrored(request: &Request, (re, im): (f64, f64)) -> (f64, f64) {
    if request.model == "cell" { (-re, im) } else { (re, -im) }
}

/// The start with every amplitude `z_n` changed.
fn map(request: &Request, change: impl Fn(u32, (f64, f64)) -> (f64, f64)) -> Request {
    let mut changed = request.clone();
    let value =
        |name: &str| request.initial.iter().find(|entry| entry.0 == name).map_or(0.0, |entry| entry.1);
    for (name, to) in &mut changed.initial {
        let Some((n, [re, im], signs)) = pair(name) else { continue };
        let z = change(n, (value(&re), signs * value(&im)));
        *to = if *name == re { z.0 } else { signs * z.1 };
    }
    changed
}

/// The mode of a coordinate, the names of its two parts, and the sign of the second one in the amplitude.
fn pair(name: &str) -> Option<(u32, [String; 2], f64)> {
    let names = |re: &str, im: &str| [re.to_owned(), im.to_owned()];
    match name {
        "v1" | "v2" => return Some((1, names("v1", "v2"), -1.0)),
        "s11" | "s12" => return Some((2, names("s11", "s12"), -1.0)),
        "u111" | "u222" => return Some((3, names("u111", "u222"), 1.0)),
        _ => {}
    }
    if let Some(rest) = name.strip_prefix('z') {
        let n = rest.split('_').next()?;
        return Some((n.parse().ok()?, names(&format!("z{n}_re"), &format!("z{n}_im")), 1.0));
    }
    let n = name.strip_prefix(['c', 's'])?;
    Some((n.parse().ok()?, names(&format!("c{n}"), &format!("s{n}")), 1.0))
}

/// Other numbers of modes: those that resolve the shape.
fn cell(subject: &Subject, settled: &Request) -> Vec<(&'static str, Request)> {
    let long = subject.parameter("length") > 15.0;
    let counts: &[u32] = if long { &[30, 42, 64] } else { &[14, 30, 42, 64] };
    let with = |&modes: &u32| {
        let mut changed = settled.clone();
        changed.set.push(("modes".to_owned(), f64::from(modes)));
        changed.initial.retain(|(name, _)| pair(name).is_some_and(|(n, ..)| n <= modes));
        ("another number of modes", changed)
    };
    counts.iter().map(with).collect()
}

/// A start given by names of one model in those of a text model with the unit `length`.
fn named(request: &Request, length: f64) -> Vec<(String, f64)> {
    let convert = |(name, value): &(String, f64)| match name.as_str() {
        "s11" => ("z2_re".to_owned(), 0.5 * value * length),
        "s12" => ("z2_im".to_owned(), -0.5 * value * length),
        "u111" => ("z3_re".to_owned(), 0.5 * value * length),
        "u222" => ("z3_im".to_owned(), 0.5 * value * length),
        _ => (name.clone(), value * length),
    };
    request.initial.iter().map(convert).collect()
}

/// The same equations as text, in other units, with silent modes, and with a free phase.
fn own(folder: &Folder, settled: &Request, text: &Text) -> Vec<(&'static str, Request)> {
    let mut all = Vec::new();
    for (name, time, length) in [("time.toml", 3.7, 1.0), ("length.toml", 1.0, 2.3)] {
        let model = write(folder, name, &text.study(time, length));
        let initial = named(settled, length);
        all.push((
            "other units",
            Request { model, initial, set: Vec::new(), time, length, ..settled.clone() },
        ));
    }
    let model = write(folder, "silent.toml", &text.with_silent_modes().study(1.0, 1.0));
    let mut initial = named(settled, 1.0);
    initial.extend([("z17_re", 0.01), ("z17_im", 0.02)].map(|(name, x)| (name.to_owned(), x)));
    all.push(("silent modes", Request { model, initial, set: Vec::new(), ..settled.clone() }));
    let model = write(folder, "free.toml", &text.with_free_phase().study(1.0, 1.0));
    let mut initial = named(settled, 1.0);
    initial.extend([("z19_re", 0.4), ("z19_im", 0.3)].map(|(name, x)| (name.to_owned(), x)));
    all.push((FREE_PHASE, Request { model, initial, set: Vec::new(), ..settled.clone() }));
    all
}

fn text_of(folder: &Folder, settled: &Request, text: &Text) -> Vec<(&'static str, Request)> {
    let model = write(folder, "text.toml", &text.study(1.0, 1.0));
    let initial = named(settled, 1.0);
    let mut all = vec![("equations as text", Request { model, initial, set: Vec::new(), ..settled.clone() })];
    all.extend(own(folder, settled, text));
    all
}
