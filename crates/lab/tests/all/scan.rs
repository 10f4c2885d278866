//! Scans: the same bytes for any threads, shards and interruptions; damage is found; memory is bounded.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::preset;
use motiform_analysis::regime::{Attractor, Regime, Spread, Verdict};
use motiform_dynamics::Watch;
use motiform_files::store::Error as StoreError;
use motiform_lab::scan::{
    Axis, Classify, Ended, Evaluate, NUMBERS, Opening, PartError, Row, SCAN_FORMAT, Scan, ScanFolder, Shard,
    Totals, cells, for_each_part, merge,
};
use motiform_study::{Error, ScanPlan, Study};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use tempfile::TempDir;

/// The evaluation of these tests: numbers that depend on the model and the start, undefined ones among them, at once.
struct Toy;

impl Evaluate for Toy {
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Watch,
    ) -> Result<Option<Verdict>, Error> {
        if stop.stopped() {
            return Ok(None);
        }
        if cell.is_multiple_of(7) && sample == 0 {
            std::thread::sleep(Duration::from_millis(1)); // rows of one part end in any order
        }
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let mut rate = start.clone();
        model.eval(0.0, &start, &mut rate);
        let regime = if rate[0] > 0.0 { Regime::Zigzag } else { Regime::Straight };
        let verdict = Verdict::new(regime, Attractor::Periodic, format!("{:?}", rate[0]), start[0]);
        let speed = Spread { mean: rate[1], min: -0.0, max: f64::MAX, error: None };
        Ok(Some(Verdict { speed: Some(speed), period: (sample > 0).then_some(rate[2]), ..verdict }))
    }
}

fn study(change: impl FnOnce(&mut Study)) -> Study {
    preset("fig1", |study| {
        study.scan.axes =
            ["kappa2=0.1:1.6:40", "gamma=0.1:1.5:30"].map(|text| Axis::parse(text).unwrap()).into();
        study.scan.samples = 3;
        change(study);
    })
}

fn plan() -> ScanPlan {
    ScanPlan::new(&study(|_| ())).unwrap()
}

fn open(path: &Path, plan: &ScanPlan, shard: &str, opening: Opening) -> Result<Scan, Error> {
    Scan::open(path, plan, Shard::parse(shard).unwrap(), opening)
}

/// A whole scan, or a shard of it, in a folder.
fn compute(path: &Path, plan: &ScanPlan, shard: &str, threads: usize) -> Ended {
    open(path, plan, shard, Opening::New).unwrap().run(&Toy, threads, &()).unwrap()
}

/// Every file that is no lock, with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let named = entries.map(|entry| (entry.file_name().into_string().unwrap(), entry.path()));
    named
        .filter(|(name, _)| name != ".lock")
        .map(|(name, path)| (name, std::fs::read(path).unwrap()))
        .collect()
}

fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = TempDir::new().unwrap();
    let root = folder.path().to_owned();
    (folder, move |name: &str| root.join(name))
}

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

#[test]
fn every_damaged_byte_is_found() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("scan"), &plan, "1/200", 1);
    let parts = ScanFolder::read(&at("scan")).unwrap().parts();
    assert_eq!(parts.check(0).map(|digest| digest.len()), Ok(64));
    assert_eq!(parts.check(1), Err(PartError::Missing));
    let whole = std::fs::read(parts.path(0)).unwrap();
    for place in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[place] ^= 1 << (place % 8);
        std::fs::write(parts.path(0), &bytes).unwrap();
        assert!(matches!(parts.check(0), Err(PartError::Damaged(_))), "byte {place} of {}", whole.len());
    }
    for length in 0..whole.len() {
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

/// A scan of an earlier version has no inventory; what its plan and the digests of its parts prove is continued.
#[test]
fn scans_of_earlier_versions_go_on() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("scan"), &plan, "1/1", 2);
    let whole = contents(&at("scan"));
    let parts = ScanFolder::read(&at("scan")).unwrap().parts();
    std::fs::remove_file(parts.path(3)).unwrap();
    std::fs::remove_file(at("scan").join("_inventory.jsonl")).unwrap();
    let replaced = open(&at("scan"), &plan, "1/1", Opening::Replace);
    assert!(matches!(replaced, Err(Error::Store(StoreError::NotOurs { .. }))));
    let scan = open(&at("scan"), &plan, "1/1", Opening::Resume).unwrap();
    assert_eq!(scan.cells_left(), plan.cells_of(3).len());
    scan.run(&Toy, 2, &()).unwrap();
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
    assert!(matches!(open(&at("mine"), &plan, "1/1", Opening::Resume), Err(Error::NoScan { .. })));
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

