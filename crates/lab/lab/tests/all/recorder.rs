//! The rows of a run as they are written.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Outcome;
use motiform_lab::recorder::{Rows, last_sample};
use motiform_lab::simulate::{Run, columns, simulate, simulate_into};
use motiform_models::ModelInfo;
use motiform_store::TableWriter;
use motiform_store::table::{Table, same_bits};
use motiform_study::{Error, RunPlan, presets};

fn plan(model: &str, preset: &str, change: impl Fn(&mut motiform_study::Study)) -> RunPlan {
    let mut study = presets::find(ModelInfo::find(model).unwrap(), preset).unwrap();
    change(&mut study);
    RunPlan::new(&study).unwrap()
}

/// Rows that fail after a number of them.
struct Failing(Table, usize);

impl Rows for Failing {
    fn table(&mut self) -> &mut Table {
        &mut self.0
    }

    fn advance(&mut self) -> Result<(), Error> {
        let error = || Error::unreadable(std::path::Path::new("disk"), "full");
        if self.0.rows() >= self.1 { Err(error()) } else { Ok(()) }
    }

    fn restart(&mut self) -> Result<(), Error> {
        Rows::restart(&mut self.0)
    }
}

/// A centred return map is recorded twice; the last sample is not the end of the run in the second plan.
#[test]
fn what_is_written_is_what_is_kept() {
    for dt_out in [0.05, 0.07] {
        let plan = plan("tensor", "fig3", |study| {
            (study.run.transient, study.run.t_end, study.run.dt_out) = (100.0, 300.0, dt_out);
        });
        let kept = simulate(&plan, &()).unwrap();
        let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
        let mut rows = TableWriter::new(columns(&plan).unwrap(), motiform_store::Format::Csv, file.path());
        let Run { manifest, crossings } = simulate_into(&plan, &mut rows, &()).unwrap();
        let written = rows.finish(&manifest).unwrap().unwrap();
        assert!(manifest == kept.manifest && manifest.centre.is_some());
        assert!(same_bits(&written, &kept.trajectory) && written.rows() > 4000);
        assert!(same_bits(&crossings.unwrap(), kept.crossings.as_ref().unwrap()));
    }
}

#[test]
fn the_last_sample_is_foreseen() {
    for (end, every) in [(300.0, 0.05), (300.0, 0.07), (1.0, 0.1), (0.3, 0.1), (1e6, 0.3), (10.0, 30.0)] {
        let plan = plan("tensor", "fig5a", |study| {
            (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, f64::min(end, 400.0), every);
        });
        let end = plan.computation.t_end;
        let times = simulate(&plan, &()).unwrap().trajectory.get("t").unwrap().to_vec();
        assert_eq!(times.last(), Some(&last_sample(end, every)), "{end} {every}");
    }
}

/// A full disk ends the run at once, not after hours.
#[test]
fn rows_that_cannot_be_written_end_the_run() {
    let long = plan("tensor", "fig5a", |study| (study.run.transient, study.run.t_end) = (0.0, 1e9));
    let mut rows = Failing(columns(&long).unwrap(), 100);
    let why = simulate_into(&long, &mut rows, &()).err().unwrap().to_string();
    assert!(why.contains("full") && rows.0.rows() == 100, "{why}");
    assert!(simulate(&long, &()).unwrap_err().to_string().contains("too many for memory"));
    let short = plan("tensor", "fig5a", |study| (study.run.transient, study.run.t_end) = (0.0, 4.0));
    let mut rows = Failing(columns(&short).unwrap(), 100);
    let run = simulate_into(&short, &mut rows, &()).unwrap();
    assert!(matches!(run.manifest.outcome.outcome, Outcome::Completed { .. }));
}
