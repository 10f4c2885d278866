//! Area, perimeter and form over the frames that are seen.

use super::{SIZE, averaged};
use motiform_statistics::Measured;
use motiform_tracks::Form;
use motiform_tracks::modes::{CellModes, FrameModes};
use serde::Serialize;

/// A number of the outline over time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FormNumber {
    /// Mean over frames; its interval is that of the mean of a correlated series, from 16 frames on.
    pub mean: Measured,
    /// Standard deviation over frames, errors included; `None` with one frame.
    pub scatter: Option<f64>,
}

/// The outline over time; `None` where no frame is seen. Definitions: [`motiform_tracks::Form`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Forms {
    /// Area (length^2).
    pub area: Option<FormNumber>,
    /// Length of the outline (length).
    pub perimeter: Option<FormNumber>,
    /// Longer over shorter axis.
    pub aspect_ratio: Option<FormNumber>,
    /// Area over that of the convex hull.
    pub solidity: Option<FormNumber>,
    /// 4 pi area/perimeter^2.
    pub circularity: Option<FormNumber>,
}

impl Forms {
    pub(super) fn of(modes: &CellModes) -> Self {
        let seen: Vec<(&FrameModes, Form)> = modes
            .frames
            .iter()
            .filter(|frame| frame.is_seen())
            .filter_map(|frame| Some((frame, frame.form?)))
            .collect();
        let number = |range: [f64; 2], of: &dyn Fn(&(&FrameModes, Form)) -> f64| {
            let values: Vec<f64> = seen.iter().map(of).collect();
            Some(FormNumber { mean: averaged(&values, range)?, scatter: scatter(&values) })
        };
        let share = [0.0, 1.0];
        Self {
            area: number(SIZE, &|(frame, _)| frame.area),
            perimeter: number(SIZE, &|(frame, _)| frame.perimeter),
            aspect_ratio: number([1.0, f64::INFINITY], &|(_, form)| form.aspect_ratio),
            solidity: number(share, &|(_, form)| form.solidity),
            circularity: number(share, &|(_, form)| form.circularity),
        }
    }
}

fn scatter(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (values.len() > 1).then(|| (squares / (n - 1.0)).sqrt())
}
