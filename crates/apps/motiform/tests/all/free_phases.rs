//! A mode whose phase nothing fixes changes no answer: the equations have more symmetry than stated, and every motion is one of a family.

use crate::common::Folder;
use serde_json::Value;

/// Velocity and ellipse with these two equations, and a fifth mode of constant size sqrt(.1) with a free phase where there is an
/// equation for it.
fn model(z1: &str, z2: &str, z5: Option<&str>) -> String {
    let modes = if z5.is_some() { "1, 2, 5" } else { "1, 2" };
    let z5 = z5.map(|z5| format!("z5 = \"{z5}\"\n")).unwrap_or_default();
    format!(
        "[model.amplitudes]\nmodes = [{modes}]\n[model.amplitudes.equations]\nz1 = \"{z1}\"\nz2 = \"{z2}\"\n{z5}"
    )
}

fn verdict(folder: &Folder, name: &str, seed: usize) -> Value {
    folder.run(&format!("classify {name} --seed {seed} --json")).expect(0).json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

const FREE: &str = "(0.1 - |z5|^2)*z5";

/// Straight motion, and an ellipse at rest. (A body that goes round a circle turns against a mode that does
/// not: its shape changes then.)
#[test]
fn steady_motions_keep_their_names_and_numbers() {
    let folder = Folder::new();
    for (z1, z2, regime) in [
        ("(0.2 - |z1|^2)*z1 + 2*conj(z1)*z2", "-0.5*z2 - 0.125*z1^2", "straight"),
        ("-(0.2 + |z1|^2)*z1", "(0.1 - |z2|^2)*z2", "motionless"),
    ] {
        folder.write("alone.toml", &model(z1, z2, None));
        folder.write("free.toml", &model(z1, z2, Some(FREE)));
        let alone = verdict(&folder, "alone.toml", 1);
        assert_eq!(alone["regime"], regime, "{alone}");
        for seed in [1, 2, 3] {
            let free = verdict(&folder, "free.toml", seed);
            assert_eq!(
                (&free["regime"], &free["attractor"]),
                (&alone["regime"], &alone["attractor"]),
                "{free}"
            );
            let speed = |verdict: &Value| number(&verdict["speed"]["mean"]);
            assert!((speed(&free) - speed(&alone)).abs() < 1e-9, "{free}");
            let zeros = |verdict: &Value| {
                let all = verdict["exponents"].as_array().expect("exponents").iter();
                all.filter(|one| number(&one["value"]) == 0.0).count()
            };
            assert_eq!(zeros(&free), zeros(&alone) + 1, "{free}");
        }
    }
}

/// The cycle of Fig. 1 between ellipses: `lambda_+- = gamma +- 2 r2`, `r2 = sqrt(-kappa2 / 8)`. Alone, beside the mode, and where the
/// mode's size adds .05 |z5|^2 = .005 to the growth of the ellipse.
#[test]
fn a_heteroclinic_cycle_keeps_its_name_and_its_rates() {
    let z1 = "(-0.04 - |z1|^2)*z1 + 2*conj(z1)*z2";
    let folder = Folder::new();
    for (z2, z5, kappa2) in [
        ("0.1*z2 - 0.125*z1^2 - 8*|z2|^2*z2", None, -0.1),
        ("0.1*z2 - 0.125*z1^2 - 8*|z2|^2*z2", Some(FREE), -0.1),
        ("(0.1 + 0.05*|z5|^2)*z2 - 0.125*z1^2 - 8*|z2|^2*z2", Some(FREE), -0.105),
    ] {
        folder.write("cycle.toml", &model(z1, z2, z5));
        let half = 2.0 * f64::sqrt(-kappa2 / 8.0);
        for seed in [1, 2] {
            let found = verdict(&folder, "cycle.toml", seed);
            assert_eq!(found["regime"], "rectangular", "{found}");
            let saddle = &found["saddle"];
            assert!((number(&saddle["out"]) - (-0.04 + half)).abs() < 1e-6, "{found}");
            assert!((number(&saddle["inward"]) - (-0.04 - half)).abs() < 1e-6, "{found}");
        }
    }
}

/// At a bifurcation an eigenvalue vanishes too, but there is no family: z2 decays like a power of time, and nothing is decided.
#[test]
fn a_bifurcation_is_no_family() {
    let folder = Folder::new();
    folder.write("pitchfork.toml", &model("(0.2 - |z1|^2)*z1", "-|z2|^2*z2", None));
    let found = folder.run("classify pitchfork.toml --budget 3000 --json").expect(1).json();
    assert_eq!(found["regime"], "undetermined", "{found}");
}

/// The orbits around a centre are a family, too, but no two of them do the same: none of them is stable, from any start, and beside any
/// silent mode.
#[test]
fn an_orbit_around_a_centre_is_not_stable() {
    let folder = Folder::new();
    let of = |modes: &str, more: &str| {
        format!(
            "[model.amplitudes]\nmodes = [{modes}]\nsymmetry = \"none\"\nvelocity = \"z2\"\n\
             [model.amplitudes.parameters]\nmu = 1.0\n[model.amplitudes.equations]\nz2 = \"-i*mu*z2\"\n{more}"
        )
    };
    folder.write("centre.toml", &of("2", ""));
    folder.write("silent.toml", &of("2, 3", "z3 = \"-z3\"\n"));
    for file in ["centre.toml", "silent.toml"] {
        for start in [
            "--initial z2_re=0.5 --initial z2_im=0.7",
            "--initial z2_re=0.5",
            "--initial z2_re=2 --initial z2_im=-1",
        ] {
            let found = folder.run(&format!("classify {file} {start} --budget 3000 --json")).expect(1).json();
            assert_eq!(found["regime"], "undetermined", "{file} {start}: {found}");
        }
    }
    let branch =
        folder.run("continue centre.toml --along mu=0.5:1.5 --initial z2_re=0.5 --initial z2_im=0.7");
    assert!(branch.expect(2).stderr.contains("undetermined"), "no branch along a parameter");
}

/// A decoupled variable of size 1 does not change the verdict on a circle of another size.
#[test]
fn a_silent_variable_of_another_size_sets_no_bounds() {
    let folder = Folder::new();
    for size in [1e4_f64, 1e6, 1e8, 1e10] {
        let model = format!(
            "[model.amplitudes]\nmodes = [2, 3]\nsymmetry = \"none\"\nvelocity = \"z2\"\n[model.amplitudes.parameters]\nk = {:e}\n\
             [model.amplitudes.equations]\nz2 = \"(1 + i - k*|z2|^2)*z2\"\nz3 = \"re(z3) - re(z3)^3 - i*im(z3)\"\n",
            1.0 / (size * size)
        );
        folder.write("silent.toml", &model);
        let found = verdict(&folder, "silent.toml", 1);
        assert_eq!(found["regime"], "circular", "{size:e}: {found}");
    }
}
