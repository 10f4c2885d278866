//! The phase diagram.

use super::super::claims::{check, claim, differs};
use super::super::context::Context;
use super::figure;
use super::places::{Extent, agreement, places};
use crate::curves::{Curves, Place};
use motiform_analysis::Regime;
use motiform_dynamics::sample::ascending;
use motiform_figures::PhaseDiagram;
use motiform_figures::report::{Claim, Section};
use motiform_lab::draw::phase_diagram;
use motiform_lab::scan::Axis;
use motiform_study::Error;

/// The relaxation rate of the triangle above which only circular and straight motion are expected. The paper
/// gives no number; other motions were found up to 0.4.
const SLOW: f64 = 0.65;

/// The row that the text names for chaos, and the `kappa2` below which its cells shall be chaotic or blow up: the paper's
/// exponent is positive below 0.8, in steps of 0.1 up to 0.7.
const NAMED: f64 = 0.1;
const SMALLER: f64 = 0.7;

/// A second chaos, beside circular motion, lies above this `kappa2`: see the claims on the exponent.
const SECOND: f64 = 1.0;

/// Zigzag is said to need a large kappa2: above this.
const LARGE: f64 = 0.55;

/// Of the measured motions at least this share must be found again; the rest may be a matter of the initial states.
const AGREE: f64 = 0.9;

/// Cells about the arch of the zigzags.
const ARCH: [&str; 2] = ["kappa2=0.65:1.25:25", "kappa3=0.05:0.15:11"];
const ARCH_QUICK: [&str; 2] = ["kappa2=0.65:1.25:9", "kappa3=0.06:0.14:5"];

pub(super) fn add(context: &Context<'_>, section: &mut Section, curves: &Curves) -> Result<(), Error> {
    let axes = context.choose(
        ["kappa2=0.05:1.6:32", "kappa3=0.1:1:19"],
        ["kappa2=0.1:1.6:16", "kappa3=0.1,0.2,0.3,0.4,0.6,1"],
    );
    let places = scan(
        context,
        section,
        curves,
        &Lattice {
            name: "fig4",
            axes,
            samples: context.choose(4, 2),
            title: "Motions of the full tensor model",
            says: "Blow-up is what the paper marks × and calls a numerical instability.",
            caption: "**Fig. 4(a), computed.** Each cell is classified by mathematics, never by eye; cells with more than one motion are \
         striped by the shares of the initial states. Lines: special points of branches, continued through the plane.",
        },
    )?;
    let arch = scan(
        context,
        section,
        curves,
        &Lattice {
            name: "fig4-arch",
            axes: context.choose(ARCH, ARCH_QUICK),
            samples: 1,
            title: "Motions about the zigzag",
            says: "Where the three-fold deformation relaxes slowly (small κ_3).",
            caption: "The lower edge of Fig. 4(a), with the curves along which zigzags change.",
        },
    )?;
    section.claims.extend([kinds(&places), order(&places), zigzag(&places), chaos(&places)]);
    section.claims.extend(wedge(&places));
    section.claims.push(measured(&places));
    section.claims.extend(windows(&places));
    section.claims.extend(quasi_periodic(&places));
    section.claims.extend(curves.claims(context, &places, &arch));
    Ok(())
}

