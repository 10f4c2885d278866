//! Every option of the program: a name means one thing, whatever the command. docs/options.md has the table.

use super::Arguments;
use clap::{Arg, CommandFactory};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// The meaning of every option. An option of another meaning needs another name.
const MEANINGS: &[(&str, &str)] = &[
    ("all", "compute all rows again, not only a sample"),
    ("along", "the parameter along which motions are followed, with its range"),
    ("at", "the surface: a coordinate at a fixed value"),
    ("atol", "absolute tolerance of adaptive steppers"),
    ("axis", "a parameter that is varied, with its values"),
    ("bifurcations", "also look for the nearest bifurcations of each fit"),
    ("bodies", "number of bodies to simulate"),
    ("branch-step", "longest step along a branch or curve"),
    ("branches", "maximum number of branches"),
    ("budget", "maximum model time for classifying one motion"),
    ("cell", "only these tracked cells"),
    ("column", "a column of the table by its header"),
    ("correct", "motions of the stage that are subtracted"),
    ("count", "number of exponents"),
    ("crossings", "which crossings of the surface count"),
    ("curve", "kinds of special points that are followed over two parameters"),
    ("direction", "the sides to which the start is followed"),
    ("disc", "radius of a disc for first-passage times"),
    ("doublings", "doublings of the period in a row that are followed"),
    ("draws", "most models drawn from the estimate"),
    ("dt-out", "model time between recorded states"),
    ("equations", "write equations as text"),
    ("escape-norm", "a shape of a larger norm has escaped"),
    ("film", "also write the animation in this format"),
    ("first-step", "first step along a branch or curve"),
    ("force", "replace an earlier result; what motiform did not write stays"),
    ("format", "format of the tables in an output folder"),
    ("from", "draw from this time"),
    ("from-stable", "of the orbits follow those that begin where a stable motion loses its stability"),
    ("in", "the plane of curves"),
    ("initial", "an initial value"),
    ("input-format", "format of the files with outlines"),
    ("interval", "time between frames"),
    ("json", "print one JSON object"),
    ("ladder", "also compare models by frames that their fits did not see"),
    ("length-unit", "unit of `--pixel-size`"),
    ("lines", "maximum number of lines across boundaries"),
    ("max-steps", "maximum number of steps"),
    ("modes", "amplitudes of the fitted model"),
    ("motion", "the motion that the start must settle on"),
    ("no-animation", "do not draw the animation"),
    ("no-caption", "omit the captions"),
    ("no-figures", "do not draw"),
    ("no-open", "print the address without opening a browser"),
    ("no-report", "write no pages"),
    ("noise", "amplitude of the noise"),
    ("noise-velocity", "amplitude of the noise on the velocity"),
    ("observable", "what a diagram of branches shows"),
    ("order", "highest order of the fitted terms"),
    ("out", "where the result is written"),
    ("outlines", "number of outlines along the path"),
    ("over", "the scan beneath the curves"),
    ("panels", "one figure of panels with letters"),
    ("pdf", "also write PDF figures"),
    ("perturb", "size of the deviations that replace zeros of a given start"),
    ("pixel-size", "length of a pixel"),
    ("points", "maximum number of points of a branch or curve to each side"),
    ("port", "port of the explorer"),
    ("preset", "a preset to start from"),
    ("quick", "coarser and shorter"),
    ("radius", "radius R0 of the undeformed body"),
    ("random", "sizes of random initial states"),
    ("resume", "go on with what is in the output folder"),
    ("rtol", "relative tolerance of adaptive steppers"),
    ("saddle", "initial states for the chaotic saddle"),
    ("samples", "number of initial states (for each cell or value)"),
    ("scale", "scale of the outlines relative to the path"),
    ("schema", "print the JSON schema of study files"),
    ("seed", "seed of everything random"),
    ("set", "the value of a parameter"),
    ("shard", "the share of a scan that is computed"),
    ("simulations", "most cells simulated by each fit"),
    ("start", "a point of an earlier result to start from"),
    ("starts", "random shapes that Newton's method starts from"),
    ("steady", "follow steady motions alone"),
    ("step", "fixed step"),
    ("stepper", "the numerical method"),
    ("style", "where the figures are shown"),
    ("sweep", "values of the parameter at which motions are simulated, upwards and downwards"),
    ("t-end", "model time to record, or to average over"),
    ("threads", "number of threads; does not affect the results"),
    ("threshold", "the quantity whose residence times are measured"),
    ("tie", "a parameter that follows from others"),
    ("time-unit", "unit of `--interval`"),
    ("title", "title of the figures"),
    ("to", "draw to this time"),
    ("together", "fit one set of coefficients to all cells"),
    ("token", "the secret part of the explorer's address"),
    ("tolerance", "tolerance of Newton's method on a branch"),
    ("transient", "model time to leave out at the beginning"),
    ("units", "physical units of axes and printed results"),
    ("until", "longest model time for which an orbit is followed"),
    ("width", "width of the figures"),
    ("write-outlines", "also write the outlines, for other programs"),
];

