//! `motiform continue --start`: earlier points, stable or not, lead to the special points that other starts, steps and sides lead to.

use crate::common::Folder;
use serde_json::Value;

/// The model of Lorenz in amplitudes: z1 = x + i y, z2 = z. (The imaginary part of z2 decays by itself.)
const LORENZ: &str = r#"
[model.amplitudes]
modes = [1, 2]
symmetry = "none"
[model.amplitudes.parameters]
r = 20.0
s = 10.0
b = 2.6666666666666665
[model.amplitudes.equations]
z1 = "s*(((-i/2)*(z1-conj(z1)))-(0.5*(z1+conj(z1)))) + i*(r*(0.5*(z1+conj(z1)))-((-i/2)*(z1-conj(z1)))-(0.5*(z1+conj(z1)))*(0.5*(z2+conj(z2))))"
z2 = "(0.5*(z1+conj(z1)))*((-i/2)*(z1-conj(z1)))-b*(0.5*(z2+conj(z2))) + i*(-(((-i/2)*(z2-conj(z2)))))"
"#;

/// Where the two equilibria beside the origin lose their stability: r = s (s + b + 3) / (s - b - 1).
const HOPF: f64 = 470.0 / 19.0;

/// A folder with the model, and with its equilibria at r = 28, all unstable: the origin, and roughly the one with x > 0.
fn lorenz() -> Folder {
    let folder = Folder::new();
    folder.write("lorenz.toml", LORENZ);
    let mut list = folder.run("equilibria lorenz.toml --set r=28 --starts 20 --json").expect(0).json();
    let origin = list["equilibria"][2].clone(); // the fastest to grow
    assert_eq!(origin["motion"], "motionless", "{list}");
    let mut beside = origin.clone();
    // v1 + i v2 = conj(z1)
    beside["shape"] = serde_json::json!({ "v1": 8.485, "v2": -8.485, "z2_re": 27.0, "z2_im": 0.0 });
    beside["unstable"] = 2.into();
    list["equilibria"] = Value::from(vec![origin, beside]);
    folder.write("equilibria.json", &list.to_string());
    folder
}

/// The kinds of special points of the first branch with their values, sorted; the start is in its list of points.
fn special(folder: &Folder, arguments: &str) -> Vec<(String, f64)> {
    let json = folder.run(&format!("continue {arguments} --json")).expect(0).json();
    let entries = json["branches"][0]["special"].as_array().expect("a list");
    let mut all: Vec<(String, f64)> = entries
        .iter()
        .map(|entry| {
            (entry["kind"].as_str().expect("a name").to_owned(), entry["r"].as_f64().expect("a value"))
        })
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all
}

/// Both equilibria beside the origin lie on one branch, which turns back at the origin.
fn is_whole(found: &[(String, f64)]) -> bool {
    let list = [("branch-point", 1.0), ("hopf", HOPF), ("hopf", HOPF)];
    found.len() == list.len()
        && found
            .iter()
            .zip(list)
            .all(|(found, (kind, value))| found.0 == kind && (found.1 - value).abs() < 1e-7)
}

#[test]
fn unstable_equilibria_are_followed_from_the_list_of_equilibria() {
    let folder = lorenz();
    let origin = special(&folder, "--start equilibria.json:1 --along r=0:30 --branches 1");
    assert!(
        matches!(&origin[..], [(kind, value)] if kind == "branch-point" && (value - 1.0).abs() < 1e-7),
        "{origin:?}"
    );
    let beside = special(&folder, "--start equilibria.json:2 --along r=0:30 --branches 1");
    assert!(is_whole(&beside), "{beside:?}");
    // the model may be named, and --set has the last word
    let named =
        special(&folder, "lorenz.toml --start equilibria.json:2 --set r=26 --along r=0:30 --branches 1");
    assert!(is_whole(&named), "{named:?}");
}

#[test]
fn steps_sides_and_tolerances_do_not_move_special_points() {
    let folder = lorenz();
    let from = |options: &str| {
        special(&folder, &format!("--start equilibria.json:2 --along r=0:30 --branches 1 {options}"))
    };
    for options in [
        "--branch-step 0.1",
        "--branch-step 0.3 --first-step 0.1",
        "--branch-step 0.005 --first-step 0.001 --points 5000",
        "--tolerance 1e-13",
        "--tolerance 1e-7",
        "--direction down",
        "--set r=25 --branch-step 0.1",
        "--set r=16 --branch-step 0.1",
    ] {
        let found = from(options);
        assert!(is_whole(&found), "{options}: {found:?}");
    }
    assert_eq!(from("--direction up"), []); // both Hopf bifurcations lie below
    let json =
        folder.run("continue --start equilibria.json:2 --along r=0:30 --branches 1 --direction up --json");
    assert_eq!(json.expect(0).json()["branches"][0]["ends"].as_array().map(Vec::len), Some(1));
}

