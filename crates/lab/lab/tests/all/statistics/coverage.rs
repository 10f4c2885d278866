//! The coverage of the intervals that `motiform statistics` prints. The table of docs/statistics.md (some
//! minutes):
//!
//!     cargo test --release -p motiform-lab --test all statistics::coverage::table -- --ignored --nocapture
//!
//! `MOTIONS=chaos,circles` before it: these columns only.

use super::motions::{Motion, Source, measured};
use crate::samples::draws;
use motiform_statistics::{Answer, Measured, Statistics, Track};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Data sets.
const SETS: usize = 200;

/// Data sets whose bodies together give the truth where there is no closed form: its error is a tenth of an interval.
const POOLED: usize = 100;

/// Data sets that are simulated together.
const TOGETHER: usize = 20;

/// Too narrow, and said to be in docs/statistics.md: the circles of this motion just leave a disc of this
/// radius, so few bodies make the mean.
const NARROW: (&str, &str) = ("circles", "leaves a large disc");

/// Steps between the samples that are used.
const STEPS: [usize; 3] = [1, 2, 4];

/// Numbers by name.
pub(crate) type Numbers = BTreeMap<String, Answer>;

/// Every number that is printed, and displacements of the table.
pub(crate) fn printed(found: &Statistics) -> Numbers {
    let mut all = Numbers::new();
    let mut add = |name: &str, answer: &Answer| all.insert(name.to_owned(), answer.clone());
    add("speed, mean", &Answer::Known(found.mean_speed));
    add("speed, root mean square", &Answer::Known(found.rms_speed));
    add("walk: P", &found.walk.persistence);
    add("walk: S", &found.walk.speed);
    add("walk: D", &found.walk.diffusion);
    add("D, Green-Kubo", &found.diffusion.green_kubo);
    add("D, displacements", &found.diffusion.displacements);
    add("exponent, shortest lag", &found.exponents[0]);
    add("exponent, last octave", &found.exponents[1]);
    for entry in &found.autocorrelations {
        let name = entry.quantity.name();
        add(&format!("time of {name}"), &entry.time);
        if let Some(oscillation) = &entry.oscillation {
            add(&format!("frequency of {name}"), &oscillation.frequency);
            add(&format!("decay of {name}"), &oscillation.decay);
        }
    }
    for (name, passage) in ["small", "large"].iter().zip(&found.passages) {
        add(&format!("leaves a {name} disc"), &passage.time.mean);
    }
    for (name, side) in [("above", &found.residence.above), ("below", &found.residence.below)] {
        side.time.iter().for_each(|time| _ = add(&format!("stays {name}"), &time.mean));
    }
    let points = found.displacement.points();
    for (name, place) in [("shortest", 0), ("middle", points.len() / 2), ("longest", points.len() - 1)] {
        add(&format!("msd, {name} lag"), &Answer::Known(points[place].value));
    }
    all
}

/// Returns `true` if a number is another one at another sampling interval: its lag is, or what is seen
/// between samples.
pub(crate) fn depends_on_sampling(name: &str) -> bool {
    ["exponent", "leaves", "stays", "msd"].iter().any(|start| name.starts_with(start))
}

/// True values: closed forms, else those of many bodies.
fn truths(motion: &Motion, pool: &[Vec<Track>], step: usize) -> BTreeMap<String, f64> {
    let pooled: Vec<Track> = pool.iter().flatten().cloned().collect();
    let values = |step| -> BTreeMap<String, f64> {
        let found = measured(motion, &pooled, step);
        let all = printed(&found).into_iter();
        let mut all: BTreeMap<String, f64> =
            all.filter_map(|(name, answer)| Some((name, answer.known()?.value))).collect();
        for entry in &found.autocorrelations {
            let Some([frequency, rate]) = entry.oscillation.as_ref().map(|found| found.nearest) else {
                continue;
            };
            all.insert(format!("frequency of {}", entry.quantity.name()), frequency);
            all.insert(format!("decay of {}", entry.quantity.name()), 1.0 / rate);
        }
        all
    };
    let mut all = values(1);
    all.extend(values(step).into_iter().filter(|(name, _)| depends_on_sampling(name)));
    if let Source::Active(d_r, omega, d) = motion.source {
        let time = d_r / (d_r * d_r + omega * omega);
        for name in ["velocity", "heading"] {
            all.insert(format!("time of {name}"), time);
            all.insert(format!("frequency of {name}"), omega / TAU);
            all.insert(format!("decay of {name}"), 1.0 / d_r);
        }
        all.insert("speed, root mean square".into(), 1.0);
        all.insert("D, Green-Kubo".into(), 0.5 * time);
        all.insert("D, displacements".into(), 0.5 * time + d);
    }
    // what a persistent random walk stands for in any motion
    for (name, other) in
        [("P", "time of velocity"), ("S", "speed, root mean square"), ("D", "D, displacements")]
    {
        let value = all.get(other).copied().unwrap_or(f64::NAN);
        all.insert(format!("walk: {name}"), value);
    }
    all
}

