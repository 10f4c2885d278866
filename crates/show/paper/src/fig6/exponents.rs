//! The largest Lyapunov exponent through the second window.

use super::super::context::Context;
use super::lengths::{modes_for, study};
use motiform_analysis::Estimate;
use motiform_figures::{Chart, Drawn, ErrorBarSeries, Measured};
use motiform_study::Error;
use motiform_study::quantity::motion::LAMBDA_1;

/// Hundredths of the lengths.
const FULL: [u32; 10] = [2120, 2130, 2140, 2150, 2160, 2170, 2180, 2185, 2190, 2200];
const QUICK: [u32; 2] = [2160, 2180];

/// Exponents by length.
pub(super) struct Exponents {
    found: Vec<(f64, Estimate)>,
    span: f64,
}

impl Exponents {
    pub(super) fn find(context: &Context<'_>) -> Result<Self, Error> {
        let lengths = context.choose(FULL.to_vec(), QUICK.to_vec());
        let span = context.choose(2e4, 6e3);
        let transient = context.choose(6e3, 2e3);
        let one = |hundredths: &u32| {
            let length = f64::from(*hundredths) / 100.0;
            let found = context.lyapunov(&study(length, modes_for(length))?, 1, (transient, span))?;
            Ok(found.exponents.first().map(|exponent| (length, *exponent)))
        };
        let found: Vec<Option<(f64, Estimate)>> = context.each(&lengths, one)?;
        Ok(Self { found: found.into_iter().flatten().collect(), span })
    }

    pub(super) fn at(&self, length: f64) -> Option<Estimate> {
        self.found.iter().find(|entry| (entry.0 - length).abs() < 1e-9).map(|entry| entry.1)
    }

    pub(super) fn drawn(&self, context: &Context<'_>) -> Result<Drawn, Error> {
        let point = |(x, e): &(f64, Estimate)| Measured { x: *x, y: e.value, error: e.error };
        let figure = Chart {
            caption: vec![format!(
                "Averaged over {} model time from a random start; bars are 95 % errors.",
                self.span
            )],
            x_label: "length *L*".to_owned(),
            y_label: LAMBDA_1.symbol.to_owned(),
            zero_line: true,
            ..Chart::default()
        }
        .with([ErrorBarSeries {
            label: String::new(),
            points: self.found.iter().map(point).collect(),
            joined: false,
        }]);
        context.sheet(figure)
    }
}