/// Points of branches, unstable orbits among them, lead to the branches on which they lie; --resume changes no bit.
#[test]
fn points_of_branches_lead_to_the_same_branch() {
    let folder = lorenz();
    let first = "continue --start equilibria.json:2 --along r=14:30 --branches 2 --no-figures --out first";
    folder.run(first).expect(0);
    for point in ["0:0", "0:7", "first/points.parquet:0:20"] {
        let point = if point.contains('/') { point.to_owned() } else { format!("first:{point}") };
        let found = special(&folder, &format!("--start {point} --along r=0:30 --branches 1"));
        assert!(is_whole(&found), "{point}: {found:?}");
    }
    let orbit = folder
        .run("continue --start first:1:40 --along r=13:30 --branches 1 --out orbit --json")
        .expect(0)
        .json();
    assert_eq!(orbit["branches"][0]["motion"], "zigzag");
    let end = &orbit["branches"][0]["special"][0];
    let (at, error) = (end["r"].as_f64().expect("a value"), end["error"].as_f64().expect("an error"));
    assert!(end["kind"] == "homoclinic" && (at - 13.926_557_4).abs() < error + 1e-7, "{end}");
    let before = std::fs::read(folder.path("orbit/points.parquet")).expect("points");
    folder.run("continue --start first:1:40 --along r=13:30 --branches 1 --out orbit --resume").expect(0);
    assert_eq!(before, std::fs::read(folder.path("orbit/points.parquet")).expect("points"));
    let other = "continue --start first:1:41 --along r=13:30 --branches 1 --out orbit --resume";
    let other = folder.run(other).expect_error(2);
    assert!(other.stderr.contains("branches of another plan (given.time: "), "{}", other.stderr);
}

/// A state of a dataset is simulated on, or taken as a guess of a steady motion, which may be unstable.
#[test]
fn states_of_datasets_are_starts() {
    let folder = lorenz();
    let start = "--initial v1=7 --initial v2=-7 --initial z2_re=19";
    folder.run(&format!("simulate lorenz.toml {start} --t-end 40 --no-figures --out run")).expect(0);
    for point in ["run", "run:t=1.5", "run:3", "run/trajectory.parquet"] {
        let found = special(&folder, &format!("--start {point} --along r=0:30 --branches 1"));
        assert!(is_whole(&found), "{point}: {found:?}");
    }
    let unstable = special(&folder, "--start run --set r=28 --motion straight --along r=0:30 --branches 1");
    assert!(is_whole(&unstable), "{unstable:?}");
    let chaotic = folder.run("continue --start run --set r=28 --along r=0:30").expect(2);
    assert!(chaotic.stderr.contains("ask for the steady motion close to the state"), "{}", chaotic.stderr);
}

#[test]
fn starts_that_are_none_are_refused_with_what_to_do() {
    let folder = lorenz();
    folder
        .run("continue --start equilibria.json:1 --along r=0:30 --branches 1 --no-figures --out first")
        .expect(0);
    folder.write("empty.json", "{}");
    std::fs::copy(folder.path("first/points.parquet"), folder.path("moved.parquet")).expect("a copy");
    for (arguments, says) in [
        ("--start nothing:1 --along r=0:30", "there is no such file or folder: give a folder of branches"),
        (
            "--start equilibria.json --along r=0:30",
            "give FILE:NUMBER, from 1\n  equilibria.json:1  motionless, 1 growing",
        ),
        ("--start equilibria.json:3 --along r=0:30", "there is no equilibrium \"3\""),
        ("--start empty.json:1 --along r=0:30", "this is no list of equilibria"),
        ("--start lorenz.toml --along r=0:30", "this holds no motion to start from"),
        ("--start first --along r=0:30", "give FOLDER:BRANCH:POINT"),
        ("--start moved.parquet:0:0 --along r=0:30", "of branches, give their folder"),
        ("--start first:4:0 --along r=0:30", "there is no branch \"4\""),
        ("--start first:0:9999 --along r=0:30", "branch 0 has points 0 to"),
        ("tensor --start equilibria.json:1 --along kappa2=0:1", "not of the tensor model"),
        ("--start equilibria.json:1 --set r=40 --along r=0:30", "is outside"),
        (
            "--start equilibria.json:2 --set r=1.5 --along r=0:30",
            "there is no steady motion close to the given one",
        ),
        ("--start equilibria.json:2 --motion straight --along r=0:30", "from = straight"),
        ("--start equilibria.json:2 --along r=0:28 --direction up", "direction = up"),
        ("--start equilibria.json:2 --along r=0:30 --direction left", "give up, down or both"),
        ("--start equilibria.json:2 --along r=0:30 --branch-step 2", "branch_step = 2"),
        ("--start equilibria.json:2 --along r=0:30 --first-step 0.1", "first_step = 0.1"),
        ("--start equilibria.json:2 --along r=0:30 --tolerance 0.1", "tolerance = 0.1"),
        ("--start equilibria.json:2 --initial v1=1 --along r=0:30", "cannot be used with"),
    ] {
        let done = folder.run(&format!("continue {arguments}")).expect_error(2);
        assert!(done.stderr.contains(says), "{arguments}: {}", done.stderr);
    }
}