/// The options of all commands by name: the names of their values, and the commands that have them.
fn options() -> BTreeMap<String, Vec<(String, String)>> {
    let mut all: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for command in Arguments::command().get_subcommands() {
        for option in command.get_arguments().filter(|option| !option.is_hide_set()) {
            if let Some(name) = option.get_long() {
                all.entry(name.to_owned()).or_default().push((value(option), command.get_name().to_owned()));
            }
        }
    }
    all
}

/// The name of the value; nothing for a switch.
fn value(option: &Arg) -> String {
    if !option.get_action().takes_values() {
        return String::new();
    }
    let names = option.get_value_names().unwrap_or_default();
    names.first().map_or_else(String::new, ToString::to_string)
}

/// The page with the table.
fn page() -> String {
    let mut page = String::from(
        "# Options\n\nEvery option of every command. A name means one thing, whatever the command; `motiform COMMAND \
         --help` says what it does there.\n\n\
         | option | value | meaning | commands |\n| --- | --- | --- | --- |\n",
    );
    let options = options();
    for (name, meaning) in MEANINGS {
        let uses = options.get(*name).map(Vec::as_slice).unwrap_or_default();
        let value = uses.first().map_or("", |one| one.0.as_str()).replace('|', "\\|");
        let value = if value.is_empty() { value } else { format!("`{value}`") };
        let commands: Vec<&str> = uses.iter().map(|one| one.1.as_str()).collect();
        let _ = writeln!(page, "| `--{name}` | {value} | {meaning} | {} |", commands.join(", "));
    }
    page
}

#[test]
fn an_option_means_one_thing() {
    let known: BTreeMap<&str, &str> = MEANINGS.iter().copied().collect();
    assert_eq!(known.len(), MEANINGS.len(), "a name is listed twice");
    assert!(MEANINGS.is_sorted_by_key(|entry| entry.0), "the names are in order");
    let options = options();
    for (name, uses) in &options {
        assert!(known.contains_key(name.as_str()), "--{name} has no meaning in MEANINGS");
        let first = &uses[0];
        let other = uses.iter().find(|one| one.0 != first.0);
        assert!(
            other.is_none(),
            "--{name}: {first:?} and {other:?} take other values: two things with one name?"
        );
    }
    let unused: Vec<&&str> = known.keys().filter(|name| !options.contains_key(**name)).collect();
    assert!(unused.is_empty(), "no command has {unused:?}");
}

/// The options of every figure.
const OF_FIGURES: [&str; 5] = ["style", "width", "title", "no-caption", "pdf"];

/// Commands that draw, but pages that lay themselves out for the window of a browser; their figures are saved from there.
const OF_PAGES: [&str; 1] = ["explore"];

/// Commands that have nothing to draw.
const WITHOUT_FIGURES: [&str; 11] = [
    "models",
    "merge",
    "classify",
    "lyapunov",
    "equilibria",
    "section",
    "new",
    "doctor",
    "check",
    "verify",
    "completions",
];

#[test]
fn every_command_that_draws_has_the_options_of_figures() {
    for command in Arguments::command().get_subcommands() {
        let name = command.get_name();
        let has = |option: &&&str| command.get_arguments().any(|known| known.get_long() == Some(option));
        let draws = !OF_PAGES.contains(&name) && !WITHOUT_FIGURES.contains(&name);
        let count = OF_FIGURES.iter().filter(has).count();
        assert_eq!(count, if draws { OF_FIGURES.len() } else { 0 }, "{name}");
    }
}

#[test]
fn the_table_of_the_documents_is_this_one() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/options.md");
    if std::env::var_os("MOTIFORM_UPDATE").is_some() {
        std::fs::write(&path, page()).expect("the page is written");
    }
    let there = std::fs::read_to_string(&path).expect("docs/options.md");
    assert!(
        there == page(),
        "docs/options.md is another: MOTIFORM_UPDATE=1 cargo test --release -p motiform vocabulary"
    );
}
