//! Phase diagrams: what is drawn for which grid, and what is refused.

use crate::drawing::drawing;
use crate::picture::Picture;
use motiform_figures::{
    Cell, ExpectedLine, Figure, FigureError, LineStyle, MapPlace, PhaseDiagram, PlaceMap, TrackPanel,
    TrackPanels, regime_mark,
};

fn cell(x: f64, y: f64, shares: &[(&str, f64)]) -> Cell {
    Cell { x, y, shares: shares.iter().map(|(name, share)| ((*name).to_owned(), *share)).collect() }
}

/// A grid of one motion, with two of them in the first cell.
fn diagram(columns: usize, rows: usize) -> PhaseDiagram {
    let (x, y) = ((0..columns).map(|i| i as f64).collect(), (0..rows).map(|i| 0.1 * i as f64).collect());
    let mut diagram = PhaseDiagram { x, y, x_label: "*κ*_2".into(), ..PhaseDiagram::default() };
    let places = diagram.y.iter().flat_map(|y| diagram.x.iter().map(move |x| (*x, *y)));
    diagram.cells = places.map(|(x, y)| cell(x, y, &[("zigzag", 1.0)])).collect();
    diagram.cells[0] = cell(0.0, 0.0, &[("circular", 0.75), ("straight", 0.25)]);
    diagram
}

fn strip(columns: usize) -> PhaseDiagram {
    PhaseDiagram { y: Vec::new(), ..diagram(columns, 1) }
}

fn text(diagram: &PhaseDiagram) -> String {
    diagram.svg().expect("a figure")
}

#[test]
fn no_diagram_holds_a_number_that_is_none() {
    let line = |points| ExpectedLine { label: "far".into(), style: LineStyle::Dotted, points };
    let mut far = diagram(3, 3);
    far.lines = vec![line(vec![[-1e99, -1e99], [1e99, 1e99]]), line(vec![[1.0, 1.0]]), line(vec![])];
    let all = [far, diagram(1, 2), diagram(2, 1), diagram(300, 2), strip(1), strip(130), diagram(50, 50)];
    for diagram in all {
        let svg = text(&diagram);
        for bad in ["NaN", "inf", "9223372"] {
            assert!(!drawing(&svg).contains(bad), "{bad} in {}", drawing(&svg));
        }
        assert_eq!(svg, text(&diagram), "same data, same bytes");
    }
}

/// The markers of rows at 0.001 to 10 stood between the values, and most could not be seen; a single value had a column of length 1.
#[test]
fn ticks_are_the_values_of_unequal_steps() {
    let of = |x: &[f64]| PhaseDiagram {
        x: x.to_vec(),
        cells: x.iter().map(|x| cell(*x, 0.0, &[("zigzag", 1.0)])).collect(),
        ..PhaseDiagram::default()
    };
    let listed = of(&[0.36, 0.4, 0.8]);
    let svg = text(&listed);
    assert!([">0.36<", ">0.4<", ">0.8<"].iter().all(|tick| svg.contains(tick)), "{svg}");
    assert!(!svg.contains(">0.6<") && listed.columns() == [true, false]);
    let geometric = of(&[0.001, 0.01, 0.1]);
    assert!(!text(&geometric).contains(">0.05<") && geometric.columns() == [false; 2]);
    let single = text(&of(&[0.9]));
    assert!(single.contains(">0.9<") && !single.contains(">1.4<") && !of(&[0.9]).columns()[0]);
    assert!(text(&of(&[0.4, 0.6, 0.8])).contains(">0.6<"));
}

#[test]
fn the_legend_names_what_is_present() {
    for mut diagram in [diagram(4, 3), diagram(64, 3)] {
        diagram.lines = vec![ExpectedLine { label: "Hopf".into(), style: LineStyle::Dashed, points: vec![] }];
        let svg = text(&diagram);
        for word in ["zigzag", "circular", "straight", "several motions", "Hopf"] {
            assert!(svg.contains(word), "{word}");
        }
        assert!(!svg.contains("chaotic") && !svg.contains("undetermined"));
        diagram.cells[0].shares = vec![("breathing".into(), 1.0)];
        let svg = text(&diagram);
        assert!(svg.contains("undetermined") && !svg.contains("several motions"));
    }
}

#[test]
fn small_grids_have_a_marker_a_cell_and_large_ones_a_picture() {
    let small = text(&diagram(40, 40));
    // one disc in the legend, one in the cell of two motions
    assert_eq!(drawing(&small).matches("<circle").count(), 2);
    assert!(!drawing(&small).contains("<image"));
    let large = text(&diagram(200, 200));
    assert!(
        drawing(&large).contains("<image") && drawing(&large).len() < 60_000,
        "{}",
        drawing(&large).len()
    );
}

#[test]
fn colours_take_their_share_of_the_area() {
    let count = |svg: &str, colour| Picture::of(svg).places(colour).len();
    let all = |n| PhaseDiagram {
        cells: diagram(n, n)
            .cells
            .iter()
            .map(|c| cell(c.x, c.y, &[("circular", 0.75), ("straight", 0.25)]))
            .collect(),
        ..diagram(n, n)
    };
    // a picture of 500 x 450 or 500 x 500 pixels
    let svg = text(&all(50));
    let (circular, straight) =
        (count(&svg, regime_mark("circular").area), count(&svg, regime_mark("straight").area));
    let share = straight as f64 / (circular + straight) as f64;
    assert!(
        circular + straight > 200_000 && (share - 0.25).abs() < 0.02,
        "{share} of {}",
        circular + straight
    );
    let mut svg = strip(10);
    svg.cells.iter_mut().for_each(|c| c.shares = vec![("circular".into(), 0.75), ("straight".into(), 0.25)]);
    let svg = text(&svg);
    let (circular, straight) =
        (count(&svg, regime_mark("circular").area), count(&svg, regime_mark("straight").area));
    let share = straight as f64 / (circular + straight) as f64;
    assert!((share - 0.25).abs() < 0.02, "{share}");
}

