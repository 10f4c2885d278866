//! `motiform continue` lists the same special points whatever range or start they are found from, and invents none.

use crate::common::{Folder, keys};
use serde_json::Value;

/// A special point: its kind, the value of the parameter, and its error where it is extrapolated.
type Found = (String, f64, f64);

/// Runs `motiform continue`, and returns what it says.
fn follow(folder: &Folder, arguments: &str) -> Value {
    folder.run(&format!("continue {arguments} --json")).expect(0).json()
}

/// The special points of all branches, each once: a branch may meet another one at its end. No parameter can have the name of another
/// number.
fn special(json: &Value, along: &str) -> Vec<Found> {
    let branches = json["branches"].as_array().expect("branches");
    let entries = branches.iter().flat_map(|branch| branch["special"].as_array().expect("a list"));
    let mut all: Vec<Found> = entries
        .map(|entry| {
            let value = entry[along].as_f64().expect("a number");
            for key in keys(entry).into_iter().filter(|key| *key != along) {
                assert!(motiform_models::amplitudes::reserved(key).is_some(), "{key} can be a parameter");
            }
            (
                entry["kind"].as_str().expect("a name").to_owned(),
                value,
                entry["error"].as_f64().unwrap_or(0.0),
            )
        })
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all.dedup_by(|a, b| a.0 == b.0 && (a.1 - b.1).abs() < 1e-7);
    all
}

fn same(a: &[Found], b: &[Found], error: f64) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < error)
}

fn expected(list: &[(&str, f64)]) -> Vec<Found> {
    list.iter().map(|(kind, value)| ((*kind).to_owned(), *value, 0.0)).collect()
}

/// A system of two real equations as a model text: x and y are the parts of one amplitude.
fn planar(folder: &Folder, name: &str, parameters: &str, [x, y]: [&str; 2]) {
    let real = |text: &str| text.replace('x', "((z1+conj(z1))/2)").replace('y', "((z1-conj(z1))*(-i/2))");
    let text = format!(
        "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\n{parameters}\n\
         [model.amplitudes.equations]\nz1 = \"{} + i*({})\"\n",
        real(x),
        real(y)
    );
    folder.write(name, &text);
}

/// Circular motion of the cell begins at a drift pitchfork of straight motion and oscillates from 12.973310 on: with 42 unknowns the
/// neutral direction has parts below round-off.
#[test]
fn the_branches_of_the_cell_have_no_false_points() {
    let folder = Folder::new();
    let quiet =
        follow(&folder, "cell --set length=12.6 --motion circular --along length=12.5:12.7 --branches 1");
    assert_eq!(special(&quiet, "length"), []);
    assert_eq!(quiet["branches"][0]["stable"], serde_json::json!([[12.5, 12.7]]));
    let circular =
        follow(&folder, "cell --set length=12.6 --motion circular --along length=12:13.5 --branches 1");
    let list = expected(&[("hopf", 12.973_310), ("pitchfork", 12.278_498)]);
    assert!(same(&special(&circular, "length"), &list, 1e-6), "{circular}");
    let straight =
        follow(&folder, "cell --set length=9 --motion straight --along length=6:12.5 --branches 3");
    let list = expected(&[("pitchfork", std::f64::consts::TAU), ("pitchfork", 12.278_498)]);
    let first = serde_json::json!({ "branches": [straight["branches"][0]] });
    let found = special(&first, "length");
    assert!(same(&found, &list, 1e-6), "{straight}");
    let motions: Vec<&Value> =
        straight["branches"].as_array().expect("branches").iter().map(|branch| &branch["motion"]).collect();
    assert_eq!(motions, ["straight", "motionless", "circular"]);
}

