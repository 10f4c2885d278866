//! Commands with equations given as text instead of a model's name.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::Folder;

/// A handed body whose rotations a field breaks: `z1` grows at `gamma +- sqrt(epsilon^2 - omega^2)`.
const BROKEN: &str = r#"
[model.amplitudes]
modes = [1]
symmetry = "none"
[model.amplitudes.parameters]
gamma = -0.5
omega = 1.0
epsilon = 0.6
[model.amplitudes.equations]
z1 = "(gamma + i*omega - |z1|^2)*z1 + epsilon*conj(z1)"
"#;

/// Rest ends at gamma = 0 in a Hopf bifurcation of period `2 pi/sqrt(omega^2 - epsilon^2)`; what begins circles.
#[test]
fn a_hopf_bifurcation_with_broken_rotations_is_where_it_is_known_to_be() {
    let folder = Folder::new();
    folder.write("my.toml", BROKEN);
    let json = folder.run("continue my.toml --along gamma=-.5:1 --json").expect(0).json();
    let hopf = &json["branches"][0]["special"][0];
    assert_eq!((hopf["kind"].as_str(), hopf["criticality"].as_str()), (Some("hopf"), Some("supercritical")));
    assert!(hopf["gamma"].as_f64().unwrap().abs() < 1e-12, "{hopf}");
    assert!((hopf["period"].as_f64().unwrap() - std::f64::consts::TAU / 0.8).abs() < 1e-9, "{hopf}");
    let born = &json["branches"][1];
    assert_eq!(
        (born["motion"].as_str(), born["form"].as_str()),
        (Some("circular"), Some("drifting-circular"))
    );
}

/// With `epsilon > omega` rest ends in a pitchfork at `gamma = -sqrt(epsilon^2 - omega^2)`: the field locks the heading.
#[test]
fn a_strong_field_locks_the_heading() {
    let folder = Folder::new();
    folder.write("my.toml", BROKEN);
    let words =
        "continue my.toml --set gamma=-1.5 --set epsilon=1.25 --along gamma=-1.5:0 --branches 1 --json";
    let json = folder.run(words).expect(0).json();
    let onset = &json["branches"][0]["special"][0];
    assert!((onset["gamma"].as_f64().unwrap() + 0.75).abs() < 1e-9, "{onset}");
}

/// Velocities of an Ornstein-Uhlenbeck process, whose equations have no size of their own: `sqrt(2) s/sqrt(2 k)` is their root mean square
/// in any unit.
#[test]
fn linear_equations_under_noise_have_the_size_that_noise_gives_them() {
    let folder = Folder::new();
    for unit in [1e-6, 1.0, 1e7] {
        let text = format!(
            "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.parameters]\nk = 0.5\ns = 1\n\n\
             [model.amplitudes.equations]\nz1 = \"-k*z1\"\n[model.amplitudes.noise]\nz1 = \"{unit:e}*s\"\n"
        );
        folder.write("walk.toml", &text);
        let words = "statistics walk.toml --bodies 16 --t-end 400 --transient 20 --dt-out 0.2 --json";
        let json = folder.run(words).expect(0).json();
        let [low, high] = ["lower", "upper"].map(|end| json["rms_speed"][end].as_f64().unwrap() / unit);
        let exact = std::f64::consts::SQRT_2;
        assert!(low - 0.05 < exact && exact < high + 0.05 && high - low < 0.3, "{unit}: {low} to {high}");
    }
}

/// An analysis of the equations without their noise says so.
#[test]
fn noise_that_is_left_out_is_said() {
    let folder = Folder::new();
    folder.write("my.toml", &format!("{BROKEN}[model.amplitudes.noise]\nz1 = \"epsilon\"\n"));
    let done = folder.run("classify my.toml").expect(0);
    assert!(done.stderr.contains("the noise of the equations is left out"), "{}", done.stderr);
    folder.write("quiet.toml", BROKEN);
    assert_eq!(folder.run("classify quiet.toml").expect(0).stderr, "");
}

#[test]
fn a_parameter_cannot_have_the_name_of_a_column() {
    let folder = Folder::new();
    folder.write("my.toml", &BROKEN.replace("epsilon", "speed_mean"));
    let done = folder.run("classify my.toml").expect_error(2);
    assert!(
        done.stderr.contains("my.toml:8:1") && done.stderr.contains("column of result tables"),
        "{}",
        done.stderr
    );
}

