//! Statements of `motiform continue` about its special points: errors that hold, and the kind of connection at an end.

use crate::common::{Folder, read_json};
use serde_json::Value;

fn follow(folder: &Folder, arguments: &str) -> Value {
    folder.run(&format!("continue {arguments} --json")).expect(0).json()
}

fn entries(json: &Value) -> Vec<&Value> {
    let branches = json["branches"].as_array().expect("branches");
    branches.iter().flat_map(|branch| branch["special"].as_array().expect("a list")).collect()
}

/// The special points of this kind nearest to an exact value are within their stated errors.
fn holds(all: &[&Value], along: &str, kind: &str, exact: f64) {
    let off = |entry: &Value| (entry[along].as_f64().expect("a number") - exact).abs();
    let near: Vec<&&Value> = all.iter().filter(|one| one["kind"] == kind && off(one) < 1e-4).collect();
    assert!(!near.is_empty(), "no {kind} near {exact}");
    for entry in near {
        let error = entry["error"].as_f64().expect("an error");
        assert!(off(entry) <= error && error < 1e-6, "{kind} at {exact}: {entry}");
        assert!(entry["transversality"].as_f64().expect("a derivative").abs() > 1e-3, "{entry}");
    }
}

/// Along kappa2 = -.06 circular motion oscillates from gamma = .024 on, and straight motion begins at 0; the cell's circle is deformed
/// by its second mode from length 4 pi on.
#[test]
fn errors_of_special_points_cover_exact_values() {
    let folder = Folder::new();
    let reduced =
        follow(&folder, "tensor --preset fig1 --set kappa2=-.06 --set gamma=0.05 --along gamma=-.1:.1");
    holds(&entries(&reduced), "gamma", "hopf", 0.024);
    holds(&entries(&reduced), "gamma", "pitchfork", 0.0);
    let cell =
        follow(&folder, "cell --set length=12.6 --motion circular --along length=12.2:12.9 --branches 3");
    holds(&entries(&cell), "length", "pitchfork", 4.0 * std::f64::consts::PI);
}

/// Towards a connection the parameter converges to within round-off, and long steps leave few points to fit: no folds may be seen in the
/// noise, and the connection must be.
#[test]
fn the_list_of_the_zigzag_does_not_depend_on_steps_and_tolerance() {
    let folder = Folder::new();
    let list = |options: &str| -> Vec<(String, f64, f64)> {
        let run = "tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.95 --motion zigzag --along kappa2=0.5:1.5 --branches 1";
        let json = follow(&folder, &format!("{run} {options}"));
        let number = |value: &Value| value.as_f64().expect("a number");
        let one = |entry: &&Value| {
            (
                entry["kind"].as_str().expect("a name").to_owned(),
                number(&entry["kappa2"]),
                number(&entry["error"]),
            )
        };
        entries(&json).iter().map(one).collect()
    };
    let first = list("");
    let kinds: Vec<&str> = first.iter().map(|one| one.0.as_str()).collect();
    assert_eq!(kinds, ["symmetry-breaking", "symmetry-breaking", "homoclinic"]);
    for options in ["--branch-step 0.05", "--branch-step 0.1", "--tolerance 1e-11", "--seed 5"] {
        let other = list(options);
        assert_eq!(other.len(), first.len(), "{options}: {other:?}");
        for (a, b) in first.iter().zip(&other) {
            assert!(a.0 == b.0 && (a.1 - b.1).abs() <= a.2 + b.2, "{options}: {a:?} {b:?}");
        }
    }
}

/// Beside a connection orbits are so sensitive that the doubling at 1.162139 was subcritical from one start and supercritical from
/// another. What begins there is stable up to 1.16355.
#[test]
fn coefficients_do_not_depend_on_the_start_and_the_tolerance() {
    let folder = Folder::new();
    let run = "tensor --preset fig5a --along kappa2=0.9:1.2 --branches 2";
    let coefficients = |options: &str| -> Vec<(f64, f64)> {
        let json = follow(&folder, &format!("{run} {options}"));
        let all = entries(&json);
        let cubic = all.iter().filter(|entry| entry["normal_form"] == "cubic");
        let of = |entry: &&Value| {
            assert_eq!(entry["criticality"], "supercritical", "{options}: {entry}");
            ["coefficient", "coefficient_error"].map(|key| entry[key].as_f64().expect("a number")).into()
        };
        cubic.map(of).collect()
    };
    let first = coefficients("");
    assert_eq!(first.len(), 2, "a symmetry breaking and a doubling: {first:?}");
    for options in ["--set kappa2=1.12", "--tolerance 1e-10", "--branch-step 0.05"] {
        let other = coefficients(options);
        assert_eq!(other.len(), first.len(), "{options}");
        for (a, b) in first.iter().zip(&other) {
            assert!((a.0 - b.0).abs() <= a.1 + b.1, "{options}: {a:?} {b:?}");
        }
    }
}

