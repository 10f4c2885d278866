//! The field of view in words.

use super::{Correction, FieldOfView, Flow};
use crate::Units;
use motiform_inference::PValue;
use motiform_statistics::{four_digits, with_error};
use motiform_study::Dimension;

/// Jumps that are listed.
const MOST_JUMPS: usize = 4;

impl FieldOfView {
    /// The findings, name by name: the same on pages and in text.
    pub fn in_words(&self, units: &Units) -> Vec<(&'static str, String)> {
        let mut rows = Vec::new();
        if let Some(drift) = self.drift {
            let [x, y] = [0, 1].map(|k| with_error(drift.velocity[k], drift.velocity_error[k]));
            let verdict = match (drift.is_seen(), self.is_corrected(Correction::Drift)) {
                (false, _) => "none is seen",
                (true, true) => "subtracted",
                (true, false) => {
                    "the cells drift together (stage, flow, or a common direction); the correction 'drift' subtracts it"
                }
            };
            rows.push((
                "drift",
                format!("({x}, {y}) {}, {}: {verdict}", units.unit(Dimension::SPEED), PValue(drift.p_value)),
            ));
        }
        if self.drift.is_none() && (1..3).contains(&self.cells) {
            let words =
                "not tested: fewer than three cells do not tell a drift of the stage from their own motion";
            rows.push(("drift", words.to_owned()));
        }
        if let Some(flow) = self.flow.filter(Flow::is_seen) {
            let [[xx, xy], [yx, yy]] = flow.gradient;
            let [turning, widening, shear] =
                [0.5 * (yx - xy), 0.5 * (xx + yy), libm::hypot(0.5 * (xx - yy), 0.5 * (xy + yx))]
                    .map(four_digits);
            let words = format!(
                "velocities differ from place to place (turning {turning}, widening {widening}, shear {shear} {}), {}: a flow, a colony \
                 that spreads, walls all around, or images that turn or change their scale; it is in all numbers of paths",
                units.unit(Dimension::RATE),
                PValue(flow.p_value)
            );
            rows.push(("flow", words));
        }
        if let Some(change) = self.magnification {
            let words = format!(
                "lengths of all cells change by a factor of {} at frame {}, and stay: another magnification, another threshold of the \
                 segmentation, or cells that all shrink or swell; numbers of the whole record mix both: read the frames before and after \
                 by themselves",
                four_digits(change.factor),
                change.frame
            );
            rows.push(("magnification", words));
        }
        if !self.jumps.is_empty() {
            rows.push(("stage jumps", self.jumps_in_words(units)));
        }
        if let Some(jitter) = &self.jitter {
            let verdict = match (jitter.is_seen(), self.is_corrected(Correction::Jitter)) {
                (false, _) => "none is seen".to_owned(),
                (true, true) => {
                    format!("{:.0} % of its variance subtracted", 100.0 * jitter.recovered.min(1.0))
                }
                (true, false) => {
                    "cells of a frame are displaced together; the correction 'jitter' subtracts it".to_owned()
                }
            };
            // p is that of displacements in common; where their size is 0 there are none, whatever it is
            let size = match jitter.deviation {
                0.0 => format!("0 {}, as of cells that move independently", units.length),
                deviation => {
                    format!("{} {}, {}", four_digits(deviation), units.length, PValue(jitter.p_value))
                }
            };
            rows.push(("jitter", format!("{size}: {verdict}")));
        }
        if let Some(pixel) = self.pixel {
            let words = format!(
                "outlines follow pixels of {} {}; edges of pixels lengthen perimeters by up to 27 %, contours at half level by 5 %",
                four_digits(pixel),
                units.length
            );
            rows.push(("pixels", words));
        }
        rows
    }

    fn jumps_in_words(&self, units: &Units) -> String {
        let one = |jump: &super::StageJump| {
            let error = jump.error.filter(|error| *error > 0.0);
            let [x, y] =
                jump.displacement.map(|x| error.map_or_else(|| four_digits(x), |error| with_error(x, error)));
            format!("({x}, {y}) {} at frame {}", units.length, jump.frame)
        };
        let mut words = self.jumps.iter().take(MOST_JUMPS).map(one).collect::<Vec<_>>().join(", ");
        if let Some(more) = self.jumps.len().checked_sub(MOST_JUMPS).filter(|more| *more > 0) {
            words += &format!(" and {more} more");
        }
        let verdict = match self.is_corrected(Correction::Jumps) {
            true => "subtracted; fits use the pieces between them",
            false => "names and fits use the pieces between them; the correction 'jumps' subtracts them",
        };
        format!("{words}: {verdict}")
    }
}
