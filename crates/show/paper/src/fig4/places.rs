//! Motions found in a scan of the plane; and the motions that were measured before this project.

use crate::curves::Place;
use motiform_analysis::Regime;
use motiform_lab::scan::CellSummary;
use motiform_study::ScanPlan;

/// The cells of a scan over kappa2 and kappa3.
pub(super) fn places(plan: &ScanPlan, cells: &[CellSummary]) -> Vec<Place> {
    let place = |cell: &CellSummary| {
        let values = plan.axis_values(cell.cell);
        let regimes = cell.motions.iter().map(|motion| motion.regime).collect();
        Place { kappa2: values[0], kappa3: values[1], regimes }
    };
    cells.iter().map(place).collect()
}

/// The extent of a motion in the plane, and the number of its cells.
pub(super) struct Extent {
    pub(super) cells: usize,
    pub(super) kappa2: (f64, f64),
    pub(super) kappa3: (f64, f64),
}

impl Extent {
    pub(super) fn of(places: &[Place], regime: Regime) -> Self {
        Self::among(places, regime, |_| true)
    }

    /// Among the places that fulfil a condition.
    pub(super) fn among(places: &[Place], regime: Regime, that: impl Fn(&Place) -> bool) -> Self {
        let mut extent = Self {
            cells: 0,
            kappa2: (f64::INFINITY, f64::NEG_INFINITY),
            kappa3: (f64::INFINITY, f64::NEG_INFINITY),
        };
        for place in places.iter().filter(|place| place.regimes.contains(&regime) && that(place)) {
            extent.cells += 1;
            extent.kappa2 = (extent.kappa2.0.min(place.kappa2), extent.kappa2.1.max(place.kappa2));
            extent.kappa3 = (extent.kappa3.0.min(place.kappa3), extent.kappa3.1.max(place.kappa3));
        }
        extent
    }

    pub(super) fn words(&self, regime: Regime) -> String {
        if self.cells == 0 {
            return format!("{regime}: nowhere");
        }
        let range = |(low, high): (f64, f64)| {
            if high - low < 1e-9 { format!("= {low:.2}") } else { format!("from {low:.2} to {high:.2}") }
        };
        format!("{regime}: {} cells, κ_2 {}, κ_3 {}", self.cells, range(self.kappa2), range(self.kappa3))
    }
}

/// The measured motions: kappa3, and one letter for each kappa2 = 0.1, 0.2, ... 1.6. `x` is chaos that may blow up.
/// (0.5, 0.2), (1.2, 0.1) and (1.3, 0.1) are circular: what had looked quasi-periodic there were slow transients (decay
/// rates 0.004 to 0.009).
const MEASURED: [(f64, &str); 6] = [
    (1.0, "cccccccsssssssss"),
    (0.6, "ccccccccssssssss"),
    (0.4, "*cccccccccssssss"),
    (0.3, "**ccccccccccssss"),
    (0.2, "****cccccccccccs"),
    (0.1, "BBxx***zzzzccccc"),
];

/// The agreement of a scan with the measured motions.
pub(super) struct Agreement {
    pub(super) compared: usize,
    pub(super) found: usize,
    /// The places where the measured motion is not among those found, in words.
    pub(super) missing: Vec<String>,
}

pub(super) fn agreement(places: &[Place]) -> Agreement {
    let mut agreement = Agreement { compared: 0, found: 0, missing: Vec::new() };
    for (kappa3, row) in MEASURED {
        for (index, letter) in row.chars().enumerate() {
            let kappa2 = 0.1 * (index + 1) as f64;
            let near =
                |place: &&Place| (place.kappa2 - kappa2).abs() < 1e-9 && (place.kappa3 - kappa3).abs() < 1e-9;
            let Some(place) = places.iter().find(near) else { continue };
            agreement.compared += 1;
            if meant(letter).iter().any(|regime| place.regimes.contains(regime)) {
                agreement.found += 1;
            } else {
                let here: Vec<&str> = place.regimes.iter().map(|regime| regime.name()).collect();
                let was = meant(letter).first().map_or("", |regime| regime.name());
                agreement.missing.push(format!(
                    "({kappa2:.1}, {kappa3:.1}): measured {was}, found {}",
                    here.join(" and ")
                ));
            }
        }
    }
    agreement
}

/// The regimes that a letter stands for.
fn meant(letter: char) -> &'static [Regime] {
    match letter {
        's' => &[Regime::Straight],
        'c' => &[Regime::Circular],
        'z' => &[Regime::Zigzag],
        '*' => &[Regime::Chaotic],
        'B' => &[Regime::BlowUp],
        _ => &[Regime::Chaotic, Regime::BlowUp],
    }
}