/// Straight motion of two modes, `z2 = z1^2` at k = 1/2, begins to turn at g = 1/2. Its circles have `4 omega^2 = g - 1/2` and the
/// deviation `xi^2 = omega^2/2` normal to the group, and straight motion grows at the rate `g - 1/2`: the coefficient is -8, from
/// straight motion and from circles. (A part of the critical vector along the group, which depends on the start, was in its norm.)
#[test]
fn the_coefficient_of_a_drift_pitchfork_does_not_depend_on_the_branch() {
    let folder = Folder::new();
    folder.write(
        "two.toml",
        "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\ng = 1.0\nk = 0.5\n[model.amplitudes.equations]\n\
         z1 = \"(g - |z1|^2)*z1 - conj(z1)*z2\"\nz2 = \"-k*z2 + 0.5*z1^2\"\n",
    );
    for start in ["--set g=1 --motion circular", "--set g=0.3 --motion straight"] {
        let json = follow(&folder, &format!("two.toml {start} --along g=-.5:3"));
        let all = entries(&json);
        let there = |entry: &&&Value| (entry["g"].as_f64().expect("a number") - 0.5).abs() < 1e-6;
        let found: Vec<&&Value> = all.iter().filter(there).collect();
        assert!(!found.is_empty(), "{start}: {all:?}");
        for entry in found {
            let [value, error] =
                ["coefficient", "coefficient_error"].map(|key| entry[key].as_f64().expect("a number"));
            assert!((value + 8.0).abs() <= error.max(1e-9) && error < 1e-4, "{start}: {entry}");
        }
    }
}

/// A motionless ellipse starts to move where its critical rate is 0 to the last bit. It is found from the straight motion that ends
/// there: the point is on both branches, from every start.
#[test]
fn a_point_where_a_branch_was_found_is_on_it() {
    let folder = Folder::new();
    folder.write(
        "three.toml",
        "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\ng = 1.0\nk = 0.5\nb = 0.5\nc = 0.4\n\
         [model.amplitudes.equations]\nz1 = \"(g - |z1|^2)*z1 + conj(z1)*z2\"\n\
         z2 = \"(k-|z2|^2)*z2 - b*z1^2 - c*|z1|^2*z2\"\n",
    );
    for start in ["--set k=0.5", "--set k=2 --seed 3"] {
        let json = follow(&folder, &format!("three.toml {start} --along k=-1:3"));
        let with = |motion: &str| {
            let branches = json["branches"].as_array().expect("branches");
            let of = branches.iter().filter(|branch| branch["motion"] == motion);
            let special = of.flat_map(|branch| branch["special"].as_array().expect("a list"));
            let there = |entry: &&Value| (entry["k"].as_f64().expect("a number") - 1.0).abs() < 1e-6;
            special.filter(there).map(|entry| entry["kind"].clone()).collect::<Vec<_>>()
        };
        for motion in ["straight", "motionless"] {
            assert_eq!(with(motion), ["pitchfork"], "{start}: {motion}");
        }
    }
}

/// Motions that begin at the special points of the zigzag and of circular motion: by the coefficient of the normal form, as published;
/// and the saddle that the zigzag ends at.
#[test]
fn coefficients_and_saddles_are_stated_with_their_errors() {
    let folder = Folder::new();
    let json = follow(
        &folder,
        "tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.95 --motion zigzag --along kappa2=0.5:1.5 --branches 4",
    );
    let all = entries(&json);
    let number = |entry: &Value, key: &str| entry[key].as_f64().unwrap_or_else(|| panic!("{key} of {entry}"));
    for (kind, name, word, sign) in
        [("symmetry-breaking", "cubic", "supercritical", -1.0), ("hopf", "l1", "subcritical", 1.0)]
    {
        let found: Vec<&&Value> = all.iter().filter(|entry| entry["kind"] == kind).collect();
        assert!(!found.is_empty(), "{kind}");
        for entry in found {
            assert_eq!(
                (&entry["normal_form"], &entry["criticality"]),
                (&name.into(), &word.into()),
                "{entry}"
            );
            let value = number(entry, "coefficient");
            assert!(sign * value > 0.0 && number(entry, "coefficient_error") < 0.01 * value.abs(), "{entry}");
        }
    }
    let end = all.iter().find(|entry| entry["kind"] == "homoclinic").expect("the end of the zigzag");
    assert_eq!((&end["connection"], &end["law"]), (&"saddle".into(), &"logarithmic".into()));
    let real = |key: &str| end[key][0].as_f64().expect("a rate");
    let (grows, decays) = (real("leading_growing"), real("leading_decaying"));
    assert!(grows > 0.0 && decays < 0.0);
    assert!((number(end, "saddle_quantity") - grows - decays).abs() < 1e-12, "{end}");
    let slower = grows.min(-decays);
    assert!((number(end, "rate") / slower - 1.0).abs() < 0.01, "{end}");
    let eigenvalues = end["saddle"]["eigenvalues"].as_array().expect("eigenvalues");
    assert!([grows, decays].iter().all(|rate| eigenvalues.iter().any(|value| value[0] == *rate)), "{end}");
}