#[test]
fn the_first_cell_is_at_the_lower_left() {
    let mut diagram = diagram(50, 50);
    diagram.cells[0] = cell(0.0, 0.0, &[("chaotic", 1.0)]);
    let places = Picture::of(&text(&diagram)).places(regime_mark("chaotic").area);
    // beneath the legend
    let places: Vec<_> = places.into_iter().filter(|(_, y)| *y > 100).collect();
    assert!(places.len() > 50 && places.iter().all(|(x, y)| *x < 100 && *y > 400), "{places:?}");
}

#[test]
fn bad_diagrams_are_refused_with_the_place() {
    let with = |change: fn(&mut PhaseDiagram)| {
        let mut diagram = diagram(3, 2);
        change(&mut diagram);
        diagram.svg().expect_err("bad data")
    };
    assert!(matches!(with(|d| d.cells.clear()), FigureError::Empty { .. }));
    assert!(matches!(with(|d| d.x.clear()), FigureError::Empty { .. }));
    assert!(matches!(with(|d| d.x[1] = f64::NAN), FigureError::NotFinite { index: 1, .. }));
    assert!(matches!(with(|d| d.x[2] = 1.0), FigureError::NotIncreasing { index: 2, .. }));
    assert!(matches!(with(|d| d.cells[4].x = 1.4), FigureError::OffGrid { index: 4, .. }));
    assert!(matches!(with(|d| d.cells[4].x = f64::NAN), FigureError::OffGrid { index: 4, .. }));
    assert!(matches!(with(|d| d.cells[4].x = 0.0), FigureError::SameCell { index: 4 }));
    assert!(matches!(with(|d| d.cells[5].shares.clear()), FigureError::Shares { index: 5, .. }));
    assert!(matches!(with(|d| d.cells[5].shares[0].1 = f64::NAN), FigureError::Shares { index: 5, .. }));
    let negative = with(|d| d.cells[0].shares = vec![("zigzag".into(), 1.5), ("chaotic".into(), -0.5)]);
    assert_eq!(
        negative.to_string(),
        "the shares of cell number 0 add up to 1; give shares of at least 0 that add up to 1"
    );
    let line = |d: &mut PhaseDiagram| {
        d.lines = vec![ExpectedLine {
            label: String::new(),
            style: LineStyle::Solid,
            points: vec![[0.0, f64::INFINITY]],
        }];
    };
    assert!(matches!(with(line), FigureError::NotFinite { .. }));
}

#[test]
fn a_place_outside_of_the_diagram_widens_its_axes_and_regions_are_cut_off() {
    let cell = |x: f64, y: f64| Cell { x, y, shares: vec![("chaotic".into(), 1.0)] };
    let under = PhaseDiagram {
        x: vec![0.0, 1.0],
        y: vec![0.0, 1.0],
        cells: vec![cell(0.0, 0.0), cell(1.0, 0.0), cell(0.0, 1.0), cell(1.0, 1.0)],
        ..PhaseDiagram::default()
    };
    let place = |at: [f64; 2]| MapPlace {
        name: "cell 1".into(),
        at,
        region: vec![[at[0] - 90.0, at[1]], [at[0] + 90.0, at[1]]],
        cloud: vec![at],
    };
    let map = |at| PlaceMap { under: under.clone(), places: vec![place(at)], ..PlaceMap::default() };
    let inside = map([0.5, 0.5]).svg().expect("a figure");
    let outside = map([7.0, 0.5]).svg().expect("a figure");
    assert!(inside.contains("cell 1") && inside.contains("chaotic"));
    assert!(!inside.contains(">6<") && outside.contains(">6<"), "ticks");
    assert!(PlaceMap { under: under.clone(), ..PlaceMap::default() }.svg().is_err());
    assert!(map([f64::NAN, 0.0]).svg().is_err());
    assert!(Figure::data(&map([0.5, 0.5])).contains("cell 1,region"));
}

#[test]
fn tracks_have_one_scale_and_a_bar_of_a_round_length() {
    let panel = |size: f64| TrackPanel {
        name: format!("size {size}"),
        path: vec![vec![[0.0, 0.0], [size, size]]],
        outlines: vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]],
    };
    let figure = |panels| TrackPanels { unit: "um".into(), columns: 4, panels, ..TrackPanels::default() };
    let svg = figure(vec![panel(100.0), panel(10.0)]).svg().expect("a figure");
    assert!(svg.contains("20 um") || svg.contains("50 um"), "{}", &svg[svg.len() - 900..]);
    assert!(figure(Vec::new()).svg().is_err());
    let empty = TrackPanel { name: String::new(), path: Vec::new(), outlines: Vec::new() };
    assert!(figure(vec![empty]).svg().is_err());
    // a single point has no size, but a picture
    let still = TrackPanel { name: "rest".into(), path: vec![vec![[1.0, 1.0]]], outlines: Vec::new() };
    let svg = figure(vec![still]).svg().expect("a figure");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}
