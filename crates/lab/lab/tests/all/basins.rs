//! Scans over coordinates of the start: maps of basins.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::regime::Regime;
use motiform_lab::scan::{Classify, Evaluate};
use motiform_study::scan::Axis;
use motiform_study::{ScanPlan, Study};

/// A subcritical onset of motion: rest is stable, and so is motion with `|z|^2 = (1 + sqrt(1 - 4 e)) / 2`.
const SUBCRITICAL: &str = r#"
title = "Subcritical onset of motion"

[model.amplitudes]
modes = [1]

[model.amplitudes.parameters]
e = { value = 0.1, range = [0, 0.2] }

[model.amplitudes.equations]
z1 = "(-e + |z1|^2 - |z1|^4)*z1"
"#;

fn plan(axes: &[&str], more: &str) -> ScanPlan {
    let mut study = Study::parse(&format!("{SUBCRITICAL}{more}"), "text", "basins").unwrap();
    study.scan.axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
    ScanPlan::new(&study).unwrap()
}

fn regime(plan: &ScanPlan, cell: usize) -> Regime {
    Classify.evaluate(plan, cell, 0, &()).unwrap().unwrap().regime
}

/// The boundary of the basins is the circle `|z|^2 = (1 - sqrt(1 - 4 e)) / 2`, exactly.
#[test]
fn the_boundary_of_two_basins_is_where_it_is_known_to_be() {
    let plan = plan(&["v1=-0.7:0.7:15", "v2=-0.7:0.7:15"], "");
    let boundary = 0.5 * (1.0 - (1.0_f64 - 0.4).sqrt());
    let mut counts = [0, 0];
    for cell in 0..plan.cells() {
        let at = plan.axis_values(cell);
        let size = at[0] * at[0] + at[1] * at[1];
        let expected = if size > boundary { Regime::Straight } else { Regime::Motionless };
        assert_eq!(regime(&plan, cell), expected, "{at:?}");
        counts[usize::from(size > boundary)] += 1;
    }
    assert!(counts.iter().all(|&count| count > 30), "{counts:?}");
}

/// A parameter on the other axis: the boundary moves with it.
#[test]
fn a_parameter_may_be_on_the_other_axis() {
    let plan = plan(&["e=0.05,0.1,0.2", "v1=0.2,0.3,0.4,0.6"], "[initial]\nv2 = 0.1\n");
    for cell in 0..plan.cells() {
        let [e, v1] = plan.axis_values(cell)[..] else { unreachable!() };
        let boundary = 0.5 * (1.0 - (1.0 - 4.0 * e).sqrt());
        let moves = v1 * v1 + 0.01 > boundary;
        assert_eq!(regime(&plan, cell) == Regime::Straight, moves, "e = {e}, v1 = {v1}");
    }
}

/// Coordinates that are no axis are those of the given start, or 0 but for the perturbation; further samples
/// are random, but on the axes too.
#[test]
fn starts_have_the_values_of_their_cell() {
    let study = "preset = \"fig4\"\n[initial]\nu111 = 0.5\n[scan]\nsamples = 3\naxes = [\"s11=-1:1:5\", \"v2=0.25,0.75\"]\n";
    let plan = ScanPlan::new(&Study::parse(study, "text", "t").unwrap()).unwrap();
    assert!(!plan.draws_first().unwrap());
    for row in 0..plan.rows() {
        let (cell, sample) = (row / 3, row % 3);
        let model = plan.model_of(cell).unwrap();
        let mut start = [0.0; 6];
        model.decode(&plan.start(cell, sample, model.as_ref()).unwrap(), &mut start);
        let at = plan.axis_values(cell);
        assert_eq!([start[2], start[1]], [at[0], at[1]]);
        let given = [0, 3, 5].iter().all(|&i| start[i] != 0.0 && start[i].abs() <= 1e-6) && start[4] == 0.5;
        assert_eq!(given, sample == 0, "{start:?}");
    }
    let unknown = Study::parse("preset = \"fig4\"\n[scan]\naxes = [\"s13=0:1:3\"]\n", "text", "t");
    assert!(unknown.unwrap_err().to_string().contains("s13"));
    assert!(Study::parse("preset = \"fig4\"\n[scan]\naxes = [\"x=0:1:3\"]\n", "text", "t").is_err());
}
