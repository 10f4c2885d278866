//! Lives of chaos in the full tensor model: the same for lanes, threads and single orbits; blow-up and capture.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::LifeLaws;
use motiform_dynamics::Watch;
use motiform_lab::draw::FigureFormat;
use motiform_lab::draw::lifetimes::draw_lifetimes;
use motiform_lab::lifetimes::{Lifetimes, lifetimes};
use motiform_study::{ScanPlan, Study};

/// The plan of a scan of the full model along kappa2 at this kappa3.
fn plan(kappa3: f64, kappa2: &str, samples: usize, budget: f64) -> ScanPlan {
    let text = format!(
        "preset = \"fig4\"\n[model.tensor]\nkappa3 = {kappa3}\n[scan]\naxes = \
        [\"kappa2={kappa2}\"]\nsamples = {samples}\nbudget = {budget}\n"
    );
    ScanPlan::new(&Study::parse(&text, "text", "test").unwrap()).unwrap()
}

fn found(plan: &ScanPlan, threads: usize) -> Lifetimes {
    lifetimes(plan, None, threads, &()).unwrap().unwrap()
}

/// At kappa2 = .1 and .2 orbits are chaotic for some time and blow up.
#[test]
fn threads_change_nothing_and_orbits_blow_up() {
    let plan = plan(0.1, "0.1,0.2,0.3", 12, 1000.0);
    let one = found(&plan, 1);
    assert_eq!(one, found(&plan, 3));
    assert_eq!((one.until(), one.values.len()), ([1000.0; 2], 3));
    for at in &one.values {
        assert_eq!(at.blew_up + at.captured + at.lasting + at.regular + at.lost, 12, "{at:?}");
        assert_eq!((at.captured, at.delay), (0, 200.0));
        assert!(at.life.value.is_none_or(|life| at.life.lower <= life));
    }
    assert!(one.values[0].blew_up > 0, "{:?}", one.values[0]);
    assert!(matches!(one.laws, LifeLaws::TooFew { .. }));
    let pictures = draw_lifetimes(&plan, &one, &FigureFormat::default()).unwrap();
    let names: Vec<&str> = pictures.iter().map(|picture| picture.name.as_str()).collect();
    assert_eq!(names, ["mean-life.svg", "mean-life.png"]);
    let svg = String::from_utf8(pictures[0].bytes.clone()).unwrap();
    assert!(svg.contains("Law: too few events") && svg.contains("mean life, with 95 % limits"), "{svg}");
}

/// At (1.2, .4) straight motion attracts all; the delay covers the way to it, so that no life is counted. At (.9, .1) it is a zigzag.
#[test]
fn captures_by_steady_motions_are_noticed_and_zigzags_do_not_count() {
    let steady = found(&plan(0.4, "1.2", 6, 2000.0), 2);
    let at = &steady.values[0];
    assert_eq!((at.captured, at.lasting, at.blew_up), (6, 0, 0), "{at:?}");
    assert_eq!((at.life.events, at.life.early), (0, 6), "{at:?}");
    assert_eq!(steady.notes().len(), 1);
    let zigzag = found(&plan(0.1, "0.9", 4, 4000.0), 2);
    assert_eq!(zigzag.values[0].regular + zigzag.values[0].blew_up, 4, "{zigzag:?}");
}

struct Stopped;

impl Watch for Stopped {
    fn stopped(&self) -> bool {
        true
    }
}

#[test]
fn a_stop_is_heard_and_nonsense_refused() {
    let one = plan(0.1, "0.3", 2, 400.0);
    assert_eq!(lifetimes(&one, None, 2, &Stopped).unwrap(), None);
    assert!(lifetimes(&one, Some(-1.0), 1, &()).is_err());
    let text = "preset = \"fig4\"\n[scan]\naxes = [\"kappa2=0.3,0.4\", \"kappa3=0.1,0.2\"]\n";
    let two = ScanPlan::new(&Study::parse(text, "text", "test").unwrap()).unwrap();
    assert!(lifetimes(&two, None, 1, &()).is_err());
    let text = text.replace("\"kappa2=0.3,0.4\", \"kappa3=0.1,0.2\"", "\"v1=0.3,0.4\"");
    let start = ScanPlan::new(&Study::parse(&text, "text", "test").unwrap()).unwrap();
    assert!(lifetimes(&start, None, 1, &()).unwrap_err().to_string().contains("a coordinate of the start"));
}

