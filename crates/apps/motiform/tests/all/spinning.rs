//! A body that turns in its place has a name of its own, in every command and list.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Folder;

/// The ellipse grows and turns: `z2 = sqrt(0.3) exp(0.7 i t)`, a turning rate of -0.7 / 2 (the angle of an ellipse is half that of z2,
/// and `z_n` is multiplied by `exp(-i n a)` when the body turns by a). The velocity decays: d v/dt = (-0.4 + 0.3 sqrt(0.3)) v at the
/// most.
const SPINNING: &str = r#"
[model.amplitudes]
modes = [1, 2]
[model.amplitudes.parameters]
omega = 0.7
[model.amplitudes.equations]
z1 = "-0.4*z1 - |z1|^2*z1 + 0.3*conj(z1)*z2"
z2 = "(0.3 + i*omega - |z2|^2)*z2"
[run]
t_end = 40.0
transient = 200.0
"#;

#[test]
fn spinning_is_the_name_in_every_command() {
    let folder = Folder::new();
    folder.write("spin.toml", SPINNING);
    for seed in [1, 2, 7] {
        let json = folder.run(&format!("classify spin.toml --seed {seed} --json")).expect(0).json();
        assert_eq!(json["regime"], "spinning", "{json}");
        assert!((json["turning_rate"].as_f64().unwrap() + 0.35).abs() < 1e-9, "{json}");
        assert_eq!(json["speed"]["max"], 0.0, "{json}");
    }
    let listed = folder.run("equilibria spin.toml --json").expect(0).json();
    let motions: Vec<&str> =
        listed["equilibria"].as_array().unwrap().iter().map(|one| one["motion"].as_str().unwrap()).collect();
    assert!(motions.contains(&"spinning") && !motions.contains(&"circular"), "{listed}");
    let run = folder.run("simulate spin.toml --out run").expect(0);
    assert!(run.stdout.contains("at the end spinning"), "{}", run.stdout);
    let words = "continue spin.toml --motion spinning --along omega=0.5:0.9 --points 5 --branches 1 --json";
    let branch = folder.run(words).expect(0).json();
    assert_eq!(branch["branches"][0]["motion"], "spinning", "{branch}");
    let scan = "scan spin.toml --axis omega=0.5:0.9:3 --out map --json";
    let scan = folder.run(scan).expect(0).json().to_string();
    assert!(scan.contains("\"spinning\":3"), "{scan}");
}
