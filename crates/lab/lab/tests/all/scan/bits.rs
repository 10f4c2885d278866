//! Neither threads nor shards nor interruptions change a bit, and no later version does without a new format.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::{Toy, compute, contents, folder, open, plan, preset, study};
use motiform_dynamics::Watch;
use motiform_lab::scan::{
    Axis, Classify, NUMBERS, Opening, Row, SCAN_FORMAT, Scan, Shard, Totals, for_each_part, merge,
};
use motiform_store::Error as StoreError;
use motiform_study::{Error, ScanPlan};
use std::sync::atomic::{AtomicUsize, Ordering};
use tempfile::TempDir;

#[test]
fn threads_change_no_bit() {
    let ((_keep, at), plan) = (folder(), plan());
    for threads in [1, 2, 5] {
        let ended = compute(&at(&threads.to_string()), &plan, "1/1", threads);
        assert_eq!((ended.complete, ended.cells), (true, 1200));
    }
    let one = contents(&at("1"));
    assert_eq!(one.len(), plan.parts() + 2);
    assert!(one == contents(&at("2")) && one == contents(&at("5")));
}

#[test]
fn shards_merge_to_the_same_bytes() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("whole"), &plan, "1/1", 2);
    for shard in 1..=3 {
        compute(&at(&shard.to_string()), &plan, &format!("{shard}/3"), shard);
    }
    let two = merge(&[at("1"), at("3")], &at("two"), false).unwrap();
    assert!(two.missing > 70 && two.damaged.is_empty(), "{}", two.missing);
    let all = merge(&[at("two"), at("2"), at("1")], &at("all"), false).unwrap();
    assert_eq!(all.missing, 0);
    assert!(contents(&at("all")) == contents(&at("whole")));
    // What is missing can be computed in the merged folder as well.
    open(&at("two"), &plan, "1/1", Opening::Resume).unwrap().run(&Toy, 2, &()).unwrap();
    assert!(contents(&at("two")) == contents(&at("whole")));
    assert!(matches!(merge(&[at("1")], &at("all"), false), Err(Error::Store(StoreError::Exists { .. }))));
}

/// Stops after so many questions.
struct Patience(AtomicUsize);

impl Watch for Patience {
    fn stopped(&self) -> bool {
        self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_err()
    }
}

#[test]
fn interruptions_change_no_bit() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("whole"), &plan, "1/1", 2);
    for (run, patience) in [0, 1, 50, 999, 2000, 333, usize::MAX].into_iter().enumerate() {
        let scan =
            open(&at("cut"), &plan, "1/1", if run == 0 { Opening::New } else { Opening::Resume }).unwrap();
        let left = scan.cells_left();
        let ended = scan.run(&Toy, 2, &Patience(patience.into())).unwrap();
        assert_eq!(ended.complete, ended.cells == left);
        // Rows under way are lost, whole parts are not.
        assert_eq!(Totals::of(scan.folder()).unwrap().missing, left - ended.cells);
    }
    assert!(contents(&at("cut")) == contents(&at("whole")));
}

/// The evaluation that comes with the program, on real orbits: the same for one and two threads.
#[test]
fn real_orbits_too() {
    let (_keep, at) = folder();
    let plan = ScanPlan::new(&study(|study| {
        study.scan.axes = ["kappa2=0.1:1.6:3", "gamma=-0.5,1"].map(|text| Axis::parse(text).unwrap()).into();
        study.scan.budget = 20.0;
    }))
    .unwrap();
    for threads in [1, 2] {
        let scan = open(&at(&threads.to_string()), &plan, "1/1", Opening::New).unwrap();
        assert!(scan.run(&Classify, threads, &()).unwrap().complete);
    }
    assert!(contents(&at("1")) == contents(&at("2")));
}

/// A part may be resumed by a later program only if that computes the same bits: a change that moves a number raises [`SCAN_FORMAT`]
/// and puts the new digest here.
#[test]
fn numbers_change_only_with_the_format() {
    let rows = |name: &str, axes: &[&str]| {
        let study = preset(name, |study| {
            study.scan.axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
            study.scan.samples = 2;
        });
        let place = TempDir::new().unwrap();
        let plan = ScanPlan::new(&study).unwrap();
        let scan = Scan::open(&place.path().join("scan"), &plan, Shard::WHOLE, Opening::New).unwrap();
        scan.run(&Classify, 2, &()).unwrap();
        let mut all = Vec::new();
        for_each_part(scan.folder(), |rows| all.extend_from_slice(rows)).unwrap();
        all
    };
    let mut all = rows("fig1", &["kappa2=-0.11:0.09:3", "gamma=-0.052:0.051:3"]);
    all.extend(rows("fig4", &["kappa2=0.47:1.03:3", "kappa3=0.11:0.31:2"]));
    // FNV-1a over the bits of all numbers but those that these bodies do not have: they have no field and no number of modes.
    const NONE: [&str; 2] = ["heading", "resolution"];
    let none = |row: &Row| NONE.iter().all(|name| row.number(name).is_none());
    assert!(all.iter().all(|row| none(row) && row.course.is_none()));
    let numbers = |row: &Row| {
        let pairs = NUMBERS.iter().zip(row.numbers);
        pairs.filter(|(known, _)| !NONE.contains(&known.name)).map(|pair| pair.1).collect::<Vec<f64>>()
    };
    let digest = all.iter().flat_map(numbers).flat_map(|x| x.to_bits().to_le_bytes());
    let digest = digest.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    assert_eq!((SCAN_FORMAT, format!("{digest:016x}").as_str()), (14, "e77fd6ae7c8a5d8d"));
}
