//! Scans that are damaged, missing or of another plan.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::{Toy, compute, contents, folder, open, plan, study};
use crate::samples::draws;
use motiform_analysis::regime::{Attractor, Regime, Verdict};
use motiform_dynamics::Watch;
use motiform_lab::scan::{Evaluate, Opening, PartError, Scan, ScanFolder, Shard, Totals, merge};
use motiform_store::Error as StoreError;
use motiform_study::{Error, ScanPlan};
use tempfile::TempDir;

#[test]
fn every_damaged_byte_is_found() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("scan"), &plan, "1/200", 1);
    let parts = ScanFolder::read(&at("scan")).unwrap().parts();
    assert_eq!(parts.check(0).map(|digest| digest.len()), Ok(64));
    assert_eq!(parts.check(1), Err(PartError::Missing));
    let whole = std::fs::read(parts.path(0)).unwrap();
    // a push has every fifth of them, and with them every bit of a byte
    for place in (0..whole.len()).step_by(draws(5, 1)) {
        let mut bytes = whole.clone();
        bytes[place] ^= 1 << (place % 8);
        std::fs::write(parts.path(0), &bytes).unwrap();
        assert!(matches!(parts.check(0), Err(PartError::Damaged(_))), "byte {place} of {}", whole.len());
    }
    for length in (0..whole.len()).step_by(draws(5, 1)) {
        std::fs::write(parts.path(0), &whole[..length]).unwrap();
        assert!(matches!(parts.check(0), Err(PartError::Damaged(_))), "{length} of {} bytes", whole.len());
    }
    // A whole part in the place of another one, and one of another scan.
    std::fs::write(parts.path(1), &whole).unwrap();
    assert!(matches!(parts.check(1), Err(PartError::Damaged(_))));
    compute(&at("other"), &ScanPlan::new(&study(|study| study.run.seed = 2)).unwrap(), "1/200", 1);
    std::fs::copy(ScanFolder::read(&at("other")).unwrap().parts().path(0), parts.path(0)).unwrap();
    assert!(matches!(parts.check(0), Err(PartError::Damaged(_))));
}

#[test]
fn damaged_parts_are_computed_again() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("scan"), &plan, "1/1", 2);
    let whole = contents(&at("scan"));
    let parts = ScanFolder::read(&at("scan")).unwrap().parts();
    std::fs::write(parts.path(3), b"PAR1").unwrap();
    let totals = Totals::of(&ScanFolder::read(&at("scan")).unwrap()).unwrap();
    assert_eq!((totals.damaged.len(), totals.missing), (1, plan.cells_of(3).len()));
    let scan = open(&at("scan"), &plan, "1/1", Opening::Resume).unwrap();
    assert!(
        scan.damaged().len() == 1 && scan.damaged()[0].contains("part-00003.parquet"),
        "{:?}",
        scan.damaged()
    );
    assert_eq!(scan.cells_left(), plan.cells_of(3).len());
    scan.run(&Toy, 2, &()).unwrap();
    let aside = at("scan").join("_damaged-part-00003.parquet");
    assert_eq!(std::fs::read(&aside).unwrap(), b"PAR1");
    assert!(scan.notes().iter().any(|note| note.contains("_damaged-part-00003.parquet")));
    std::fs::remove_file(aside).unwrap();
    assert!(contents(&at("scan")) == whole);
}

