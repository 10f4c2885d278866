//! Which motion occurs where.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::figure;
use super::places::{Extent, Place, agreement, places};
use crate::Error;
use crate::draw::phase_diagram;
use crate::figures::PhaseDiagram;
use crate::report::{Claim, Section};
use crate::scan::Axis;
use motiform_analysis::Regime;

/// Chaos and zigzag are said to need a slow triangle: a smaller rate than this. The text gives no number (it names 0.1, and
/// the figure is not at hand); this is the lower 60 % of the plane, and the extent found stands in every claim.
const SLOW: f64 = 0.65;

/// Zigzag is said to need a large kappa2: above this.
const LARGE: f64 = 0.55;

/// Of the measured motions at least this share must be found again; the rest may be a matter of the initial states.
const AGREE: f64 = 0.9;

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let axes = context.choose(
        ["kappa2=0.05:1.6:32", "kappa3=0.1:1:19"],
        ["kappa2=0.1:1.6:16", "kappa3=0.1,0.2,0.3,0.4,0.6,1"],
    );
    let study = context.preset("fig4", |study| {
        study.scan.axes = axes.iter().map(|text| Axis::parse(text)).collect::<Result<_, _>>()?;
        study.scan.samples = context.choose(4, 2);
        Ok(())
    })?;
    let (plan, cells) = context.scan("fig4", &study)?;
    let caption = format!(
        "{} random initial states per cell. Blow-up is what the paper marks × and calls a numerical instability.",
        study.scan.samples
    );
    let drawn = phase_diagram(&plan, &cells)?;
    let svg = PhaseDiagram {
        title: "Motions of the full tensor model".to_owned(),
        caption: vec![caption],
        ..drawn
    }
    .svg()?;
    section.figures.push(figure(
        svg,
        "**Fig. 4(a), computed.** Each cell is classified by mathematics, never by eye; cells with more than one motion are \
         striped by the shares of the initial states.",
    ));
    let places = places(&plan, &cells);
    section.claims.extend([kinds(&places), order(&places), zigzag(&places), chaos(&places)]);
    section.claims.push(measured(&places));
    section.claims.extend(windows(&places));
    section.claims.extend(quasi_periodic(&places));
    Ok(())
}

const HOW: &str = "classification of every cell: eigenvalues of the relative equilibrium, Newton's method on the return, \
Lyapunov exponent with its error, blow-up time";

fn kinds(places: &[Place]) -> Claim {
    let kinds = [Regime::Straight, Regime::Circular, Regime::Zigzag, Regime::Chaotic, Regime::BlowUp];
    let extents = kinds.map(|regime| (regime, Extent::of(places, regime)));
    let unknown = Extent::of(places, Regime::Undetermined).cells;
    let words: Vec<String> = extents.iter().map(|(regime, extent)| extent.words(*regime)).collect();
    claim(
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
            "The zigzag is a motion of large κ_2.",
            format!("Also {}.", small.words(Regime::Zigzag)),
            HOW,
            "along the edge of the chaos lie windows of periodic motion, as is usual; some of these orbits are mirror symmetric, \
             that is, zigzags of another shape and a longer period, often beside a chaotic set",
            small.kappa3.1 < SLOW,
        )
    })
}

fn chaos(places: &[Place]) -> Claim {
    let extent = Extent::of(places, Regime::Chaotic);
    claim(
        "The motion is chaotic for the smaller values of κ_2 and small κ_3.",
        format!("{}. The text names κ_3 = 0.1.", extent.words(Regime::Chaotic)),
        "the cells with λ_1 above twice its 95 % error; small: κ_3 below 0.65, the lower 60 % of the plane (the text gives no \
         number)",
        extent.cells > 0 && extent.kappa3.1 < SLOW,
    )
}

fn measured(places: &[Place]) -> Claim {
    let agreement = agreement(places);
    let share = agreement.found as f64 / agreement.compared as f64;
    let missing = if agreement.missing.is_empty() {
        String::new()
    } else {
        format!(" Not at (κ_2, κ_3) = {}.", agreement.missing.join("; "))
    };
    claim(
        "(Measured before this project, by independent programs: a table of motions at 16 × 6 places.)",
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
    let says = "The figure's symbols are squares, circles, stars, triangles and ×: no quasi-periodic motion.";
    (extent.cells > 0).then(|| {
        differs(
            says,
            format!("{}.", extent.words(Regime::QuasiPeriodic)),
            HOW,
            "between chaos or zigzag and circular motion lie narrow strips in which the shape repeats with a net rotation, \
             which draws a rosette; on a coarse diagram they pass for circular or chaotic motion",
            true,
        )
    })
}
