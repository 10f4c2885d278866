//! Results computed from the recorded motion: strips for the page, files for export.

use super::returns::{self, Returns};
use super::setting::Setting;
use crate::export::{Made, Maker};
use crate::motion::History;
use crate::protocol::{Export, Section, SectionKind, Spectrum, Strips};
use motiform_dynamics::Outcome;
use motiform_lab::draw;
use motiform_lab::live::{Record, dataset, spectra};
use motiform_store::columns::to_csv;
use motiform_study::{Dataset, Study};

/// The motion since the last change.
pub(super) struct Look<'l> {
    pub(super) setting: &'l Setting,
    pub(super) record: &'l Record,
    pub(super) outcome: Option<Outcome>,
}

impl Look<'_> {
    fn returns(&self, section: Section) -> Returns {
        returns::of(self.record, self.setting.model(), self.setting.return_map(), section)
    }

    fn dataset(&self, section: Section) -> Option<Dataset> {
        let crossings = match section.section {
            SectionKind::Path => self.returns(section).crossings,
            SectionKind::Speed => None,
        };
        let plan = self.setting.plan();
        // An unknown model is none of ours: nothing to make a file of.
        dataset(plan, self.setting.model(), self.record, self.outcome, crossings).ok().flatten()
    }
}

/// Spectrum and return map, in the form of the protocol.
pub(super) fn strips(look: &Look<'_>, section: Section) -> Strips {
    let spectra = spectra(look.record, look.setting.model(), look.setting.plan().computation.dt_out);
    let returns = look.returns(section);
    let curve = |(name, symbol, power): &(&'static str, &'static str, Vec<f64>)| Spectrum {
        name,
        symbol,
        power: shorts(power),
    };
    Strips {
        revision: look.setting.revision(),
        samples: look.record.len(),
        frequencies: shorts(&spectra.frequencies),
        spectra: spectra.curves.iter().map(curve).collect(),
        returns: returns.told(section.section),
    }
}

/// Enough digits for a picture.
pub(super) const DIGITS: usize = 6;

fn shorts(values: &[f64]) -> Vec<f64> {
    values.iter().map(|&value| short(value, DIGITS)).collect()
}

/// A number with this many significant digits, for a short text.
pub(crate) fn short(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// The study file.
pub(super) fn study(mut study: Study) -> Maker {
    // What the preset says of its motion may be true no longer.
    study.about = String::new();
    Box::new(move || Ok(Some(Made::Bytes(study.to_toml()?.into_bytes()))))
}

/// The figure of the exponents so far.
pub(super) fn exponents(look: &Look<'_>, history: History) -> Maker {
    let plan = look.setting.plan().clone();
    Box::new(move || Ok(draw::live::exponents(&plan, &history)?.map(Made::Svg)))
}

/// Makes a file of the motion; `None` for an unknown name.
pub(super) fn maker(look: &Look<'_>, export: &Export) -> Option<Maker> {
    let section = Section { section: export.section, y: export.y };
    let plan = look.setting.plan().clone();
    let (subject, ending) = export.what.split_once('.')?;
    let svg = matches!(ending, "svg" | "png");
    Some(match (subject, ending) {
        ("spectrum", _) if svg => {
            let spectra = spectra(look.record, look.setting.model(), plan.computation.dt_out);
            Box::new(move || Ok(draw::live::spectrum(&plan, &spectra)?.map(Made::Svg)))
        }
        ("return-map", _) if svg => {
            let Returns { values, symbol, what, .. } = look.returns(section);
            Box::new(move || Ok(draw::live::return_map(&plan, &values, symbol, &what)?.map(Made::Svg)))
        }
        ("path" | "series", _) if svg => {
            let (dataset, name) = (look.dataset(section), subject.to_owned());
            Box::new(move || match dataset {
                Some(dataset) => Ok(draw::still(&dataset, &name)?.map(Made::Svg)),
                None => Ok(None),
            })
        }
        ("motion", "csv") => {
            let dataset = look.dataset(section);
            Box::new(move || Ok(dataset.map(|dataset| Made::Bytes(to_csv(&dataset.trajectory.columns)))))
        }
        ("body", "apng") => {
            let dataset = look.dataset(section);
            Box::new(move || match dataset {
                Some(dataset) => Ok(draw::film(&dataset)?.map(Made::Bytes)),
                None => Ok(None),
            })
        }
        _ => return None,
    })
}
