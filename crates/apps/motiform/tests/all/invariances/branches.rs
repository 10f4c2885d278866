//! The list of special points of a branch depends neither on the range, nor on the steps, nor on the start.
//!
//! Each subject is followed as it is, and then over random ranges that contain its window, from random starts, with random steps and
//! tolerances. Within the window the lists must be the same: the kinds, the criticality, and the places within their stated errors.

use super::all;
use super::texts::Random;
use crate::common::Folder;
use serde_json::Value;

/// A diagram and what may be changed without changing it.
struct Subject {
    name: &'static str,
    /// The command without the start and the range.
    words: &'static str,
    along: &'static str,
    /// Where lists are compared: every range contains it.
    window: [f64; 2],
    /// Distance by which a range may go beyond it on either side.
    beyond: [f64; 2],
    /// Where the start may be.
    starts: &'static [[f64; 2]],
    /// The kinds of points in the window.
    kinds: &'static [&'static str],
}

const SUBJECTS: [Subject; 5] = [
    Subject {
        name: "steady motions of the tensor model",
        words: "tensor --preset fig1 --set kappa2=-0.06 --steady --branches 20",
        along: "gamma",
        window: [-0.09, 0.09],
        beyond: [0.05, 0.05],
        starts: &[[0.03, 0.09], [-0.09, -0.08]],
        kinds: &["hopf", "hopf", "pitchfork", "pitchfork"],
    },
    Subject {
        name: "orbits of the tensor model",
        words: "tensor --preset fig4 --set kappa3=0.1 --motion zigzag --branches 1",
        along: "kappa2",
        window: [0.7, 1.36],
        beyond: [0.15, 0.3],
        starts: &[[0.8, 1.1]],
        kinds: &["homoclinic", "symmetry-breaking", "symmetry-breaking"],
    },
    Subject {
        name: "cycles of FitzHugh and Nagumo",
        words: "canard.toml --branches 4",
        along: "I",
        window: [-0.2, 1.8],
        beyond: [0.5, 0.5],
        starts: &[[-0.2, 0.3], [0.45, 1.3], [1.45, 1.8]],
        kinds: &["fold", "fold", "hopf", "hopf"],
    },
    Subject {
        name: "folds and a Hopf bifurcation of Lorenz's equations of 1984",
        words: "lor84.toml --steady --initial v1=0.9 --initial v2=-0.3 --initial z2_re=0.3",
        along: "F",
        window: [0.5, 1.6],
        beyond: [0.4, 1.0],
        starts: &[[0.6, 1.05]],
        kinds: &["fold", "fold", "hopf"],
    },
    Subject {
        name: "steady motions of the cell",
        words: "cell --steady --branches 20",
        along: "length",
        window: [12.1, 13.4],
        beyond: [0.6, 0.9],
        starts: &[[12.32, 12.9], [12.12, 12.25]],
        kinds: &["hopf", "pitchfork", "pitchfork", "pitchfork"],
    },
];

/// Changes of each subject in every push, and of all.
const CHANGES: [u64; 2] = [1, 10];

/// Errors are to first order.
const ROOM: f64 = 1e-10;

/// Real equations as a text: x and y are the parts of the first amplitude, w is the real part of the second.
fn texts(folder: &Folder) {
    let real = |text: &str| {
        let text = text.replace('x', "((z1+conj(z1))/2)").replace('y', "((z1-conj(z1))*(-i/2))");
        text.replace('w', "((z2+conj(z2))/2)").replace('v', "((z2-conj(z2))*(-i/2))")
    };
    let head = |modes: &str, parameters: &str| {
        format!(
            "[model.amplitudes]\nmodes = {modes}\nsymmetry = \"none\"\n\
             [model.amplitudes.parameters]\n{parameters}\n[model.amplitudes.equations]\n"
        )
    };
    let canard = real("x-x^3/3-y+I + i*(0.08*(x+0.7-0.8*y))");
    folder.write("canard.toml", &format!("{}z1 = \"{canard}\"\n", head("[1]", "I = 0.0")));
    let (z1, z2) = (real("-y^2-w^2-0.25*x+0.25*F + i*(x*y-4*x*w-y+0.5)"), real("4*x*y+x*w-w - i*v"));
    folder.write("lor84.toml", &format!("{}z1 = \"{z1}\"\nz2 = \"{z2}\"\n", head("[1, 2]", "F = 1.0")));
}

/// A number between two others.
fn between(random: &mut Random, [low, high]: [f64; 2]) -> f64 {
    low + 0.5 * (high - low) * (1.0 + random.next())
}

