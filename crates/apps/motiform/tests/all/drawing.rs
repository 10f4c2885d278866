//! Words, size and films of figures, as people ask for them.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Folder;
use std::fs;

const RUN: &str = "simulate tensor --preset fig5a --t-end 20 --dt-out 1 --out run";

#[test]
fn figures_take_a_title_and_a_width() {
    let folder = Folder::new();
    assert_eq!(folder.run(&format!("{RUN} --no-animation")).code, Some(0));
    let own = fs::read_to_string(folder.path("run/path.svg")).unwrap();
    let data = fs::read(folder.path("run/trajectory.parquet")).unwrap();
    let done = folder.run("figure run --no-animation --title Another --no-caption --width 86mm");
    assert_eq!((done.code, done.stderr.as_str()), (Some(0), ""));
    let other = fs::read_to_string(folder.path("run/path.svg")).unwrap();
    assert!(own.contains("in model units") && !other.contains("in model units"), "the caption is left out");
    assert!(!own.contains(">Another<") && other.contains(">Another<"));
    assert!(other.contains(" width=\"86mm\" height=\""));
    assert_eq!(fs::read(folder.path("run/trajectory.parquet")).unwrap(), data);
    let done = folder.run("figure run --width 86");
    assert_eq!(done.code, Some(2));
    assert!(done.stderr.contains("--width") && done.stderr.contains("such as 86mm"), "{}", done.stderr);
}

/// Branches, curves and scans take the same options, and what an option is not for is refused.
#[test]
fn every_figure_takes_the_options_of_style() {
    let folder = Folder::new();
    let style = "--width 86mm --title Another --no-caption";
    let along = "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5";
    folder.run(&format!("{along} --out b")).expect(0);
    folder.run(&format!("{along} --out styled {style}")).expect(0);
    folder.run(&format!("scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --out s {style}")).expect(0);
    let own = fs::read(folder.path("b/branches.svg")).unwrap();
    folder.run(&format!("figure b --out drawn --observable size {style}")).expect(0);
    assert_eq!(fs::read(folder.path("b/branches.svg")).unwrap(), own, "the figures of the result stay");
    for name in ["styled/branches", "styled/period", "s/_diagram", "drawn/branches", "drawn/period"] {
        let svg = fs::read_to_string(folder.path(&format!("{name}.svg"))).unwrap();
        assert!(svg.contains(" width=\"86mm\"") && svg.contains(">Another<"), "{name}");
        assert!(!svg.contains("all other parameters"), "{name} has a caption");
    }
    let size = fs::read_to_string(folder.path("drawn/branches.csv")).unwrap();
    assert!(size.lines().next().unwrap().contains("size"), "{size}");
    for (words, key) in
        [("b --radius 3", "--radius"), ("s --to 5", "--to"), ("s --observable size", "--observable")]
    {
        let done = folder.run(&format!("figure {words}")).expect(2);
        assert!(done.stderr.contains(key) && done.stderr.contains("leave it out"), "{}", done.stderr);
    }
    let done = folder.run("figure b s --out both").expect(2);
    assert!(done.stderr.contains("one folder at a time"), "{}", done.stderr);
}

/// A style for a journal leaves title and caption to the text, one for a slide the caption; what is given has the last word.
#[test]
fn styles_are_for_a_medium() {
    let folder = Folder::new();
    folder.run(&format!("{RUN} --no-animation --style journal")).expect(0);
    let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    let svg = read("run/path.svg");
    assert!(svg.contains(" width=\"86mm\"") && !svg.contains("in model units") && !svg.contains(">Zigzag"));
    let words = read("run/path.txt");
    assert!(words.starts_with("Zigzag motion\n") && words.contains("in model units"), "{words}");
    folder.run("figure run --no-animation --style slide --out slide").expect(0);
    let svg = read("slide/path.svg");
    assert!(
        svg.contains(" width=\"1920\"") && svg.contains(">Zigzag motion<") && !svg.contains("in model units")
    );
    folder.run("figure run --no-animation --style journal --width 120mm --title Mine --out mine").expect(0);
    let svg = read("mine/path.svg");
    assert!(svg.contains(" width=\"120mm\"") && svg.contains(">Mine<"));
}