/// Lorenz's equations at r = 23 with amplitudes in units of `length` and rates `k` in units of `rate`, along an axis.
fn lorenz([length, rate]: [f64; 2], axis: &str, samples: usize) -> ScanPlan {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/models/lorenz.toml"))
        .unwrap();
    let text = text
        .replace(
            "z2 = \"(10*(im(z2)-re(z2))) + i*((r*re(z2)-im(z2)-re(z2)*re(z3)))\"",
            "z2 = \"k*((10*(im(z2)-re(z2))) + i*((r*re(z2)-im(z2)-q*re(z2)*re(z3))))\"",
        )
        .replace(
            "z3 = \"(re(z2)*im(z2)-8/3*re(z3)) + i*((-im(z3)))\"",
            "z3 = \"k*((q*re(z2)*im(z2)-8/3*re(z3)) + i*((-im(z3))))\"",
        )
        .replace("r = 28", &format!("r = 23\nq = {:e}\nk = {rate:e}", 1.0 / length));
    let (low, high) = (length, 30.0 * length);
    let starts = format!(
        "[initial]\nrandom = \"{low:e}:{high:e}\"\n[scan]\naxes = [\"{axis}\"]\nsamples = {samples}\n"
    );
    ScanPlan::new(&Study::parse(&format!("{text}\n{starts}"), "text", "test").unwrap()).unwrap()
}

/// The mean life of Lorenz's transient chaos at r = 23, in units of any size. Its value: 6000 starts by Runge-Kutta 4 with steps of 0.004,
/// lives to 1e-3 from the foci, after a delay of 270: 327 +- 23 (95 %).
#[test]
fn lives_are_those_of_other_units() {
    for units in [[1.0, 1.0], [1e-6, 1.0], [1e6, 1.0], [1.0, 1e3], [1.0, 1e-3]] {
        let found = found(&lorenz(units, "r=23", 160), 2);
        let life = &found.values[0].life;
        let (lower, upper) = (units[1] * life.lower, units[1] * life.upper.unwrap());
        assert!(lower < 327.0 && 327.0 < upper && upper < 4.0 * lower, "{units:?}: {found:?}");
    }
}

/// Where rates vary along the axis, each value has looks of its own, in any order of the values.
#[test]
fn lives_are_those_of_other_units_along_an_axis_of_rates() {
    for axis in ["k=1,1000", "k=1000,1"] {
        let found = found(&lorenz([1.0; 2], axis, 160), 2);
        for at in &found.values {
            let (lower, upper) = (at.value * at.life.lower, at.value * at.life.upper.unwrap());
            assert!(lower < 327.0 && 327.0 < upper && upper < 4.0 * lower, "{axis}: {found:?}");
        }
    }
}

/// At 20 most lives end at once, at 23.5 some at once and others late: neither are those of a set that loses its orbits at a constant rate,
/// though the places of all their ends together look uniform.
#[test]
fn lives_of_opposite_kinds_are_no_law() {
    let plan = lorenz([1.0; 2], "r=18:23.5:6", 64);
    let found = lifetimes(&plan, Some(20.0), 2, &()).unwrap().unwrap();
    assert!(matches!(found.laws, LifeLaws::NotExponential(_)), "{}", found.laws.words());
    // r, which is the axis, is the only parameter: no other one is 0
    let pictures = draw_lifetimes(&plan, &found, &FigureFormat::default()).unwrap();
    let svg = String::from_utf8(pictures[0].bytes.clone()).unwrap();
    assert!(svg.contains("model units") && !svg.contains("all other"), "{svg}");
}
