//! Statements about a cell, against what is true.

use super::laws::Law;
use motiform_cells::{CellFit, Fitted, PERSISTENT_WALK};
use motiform_inference::{Placement, Symmetry};

/// Distance, in half widths of a printed interval, beyond which a number is a confident error.
const FAR: f64 = 2.0;

/// Statements about cells: how many are right, missing and wrong.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub(super) cells: usize,
    pub(super) right: usize,
    pub(super) undecided: usize,
    /// Statements that are wrong.
    pub(super) wrong: Vec<String>,
    /// Printed intervals of coefficients, those that hold the truth and all: of the terms that are listed, of those of the law, and of
    /// the listed ones of cells that are in doubt (which are among the first).
    pub(super) held: [[usize; 2]; 3],
    /// Printed intervals of places, likewise.
    pub(super) placed: [usize; 2],
    /// Cells with a wrong statement.
    pub(super) cells_wrong: usize,
}

impl Tally {
    /// Judges a cell that follows a law; `coefficients`: whether they are true of the record.
    pub(super) fn judge(&mut self, fit: &CellFit, law: &Law, (motion, coefficients): (Option<&str>, bool)) {
        self.cells += 1;
        let before = self.wrong.len();
        let Ok(fitted) = &fit.fitted else {
            self.undecided += 1;
            return;
        };
        self.motion(fitted, motion, law.is_handed());
        self.symmetry(fitted, law.is_handed());
        if coefficients && !law.is_handed() {
            self.coefficients(fitted, law);
            self.place(fitted, law);
        }
        self.cells_wrong += usize::from(self.wrong.len() > before);
    }

    /// Judges a random walker: it has no law, no symmetry to lose and no place.
    pub(super) fn walker(&mut self, fit: &CellFit) {
        self.cells += 1;
        let before = self.wrong.len();
        let Ok(fitted) = &fit.fitted else {
            self.undecided += 1;
            return;
        };
        self.motion(fitted, Some(PERSISTENT_WALK), false);
        self.symmetry(fitted, false);
        if fitted.places.iter().any(|place| matches!(place, Placement::Placed(_))) {
            self.wrong.push("a random walk has a place".to_owned());
        }
        self.cells_wrong += usize::from(self.wrong.len() > before);
    }

    fn motion(&mut self, fitted: &Fitted, motion: Option<&str>, handed: bool) {
        match (fitted.motion_name(), motion) {
            ("undecided", _) => self.undecided += 1,
            (name, Some(motion)) if name == motion => self.right += 1,
            (_, None) if handed => self.right += 1,
            (name, motion) => self.wrong.push(format!("'{name}' for '{}'", motion.unwrap_or("no law"))),
        }
    }

    fn symmetry(&mut self, fitted: &Fitted, handed: bool) {
        match (fitted.symmetry(), handed) {
            (Symmetry::Handed, false) => {
                self.wrong.push(format!("handed, p = {:.0e}", fitted.handedness.p_value));
            }
            (Symmetry::Mirror, true) => {
                self.wrong.push(format!("mirror symmetric, p = {:.2}", fitted.handedness.p_value));
            }
            _ => {}
        }
    }

    /// All terms of the library, as the page and the command print them.
    fn coefficients(&mut self, fitted: &Fitted, law: &Law) {
        if fitted.no_intervals().is_some() || !fitted.model().converged() {
            return;
        }
        let doubted = !fitted.doubts.is_empty() || !fitted.is_identifiable();
        for coefficient in &fitted.whole.coefficients {
            let term = law.terms.iter().find(|term| term.name == coefficient.name);
            let truth = term.map_or(0.0, |term| term.value.re);
            let printed = fitted.over_sets(&coefficient.name);
            let over = printed.filter(|one| one.weight > 0.0);
            let [low, high] = printed.map_or([0.0; 2], |one| one.interval);
            let held = usize::from((low..=high).contains(&truth));
            let kinds = [over.is_some(), term.is_some(), over.is_some() && doubted];
            for (kind, counts) in kinds.into_iter().enumerate() {
                self.held[kind][0] += if counts { held } else { 0 };
                self.held[kind][1] += usize::from(counts);
            }
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            if (truth - middle).abs() > FAR * half && over.is_some() {
                let weight = over.map_or(0.0, |one| one.weight);
                self.wrong.push(format!(
                    "{}: {low:.4} to {high:.4} for {truth:.4}, weight {weight:.2}",
                    coefficient.name
                ));
            }
        }
    }

    fn place(&mut self, fitted: &Fitted, law: &Law) {
        for place in &fitted.places {
            let Placement::Placed(place) = place else { continue };
            for (coordinate, name) in place.coordinates.iter().zip(["z2: z2", "z3: z3"]) {
                let Some(term) = law.terms.iter().find(|term| term.name == name) else { continue };
                if !(coordinate.name == "kappa2" || coordinate.name == "kappa3") || law.radius < 0.5 {
                    continue; // the reduced model has other units
                }
                let (truth, found) = (-term.value.re, &coordinate.estimate);
                let [low, high] = found.interval;
                self.placed[0] += usize::from((low..=high).contains(&truth));
                self.placed[1] += 1;
                if (truth - found.value).abs() > FAR * 0.5 * (high - low) {
                    self.wrong.push(format!("{} {low:.3} to {high:.3} for {truth:.3}", coordinate.name));
                }
            }
        }
    }
}