/// Circular motion meets straight motion at a pitchfork, seen from either of them and over any range.
#[test]
fn the_reduced_model_has_one_list_from_all_starts_and_ranges() {
    let folder = Folder::new();
    let from = |gamma: f64, along: &str| {
        let plan = format!(
            "tensor --preset fig1 --set kappa2=-0.06 --set gamma={gamma} --along gamma={along} --branches 9"
        );
        special(&follow(&folder, &plan), "gamma")
    };
    let base = from(0.05, "-0.1:0.11");
    let names: Vec<&str> = base.iter().map(|found| found.0.as_str()).collect();
    assert_eq!(names, ["heteroclinic", "homoclinic", "hopf", "hopf", "pitchfork", "pitchfork"], "{base:?}");
    for (gamma, along) in [(0.05, "-0.1:0.12"), (0.05, "-0.1:0.1"), (-0.08, "-0.1:0.11"), (0.1, "-0.11:0.11")]
    {
        let other = from(gamma, along);
        let agrees = base.len() == other.len()
            && base.iter().zip(&other).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-8 + a.2 + b.2);
        assert!(agrees, "from {gamma} over {along}: {other:?}, not {base:?}");
    }
    // the torus ends where growth and decay at the ellipses are equal: gamma = 0
    let resonant =
        base.iter().find(|found| found.0 == "homoclinic" && found.1.abs() < 1e-3).expect("a resonance");
    assert!(resonant.1.abs() < resonant.2 && resonant.2 < 1e-3, "{resonant:?}");
}

/// Along kappa2 = -.06 pulsating straight motion ends in a cycle of the circle, whose second mode grows with -kappa2 and whose first
/// decays with gamma, and the ellipse at rest, whose second mode decays with 2 kappa2: each is joined to the other one within the
/// shapes with a mirror axis.
#[test]
fn pulsating_straight_motion_of_the_reduced_model_ends_in_a_cycle_of_circle_and_ellipse() {
    let folder = Folder::new();
    let plan =
        "tensor --preset fig1 --set kappa2=-0.06 --set gamma=-0.08 --along gamma=-0.1:-0.03 --branches 5";
    let json = follow(&folder, plan);
    let branches = json["branches"].as_array().expect("branches");
    let branch = branches.iter().find(|branch| branch["motion"] == "pulsating-straight").expect("it begins");
    let end = branch["special"].as_array().and_then(|all| all.last()).expect("an end");
    assert_eq!((&end["kind"], &end["joins"]), (&"heteroclinic".into(), &"different".into()), "{end}");
    let number = |value: &Value| value.as_f64().expect("a number");
    let mut sides: Vec<[f64; 2]> = end["saddles"]
        .as_array()
        .expect("saddles")
        .iter()
        .map(|one| ["leading_growing", "leading_decaying"].map(|key| number(&one[key][0])))
        .collect();
    sides.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let [circle, ellipse] = sides[..] else { panic!("two saddles: {end}") };
    let gamma = number(&end["gamma"]);
    assert!((circle[0] - 0.06).abs() < 1e-9 && (circle[1] - gamma).abs() < 2e-7, "{circle:?} {gamma}");
    assert!((ellipse[1] + 0.12).abs() < 1e-9 && ellipse[0] > 0.0, "{ellipse:?}");
    let product = circle[1] / circle[0] * ellipse[1] / ellipse[0];
    assert!((number(&end["attraction"]) - product).abs() < 1e-9, "{end}");
}

/// A rotating zigzag ends where a zigzag begins, and one of twice the period where the former begins: neither is a fold.
#[test]
fn orbits_that_gain_a_symmetry_meet_the_orbit_that_has_it() {
    let folder = Folder::new();
    let from = |kappa2: f64| {
        let plan = format!(
            "tensor --preset fig4 --set kappa3=0.1 --set kappa2={kappa2} --along kappa2=0.7:0.85 --branches 5"
        );
        let mut found = special(&follow(&folder, &plan), "kappa2");
        found.retain(|one| one.1 > 0.7237); // the cascade goes on below
        found
    };
    let list = expected(&[
        ("period-doubling", 0.723_804_366),
        ("period-doubling", 0.725_650_983),
        ("period-doubling", 0.734_341_551),
        ("symmetry-breaking", 0.783_547_485),
    ]);
    for kappa2 in [0.73, 0.76, 0.8] {
        let found = from(kappa2);
        assert!(same(&found, &list, 1e-7), "from {kappa2}: {found:?}");
    }
}