/// Rows come back as they were evaluated; an undefined number stays undefined, -0 stays -0.
#[test]
fn rows_are_read_back() {
    let ((_keep, at), plan) = (folder(), plan());
    compute(&at("scan"), &plan, "1/1", 2);
    let scan = ScanFolder::read(&at("scan")).unwrap();
    let mut next = 0;
    for_each_part(&scan, |rows| {
        for row in rows {
            let (cell, sample) = (next / 3, next % 3);
            let expected = Row::new(cell, sample, Toy.evaluate(&plan, cell, sample, &()).unwrap().unwrap());
            assert_eq!(row.numbers.map(f64::to_bits), expected.numbers.map(f64::to_bits));
            let words = |row: &Row| (row.cell, row.sample, row.regime, row.attractor, row.why.clone());
            assert_eq!(words(row), words(&expected));
            assert_eq!(row.number("period").is_some(), sample > 0);
            next += 1;
        }
    })
    .unwrap();
    assert_eq!(next, plan.rows());
    let cells = cells(&scan).unwrap();
    assert!(
        cells.iter().enumerate().all(|(place, cell)| cell.as_ref().is_some_and(|cell| cell.cell == place))
    );
    let totals = Totals::of(&scan).unwrap();
    assert_eq!((totals.cells, totals.rows, totals.regimes.iter().sum::<usize>()), (1200, 3600, 3600));
    let multistable = cells.iter().flatten().filter(|cell| cell.motions.len() > 1).count();
    assert_eq!(totals.multistable, multistable);
}

#[test]
fn starts_depend_on_seed_cell_and_sample_alone() {
    let start = |plan: &ScanPlan, cell, sample| {
        plan.start(cell, sample, plan.model_of(cell).unwrap().as_ref())
            .unwrap()
            .iter()
            .map(|x| x.to_bits())
            .collect::<Vec<_>>()
    };
    let plan = plan();
    let mut all: Vec<_> = (0..100).flat_map(|cell| (0..3).map(move |sample| (cell, sample))).collect();
    let mut starts: Vec<_> = all.drain(..).map(|(cell, sample)| start(&plan, cell, sample)).collect();
    assert_eq!(starts[4], start(&plan, 1, 1));
    starts.sort();
    starts.dedup();
    assert_eq!(starts.len(), 300);
    let seeded = ScanPlan::new(&study(|study| study.run.seed = 2)).unwrap();
    assert_ne!(start(&seeded, 0, 0), start(&plan, 0, 0));
    let given = ScanPlan::new(&study(|study| study.set_initial("v1", 0.5).unwrap())).unwrap();
    assert_eq!(start(&given, 7, 0), start(&given, 0, 0));
    assert_eq!(start(&given, 7, 1), start(&plan, 7, 1));
}

/// What the numerics refuse for a row is that row's answer.
#[test]
fn a_refused_row_is_undetermined() {
    struct Refusing;
    impl Evaluate for Refusing {
        fn evaluate(
            &self,
            _: &ScanPlan,
            _: usize,
            _: usize,
            _: &dyn Watch,
        ) -> Result<Option<Verdict>, Error> {
            Err(Error::Setting { key: "key", value: "value".into(), remedy: "remedy" })
        }
    }
    let (_keep, at) = folder();
    let plan = ScanPlan::new(&study(|study| study.scan.axes.truncate(1))).unwrap();
    let scan = open(&at("scan"), &plan, "1/1", Opening::New).unwrap();
    scan.run(&Refusing, 2, &()).unwrap();
    let totals = Totals::of(scan.folder()).unwrap();
    assert_eq!((totals.undetermined, totals.multistable), (40, 0));
    for_each_part(scan.folder(), |rows| assert_eq!(rows[0].why, "refused: key = value: remedy")).unwrap();
}

