//! Pages of a simulated cell and of records without results: every link leads somewhere, every number is there.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::recordings::{Shape, Walker, tracks};
use motiform_cells::report::{Case, pages};
use motiform_cells::{CellFit, CellTrack, FitOptions, Observation, Sample, fit_cells, fit_together, observe};
use motiform_dynamics::Normal;
use motiform_lab::draw::FigureFormat;
use motiform_lab::simulate::simulate;
use motiform_study::{RunPlan, presets::find_any};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::synthetic::{Synthetic, blur};
use motiform_tracks::{Cell, Outline, Tracks};

const FRAMES: usize = 400;

/// Outlines of the chaotic body of Fig. 5, in um and s.
fn outlines() -> Vec<Outline> {
    let mut study = find_any("fig5b", "tensor").unwrap();
    study.run.transient = 200.0;
    study.run.dt_out = 0.5;
    study.run.t_end = 0.5 * (FRAMES - 1) as f64;
    study.run.noise = 0.01;
    let dataset = simulate(&RunPlan::new(&study).unwrap(), &()).unwrap();
    let column = |name: &str| dataset.trajectory.get(name).unwrap();
    let mut normal = Normal::new(7, 0);
    let frame = |k: usize| {
        let z = [["s11", "s12"], ["u111", "u222"]].map(|names| names.map(|name| 0.5 * column(name)[k]));
        let z = vec![[z[0][0], -z[0][1]], z[1]];
        let body = Synthetic { centre: ["x", "y"].map(|name| column(name)[k]), r0: 2.0, z };
        let mut points = body.vertices(48, 0.0);
        blur(&mut points, 0.02, || normal.next());
        Outline { frame: i64::try_from(k).unwrap(), t: 0.5 * k as f64, points, missing: 0 }
    };
    (0..FRAMES).map(frame).collect()
}

fn sample() -> Sample {
    let all = outlines();
    let cell = |name: &str, frames: Vec<Outline>| Cell { name: name.to_owned(), frames };
    let few = all[..12].to_vec();
    let tracks = Tracks {
        cells: vec![cell("a*_1", all), cell("few & <b>", few), cell("none", Vec::new())],
        length_unit: "um".to_owned(),
        time_unit: "s".to_owned(),
        y_down: Some(true),
        image: None,
        files: Vec::new(),
        notes: Vec::new(),
    };
    Sample::of_tracks(tracks, &ModeOptions::default())
}

fn drawn(sample: &Sample, fits: &[CellFit]) -> Vec<File> {
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let found: Vec<Observation> = cells.iter().map(|cell| observe(cell)).collect();
    let cases: Vec<Case<'_>> = cells
        .into_iter()
        .zip(&found)
        .map(|(cell, observation)| Case {
            cell,
            observation,
            fit: fits.iter().find(|fit| fit.name == cell.name),
        })
        .collect();
    written(sample, &cases, None)
}

/// The name and content of a page.
type File = (String, Vec<u8>);