/// Exactly at its bifurcation a motion has no name; the start that the error names finds the bifurcation.
#[test]
fn a_start_at_a_bifurcation_says_which_one_decides() {
    let folder = Folder::new();
    let text = "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.parameters]\nmu = 0.0\n[model.amplitudes.equations]\n\
                z1 = \"mu*z1 - |z1|^2*z1\"\n";
    folder.write("fork.toml", text);
    let refused = folder.run("continue fork.toml --along mu=-1:2").expect(2).stderr;
    assert!(refused.contains("a start elsewhere may decide: mu = 1"), "{refused}");
    let found = follow(&folder, "fork.toml --set mu=1 --along mu=-1:2");
    let at = |entry: &Value| entry["mu"].as_f64().is_some_and(|mu| mu.abs() < 1e-8);
    assert!(found["branches"][0]["special"].as_array().expect("a list").iter().any(at), "{found}");
}

/// FitzHugh and Nagumo: the cycles explode within a range of the parameter of 1e-9, which is no connection, because there is no saddle.
#[test]
fn a_canard_explosion_is_no_homoclinic_orbit() {
    let folder = Folder::new();
    planar(&folder, "canard.toml", "I = 0.0", ["x-x^3/3-y+I", "0.08*(x+0.7-0.8*y)"]);
    for start in [0.0, 0.6] {
        let plan = format!("canard.toml --set I={start} --along I=-0.5:2 --branches 2");
        let json = follow(&folder, &plan);
        let list = expected(&[
            ("fold", 0.324_178_523),
            ("fold", 1.425_821_477),
            ("hopf", 0.331_281_337),
            ("hopf", 1.418_718_663),
        ]);
        assert!(same(&special(&json, "I"), &list, 1e-7), "from {start}: {json}");
    }
}