/// In x' = x(1-r^2) - y(mu-x), y' = y(1-r^2) + x(mu-x) two equilibria appear on the circle at mu = 1, where x = 1 stops turning: the
/// period is 2 pi / sqrt(mu^2 - 1).
#[test]
fn a_saddle_node_on_a_circle_is_named_where_it_is() {
    let folder = Folder::new();
    let x = "((z1+conj(z1))/2)";
    folder.write(
        "circle.toml",
        &format!(
            "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nmu = 1.3\n\
             [model.amplitudes.equations]\nz1 = \"z1*(1-z1*conj(z1)) + i*z1*(mu-{x})\"\n"
        ),
    );
    let json = follow(&folder, "circle.toml --along mu=0.5:2");
    let found = entries(&json);
    let [only] = &found[..] else { panic!("{found:?}") };
    assert_eq!((&only["kind"], &only["connection"]), (&"homoclinic".into(), &"saddle-node".into()));
    let (value, error) = (only["mu"].as_f64().unwrap(), only["error"].as_f64().unwrap());
    assert!((value - 1.0).abs() <= error && error < 1e-5, "{only}");
    let branch = &json["branches"][0];
    assert!(branch["ends"].to_string().contains("saddle-node on a circle"), "{}", branch["ends"]);
    let amplitude = std::f64::consts::TAU / 2.0_f64.sqrt();
    assert!(branch["ends"].to_string().contains(&format!("{amplitude:.2}")), "{}", branch["ends"]);
    assert!((branch["stable"][0][0].as_f64().unwrap() - 1.0).abs() <= error, "stable up to the end");
}

/// At the Hopf bifurcation of the cell's circular motion an unstable periodic modulation begins. Close to it the normal form predicts
/// the growth rate of deviations from the modulated motion: -2 times that of deviations from circular motion. Multipliers are compared
/// with eigenvalues.
#[test]
fn orbits_of_the_cell_grow_as_the_normal_form_says() {
    let folder = Folder::new();
    let arguments = "continue cell --set length=12.955 --motion circular --along length=12.955:12.98 --points 12 \
     --branch-step 0.2 --no-figures --out here";
    folder.run(arguments).expect(0);
    let json = read_json(&folder.path("here/branches.json"));
    let samples = |branch: usize| -> Vec<Value> {
        let legs = json["branches"][branch]["legs"].as_array().expect("legs");
        legs.iter()
            .flat_map(|leg| leg["samples"].as_array().expect("samples").clone())
            .map(|one| one["point"].clone())
            .collect()
    };
    let pair = |point: &Value| {
        let all = point["motion"]["Equilibrium"]["eigenvalues"].as_array().expect("eigenvalues").clone();
        let oscillating = all.iter().filter(|value| value[1].as_f64().unwrap().abs() > 0.1);
        let growth = oscillating.map(|value| value[0].as_f64().unwrap()).fold(f64::NEG_INFINITY, f64::max);
        (point["parameter"].as_f64().unwrap(), growth)
    };
    let circular: Vec<(f64, f64)> = samples(0).iter().map(pair).collect();
    let hopf =
        samples(0).iter().find(|point| point["special"].is_object()).map(pair).expect("a Hopf point").0;
    let near = circular.iter().filter(|one| one.0 < hopf - 1e-4).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let slope = near.1 / (near.0 - hopf);
    for point in &samples(1)[..4] {
        let orbit = &point["motion"]["Orbit"]["orbit"];
        let first = &orbit["multipliers"][0];
        let modulus = first[0].as_f64().unwrap().hypot(first[1].as_f64().unwrap());
        let growth = modulus.ln() / orbit["time"].as_f64().unwrap();
        let expected = -2.0 * slope * (point["parameter"].as_f64().unwrap() - hopf);
        assert!((growth / expected - 1.0).abs() < 0.03, "{growth:e} {expected:e}");
        assert_eq!(point["unstable"], 1);
    }
}