/// The keys of a study file are those of the options.
#[test]
fn a_study_sets_steps_and_sides() {
    let folder = lorenz();
    let keys = "[continue]\nalong = \"r=0:30\"\nbranches = 1\ndirection = \"up\"\nbranch_step = 0.1\nfirst_step = 0.02\ntolerance = 1e-8\n";
    folder.write("study.toml", &format!("{LORENZ}\n{keys}"));
    let points = |arguments: &str| {
        let json = folder.run(&format!("continue {arguments} --json")).expect(0).json();
        json["branches"][0]["points"].as_u64().expect("a count")
    };
    let options =
        "--along r=0:30 --branches 1 --direction up --branch-step 0.1 --first-step 0.02 --tolerance 1e-8";
    let start = "--start equilibria.json:2";
    assert_eq!(points(&format!("study.toml {start}")), points(&format!("lorenz.toml {start} {options}")));
    assert!(points(&format!("study.toml {start} --direction both")) > points(&format!("study.toml {start}")));
    folder.write("wrong.toml", &format!("{LORENZ}\n{}", keys.replace("\"up\"", "\"upp\"")));
    let wrong = folder.run("continue wrong.toml").expect_error(2);
    assert!(wrong.stderr.contains("did you mean up"), "{}", wrong.stderr);
}

/// `z1' = (p + i) z1 - |z1|^2 z1` oscillates from p = 0 on; the real part w of z2, `w' = s w - w^3`, makes the rest unstable where s is
/// positive.
const OSCILLATES: &str = r#"
[model.amplitudes]
modes = [1, 2]
symmetry = "none"
[model.amplitudes.parameters]
p = -0.5
s = -0.5
[model.amplitudes.equations]
z1 = "(p+i)*z1 - z1*z1*conj(z1)"
z2 = "s*(0.5*(z2+conj(z2))) - (0.5*(z2+conj(z2)))^3 - 0.5*(z2-conj(z2))"
"#;

#[test]
fn orbits_that_begin_on_stable_motions_can_be_followed_alone() {
    let folder = Folder::new();
    folder.write("oscillates.toml", OSCILLATES);
    let stable = "continue oscillates.toml --along p=-1:1 --json";
    let list = folder.run("equilibria oscillates.toml --set s=0.5 --json").expect(0).json();
    let number = |entry: &Value| entry["motion"] == "motionless" && entry["unstable"] == 1;
    let number =
        1 + list["equilibria"].as_array().expect("a list").iter().position(number).expect("the rest");
    folder.write("equilibria.json", &list.to_string());
    let unstable = format!("continue --start equilibria.json:{number} --along p=-1:1 --branches 2 --json");
    for (command, from_stable, branches) in
        [(stable, false, 2), (stable, true, 2), (unstable.as_str(), false, 2), (unstable.as_str(), true, 1)]
    {
        let option = if from_stable { " --from-stable" } else { "" };
        let json = folder.run(&format!("{command}{option}")).expect(0).json();
        assert_eq!(
            json["branches"].as_array().expect("branches").len(),
            branches,
            "{command}{option}: {json}"
        );
        assert_eq!(json["branches"][0]["special"][0]["kind"], "hopf", "{json}");
    }
}

/// The circle of the cell model loses its stability to ellipses at length 4 pi. From an ellipse, too, the circle is a branch of its own, on
/// both sides of that point.
#[test]
fn a_branch_that_is_met_at_its_symmetric_end_is_followed() {
    let folder = Folder::new();
    let list = folder.run("equilibria cell --set length=12.7 --set modes=12 --starts 30 --json").expect(0);
    folder.write("cell.json", &list.stdout);
    let rows = list.json()["equilibria"].as_array().expect("a list").clone();
    let is_ellipse = |row: &Value| {
        row["motion"] == "motionless" && row["shape"]["c2"].as_f64().is_some_and(|c2| c2.abs() > 0.1)
    };
    let ellipse = rows.iter().position(is_ellipse).expect("an ellipse at rest") + 1;
    let continued =
        format!("continue --start cell.json:{ellipse} --along length=12.4:12.7 --branches 3 --steady --json");
    let branches = folder.run(&continued).expect(0).json()["branches"].as_array().expect("a list").clone();
    let circle =
        branches.iter().find(|branch| branch["origin"]["kind"] == "meets").expect("the branch that is met");
    let at = circle["special"][0]["length"].as_f64().expect("a length");
    assert!(
        (at - 4.0 * std::f64::consts::PI).abs() < 1e-9 && circle["special"][0]["kind"] == "pitchfork",
        "{circle}"
    );
    assert_eq!(circle["ends"].as_array().map(Vec::len), Some(2));
}