/// A lattice of cells over the plane, and the words of its figure.
struct Lattice {
    name: &'static str,
    axes: [&'static str; 2],
    /// Initial states of each cell.
    samples: u64,
    title: &'static str,
    says: &'static str,
    caption: &'static str,
}

/// Computes and draws a lattice over the plane, under the curves.
fn scan(
    context: &Context<'_>,
    section: &mut Section,
    curves: &Curves,
    lattice: &Lattice,
) -> Result<Vec<Place>, Error> {
    let Lattice { name, axes, samples, title, says, caption } = *lattice;
    let study = context.preset("fig4", |study| {
        study.scan.axes = axes.iter().map(|text| Axis::parse(text)).collect::<Result<_, _>>()?;
        study.scan.samples = samples;
        Ok(())
    })?;
    let (plan, cells) = context.scan(name, &study)?;
    let svg = PhaseDiagram {
        title: title.to_owned(),
        caption: vec![format!("Random initial states per cell: {samples}. {says}")],
        lines: curves.lines(),
        ..phase_diagram(&plan, &cells)?
    };
    let drawn = figure(context.sheet(svg)?, caption);
    section.figures.push(if name == "fig4" { drawn.of_paper("4(a)") } else { drawn });
    Ok(places(&plan, &cells))
}

const HOW: &str = "classification of every cell: eigenvalues of the relative equilibrium, Newton's method on the return, \
Lyapunov exponent with its error, blow-up time";

fn kinds(places: &[Place]) -> Claim {
    let kinds = [Regime::Straight, Regime::Circular, Regime::Zigzag, Regime::Chaotic, Regime::BlowUp];
    let extents = kinds.map(|regime| (regime, Extent::of(places, regime)));
    let unknown = Extent::of(places, Regime::Undetermined).cells;
    let words: Vec<String> = extents.iter().map(|(regime, extent)| extent.words(*regime)).collect();
    claim(
        &[111, 135],
        "The plane holds straight, circular, zigzag and chaotic motion, and a region ×.",
        format!("{}; {unknown} cells with an undetermined start.", words.join("; ")),
        HOW,
        extents.iter().all(|(_, extent)| extent.cells > 0),
    )
}

/// At fast triangles there are only two motions, circular at small kappa2 and straight at large.
fn order(places: &[Place]) -> Claim {
    let fast: Vec<&Place> = places.iter().filter(|place| place.kappa3 > SLOW).collect();
    let two = fast
        .iter()
        .all(|place| place.regimes.iter().all(|r| matches!(r, Regime::Straight | Regime::Circular)));
    let inverted = fast.iter().any(|a| {
        let circular_beyond =
            |b: &&Place| b.kappa3 == a.kappa3 && b.kappa2 > a.kappa2 && b.regimes == [Regime::Circular];
        a.regimes == [Regime::Straight] && fast.iter().any(circular_beyond)
    });
    claim(
        &[112],
        "Where κ_3 is not small the motion is circular or straight (circles and squares).",
        format!(
            "Of {} cells with κ_3 > {SLOW}, {} hold only these two; {}.",
            fast.len(),
            if two { "all" } else { "not all" },
            if inverted {
                "straight cells lie left of circular ones"
            } else {
                "along each row circular motion comes first, then straight motion"
            }
        ),
        HOW,
        two && !inverted && !fast.is_empty(),
    )
}

fn zigzag(places: &[Place]) -> Claim {
    let large = Extent::among(places, Regime::Zigzag, |place| place.kappa2 > LARGE);
    claim(
        &[117],
        "A zigzag motion is observed when κ_2 is large and κ_3 is small.",
        format!("{}.", large.words(Regime::Zigzag)),
        "the cells at κ_2 > 0.55 whose shape returns to its mirror image half a period later, net rotation 0; small: κ_3 below \
         0.25",
        large.cells > 0 && large.kappa3.1 < 0.25,
    )
}

/// Zigzags elsewhere, if any: windows in the chaos.
fn windows(places: &[Place]) -> Option<Claim> {
    let small = Extent::among(places, Regime::Zigzag, |place| place.kappa2 <= LARGE);
    (small.cells > 0).then(|| {
        differs(
            &[117],
            "The zigzag is a motion of large κ_2.",
            format!("Also {}.", small.words(Regime::Zigzag)),
            HOW,
            "along the edge of the chaos lie windows of periodic motion, as is usual; some of these orbits are mirror symmetric, \
             that is, zigzags of another shape and a longer period, often beside a chaotic set",
            small.kappa3.1 < SLOW,
        )
    })
}

/// The row that the text names: chaotic (or blowing up) from its left end on, and regular beyond.
fn chaos(places: &[Place]) -> Claim {
    let row = || places.iter().filter(|place| (place.kappa3 - NAMED).abs() < 1e-9);
    let wild = |place: &&Place| place.has(Regime::Chaotic) || place.has(Regime::BlowUp);
    let regular =
        |regime: &Regime| !matches!(regime, Regime::Chaotic | Regime::BlowUp | Regime::Undetermined);
    let below = || row().filter(|place| place.kappa2 < SMALLER + 1e-9);
    let beyond = || row().filter(|place| place.kappa2 > 0.8 - 1e-9 && place.kappa2 < SECOND + 1e-9);
    let chaotic = Extent::among(places, Regime::Chaotic, |place| {
        (place.kappa3 - NAMED).abs() < 1e-9 && place.kappa2 < SECOND + 1e-9
    });
    claim(
        &[113],
        "In the region of the stars, for the smaller values of κ_2 and for κ_3 = 0.1, the motion becomes chaotic.",
        format!(
            "At κ_3 = {NAMED} {} of {} cells up to κ_2 = {SMALLER} hold chaos or blow up, and {} of {} from 0.8 to {SECOND}; {}.",
            below().filter(wild).count(),
            below().count(),
            beyond().filter(wild).count(),
            beyond().count(),
            chaotic.words(Regime::Chaotic)
        ),
        "the cells of this row, named by the classifier; all of the smaller ones, the larger ones hold \
         a regular motion, and at least three show chaos that lasts",
        chaotic.cells >= 3
            && below().all(|place| wild(&place))
            && beyond().count() > 0
            && beyond().all(|place| place.regimes.iter().any(regular)),
    )
}

/// Chaos in other rows, which the text does not name: how far it reaches in each.
fn wedge(places: &[Place]) -> Option<Claim> {
    let mut rows: Vec<f64> = places.iter().map(|place| place.kappa3).collect();
    ascending(&mut rows);
    rows.dedup();
    let end = |row: &f64| {
        let extent =
            Extent::among(places, Regime::Chaotic, |place| place.kappa3 == *row && place.kappa2 < SECOND);
        (extent.cells > 0).then_some((*row, extent.kappa2.1))
    };
    let ends: Vec<(f64, f64)> = rows.iter().filter_map(end).collect();
    let words: Vec<String> = ends.iter().map(|(row, end)| format!("{end:.2} at κ_3 = {row:.2}")).collect();
    let widest = (0..ends.len()).max_by(|&a, &b| ends[a].1.total_cmp(&ends[b].1));
    (ends.len() > 1).then(|| {
        differs(
            &[113],
            "The text names chaos for κ_3 = 0.1 alone.",
            format!("Chaos also in other rows: up to κ_2 = {}.", words.join(", ")),
            "the largest κ_2 with chaos in each row (up to κ_2 = 1): it is largest in a row with κ_3 below 0.25, and above that row \
             no row reaches further than the one before",
            "the region narrows with κ_3: where the triangle relaxes faster, κ_2 has to be smaller",
            widest.is_some_and(|widest| ends[widest].0 < 0.25 && ends[widest..].is_sorted_by(|a, b| a.1 >= b.1)),
        )
    })
}

fn measured(places: &[Place]) -> Claim {
    let agreement = agreement(places);
    let share = agreement.found as f64 / agreement.compared as f64;
    let missing = if agreement.missing.is_empty() {
        String::new()
    } else {
        format!(" Not at (κ_2, κ_3) = {}.", agreement.missing.join("; "))
    };
    check(
        "Measured before this project, by independent programs: a table of motions at 16 × 6 places.",
        format!(
            "At {} of {} places the table's motion is among those found.{missing}",
            agreement.found, agreement.compared
        ),
        "share of at least 90 %: where motions coexist, random starts decide which one is met",
        share >= AGREE,
    )
}

/// Present or not, it is a motion that the paper does not list here.
fn quasi_periodic(places: &[Place]) -> Option<Claim> {
    let extent = Extent::of(places, Regime::QuasiPeriodic);
    let beside = |place: &Place| {
        let near = |other: &&Place| {
            (other.kappa2 - place.kappa2).abs() < 0.11 && (other.kappa3 - place.kappa3).abs() < 0.11
        };
        places.iter().filter(near).any(|other| other.has(Regime::Chaotic) || other.has(Regime::Zigzag))
    };
    let all = || places.iter().filter(|place| place.has(Regime::QuasiPeriodic));
    let says = "The figure's symbols are squares, circles, stars, triangles and ×: no quasi-periodic motion.";
    (extent.cells > 0).then(|| {
        differs(
            &[111],
            says,
            format!(
                "{}; {} of them beside a cell with chaos or a zigzag.",
                extent.words(Regime::QuasiPeriodic),
                all().filter(|place| beside(place)).count()
            ),
            "classification of every cell; all of these cells have chaos or a zigzag within 0.1, and they are fewer than a tenth of all",
            "between the chaos and the zigzag lie narrow strips in which the zigzag has lost its mirror symmetry: it rotates slowly, to \
             the left or to the right, which draws a rosette; on a coarse diagram it passes for a zigzag or for chaos",
            all().all(beside) && 10 * extent.cells < places.len(),
        )
    })
}
