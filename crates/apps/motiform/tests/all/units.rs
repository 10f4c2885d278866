//! The same equations with their variables and their time in other units have the same equilibria and the same special points.

use crate::common::Folder;
use serde_json::Value;

const X: &str = "(0.5*(z1+conj(z1)))";
const Y: &str = "((-i/2)*(z1-conj(z1)))";
const Z: &str = "(0.5*(z2+conj(z2)))";

/// A system of real equations: x and y are the parts of the first amplitude, z is the real part of the second one.
struct System {
    name: &'static str,
    parameters: &'static str,
    rates: &'static [&'static str],
    /// The motion that is followed, and from which value of the parameter on.
    along: &'static str,
    start: &'static str,
    branches: usize,
}

const SYSTEMS: [System; 4] = [
    System {
        name: "lorenz",
        parameters: "r = 20.0\ns = 10.0\nb = 2.6666666666666665",
        rates: &["s*(Y-X)", "r*X-Y-X*Z", "X*Y-b*Z"],
        along: "r=0.5:40",
        start: "r=20",
        branches: 3,
    },
    System {
        name: "fhn",
        parameters: "I = 0.0\ne = 0.08\na = 0.7\nb = 0.8",
        rates: &["X-X^3/3-Y+I", "e*(X+a-b*Y)"],
        along: "I=-0.5:2",
        start: "I=0.5",
        branches: 2,
    },
    System {
        name: "lv",
        parameters: "d = 0.5",
        rates: &["X*(1-X)-X*Y", "-d*Y+X*Y"],
        along: "d=0.2:1.5",
        start: "d=0.5",
        branches: 4,
    },
    System {
        name: "lor84",
        parameters: "a = 0.25\nb = 4.0\nF = 1.0\nG = 0.5",
        rates: &["-Y^2-Z^2-a*X+a*F", "X*Y-b*X*Z-Y+G", "b*X*Y+X*Z-Z"],
        along: "F=0:2",
        start: "F=0.2",
        branches: 2,
    },
];

impl System {
    /// The model text with its variables larger by `length`, and its rates by `rate`.
    fn text(&self, length: f64, rate: f64) -> String {
        let modes = if self.rates.len() > 2 { "[1, 2]" } else { "[1]" };
        let real = |text: &str| text.replace('X', X).replace('Y', Y).replace('Z', Z);
        let scaled = |text: &str| {
            let own = ["z1", "z2"]
                .iter()
                .fold(text.to_owned(), |text, name| text.replace(name, &format!("({name}/{length:e})")));
            format!("{:e}*({own})", length * rate)
        };
        let first = scaled(&format!("({}) + i*({})", real(self.rates[0]), real(self.rates[1])));
        let mut out = format!(
            "[model.amplitudes]\nmodes = {modes}\nsymmetry = \"none\"\n[model.amplitudes.parameters]\n{}\n\
             [model.amplitudes.equations]\nz1 = \"{first}\"\n",
            self.parameters
        );
        if let Some(third) = self.rates.get(2) {
            let idle = "-((-i/2)*(z2-conj(z2)))";
            out += &format!("z2 = \"{}\"\n", scaled(&format!("({}) + i*({idle})", real(third))));
        }
        out
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The eigenvalues of all equilibria, in the units of the equations themselves, and how many there are.
fn equilibria(folder: &Folder, system: &System, rate: f64) -> Vec<Vec<f64>> {
    let json = folder
        .run(&format!("equilibria model.toml --set {} --starts 60 --json", system.start))
        .expect(0)
        .json();
    folder.write("equilibria.json", &json.to_string());
    let list = json["equilibria"].as_array().expect("a list");
    let eigenvalues = |one: &Value| {
        let all = one["eigenvalues"].as_array().expect("eigenvalues");
        all.iter().flat_map(|value| [number(&value[0]) / rate, number(&value[1]) / rate]).collect()
    };
    list.iter().map(eigenvalues).collect()
}

/// A special point: branch, kind, parameter, period.
type Found = (usize, String, f64, f64);

/// The special points of all branches that are found from the first equilibrium.
fn special(folder: &Folder, system: &System, rate: f64) -> Vec<Found> {
    let System { along, branches, .. } = system;
    let run = format!(
        "continue --start equilibria.json:1 --along {along} --branches {branches} --points 150 --json"
    );
    let json = folder.run(&run).expect(0).json();
    let name = along.split('=').next().expect("a name");
    let mut out = Vec::new();
    for (place, branch) in json["branches"].as_array().expect("branches").iter().enumerate() {
        for entry in branch["special"].as_array().expect("a list") {
            let kind = entry["kind"].as_str().expect("a name").to_owned();
            let period = entry["period"].as_f64().unwrap_or(0.0) * rate;
            out.push((place, kind, number(&entry[name]), period));
        }
    }
    out
}

#[test]
fn other_units_give_the_same_equilibria_and_special_points() {
    let near = |a: f64, b: f64, least: f64| (a - b).abs() <= least * (1.0 + b.abs());
    for system in &SYSTEMS {
        let mut first = None;
        for (length, rate) in [(1.0, 1.0), (1e6, 1.0), (1e-6, 1.0), (1.0, 1e6), (1e-6, 1e-6)] {
            let folder = Folder::new();
            folder.write("model.toml", &system.text(length, rate));
            let found = (equilibria(&folder, system, rate), special(&folder, system, rate));
            let (steady, points) = first.get_or_insert_with(|| found.clone());
            let label = format!("{} in units {length} and {rate}", system.name);
            assert_eq!(found.0.len(), steady.len(), "{label}");
            let values = found.0.iter().flatten().zip(steady.iter().flatten());
            assert!(values.clone().all(|(a, b)| near(*a, *b, 1e-6)), "{label}: {:?} {steady:?}", found.0);
            let same = |(a, b): (&Found, &Found)| {
                a.0 == b.0 && a.1 == b.1 && near(a.2, b.2, 1e-6) && near(a.3, b.3, 1e-3)
            };
            assert_eq!(found.1.len(), points.len(), "{label}: {:?} {points:?}", found.1);
            assert!(found.1.iter().zip(&*points).all(same), "{label}: {:?} {points:?}", found.1);
            assert!(!points.is_empty(), "{label}");
        }
    }
}
