//! `motiform observe`: exit codes, and outlines that are written again.

use crate::common::Folder;
use std::fmt::Write;

/// A table of cells that do not move: ellipses of 16 vertices in 5 frames.
pub(crate) fn table(cells: &[&str]) -> String {
    let mut text = "cell,frame,i,x,y\n".to_owned();
    for (number, name) in cells.iter().enumerate() {
        for (frame, i) in (0..5).flat_map(|frame| (0..16).map(move |i| (frame, i))) {
            let angle = f64::from(i) / 16.0 * std::f64::consts::TAU;
            let (x, y) = (30.0 * number as f64 + 9.0 * libm::cos(angle), 8.0 * libm::sin(angle));
            _ = writeln!(text, "{name},{frame},{i},{x},{y}");
        }
    }
    text
}

#[test]
fn outlines_are_written_for_other_programs() {
    let folder = Folder::new();
    folder.write("cells.csv", &table(&["a", "b"]));
    let words = "observe cells.csv --pixel-size 0.5 --interval 2";
    let text = folder.run(&format!("{words} --write-outlines again.csv")).expect(1).stdout;
    assert!(text.contains("written            again.csv"), "{text}");
    // a row of each label: those of a path of 13 frames and more are in the golden output
    let rows = text.lines().skip(1).filter(|line| !line.is_empty() && !line.starts_with(' '));
    rows.for_each(|line| assert_eq!(line.as_bytes()[18], b' ', "{line}"));
    let half = folder.run("observe cells.csv --pixel-size 0.5 --interval 2 --json").expect(1).json();
    let again = folder.run("observe again.csv --pixel-size 1 --interval 2 --json").expect(1).json();
    assert_eq!(half["cells"], again["cells"]);

    folder.run(&format!("{words} --cell b --write-outlines b.txt")).expect(1);
    let b = folder.run("observe b.txt --json").expect(1).json();
    assert_eq!(b["cells"][0]["measures"], half["cells"][1]["measures"]);
}

#[test]
fn files_that_cannot_be_written_are_named() {
    let folder = Folder::new();
    folder.write("cells.csv", &table(&["a", "b"]));
    folder.write("there.csv", "x");
    for (words, problem) in [
        ("--write-outlines cells.xml", "end the name in one of these"),
        ("--write-outlines there.csv", "--force"),
        ("--write-outlines both.txt --pixel-size 1 --interval 1", "there are 2: choose one"),
        ("--write-outlines a.txt --cell a", "give pixel size and interval"),
    ] {
        let done = folder.run(&format!("observe cells.csv {words}")).expect(2);
        let error = done.stderr.lines().last().unwrap_or_default(); // after warnings about units
        assert!(error.starts_with("error: ") && error.contains(problem), "{words}: {error}");
        assert_eq!(done.stdout, "");
    }
    let refused = folder.run("observe cells.csv --write-outlines there.csv --force").expect(2);
    assert!(refused.stderr.contains("it is not replaced"), "{}", refused.stderr);
    for force in ["", "--force"] {
        folder.run(&format!("observe cells.csv --write-outlines new.csv {force}")).expect(1);
    }
    assert_eq!(folder.names(), [".new.csv.inventory", "cells.csv", "new.csv", "there.csv"]);
}

/// 1 is for cells that are undecided, and nothing else: a file that cannot be written is an error like bad input.
#[test]
fn a_failed_write_is_not_an_undecided_cell() {
    let folder = Folder::new();
    folder.write("cells.csv", &table(&["a", "b"]));
    let words = "observe cells.csv --pixel-size 0.5 --interval 2";
    folder.run(words).expect(1);
    for (limit, line) in [
        ("", "--json > /dev/full"),
        ("ulimit -f 0;", "--out seen"),
        ("ulimit -f 1;", "--out seen"),
        ("ulimit -f 0;", "--write-outlines again.csv"),
        ("ulimit -f 1;", "--write-outlines again.csv"),
    ] {
        let done = folder.bash(&format!("trap '' XFSZ; {limit} exec $motiform {words} {line}")).expect(2);
        let error = done.stderr.lines().last().unwrap_or_default();
        assert!(
            error.starts_with("error: writing ") && !error.contains(".partial"),
            "{limit} {line}: {error}"
        );
        assert_eq!(
            (done.stdout.as_str(), folder.names()),
            ("", vec!["cells.csv".to_owned()]),
            "{limit} {line}"
        );
    }
}

/// Cells that do not move have displacements of 0, and no turning for that reason; the help names every format.
#[test]
fn reasons_and_formats_are_named() {
    let folder = Folder::new();
    // octagons of whole numbers about (0, 0), of changing size: repeated outlines would not count
    let mut rows = "cell,frame,i,x,y\n".to_owned();
    for frame in 0..9 {
        let (a, b) = (20 + frame % 3, 8);
        let corners = [[a, -b], [a, b], [b, a], [-b, a], [-a, b], [-a, -b], [-b, -a], [b, -a]];
        for (i, [x, y]) in corners.into_iter().enumerate() {
            _ = writeln!(rows, "a,{frame},{i},{x},{y}");
        }
    }
    folder.write("cells.csv", &rows);
    let text = folder.run("observe cells.csv --pixel-size 0.5 --interval 2").expect(1).stdout;
    assert!(text.contains("directionality, turning cosine, turning rate: every displacement is 0"), "{text}");
    for command in ["observe", "fit"] {
        let help = folder.run(&format!("{command} --help")).expect(0).stdout;
        for words in ["label masks", "wkt or masks"] {
            let flat = help.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(flat.contains(words), "{command}: {words}");
        }
    }
}
