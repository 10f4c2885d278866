//! The options of figures, on every command that draws: they act on every figure, those in pages too, or are refused.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Folder, names};
use crate::fits::outlines;
use crate::observe::table;
use std::fs;

const STYLE: &str = "--width 86mm --title X --no-caption";

/// Commands, each with the folder that it writes and its exit code. Their default captions have the word `CAPTION`.
const COMMANDS: [(&str, &str, i32); 7] = [
    ("simulate tensor --preset fig5a --t-end 20 --dt-out 1 --no-animation --out run", "run", 0),
    ("figure run --no-animation --out drawn", "drawn", 0),
    (
        "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5 --out branches",
        "branches",
        0,
    ),
    (
        "continue tensor --preset fig4 --set kappa3=0.3 --set kappa2=1.5 --along kappa2=0.9:1.6 \
         --in kappa2,kappa3=0.29:0.31 --curve pitchfork --branches 1 --points 60 --out curves",
        "curves",
        0,
    ),
    ("scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --out scan", "scan", 0),
    (
        "lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.1,0.2 --samples 6 --until 400 --out lives",
        "lives",
        1,
    ),
    ("statistics tensor --preset fig5a --noise 0.1 --t-end 40 --bodies 4 --out statistics", "statistics", 0),
];

/// A word of captions of figures in model units.
const CAPTION: &str = "in model units";

/// The drawings of a folder: name and text.
fn drawings(folder: &Folder, name: &str) -> Vec<(String, String)> {
    let all = names(&folder.path(name)).into_iter().filter(|file| file.ends_with(".svg"));
    all.map(|file| (file.clone(), fs::read_to_string(folder.path(&format!("{name}/{file}"))).unwrap()))
        .collect()
}

/// The drawings of a page, and the words below each.
fn of_page(folder: &Folder, page: &str) -> Vec<(String, String)> {
    let html = fs::read_to_string(folder.path(page)).unwrap();
    let figures = html.split("<figure ").skip(1).map(|rest| rest.split("</figure>").next().unwrap());
    let figures = figures.filter(|figure| figure.contains("<svg role=\"img\""));
    figures
        .map(|figure| {
            let (drawing, words) = figure.split_once("<figcaption>").unwrap();
            (drawing.to_owned(), words.split("</figcaption>").next().unwrap().to_owned())
        })
        .collect()
}

fn check_drawing(name: &str, svg: &str) {
    let tag = svg.split("<svg ").nth(1).and_then(|rest| rest.split('>').next()).unwrap();
    assert!(tag.contains(" width=\"86mm\""), "{name}: {tag}");
    assert!(svg.contains(">X<"), "{name} has another title");
    assert!(!svg.contains(CAPTION), "{name} has a caption");
}

fn check_page(folder: &Folder, page: &str) {
    let all = of_page(folder, page);
    assert!(!all.is_empty(), "{page} has no figure");
    for (drawing, words) in all {
        check_drawing(page, &drawing);
        assert!(words.starts_with("<b>Figure ") && words.ends_with(".</b>"), "{page}: {words}");
    }
}

#[test]
fn every_command_that_draws_takes_them() {
    let folder = Folder::new();
    for (command, out, code) in COMMANDS {
        folder.run(&format!("{command} {STYLE}")).expect(code);
        let all = drawings(&folder, out);
        assert!(!all.is_empty(), "{command}");
        all.iter().for_each(|(name, svg)| check_drawing(&format!("{out}/{name}"), svg));
    }
    let own = folder.run("figure run --no-animation --out own");
    assert_eq!(own.code, Some(0));
    let own = drawings(&folder, "own");
    assert!(own.iter().all(|(_, svg)| svg.contains(CAPTION)), "captions have the word that is looked for");
}