/// A cycle between three saddles (Guckenheimer and Holmes 1988, rests that double) beside a variable that decays: soon the way out of a
/// saddle is too small for a number, in every unit of time. That is neither rest nor a start of exact symmetry.
#[test]
fn a_cycle_whose_coordinates_vanish_is_not_at_rest() {
    let folder = Folder::new();
    let [x, y, z] =
        ["(z1+conj(z1))/2", "(-i/2)*(z1-conj(z1))", "(z2+conj(z2))/2"].map(|text| format!("({text})"));
    let rate = |u: &str, v: &str, w: &str| format!("{u}*(1-{u}^2-b*{v}^2-c*{w}^2)");
    for per_time in [1, 10] {
        let text = format!(
            "[model.amplitudes]\nmodes = [1, 2]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nb = 0.5\nc = 2.0\n\
             [model.amplitudes.equations]\n\
             z1 = \"{per_time}*({}) + {per_time}*i*({})\"\nz2 = \"{per_time}*({}) - {per_time}*i*(-i/2)*(z2-conj(z2))\"\n",
            rate(&x, &y, &z),
            rate(&y, &z, &x),
            rate(&z, &x, &y)
        );
        folder.write("cycle.toml", &text);
        for seed in 1..=3 {
            let found = folder.run(&format!("classify cycle.toml --random 1 --seed {seed} --json")).json();
            let name = found["regime"].as_str().unwrap().to_owned();
            assert!(["undetermined", "rectangular"].contains(&name.as_str()), "{per_time} {seed}: {found}");
        }
    }
}

/// A field `e` along x draws the heading along it where e > 0, and across it where e < 0: half of a symmetric range each.
const FIELD: &str = r#"
[model.amplitudes]
modes = [1]
symmetry = "mirror"
[model.amplitudes.parameters]
gamma = 1.0
e = { value = 0.1, range = [-0.5, 0.5] }
g = { value = 1.0, range = [0.1, 2.0] }
[model.amplitudes.equations]
z1 = "(gamma - g*|z1|^2)*z1 + e*conj(z1)"
"#;

#[test]
fn scans_and_maps_tell_what_goes_along_a_field_and_across() {
    let folder = Folder::new();
    folder.write("field.toml", FIELD);
    let axes = "field.toml --axis e=-0.5:0.5:6 --axis g=0.5:1.5:4 --samples 2 --seed 1";
    let json = folder.run(&format!("scan {axes} --out scan --json")).expect(0).json();
    let both = serde_json::json!({ "straight": { "along-field": 24, "across-field": 24 } });
    assert_eq!((&json["courses"], &json["regimes"]["straight"]), (&both, &48.into()));
    let map = folder.run(&format!("atlas {axes} --out map")).expect(0).stdout;
    assert!(
        map.contains("Motion 'straight' goes along the field in") && map.contains("across the field in"),
        "{map}"
    );
    let handless =
        folder.run("scan tensor --preset fig5a --axis kappa2=0.9:1:2 --out plain --json").expect(0).json();
    assert!(handless["courses"].is_null(), "a model with all symmetries has no courses: {handless}");
}

/// The oscillator of van der Pol in units of any size: the same name and period, and no blow-up.
#[test]
fn sizes_far_from_one_change_no_name() {
    let folder = Folder::new();
    for size in [1.0, 1e-7, 1e7] {
        let text = format!(
            "[model.amplitudes]\nmodes = [2]\nsymmetry = \"none\"\nvelocity = \"z2\"\n\
             [model.amplitudes.parameters]\nmu = 1.0\n\
             [model.amplitudes.equations]\nz2 = \"(mu/2 - i)*z2 - mu/2*conj(z2) - mu/8*(z2 + conj(z2))^2*(z2 - conj(z2))/{}\"\n",
            size * size
        );
        folder.write("vdp.toml", &text);
        let start = format!("--initial z2_re={:e} --initial z2_im={:e}", 0.5 * size, 0.7 * size);
        let found = folder.run(&format!("classify vdp.toml {start} --json")).expect(0).json();
        let period = found["period"].as_f64().unwrap_or(0.0);
        assert!((period - 6.663_286_859).abs() < 1e-5, "{size}: {found}");
    }
}

/// Lorenz's equations in real parts of z2 and z3, and a coordinate that decays beside them, slowly or fast: the dimension of the attractor
/// is the same (Sprott 2003, app. A: 2.0621).
#[test]
fn a_coordinate_that_decays_beside_chaos_is_no_dimension_of_it() {
    let folder = Folder::new();
    for rate in [1.0, 20.0] {
        // z2 = x + iy, z3 = z + iw
        let text = format!(
            "[model.amplitudes]\nmodes = [2, 3]\nsymmetry = \"none\"\nvelocity = \"z2\"\n\
             [model.amplitudes.parameters]\nk = {rate}\n\
             [model.amplitudes.equations]\n\
             z2 = \"5*(z2 - conj(z2))*(-i) - 5*(z2 + conj(z2)) \
             + i*(14*(z2 + conj(z2)) - (z2 + conj(z2))*(z3 + conj(z3))/4) - (z2 - conj(z2))/2\"\n\
             z3 = \"-i*(z2 + conj(z2))*(z2 - conj(z2))/4 - 4/3*(z3 + conj(z3)) - k/2*(z3 - conj(z3))\"\n"
        );
        folder.write("lorenz.toml", &text);
        let start = "--initial z2_re=1 --initial z2_im=1 --initial z3_re=20 --transient 50 --t-end 1500";
        let found = folder.run(&format!("lyapunov lorenz.toml {start} --json")).expect(0).json();
        let dimension = &found["dimension"];
        let (value, error) = (dimension["value"].as_f64().unwrap(), dimension["error"].as_f64().unwrap());
        assert!((value - 2.0621).abs() <= error + 1e-3 && error < 3e-3, "{rate}: {found}");
    }
}
