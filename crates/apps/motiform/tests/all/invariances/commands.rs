//! One command against another.

use super::judge::Judged;
use super::request::{Answer, Request};
use crate::common::Folder;

/// Answers of other commands about a motion that `classify` has named.
pub(crate) fn compare(folder: &Folder, settled: &Request, base: &Answer) -> Vec<(&'static str, Judged)> {
    let mut all = vec![("simulate", simulate(folder, settled, base))];
    match base.0["attractor"].as_str() {
        Some("equilibrium") => {
            all.push(("equilibria", equilibria(folder, settled, base)));
            all.push(("lyapunov", lyapunov(folder, settled, base)));
        }
        Some("periodic") if base.0["exponents"].as_array().is_some_and(|list| !list.is_empty()) => {
            all.push(("lyapunov", lyapunov(folder, settled, base)));
        }
        _ => {}
    }
    all
}

/// A short run that starts on the motion has its name, or none.
fn simulate(folder: &Folder, settled: &Request, base: &Answer) -> Judged {
    let run = settled.ask(folder, "simulate", "--transient 0 --t-end 10 --out named --force");
    match run.0.pointer("/manifest/regime").and_then(|name| name.as_str()) {
        None => Judged::Same,
        Some(_) if base.regime() == "undetermined" => Judged::Undecided,
        Some(name) if name == base.regime() => Judged::Same,
        Some(name) => Judged::Contradiction(format!("{} and {name}", base.regime())),
    }
}

/// The steady motion is in the list, with the same name, speed, turning rate and stability.
fn equilibria(folder: &Folder, settled: &Request, base: &Answer) -> Judged {
    let list = settled.ask(folder, "equilibria", "");
    let Some(list) = list.0["equilibria"].as_array() else {
        return Judged::Contradiction("no list".to_owned());
    };
    let number = |path: &str| base.number(path).unwrap_or(0.0).abs();
    let (speed, turning) = (number("/speed/mean"), number("/turning_rate"));
    let near = |x: Option<f64>, y: f64| x.is_some_and(|x| (x.abs() - y).abs() <= 1e-6 * y + 1e-9);
    let same = |one: &&serde_json::Value| {
        one["motion"].as_str() == Some(base.regime())
            && one["unstable"].as_u64() == Some(0)
            && near(one["speed"].as_f64(), speed)
            && near(one["turning_rate"].as_f64(), turning)
    };
    let stable = list.iter().filter(|one| one["unstable"].as_u64() == Some(0)).count();
    if list.iter().any(|one| same(&one)) {
        Judged::Same
    } else if stable == 0 {
        Judged::Undecided // random starts of Newton's method may miss it
    } else {
        Judged::Contradiction(format!("{} {speed} {turning} is not in the list", base.regime()))
    }
}

/// The exponents of a long run are those of eigenvalues or multipliers, within their errors, and as many of them must be zero.
fn lyapunov(folder: &Folder, settled: &Request, base: &Answer) -> Judged {
    let mut exact = base.exponents();
    let neutral = exact.iter().filter(|one| one.0 == 0.0).count();
    exact.truncate(4);
    let run = settled.ask(folder, "lyapunov", &format!("--count {}", exact.len()));
    let measured = run.exponents();
    if !measured.is_empty() && run.0["neutral"] != neutral {
        return Judged::Contradiction(format!("{neutral} and {} neutral directions", run.0["neutral"]));
    }
    for (k, (&(x, error), &(y, other))) in exact.iter().zip(&measured).enumerate() {
        if (x - y).abs() > 3.0 * (error + other) + 1e-9 {
            return Judged::Contradiction(format!("lambda_{} {x} +- {error} and {y} +- {other}", k + 1));
        }
    }
    if measured.is_empty() { Judged::Undecided } else { Judged::Same }
}