/// Data sets with an interval, those of them that hold the truth, and the half widths as parts of it.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    known: usize,
    held: usize,
    width: f64,
}

impl Tally {
    fn add(&mut self, found: Measured, truth: f64) {
        let Some([lower, upper]) = found.interval else { return };
        let rounding = 1e-9 * truth.abs();
        self.known += 1;
        self.held += usize::from((lower - rounding..=upper + rounding).contains(&truth));
        self.width += 0.5 * (upper - lower) / truth;
    }

    /// `95`, in % of the data sets with an interval; `95 (30)` of few; `-` of less than a tenth of the data sets.
    fn shown(&self, sets: usize) -> String {
        let percent = (100.0 * self.held as f64 / self.known.max(1) as f64).round();
        match self.known {
            known if 10 * known < sets => "-".to_owned(),
            known if 10 * known < 9 * sets => format!("{percent} ({known})"),
            _ => format!("{percent}"),
        }
    }

    /// 3.5 standard deviations of a binomial variable below 95 %: of 500 cells of the table a tenth of one is by chance.
    fn fails(&self) -> bool {
        let (n, p) = (self.known as f64, 0.95);
        n >= 20.0 && (self.held as f64) < n * p - 3.5 * (n * p * (1.0 - p)).sqrt()
    }
}

fn tally(motion: &Motion, all: &[Vec<Track>], step: usize) -> BTreeMap<String, Tally> {
    let truths = truths(motion, &all[..POOLED.min(all.len())], step);
    let mut tallies: BTreeMap<String, Tally> = BTreeMap::new();
    for bodies in all {
        for (name, answer) in printed(&measured(motion, bodies, step)) {
            let tally = tallies.entry(name.clone()).or_default();
            if let (Some(found), Some(truth)) = (answer.known(), truths.get(&name)) {
                tally.add(found, *truth);
            }
        }
    }
    tallies
}

/// Coverage of each number, in a column for each motion; three sampling intervals.
fn coverage(motions: &[Motion], sets: usize) -> (String, Vec<String>) {
    let mut cells: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    let mut failed = Vec::new();
    for (column, motion) in motions.iter().enumerate() {
        let all: Vec<Vec<Track>> =
            (0..sets / TOGETHER).flat_map(|k| motion.sets(k * TOGETHER, TOGETHER)).collect();
        for step in STEPS {
            for (name, tally) in tally(motion, &all, step) {
                println!("{} {step} {name}: {tally:?}", motion.name);
                if tally.fails() && (motion.name, name.as_str()) != NARROW {
                    failed.push(format!("{}, {step} steps: {name}: {tally:?}", motion.name));
                }
                let row = cells.entry(name).or_insert_with(|| vec![Vec::new(); motions.len()]);
                row[column].push(tally.shown(sets));
            }
        }
    }
    let line = |name: &str, row: &[String]| format!("| {name} | {} |\n", row.join(" | "));
    let names: Vec<String> = motions.iter().map(|motion| motion.name.to_owned()).collect();
    let rule = vec!["---".to_owned(); names.len()];
    let rows = cells.iter().map(|(name, row)| {
        let row: Vec<String> = row.iter().map(|steps| steps.join(", ")).collect();
        line(name, &row)
    });
    let rows: String = rows.collect();
    (line("", &names) + &line("---", &rule) + &rows, failed)
}

#[test]
#[ignore = "some minutes"]
fn table() {
    let asked = std::env::var("MOTIONS").unwrap_or_default();
    let mut motions = Motion::all().to_vec();
    motions.retain(|motion| asked.is_empty() || asked.split(',').any(|name| name == motion.name));
    let (table, failed) = coverage(&motions, SETS);
    println!("{table}");
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A sample of the table: the processes that cost least, in a push two of the three.
#[test]
fn a_sample() {
    let cheap: Vec<Motion> =
        Motion::all().into_iter().filter(|motion| matches!(motion.source, Source::Active(..))).collect();
    let cheap: Vec<Motion> = cheap.into_iter().step_by(draws(2, 1)).collect();
    let (table, failed) = coverage(&cheap, 20);
    println!("{table}");
    assert!(failed.is_empty(), "{failed:#?}");
}
