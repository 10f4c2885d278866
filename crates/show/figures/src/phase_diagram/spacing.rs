//! The places of a diagram's values along an axis: every cell has its centre at its value.

use super::super::axes::AxisKind;
use super::PhaseDiagram;
use std::borrow::Cow;

/// Steps that differ by a smaller part are equal up to rounding.
const EQUAL: f64 = 1e-6;

/// The division of an axis for cells of one size about their values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Spacing {
    /// Equal steps: a linear axis.
    Even,
    /// Equal ratios: a logarithmic axis.
    Geometric,
    /// Any others, and a single value: one column for each value.
    Listed(Vec<f64>),
}

impl Spacing {
    /// That of increasing values.
    pub(super) fn of(values: &[f64]) -> Self {
        let equal = |places: &[f64]| {
            let steps: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
            steps.iter().all(|step| (step - steps[0]).abs() <= EQUAL * steps[0])
        };
        let logarithms: Vec<f64> = values.iter().map(|value| libm::log10(*value)).collect();
        if values.len() != 1 && equal(values) {
            Self::Even
        } else if values.len() > 1 && values[0] > 0.0 && equal(&logarithms) {
            Self::Geometric
        } else {
            Self::Listed(values.to_vec())
        }
    }

    pub(crate) fn kind(&self) -> AxisKind {
        AxisKind::of(*self == Self::Geometric)
    }

    /// The values whose columns are numbered, if they are.
    pub(crate) fn listed(&self) -> Option<&[f64]> {
        match self {
            Self::Listed(values) => Some(values),
            _ => None,
        }
    }

    /// The place of a value; on an axis of columns between those of its neighbours.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        match self {
            Self::Even | Self::Geometric => self.kind().place(value),
            Self::Listed(values) => Some(column(values, value)),
        }
    }
}

/// The number of a value's column, and between two values the part of the step that lies before it.
fn column(values: &[f64], value: f64) -> f64 {
    let Some(last) = values.len().checked_sub(2) else { return 0.0 };
    let before = values.partition_point(|known| *known <= value).saturating_sub(1).min(last);
    before as f64 + (value - values[before]) / (values[before + 1] - values[before])
}

impl PhaseDiagram {
    /// The axes on which the values stand in columns of one width, so that distances along them mean nothing: across and upwards.
    pub fn columns(&self) -> [bool; 2] {
        self.spacings().map(|spacing| spacing.listed().is_some_and(|values| values.len() > 1))
    }

    pub(crate) fn spacings(&self) -> [Spacing; 2] {
        [&self.x[..], if self.y.len() < 2 { &[] } else { &self.y }].map(Spacing::of)
    }

    /// The diagram with places instead of values.
    pub(crate) fn placed(&self, [across, upwards]: &[Spacing; 2]) -> Cow<'_, Self> {
        if [across, upwards] == [&Spacing::Even; 2] {
            return Cow::Borrowed(self);
        }
        let mut placed = self.clone();
        let place = |spacing: &Spacing, value: f64| spacing.place(value).unwrap_or(value);
        placed.x.iter_mut().for_each(|x| *x = place(across, *x));
        placed.y.iter_mut().for_each(|y| *y = place(upwards, *y));
        for cell in &mut placed.cells {
            (cell.x, cell.y) = (place(across, cell.x), place(upwards, cell.y));
        }
        for line in &mut placed.lines {
            let points =
                line.points.iter().filter_map(|[x, y]| Some([across.place(*x)?, upwards.place(*y)?]));
            line.points = points.collect();
        }
        Cow::Owned(placed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_axis_of_their_steps() {
        assert_eq!(Spacing::of(&[0.1, 0.2, 0.1 + 0.2]), Spacing::Even);
        assert_eq!(Spacing::of(&[1.0, 3.0]), Spacing::Even);
        assert_eq!(Spacing::of(&[]), Spacing::Even);
        assert_eq!(Spacing::of(&[0.001, 0.01, 0.1, 1.0]), Spacing::Geometric);
        for list in [&[0.36, 0.4, 0.8][..], &[-1.0, 0.0, 10.0], &[0.9]] {
            assert_eq!(Spacing::of(list), Spacing::Listed(list.to_vec()));
        }
        let columns = Spacing::of(&[0.36, 0.4, 0.8]);
        let near = |value: f64, place: f64| (columns.place(value).unwrap_or(f64::NAN) - place).abs() < 1e-9;
        assert!(near(0.36, 0.0) && near(0.4, 1.0) && near(0.8, 2.0) && near(0.6, 1.5) && near(1.2, 3.0));
    }
}