/// Several results as one figure, each panel with its letter.
#[test]
fn panels_are_one_figure() {
    let folder = Folder::new();
    folder.run(&format!("{RUN} --no-animation")).expect(0);
    folder
        .run("scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --axis gamma=0.1:0.2:3 --out s --no-figures")
        .expect(0);
    folder.run("figure run run:series s --panels 3x1 --width 250mm --pdf --out all").expect(0);
    let svg = fs::read_to_string(folder.path("all/panels.svg")).unwrap();
    assert!(svg.contains(" width=\"250mm\"") && !svg.contains(">(d)<"));
    for words in
        [">(a)<", ">(b)<", ">(c)<", "(a) Zigzag motion.", "(c) Motions of the tensor model.", ">turning"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert!(fs::read(folder.path("all/panels.pdf")).unwrap().starts_with(b"%PDF"));
    assert!(fs::read_to_string(folder.path("all/panels.csv")).unwrap().contains("# (c)\nregime or line,"));
    for (words, why) in [
        ("run s --panels 1x1 --out no", "--panels"),
        ("run:speed s --panels 2x1 --out no", "it has path, series"),
        ("run s --panels 2x1", "--out"),
        ("run s --panels two --out no", "COLUMNSxROWS"),
        ("run s --panels 2x1 --width 50mm --out no", "fewer columns"),
        ("s s --panels 2x1 --to 5 --out no", "--to"),
    ] {
        let done = folder.run(&format!("figure {words}"));
        assert!(done.code != Some(0) && done.stderr.contains(why), "{words}: {}", done.stderr);
        assert!(!folder.path("no/panels.svg").exists(), "{words}");
    }
}

/// Speeds, periods and exponents of scans, branches, lives and statistics are converted like those of a body; parameters are not.
#[test]
fn results_of_every_kind_have_physical_units() {
    let folder = Folder::new();
    let number = |text: &str, before: &str| -> f64 {
        let rest = text.split(before).nth(1).unwrap_or_else(|| panic!("no {before} in {text}")).trim_start();
        rest.split(' ').next().unwrap().trim_end_matches([',', ')']).parse().unwrap()
    };
    let both = |command: &str, file: &str, label: &str| {
        let model = folder.run(&format!("{command} --out model")).expect(0);
        let physical = folder.run(&format!("{command} --units 20um,3min --out physical")).expect(0);
        let svg = fs::read_to_string(folder.path(&format!("physical/{file}.svg"))).unwrap();
        let plain = fs::read_to_string(folder.path(&format!("model/{file}.svg"))).unwrap();
        assert!(svg.contains(label) && !plain.contains(label), "{command}: {label}");
        assert!(!svg.contains("in model units") && plain.contains("in model units"), "{command}: caption");
        for name in ["model", "physical"] {
            fs::remove_dir_all(folder.path(name)).unwrap();
        }
        (model.stdout, physical.stdout)
    };
    let walk =
        "statistics tensor --set gamma=1 --set kappa2=2 --set kappa3=2 --noise 0.3 --t-end 100 --bodies 10";
    let (model, physical) = both(walk, "msd", "µm");
    let ratio = |before: &str| number(&physical, before) / number(&model, before);
    assert!((ratio("speed        mean ") - 20.0 / 3.0).abs() < 0.01, "{model}{physical}");
    assert!(
        (ratio("time of speed: ") - 3.0).abs() < 0.05 && physical.contains("of radius 3.979 µm"),
        "{physical}"
    );
    let zigzag = "continue tensor --preset fig5a --along kappa2=0.75:0.95 --branches 1";
    let (model, physical) = both(zigzag, "period", "period (min)");
    let ratio = number(&physical, "period ") / number(&model, "period ");
    assert!((ratio - 3.0).abs() < 1e-5 && physical.contains(" min  "), "{physical}");
    let kappa = |text: &str| number(text, "symmetry breaking ");
    assert_eq!(kappa(&model), kappa(&physical), "parameters stay those of the model");
    both("scan tensor --preset fig4 --axis kappa2=0.5:0.55:2", "_exponent", "1/min");
    let curve =
        "continue tensor --preset fig5a --along kappa2=0.85:0.95 --in kappa2,kappa3=0.1:0.2 --curve fold";
    let done = folder.run(&format!("{curve} --units 20um,3min")).expect(2);
    assert!(done.stderr.contains("both axes of this figure are parameters"), "{}", done.stderr);
}

/// The figures of a result are drawn again in the units of the result, where none are given: they went back to those of the model.
#[test]
fn results_keep_their_units() {
    let folder = Folder::new();
    let branches = "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5 --out b";
    let scan = "scan tensor --preset fig4 --axis kappa2=0.5:0.55:2 --out s";
    for (command, name, figures) in
        [(branches, "b", &["branches", "period"][..]), (scan, "s", &["_exponent", "_diagram"])]
    {
        folder.run(&format!("{command} --units 20um,3min")).expect(0);
        folder.run(&format!("figure {name} --out again-{name}")).expect(0);
        for figure in figures {
            let read =
                |at: &str| fs::read_to_string(folder.path(&format!("{at}{name}/{figure}.svg"))).unwrap();
            assert!(!read("").contains("in model units"), "{figure}");
            assert_eq!(read(""), read("again-"), "{figure}");
        }
    }
    folder.run("figure s --units 1um,1s --out other").expect(0);
    assert!(fs::read_to_string(folder.path("other/_exponent.svg")).unwrap().contains("of time 1 s"));
}

/// A map of undetermined cells says why, in the terminal and below the figure.
#[test]
fn undetermined_cells_have_a_reason() {
    let folder = Folder::new();
    let done = folder.run("scan tensor --preset fig4 --axis kappa2=0.1:1.6:2 --budget 1 --out s");
    let why = "no motion had established itself within the budget of 1.0";
    assert!(done.stdout.contains(&format!("2 rows undetermined: {why}")), "{}", done.stdout);
    let svg = fs::read_to_string(folder.path("s/_diagram.svg")).unwrap();
    assert!(svg.contains("Undetermined: no motion"), "{svg}");
}

/// A study that says what its units are has axes in these.
#[test]
fn axes_are_physical_where_units_are_given() {
    let folder = Folder::new();
    folder.run(&format!("{RUN} --no-animation --units 20um,2min")).expect(0);
    folder.run("figure run --no-animation --units 1um,1s --out other").expect(0);
    let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    let (path, series) = (read("run/path.svg"), read("run/series.svg"));
    assert!(path.contains("> (µm)<") && path.contains("unit of length 20 µm, of time 2 min"), "{path}");
    assert!(!path.contains("in model units") && read("other/path.svg").contains("of time 1 s"));
    assert!(series.contains(">(rad/min)<") && series.contains("| (µm/min)<"), "{series}");
    let done = folder.run("figure run --no-animation --units 20,2 --out no").expect(2);
    assert!(done.stderr.contains("20um,1min"), "{}", done.stderr);
}

/// An ffmpeg that writes what it read: `-i FROM` comes before the last word, the file to be written.
#[cfg(unix)]
const FFMPEG: &str = "#!/bin/sh
[ \"$1\" = -version ] && exit 0
while [ $# -gt 1 ]; do [ \"$1\" = -i ] && from=\"$2\"; shift; done
cp \"$from\" \"$1\"
";

#[cfg(unix)]
#[test]
fn films_are_made_by_ffmpeg() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let program = folder.path("bin/ffmpeg");
    fs::create_dir(folder.path("bin")).unwrap();
    fs::write(&program, FFMPEG).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let done = folder.bash(&format!("PATH=$PWD/bin:$PATH $motiform {RUN} --film mp4 --film gif"));
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let read = |name: &str| fs::read(folder.path(&format!("run/{name}"))).unwrap();
    assert_eq!(read("motion.mp4"), read("motion.png"));
    assert_eq!(read("motion.gif"), read("motion.png"));
    // without one nothing is computed, and the message says what to do
    let done = folder.bash(&format!("PATH=/nowhere $motiform {RUN}2 --film mp4"));
    assert_eq!(done.code, Some(2));
    assert!(done.stderr.contains("--film needs ffmpeg") && done.stderr.contains("apt-get install ffmpeg"));
    // one that fails costs the film alone
    fs::write(&program, "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\necho no encoder >&2; exit 1\n").unwrap();
    let done = folder.bash(&format!("PATH=$PWD/bin:$PATH $motiform {RUN}3 --film mp4"));
    assert_eq!(done.code, Some(2));
    assert!(done.stderr.contains("no encoder"), "{}", done.stderr);
    assert!(folder.path("run3/path.svg").exists() && folder.path("run3/manifest.json").exists());
}

/// No folder, a figure that a folder has not, one that is not asked for as a panel, and a layout without room: input, exit code 2.
#[test]
fn what_is_no_folder_of_figures_is_named() {
    let folder = Folder::new();
    folder.run("simulate tensor --preset fig5a --t-end 40 --transient 0 --no-figures --out run").expect(0);
    for (words, told) in [
        ("figure nothing", "`motiform simulate`, `scan`, `continue` or `atlas`"),
        ("figure run:foo", "there is no such figure; it has path"),
        ("figure run:path", "add --panels 1x1"),
        ("figure run:path run:series run --panels 3x1 --width 60mm --out wide", "mm on paper and has"),
    ] {
        let done = folder.run(words).expect(2);
        assert!(done.stderr.contains(told), "{words}: {}", done.stderr);
    }
    let short = "simulate tensor --preset fig5a --transient 0 --t-end 10 --dt-out 50 --out short";
    assert!(folder.run(short).expect(0).stderr.contains("no figure is drawn"));
}