/// Parts are fixed by the plan and small; rows in memory are at most those of the parts under way.
#[test]
fn memory_does_not_grow_with_the_cells() {
    struct Nothing;
    impl Evaluate for Nothing {
        fn evaluate(
            &self,
            _: &ScanPlan,
            _: usize,
            _: usize,
            _: &dyn Watch,
        ) -> Result<Option<Verdict>, Error> {
            Ok(Some(Verdict::new(Regime::Motionless, Attractor::Equilibrium, String::new(), 0.0)))
        }
    }
    let sized = |axes: [&str; 2], samples| {
        ScanPlan::new(&study(|study| {
            study.scan.axes = axes.map(|text| Axis::parse(text).unwrap()).into();
            study.scan.samples = samples;
        }))
        .unwrap()
    };
    let threads = 4;
    for (axes, samples, per_part, parts) in [
        (["kappa2=0.1:1:3", "gamma=1"], 2, 1, 3),
        (["kappa2=0.1:1:100", "gamma=0.1:1:10"], 2, 4, 250),
        (["kappa2=0.1:1:300", "gamma=0.1:1:200"], 1, 160, 375),
        (["kappa2=0.1:1:20", "gamma=0.1:1:20"], 3000, 1, 400),
    ] {
        let plan = sized(axes, samples);
        assert_eq!((plan.cells_per_part(), plan.parts()), (per_part, parts));
        let all: usize = (0..parts).map(|part| plan.cells_of(part).len()).sum();
        assert_eq!(all, plan.cells());
        if plan.rows() > 100_000 {
            continue; // the sizes are what matters
        }
        let (_keep, at) = folder();
        let ended =
            open(&at("scan"), &plan, "1/1", Opening::New).unwrap().run(&Nothing, threads, &()).unwrap();
        let most = (threads + 1) * per_part * plan.computation.samples;
        assert!(ended.most_rows <= most, "{} rows in memory, {most} expected", ended.most_rows);
    }
    let large = sized(["kappa2=0.1:1:10000", "gamma=0.1:1:10000"], 8);
    assert_eq!((large.cells_per_part(), large.cells()), (160, 100_000_000));
}

#[test]
fn bad_plans_are_refused() {
    let refuse = |change: fn(&mut Study)| ScanPlan::new(&study(change)).unwrap_err().to_string();
    assert!(refuse(|study| study.scan.axes.clear()).contains("kappa2, gamma"));
    assert!(refuse(|study| study.scan.axes[0].values.clear()).contains("no points"));
    assert!(refuse(|study| study.scan.axes[0].name = "kapa2".into()).contains("did you mean kappa2"));
    assert!(refuse(|study| study.scan.axes[1].name = "kappa2".into()).contains("both axes"));
    assert!(refuse(|study| study.scan.axes.push(Axis::parse("a1=1").unwrap())).contains("one or two axes"));
    assert!(refuse(|study| study.scan.samples = 0).contains("samples = 0"));
    assert!(refuse(|study| study.scan.budget = -1.0).contains("budget = -1"));
    assert!(refuse(|study| study.scan.axes[0].values[3] = 2e6).contains("out of range"));
    let cell = preset("fig6a", |study| study.scan.axes = vec![Axis::parse("modes=20:21:3").unwrap()]);
    assert!(ScanPlan::new(&cell).unwrap_err().to_string().contains("not a whole number"));
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
        pairs.filter(|(known, _)| !NONE.contains(&known.0)).map(|pair| pair.1).collect::<Vec<f64>>()
    };
    let digest = all.iter().flat_map(numbers).flat_map(|x| x.to_bits().to_le_bytes());
    let digest = digest.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    assert_eq!((SCAN_FORMAT, format!("{digest:016x}").as_str()), (9, "e77fd6ae7c8a5d8d"));
}

/// What something else removes or damages while a scan runs is counted at its end.
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