#[test]
fn one_process_at_a_time_and_one_plan_per_folder() {
    let ((_keep, at), plan) = (folder(), plan());
    let scan = open(&at("scan"), &plan, "1/1", Opening::New).unwrap();
    for opening in [Opening::Resume, Opening::Replace] {
        assert!(matches!(
            open(&at("scan"), &plan, "1/2", opening),
            Err(Error::Store(StoreError::Busy { .. }))
        ));
    }
    drop(scan);
    assert!(matches!(
        open(&at("scan"), &plan, "1/1", Opening::New),
        Err(Error::Store(StoreError::Resumable { .. }))
    ));
    let other = study(|study| {
        study.scan.axes.pop();
        study.scan.samples = 4;
        study.set("a1", 0.5).unwrap();
        study.set_initial("v1", 0.25).unwrap();
    });
    let other = ScanPlan::new(&other).unwrap();
    let error = open(&at("scan"), &other, "1/1", Opening::Resume).unwrap_err().to_string();
    for said in
        ["samples: 3 there, 4 requested", "parameters.a1: 1.0 there, 0.5 requested", "initial.v1: none there"]
    {
        assert!(error.contains(said), "{error}");
    }
    assert!(
        error.contains("axes: [kappa2 = 0.1 to 1.6 (40 values)] x [gamma = 0.1 to 1.5 (30 values)] there")
    );
    open(&at("scan"), &other, "1/1", Opening::Replace).unwrap();
    assert_eq!(ScanFolder::read(&at("scan")).unwrap().plan(), &other);
    std::fs::create_dir(at("mine")).unwrap();
    std::fs::write(at("mine").join("notes.md"), "mine").unwrap();
    for opening in [Opening::New, Opening::Replace] {
        assert!(matches!(
            open(&at("mine"), &plan, "1/1", opening),
            Err(Error::Store(StoreError::NotOurs { .. }))
        ));
    }
    assert!(matches!(open(&at("mine"), &plan, "1/1", Opening::Resume), Err(Error::NoResult { .. })));
}

#[test]
fn different_numbers_for_the_same_rows_are_refused() {
    struct Other;
    impl Evaluate for Other {
        fn evaluate(
            &self,
            _: &ScanPlan,
            _: usize,
            _: usize,
            _: &dyn Watch,
        ) -> Result<Option<Verdict>, Error> {
            Ok(Some(Verdict::new(Regime::Chaotic, Attractor::Chaotic, String::new(), 1.0)))
        }
    }
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("a"), &plan, "1/1", 2);
    open(&at("b"), &plan, "2/99", Opening::New).unwrap().run(&Other, 2, &()).unwrap();
    assert!(matches!(merge(&[at("a"), at("b")], &at("c"), false), Err(Error::Conflict { .. })));
    compute(&at("d"), &ScanPlan::new(&study(|study| study.run.seed = 2)).unwrap(), "1/99", 2);
    assert!(matches!(merge(&[at("a"), at("d")], &at("c"), false), Err(Error::Unmergeable { .. })));
    assert!(!at("c").exists() && std::fs::read_dir(at("")).unwrap().count() == 3);
}

/// Parts that something else removes or damages while a scan runs are counted at its end.
#[test]
fn parts_that_vanish_are_counted() {
    let place = TempDir::new().unwrap();
    let scan = Scan::open(&place.path().join("scan"), &plan(), Shard::WHOLE, Opening::New).unwrap();
    scan.run(&Toy, 2, &()).unwrap();
    assert_eq!(scan.lost(), 0);
    let parts = scan.folder().parts();
    std::fs::remove_file(parts.path(0)).unwrap();
    std::fs::write(parts.path(2), "nothing").unwrap();
    assert_eq!(scan.lost(), 2);
}

/// A run with `--force` that was killed leaves a folder beside the scan; the next run removes it.
#[test]
fn what_a_killed_run_left_is_removed_when_a_scan_goes_on() {
    let place = TempDir::new().unwrap();
    let folder = place.path().join("scan");
    drop(Scan::open(&folder, &plan(), Shard::WHOLE, Opening::New).unwrap());
    let left = place.path().join(".scan.0123456789abcdef.partial");
    std::fs::create_dir(&left).unwrap();
    let marker = "{\"motiform\":\"0.1.0\",\"kind\":\"scan\",\"format\":1,\"complete\":false,\"staging_for\":\"scan\"}\n";
    std::fs::write(left.join("_inventory.jsonl"), marker).unwrap();
    let scan = Scan::open(&folder, &plan(), Shard::WHOLE, Opening::Resume).unwrap();
    assert!(!left.exists());
    assert!(scan.notes()[0].contains("left by a killed run"));
}