/// The same, its logarithm uniform.
fn size(random: &mut Random, [low, high]: [f64; 2]) -> f64 {
    between(random, [low.ln(), high.ln()]).exp()
}

impl Subject {
    /// The command of the change with this number; the first one is the subject itself.
    fn command(&self, number: u64) -> String {
        let Self { words, along, window: [low, high], beyond, starts, .. } = *self;
        let mut random = Random(1_000_003 * number + self.name.len() as u64);
        let start = between(&mut random, starts[(number as usize) % starts.len()]);
        if number == 0 {
            return format!("continue {words} --set {along}={start} --along {along}={low}:{high} --json");
        }
        let range =
            [between(&mut random, [low - beyond[0], low]), between(&mut random, [high, high + beyond[1]])];
        let longest = size(&mut random, [0.005, 0.08]);
        let first = size(&mut random, [1e-4, longest]);
        let tolerance = size(&mut random, [1e-12, 1e-8]);
        format!(
            "continue {words} --set {along}={start} --along {along}={}:{} --branch-step {longest} --first-step {first} \
             --tolerance {tolerance:e} --seed {number} --json",
            range[0], range[1]
        )
    }

    /// The special points within the window, each once, by kind and place.
    fn list(&self, folder: &Folder, command: &str) -> Vec<Found> {
        let json = folder.run(command).expect(0).json();
        let branches = json["branches"].as_array().expect("branches");
        let entries = branches.iter().flat_map(|branch| branch["special"].as_array().expect("a list"));
        let mut all: Vec<Found> = entries.map(|entry| Found::read(entry, self.along)).collect();
        all.retain(|one| (self.window[0]..=self.window[1]).contains(&one.place));
        all.sort_by(|a, b| a.kind.cmp(&b.kind).then(a.place.total_cmp(&b.place)));
        all.dedup_by(|a, b| a.agrees(b));
        all
    }
}

/// A special point.
#[derive(Clone, Debug)]
struct Found {
    kind: String,
    criticality: String,
    place: f64,
    error: f64,
}

impl Found {
    fn read(entry: &Value, along: &str) -> Self {
        let word = |key: &str| entry[key].as_str().unwrap_or("").to_owned();
        Self {
            kind: word("kind"),
            criticality: word("criticality"),
            place: entry[along].as_f64().expect("a number"),
            error: entry["error"].as_f64().unwrap_or(0.0),
        }
    }

    fn agrees(&self, other: &Self) -> bool {
        let apart = (self.place - other.place).abs();
        self.kind == other.kind
            && self.criticality == other.criticality
            && apart <= self.error + other.error + ROOM * (1.0 + self.place.abs())
    }
}

#[test]
fn lists_of_special_points_do_not_depend_on_ranges_steps_and_starts() {
    let folder = Folder::new();
    texts(&folder);
    let changes = CHANGES[usize::from(all())];
    let mut wrong = Vec::new();
    for subject in &SUBJECTS {
        let command = subject.command(0);
        let wanted = subject.list(&folder, &command);
        let kinds: Vec<&str> = wanted.iter().map(|one| one.kind.as_str()).collect();
        assert_eq!(kinds, subject.kinds, "{}: motiform {command}: {wanted:?}", subject.name);
        for number in 1..=changes {
            let command = subject.command(number);
            let found = subject.list(&folder, &command);
            let same = found.len() == wanted.len() && found.iter().zip(&wanted).all(|(a, b)| a.agrees(b));
            println!("{:<60} {number:>3} {}", subject.name, if same { "same" } else { "different" });
            if !same {
                wrong.push(format!("motiform {command}:\n{found:?}, not\n{wanted:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Along a canard the slope of the branch is smaller than its error: from this start its sign shows one of the two folds only, and a
/// multiplier of 1 the other one.
#[test]
fn a_fold_of_a_canard_that_the_slope_does_not_show_is_a_fold() {
    let folder = Folder::new();
    texts(&folder);
    let subject = SUBJECTS.iter().find(|subject| subject.along == "I").expect("FitzHugh and Nagumo");
    let found = subject.list(&folder, &subject.command(9));
    let kinds: Vec<&str> = found.iter().map(|one| one.kind.as_str()).collect();
    assert_eq!(kinds, subject.kinds);
    for (fold, place) in found.iter().zip([0.324_178_522_503, 1.425_821_477_496]) {
        assert!((fold.place - place).abs() < 1e-9, "{fold:?}");
    }
}
