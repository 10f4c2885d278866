//! Rows and plans.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::{Toy, compute, folder, open, plan, preset, study};
use motiform_analysis::regime::{Attractor, Regime, Verdict};
use motiform_dynamics::Watch;
use motiform_lab::scan::{Axis, Evaluate, Opening, Row, ScanFolder, Totals, cells, for_each_part};
use motiform_study::{Error, ScanPlan, Study};

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

/// The refusal of a row by the numerics is that row's answer.
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