#[test]
fn figures_of_pages_take_them() {
    let folder = Folder::new();
    folder.write("cells.csv", &outlines(2));
    let data = "cells.csv --interval 1 --pixel-size 1";
    folder.run(&format!("observe {data} --out seen --pdf {STYLE}")).expect(1);
    check_page(&folder, "seen/report-cell-0.html");
    let drawn = of_page(&folder, "seen/report-cell-0.html").len();
    let files = |ending: &str| {
        let all = names(&folder.path("seen")).into_iter();
        all.filter(|name| name.starts_with("report-cell-0-figure-") && name.ends_with(ending)).count()
    };
    assert_eq!([files(".pdf"), files(".svg"), files(".png")], [drawn; 3]);
    let fit = format!("fit {data} --draws 3 --modes 2 --simulations 19 --out fitted");
    let code = folder.run(&format!("{fit} {STYLE}")).code;
    assert!(matches!(code, Some(0 | 1)), "{code:?}");
    check_page(&folder, "fitted/report-cell-0.html");
    for (name, svg) in drawings(&folder, "fitted") {
        check_drawing(&name, &svg);
    }
    assert_eq!(names(&folder.path("fitted")).iter().filter(|name| name.ends_with(".pdf")).count(), 0);
    let done = folder.run(&format!("{fit} --resume {STYLE}")).expect(2);
    assert!(done.stderr.contains("--width") && done.stderr.contains("--force"), "{}", done.stderr);
    folder.run(
        "atlas fig1 --axis kappa2=-0.2:0.2:5 --axis gamma=-0.16:0.12:5 --lines 0 --samples 1 --out plane \
                --width 86mm --title X --no-caption",
    );
    check_page(&folder, "plane/report.html");
    drawings(&folder, "plane").iter().for_each(|(name, svg)| check_drawing(name, svg));
}

/// The figures of the reproduction, and those of a finished chapter in another style.
#[test]
fn figures_of_the_reproduction_take_them() {
    let folder = Folder::new();
    folder.run("reproduce fig3 --quick --out paper").expect(0);
    let own = drawings(&folder, "paper");
    assert!(own.iter().all(|(_, svg)| !svg.contains(" width=\"86mm\"")) && own.len() > 2);
    folder.run(&format!("reproduce fig3 --quick --out paper --pdf {STYLE}")).expect(0);
    let styled = drawings(&folder, "paper");
    assert_eq!(styled.len(), own.len());
    styled.iter().for_each(|(name, svg)| check_drawing(name, svg));
    check_page(&folder, "paper/report.html");
    assert!(fs::read(folder.path("paper/figure-3b.pdf")).unwrap().starts_with(b"%PDF"));
    folder.run("reproduce fig3 --quick --out paper --style journal").expect(0);
    let words = fs::read_to_string(folder.path("paper/figure-3b.txt")).unwrap();
    assert!(words.starts_with("Return map") && words.contains("open arcs"), "{words}");
    let page = of_page(&folder, "paper/report.html");
    assert!(page.iter().any(|(_, below)| below.contains("open arcs") && below.contains("<br>Return map")));
}

/// Where nothing is drawn an option of figures is a mistake, and costs no computing.
#[test]
fn they_are_refused_where_nothing_is_drawn() {
    let folder = Folder::new();
    folder.write("cells.csv", &table(&["a"]));
    for (command, option, remedy) in [
        ("simulate tensor --preset fig5a --no-figures", "--width 86mm", "--no-figures"),
        ("simulate tensor --preset fig5a --out run.csv", "--title X", "a single table"),
        ("simulate tensor --preset fig5a --json", "--no-caption", "--json"),
        ("scan tensor --preset fig1 --axis kappa2=0.1:0.2:3 --no-figures", "--pdf", "--no-figures"),
        ("atlas fig1 --no-figures", "--style slide", "--no-figures"),
        ("continue tensor --preset fig5a --along kappa2=0.8:0.9 --json", "--width 86mm", "--json"),
        ("continue tensor --preset fig5a --along kappa2=0.8:0.9 --no-figures", "--title X", "--no-figures"),
        ("lifetimes tensor --preset fig4 --axis kappa2=0.1,0.2", "--width 86mm", "--out DIR"),
        ("statistics tensor --preset fig5a", "--no-caption", "--out DIR"),
        ("observe cells.csv", "--width 86mm", "--out DIR"),
        ("observe cells.csv --out seen --no-report", "--pdf", "--no-report"),
        ("fit cells.csv", "--title X", "--out DIR"),
    ] {
        let done = folder.run(&format!("{command} {option}")).expect_error(2);
        let name = option.split(' ').next().unwrap();
        assert!(done.stderr.contains(name) && done.stderr.contains(remedy), "{command}: {}", done.stderr);
    }
    assert_eq!(folder.names(), ["cells.csv"], "nothing is written");
}