/// All pages, that of the data set, which is written last, first.
fn written(sample: &Sample, cases: &[Case<'_>], together: Option<&CellFit>) -> Vec<File> {
    let files = std::sync::Mutex::new(Vec::new());
    let write = |name: &str, bytes: &[u8]| {
        files.lock().unwrap().push((name.to_owned(), bytes.to_vec()));
        Ok(())
    };
    assert!(pages(sample, cases, together, 2, &FigureFormat::default(), &(), &write).unwrap());
    let mut files: Vec<File> = files.into_inner().unwrap();
    let index = files.pop().unwrap();
    files.sort();
    files.insert(0, index);
    files
}

/// A page without the data of its fonts and pictures, which are no words.
fn words(html: &str) -> String {
    let mut parts = html.split("data:");
    let mut text = parts.next().unwrap().to_owned();
    parts.for_each(|part| text += &part[part.find(['"', ')', '<']).unwrap()..]);
    text
}

/// The targets of links in a page.
fn links(html: &str) -> Vec<&str> {
    html.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

fn check(files: &[File]) {
    for (name, bytes) in files {
        let html = &words(std::str::from_utf8(bytes).unwrap());
        for link in links(html).into_iter().filter(|link| !link.is_empty()) {
            match link.strip_prefix('#') {
                Some(anchor) => assert!(html.contains(&format!("id=\"{anchor}\"")), "{name}: {link}"),
                None => assert!(files.iter().any(|file| file.0 == link), "{name}: {link}"),
            }
        }
        let blanks = ["\"></td>", "\">-</td>", "\">−</td>", "\">–</td>"];
        for bad in ["NaN", "inf ", "<b>&", "few & <b>"].into_iter().chain(blanks) {
            let before =
                html.split_once(bad).map(|(before, _)| before.chars().rev().take(200).collect::<Vec<_>>());
            let before = before.map(|before| before.into_iter().rev().collect::<String>());
            assert!(before.is_none(), "{name}: {bad} after {before:?}");
        }
    }
}

#[test]
fn a_fitted_cell_has_its_motion_place_and_simulations_and_what_is_missing_is_said() {
    let sample = sample();
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let options = FitOptions { simulations: 39, draws: 20, drift: false, ..FitOptions::default() };
    let fits: Vec<CellFit> = fit_cells(&cells, &options, 2, &()).unwrap().into_iter().flatten().collect();
    let (pages, pictures): (Vec<File>, Vec<File>) =
        drawn(&sample, &fits).into_iter().partition(|file| file.0.ends_with(".html"));
    let names = |files: &[File]| files.iter().map(|file| file.0.clone()).collect::<Vec<_>>();
    let expected =
        ["report.html", "report-cell-a-_1.html", "report-cell-few----b-.html", "report-cell-none.html"];
    assert_eq!(names(&pages), expected);
    assert_eq!(
        names(&pictures),
        ["paths-cell-a-_1.png", "paths-cell-a-_1.svg"],
        "of the fit that was simulated"
    );
    check(&pages);
    let page = |k: usize| std::str::from_utf8(&pages[k].1).unwrap();
    assert!(page(0).contains("speed (µm/s)") && page(0).contains("aspect ratio"));
    // wider tables run off a page of 1200 pixels
    let columns = page(0).split("<table").skip(1).map(|table| table.matches("scope=\"col\"").count());
    assert!(columns.max().unwrap() <= 7);
    for words in [
        "Cell a*_1: chaotic",
        "plane of Fig. 4",
        "kappa2",
        "statistics",
        "autocorrelation of the velocity",
        "z2: z1* z3",
        "turns of the shape",
        "0-1 test",
        "weak form",
        "p of white noise",
    ] {
        assert!(page(1).contains(words), "{words}");
    }
    // times of reasons have their unit
    let reason = page(1)
        .split("at the longest lag ")
        .nth(1)
        .map(|rest| rest.split_whitespace().take(2).collect::<Vec<_>>());
    assert!(reason.is_none_or(|words| words[1].starts_with('s')), "a lag without a unit");
    assert!(
        page(1).contains("*κ*") || page(1).contains("<i>κ</i><sub>2</sub>"),
        "the place in the paper's notation"
    );
    assert!(page(2).contains("undecided") && page(2).contains("12 frames count"));
    assert!(page(3).contains("No fit"));
    let long = page(1);
    assert!(long.matches("<svg ").count() > 8);
    assert_eq!(long.matches("@font-face").count(), 2, "upright and italic, once");
    assert!(long.len() < 500_000, "{} bytes", long.len());
}

#[test]
fn cells_without_fits_have_pages_too_and_the_watch_stops_the_drawing() {
    struct Stop;
    impl motiform_dynamics::Watch for Stop {
        fn stopped(&self) -> bool {
            true
        }
    }
    let sample = sample();
    let files = drawn(&sample, &[]);
    check(&files);
    assert!(!std::str::from_utf8(&files[0].1).unwrap().contains("#d-motion-of-the-fit"));
    let cell = &sample.cells[0];
    let observation = observe(cell);
    let cases = [Case { cell, observation: &observation, fit: None }];
    let write = |name: &str, _: &[u8]| panic!("{name} is written");
    assert!(!pages(&sample, &cases, None, 1, &FigureFormat::default(), &Stop, &write).unwrap());
}

#[test]
fn one_law_for_all_cells_is_on_the_first_page() {
    let mut sample = sample();
    let (first, second) = (&sample.tracks.cells[0].frames[..150], &sample.tracks.cells[0].frames[200..350]);
    let cell = |name: &str, frames: &[Outline]| Cell { name: name.to_owned(), frames: frames.to_vec() };
    sample.tracks.cells = vec![cell("one", first), cell("two", second)];
    let sample = Sample::of_tracks(sample.tracks, &ModeOptions::default());
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let options = FitOptions { draws: 4, drift: false, together: true, ..FitOptions::default() };
    let fit = fit_together(&cells, &options, &()).unwrap();
    let found: Vec<Observation> = cells.iter().map(|cell| observe(cell)).collect();
    let cases: Vec<Case<'_>> = cells
        .into_iter()
        .zip(&found)
        .map(|(cell, observation)| Case { cell, observation, fit: None })
        .collect();
    let files = written(&sample, &cases, Some(&fit));
    assert_eq!(files.len(), 3);
    let page = std::str::from_utf8(&files[0].1).unwrap();
    for words in [
        "One law for all cells",
        "error between cells",
        " cell-together.toml",
        "<i>z</i><sub>1</sub><sup>*</sup> <i>z</i><sub>2</sub>",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

/// Rods have no modes, and numbers of every frame: the first page says of how many.
#[test]
fn the_first_page_counts_the_frames_of_its_numbers() {
    let rod = Walker { speed: 0.5, persistence: 5.0, shape: Shape::Rod, frames: 77, noise: 0.001 };
    let sample = Sample::of_tracks(tracks(vec![rod.outlines(3)]), &ModeOptions::default());
    assert_eq!(sample.cells[0].frames(), 0);
    let files = drawn(&sample, &[]);
    assert!(std::str::from_utf8(&files[0].1).unwrap().contains(">77</td>"));
}
