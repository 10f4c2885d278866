//! Equations whose symmetry is not stated have the same motions: `symmetry = "none"` and a start of exact symmetry change what is
//! looked for, and no name.

#![allow(clippy::panic, reason = "a test may fail")]

use crate::common::Folder;
use serde_json::Value;

/// The reduced model (a1 = 1, b1 = .5, b3 = 1) at (kappa2, gamma), with a stated symmetry.
fn reduced(kappa2: f64, gamma: f64, symmetry: &str) -> String {
    format!(
        "[model.amplitudes]\nmodes = [1, 2]\nsymmetry = \"{symmetry}\"\n[model.amplitudes.equations]\n\
         z1 = \"({gamma} - |z1|^2)*z1 - 2*conj(z1)*z2\"\nz2 = \"({} - 8*|z2|^2)*z2 + 0.125*z1^2\"\n",
        -kappa2
    )
}

fn number(json: &Value, path: &str) -> f64 {
    json.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} of {json}"))
}

/// Pulsating straight motion has period 228.156 at (-.02, -.044) and speeds from .00793 to .1001 (another program); its exponents are
/// the same, with a zero for the heading, that of the rotations or of the family.
#[test]
fn pulsating_straight_motion_keeps_its_name() {
    let folder = Folder::new();
    for symmetry in ["rotation+mirror", "rotation", "none"] {
        folder.write("model.toml", &reduced(-0.02, -0.044, symmetry));
        for seed in [1, 2, 3] {
            let found = folder.run(&format!("classify model.toml --seed {seed} --json")).expect(0).json();
            let names = (&found["regime"], &found["form"]);
            assert_eq!(names, (&"pulsating-straight".into(), &"pulsating-straight".into()), "{found}");
            assert!(number(&found, "/margin") > 3.0, "{found}");
            assert!((number(&found, "/period") - 228.156).abs() < 0.01, "{found}");
            assert!((number(&found, "/speed/max") - 0.1001).abs() < 1e-4, "{found}");
            assert_eq!(number(&found, "/turning_rate"), 0.0, "{found}");
            let zeros = found["exponents"].as_array().expect("a list").iter();
            assert_eq!(zeros.filter(|one| number(one, "/value") == 0.0).count(), 2, "{found}");
        }
        let run = folder.run("simulate model.toml --transient 20000 --t-end 500 --out run --force").expect(0);
        assert!(run.stdout.contains("pulsating straight"), "{}", run.stdout);
    }
}

/// Straight motion and rest, in every command: one entry of the list, one name, and as many exponents that must be zero as there are.
#[test]
fn steady_motions_keep_their_names_and_their_neutral_directions() {
    let folder = Folder::new();
    for (kappa2, gamma, regime, neutral) in
        [(0.18, 0.1, "straight", 1), (-0.2, -0.4, "motionless", 1), (0.1, -0.05, "motionless", 0)]
    {
        for symmetry in ["rotation+mirror", "none"] {
            folder.write("model.toml", &reduced(kappa2, gamma, symmetry));
            let found = folder.run("classify model.toml --json").expect(0).json();
            assert_eq!(found["regime"], regime, "{symmetry}: {found}");
            let words = "lyapunov model.toml --count 4 --transient 500 --t-end 1000 --json";
            let run = folder.run(words).expect(0).json();
            assert_eq!(run["neutral"], neutral, "{symmetry}: {run}");
            let list = folder.run("equilibria model.toml --json").expect(0).json();
            let stable: Vec<&Value> = list["equilibria"]
                .as_array()
                .expect("a list")
                .iter()
                .filter(|one| one["unstable"] == 0)
                .collect();
            assert_eq!(stable.len(), 1, "{symmetry}: {list}");
            assert_eq!(stable[0]["motion"], regime, "{symmetry}: {list}");
            let family = if symmetry == "none" { neutral } else { 0 };
            assert_eq!(stable[0]["family"].as_u64().unwrap_or(0), family, "{symmetry}: {list}");
        }
    }
}

/// A start of exact symmetry stays on an unstable motion, also on the circle, which it comes to as close as numbers go: `simulate` and
/// `lyapunov` say so.
#[test]
fn runs_that_stay_on_an_unstable_motion_say_so() {
    let folder = Folder::new();
    for (start, motion) in [
        ("--initial u111=0.1", "motionless"),
        ("--initial s11=0.1", "motionless"),
        ("--initial v1=0.1 --set kappa2=0.02 --set gamma=0.05", "straight"),
    ] {
        let words = format!(
            "tensor --preset fig1 --set kappa2=-0.1 --set gamma=-0.04 --initial v1=0 --initial v2=0 --initial s11=0 --initial s12=0 \
             --initial u111=0 --initial u222=0 {start}"
        );
        let run = folder.run(&format!("simulate {words} --transient 500 --out run --force")).expect(0);
        assert!(run.stderr.contains(&format!("ends on {motion} motion that is unstable")), "{}", run.stderr);
        let run = folder.run(&format!("lyapunov {words} --count 1 --transient 500 --t-end 500")).expect(0);
        assert!(run.stdout.contains(&format!("stays on {motion} motion")), "{}", run.stdout);
    }
}