/// Two branches exchange their stability where they cross.
#[test]
fn a_transcritical_point_is_where_the_branches_cross() {
    let folder = Folder::new();
    planar(&folder, "cross.toml", "mu = -0.5", ["mu*x-x^2", "-y"]);
    let json = follow(&folder, "cross.toml --along mu=-1:1");
    assert!(same(&special(&json, "mu"), &expected(&[("branch-point", 0.0)]), 1e-9), "{json}");
    let stable: Vec<Vec<f64>> = json["branches"]
        .as_array()
        .expect("branches")
        .iter()
        .map(|branch| serde_json::from_value(branch["stable"][0].clone()).expect("a range"))
        .collect();
    assert_eq!(stable.len(), 2, "{json}");
    for (range, expected) in stable.iter().zip([[-1.0, 0.0], [0.0, 1.0]]) {
        assert!(range.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{json}");
    }
}

/// The branches that begin at a pitchfork of a body at rest, `x = sqrt(mu)`, are followed to the ends of the range. All growth rates of the
/// critical mode are zero at the pitchfork: the unit of length follows from other values of the parameter.
#[test]
fn the_branches_of_a_pitchfork_at_rest_are_followed_to_their_ends() {
    let folder = Folder::new();
    planar(&folder, "two.toml", "mu = -0.5", ["mu*x-x^3", "-y"]);
    for (name, modes, more) in [("one", "1", ""), ("with", "1, 2", "z2 = \"-z2\"\n")] {
        folder.write(
            &format!("{name}.toml"),
            &format!(
                "[model.amplitudes]\nmodes = [{modes}]\n[model.amplitudes.parameters]\nmu = -0.5\n\
                 [model.amplitudes.equations]\nz1 = \"mu*z1 - |z1|^2*z1\"\n{more}"
            ),
        );
    }
    for (file, kind, ends) in [("one", "pitchfork", 1), ("with", "pitchfork", 1), ("two", "branch-point", 2)]
    {
        let json = follow(&folder, &format!("{file}.toml --along mu=-1:1"));
        assert!(same(&special(&json, "mu"), &expected(&[(kind, 0.0)]), 1e-9), "{file}: {json}");
        let place = &json["branches"][0]["special"][0];
        assert_eq!(place["criticality"], "supercritical", "{file}: {json}");
        assert_eq!(place["normal_form"], "cubic", "{file}: {json}");
        assert!((place["coefficient"].as_f64().unwrap() + 1.0).abs() < 1e-4, "{file}: {json}");
        let begins = &json["branches"][1];
        assert!(begins["points"].as_u64().unwrap() < 200, "{file}: {json}");
        let left: Vec<&str> = begins["ends"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        let expected = ["the parameter left its range at 1.000000000"; 2];
        assert_eq!(left, expected[..ends], "{file}: {json}");
    }
}

/// FitzHugh and Nagumo's cycle: whether the loop of its velocity (x, -y) encloses rest depends on J, and so does its name.
#[test]
fn a_branch_has_the_names_that_its_motions_have_alone() {
    let folder = Folder::new();
    planar(&folder, "cycle.toml", "J = 0.5", ["x-x^3/3-y+J", "0.08*(x+0.7-0.8*y)"]);
    let json = follow(&folder, "cycle.toml --along J=0.4:1.1");
    let parts = json["branches"][0]["parts"].as_array().expect("parts");
    let named: Vec<&str> = parts.iter().filter_map(|part| part["motion"].as_str()).collect();
    assert_eq!(named, ["circular", "zigzag"]);
    assert_eq!(parts[0]["course"], "clockwise");
    for (part, end) in [(0, "to"), (1, "from")] {
        let place = parts[part][end].as_f64().expect("a number");
        let alone = folder.run(&format!("classify cycle.toml --set J={place} --json")).expect(0).json();
        assert_eq!(alone["regime"], named[part], "J = {place}");
    }
    let text = folder.run("continue cycle.toml --along J=0.4:1.1").expect(0).stdout;
    assert!(text.contains("becomes zigzag between"), "{text}");
}

/// A centre is neither stable nor unstable, however rounding falls: for all values of the parameter its eigenvalues are imaginary.
#[test]
fn a_centre_is_neutral_along_its_branch() {
    let folder = Folder::new();
    planar(&folder, "prey.toml", "a = 1.0", ["x-x*y", "x*y-a*y"]);
    folder.run("equilibria prey.toml --json").expect(0);
    let list = folder.run("equilibria prey.toml --json").expect(0).stdout;
    folder.write("list.json", &list);
    let entries: Value = serde_json::from_str(&list).expect("a list");
    let speed = |entry: &Value| entry["speed"].as_f64().expect("a number");
    let all = entries["equilibria"].as_array().expect("a list");
    let centre = all.iter().position(|entry| speed(entry) > 0.5).expect("a centre") + 1;
    let json = follow(&folder, &format!("--start list.json:{centre} --along a=0.5:2"));
    let branch = &json["branches"][0];
    assert_eq!(branch["stable"], serde_json::json!([]), "{json}");
    assert_eq!(branch["neutral"], serde_json::json!([[0.5, 2.0]]), "{json}");
}

/// A circle without a mirror begins to turn at mu = 0, with an amplitude of the root of mu: a steady motion, which `--steady` follows.
#[test]
fn a_circle_that_begins_to_turn_begins_a_steady_motion() {
    let folder = Folder::new();
    folder.write(
        "chiral.toml",
        "[model.amplitudes]\nmodes = [1]\nsymmetry = \"rotation\"\n[model.amplitudes.parameters]\nmu = -0.5\n\
         [model.amplitudes.equations]\nz1 = \"(mu+0.5*i)*z1-z1^2*conj(z1)\"\n",
    );
    for options in ["", "--steady", "--from-stable"] {
        let json = follow(&folder, &format!("chiral.toml --along mu=-1:1 {options}"));
        let branches = json["branches"].as_array().expect("branches");
        assert_eq!(branches.len(), 2, "{options} {json}");
        assert!(same(&special(&json, "mu"), &expected(&[("hopf", 0.0)]), 1e-9), "{options} {json}");
        let stable: Vec<f64> = serde_json::from_value(branches[1]["stable"][0].clone()).expect("a range");
        assert!(stable[0].abs() < 1e-6 && (stable[1] - 1.0).abs() < 1e-9, "{options} {json}");
    }
}

/// The subcritical Hopf bifurcation and the fold of Bautin's normal form, at 0 and -1/16, wherever the origin lies, and in any unit of
/// length.
#[test]
fn the_origin_does_not_matter() {
    let folder = Folder::new();
    for (name, [x, y], length) in [
        ("near", ["x", "y"], 1.0),
        ("far", ["(x-3)", "(y+4)"], 1.0),
        ("small", ["(x-0.01)", "(y-0.02)"], 0.01),
    ] {
        let square = format!("({x}*{x}+{y}*{y})/{}", length * length);
        let growth = format!("(m+0.5*{square}-{square}*{square})");
        let turning = format!("(1.3+0.3*{square})");
        let file = format!("{name}.toml");
        let rates = [format!("{growth}*{x}-{turning}*{y}"), format!("{growth}*{y}+{turning}*{x}")];
        planar(&folder, &file, "m = -0.3", [&rates[0], &rates[1]]);
        let found = special(&follow(&folder, &format!("{file} --along m=-0.5:0.5")), "m");
        let known = expected(&[("fold", -0.0625), ("hopf", 0.0)]);
        assert!(same(&found, &known, 1e-9), "{name}: {found:?}");
    }
}

/// Van der Pol's equation: at 0 it is `x'' = -x`, whose circles of all sizes are one family. It crosses the limit cycle, which has the
/// amplitude 2 there, and begins at rest; where they cross, and in which unit of length and from which start, changes nothing.
#[test]
fn a_family_of_orbits_is_one_branch_in_all_units_and_from_all_starts() {
    let folder = Folder::new();
    for (size, start) in [(1.0, 0.7), (1e3, 0.5), (1e5, 0.3)] {
        let square = size * size;
        planar(&folder, "pol.toml", "mu = 1.0", ["y", &format!("mu*(1 - x^2/{square:e})*y - x")]);
        let words = format!("pol.toml --along mu=-1:1 --set mu={start} --initial v1={size:e} --no-figures");
        let json = follow(&folder, &words);
        let case = format!("{size}, {start}: {json:#}");
        let branches = json["branches"].as_array().expect("branches");
        let leads = |branch: usize| {
            let special = branches[branch]["special"].as_array().expect("a list").iter();
            special.map(|one| (one["kind"].clone(), one["branch"].clone())).collect::<Vec<_>>()
        };
        assert_eq!(branches.len(), 3, "{case}");
        assert_eq!(leads(0), [("branch-point".into(), 1.into())], "{case}");
        assert!(leads(1).is_empty(), "{case}");
        assert_eq!(leads(2), [("hopf".into(), 1.into())], "{case}");
        let crossing = &branches[0]["special"][0];
        let [place, error, second, by] = ["mu", "error", "coefficient", "coefficient_error"]
            .map(|key| crossing[key].as_f64().expect("a number"));
        // along the family nothing changes: the coefficient is 0
        assert!(place.abs() <= error && second.abs() <= 3.0 * by && second.abs() * size < 1e-6, "{case}");
    }
}
