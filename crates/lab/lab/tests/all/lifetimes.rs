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
    assert_eq!((one.until, one.values.len()), (1000.0, 3));
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
