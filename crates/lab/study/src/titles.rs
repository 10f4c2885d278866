//! Titles of figures: as typed, otherwise from the verdict, otherwise from the parameters. Never from the
//! motion of a preset with modified
//! parameters ([`Study::set`] removes its title).

use crate::plan::Computation;
use crate::{Dataset, Manifest, Study, presets};
use motiform_models::ModelInfo;

/// More parameters than this do not fit into a title.
const MOST: usize = 3;

/// Title of the figures of a run: the model with the parameters that differ from its preset (or from the
/// model's defaults), if they are
/// few: `Tensor model: kappa2 = 0.5`; with a verdict `Circular motion: kappa2 = 0.5`.
pub(crate) fn of_run(run: &Computation, name: &str, regime: Option<&str>) -> String {
    let model = format!("{} model", capital(run.model.as_str()));
    let changed = changed(run, name);
    let motion = regime.map(|regime| match regime {
        "motionless" => "Motionless body".to_owned(),
        name => format!("{} motion", capital(name)),
    });
    match (motion, changed.is_empty() || changed.len() > MOST) {
        (None, true) => model,
        (None, false) => format!("{model}: {}", changed.join(", ")),
        (Some(motion), true) => format!("{motion} of the {} model", run.model),
        (Some(motion), false) => format!("{motion}: {}", changed.join(", ")),
    }
}

/// The parameters that differ from the preset of this name, or from the model's defaults, as `symbol = value`.
fn changed(run: &Computation, name: &str) -> Vec<String> {
    let Ok(info) = run.model.info() else { return Vec::new() };
    let bare = presets::find(info, name).unwrap_or_else(|_| Study::of_model(info));
    let values = bare.values().unwrap_or_default().into_iter().zip(run.parameters.values());
    let specs = info.parameters().iter().zip(values).filter(|(_, (then, now))| then != now);
    specs.map(|(spec, (_, now))| format!("{}\u{a0}=\u{a0}{}", spec.symbol, number(now))).collect()
}

impl Dataset {
    /// Title of its figures: that of its manifest.
    pub fn title(&self) -> String {
        self.manifest.title()
    }
}

impl Manifest {
    /// Title of its figures: as typed, otherwise from the regime of its motion, otherwise from its parameters.
    pub fn title(&self) -> String {
        let (plan, regime) = (&self.plan, self.regime.as_deref());
        if plan.title.is_empty() { of_run(&plan.computation, &plan.name, regime) } else { plan.title.clone() }
    }
}

/// A number as people write it: `0.9`, `-1`, `10^{-9}`, `2.5×10^{6}`.
pub fn number(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) {
        let text = format!("{x:.6}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    let text = format!("{x:.3e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    match mantissa {
        "1" => format!("10^{{{exponent}}}"),
        "-1" => format!("-10^{{{exponent}}}"),
        _ => format!("{mantissa}×10^{{{exponent}}}"),
    }
}

/// Title of a scan: as typed, unless it is that of a preset, which describes a single motion.
pub(crate) fn of_scan(study: &Study, info: &ModelInfo) -> String {
    if study.title.is_empty() || presets::says(info.name, &study.title) {
        of_motions(info.name)
    } else {
        study.title.clone()
    }
}

/// Title of the figures of the motions of a model over a plane.
pub(crate) fn of_motions(model: &str) -> String {
    format!("Motions of the {model} model")
}

/// The same with a capital letter.
pub fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
