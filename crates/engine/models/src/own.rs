//! Models of one's own: an implementation of [`Model`] in Rust, made known by name, so that studies, scans,
//! branches and figures take it as they take those that are built in.

use crate::registry::{Display, Source};
use crate::{Error, MODELS, ModelInfo, ParameterSpec, Parameters, amplitudes};
use motiform_dynamics::model::Coordinate;
use motiform_dynamics::{Model, Shape, conformance};
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// The description of a model of one's own, as it is registered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct About {
    /// Its name, for study files, folders and titles: letters, digits and `-`.
    pub name: &'static str,
    /// One line on what it is.
    pub title: &'static str,
    /// Its equations, as text.
    pub equations: &'static str,
    /// The origin of the equations (a publication).
    pub source: &'static str,
    /// The length of a look, the unit in which times of observation are given ([`ModelInfo::look`]): some tens of the
    /// model's slowest ordinary time scale (model time).
    pub look: f64,
    /// Typical size of its shapes: the norm of their coordinates, to one digit.
    pub size: f64,
    /// The stepper to use by default: an exponential one (`krogstad4`) where the linear part is stiff.
    pub stepper: &'static str,
}

impl Default for About {
    fn default() -> Self {
        Self {
            name: "",
            title: "a model of one's own",
            equations: "given as code",
            source: "given as code",
            look: 200.0,
            size: 1.0,
            stepper: "dop853",
        }
    }
}

/// Makes a model from parameter values in registry order.
type Build = dyn Fn(&[f64]) -> Result<Box<dyn Model>, Error> + Send + Sync;

/// The names and the construction of a model of one's own.
pub(crate) struct Own {
    about: About,
    pub(crate) parameters: &'static [ParameterSpec],
    pub(crate) coordinates: Vec<Coordinate>,
    build: Box<Build>,
    /// See [`fingerprint`].
    pub(crate) field: String,
}

impl Own {
    pub(crate) fn build(&self, values: &[f64]) -> Result<Box<dyn Model>, Error> {
        (self.build)(values)
    }
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Own").field("field", &self.field).finish_non_exhaustive()
    }
}

/// All models of one's own of this process. An entry lives as long as the process, so that its names are static as those of other models.
static ALL: Mutex<Vec<&'static ModelInfo>> = Mutex::new(Vec::new());

/// Makes a model known by its name. `build` makes it from its parameters, which [`parameters!`](crate::parameters!) declares.
///
/// The same name with the same equations, parameters and description gives the same entry again.
///
/// # Errors
/// [`Error::OwnModel`]: a name that is not usable or taken, a time or size that is not above 0, a model that `build` refuses at its
/// default parameters, or one whose equations do not have the symmetry that it declares, there or at other parameters.
pub fn register<P, M>(
    about: &About,
    build: impl Fn(&P) -> Result<M, Error> + Send + Sync + 'static,
) -> Result<&'static ModelInfo, Error>
where
    P: Parameters,
    M: Model + 'static,
{
    let refuse = |problem: String| Error::OwnModel { name: about.name.to_owned(), problem };
    let usable = |c: char| c.is_ascii_alphanumeric() || c == '-';
    if about.name.is_empty() || !about.name.chars().all(usable) {
        return Err(refuse("give a name of letters, digits and '-'".to_owned()));
    }
    if about.name == amplitudes::NAME || MODELS.iter().any(|known| known.name == about.name) {
        return Err(refuse("a model that is built in has this name: give another one".to_owned()));
    }
    if let Some((key, value)) = [("look", about.look), ("size", about.size)]
        .into_iter()
        .find(|(_, value)| !(*value > 0.0 && value.is_finite()))
    {
        return Err(refuse(format!("{key} = {value}: give a number above 0")));
    }
    let make = move |values: &[f64]| -> Result<Box<dyn Model>, Error> {
        Ok(Box::new(build(&crate::registry::from_values::<P>(values))?))
    };
    let defaults = P::default().values();
    let body = make(&defaults).map_err(|error| refuse(format!("at its default parameters: {error}")))?;
    let bodies = [defaults, others(P::specs())].map(|values| make(&values).ok());
    let probes = probes(&bodies, about.size);
    if let Some(wrong) = probes.iter().find_map(|(body, state)| conformance::contradiction(*body, state)) {
        return Err(refuse(format!("{wrong}: correct it, or declare less in `symmetry`")));
    }
    let field = fingerprint(&probes);
    let mut all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.iter().find(|info| info.name == about.name) {
        let is_this = |own: &Own| own.about == *about && own.parameters == P::specs() && own.field == field;
        let same = matches!(&known.inner, Source::Own(own) if is_this(own));
        return if same {
            Ok(known)
        } else {
            Err(refuse("another model has this name: give another one".to_owned()))
        };
    }
    let coordinates = body.coordinates().to_vec();
    let own = Own { about: *about, parameters: P::specs(), coordinates, build: Box::new(make), field };
    let info: &'static ModelInfo = Box::leak(Box::new(info(own)));
    all.push(info);
    Ok(info)
}

/// The entry of a name, if it was registered.
pub(crate) fn find(name: &str) -> Option<&'static ModelInfo> {
    let all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
    all.iter().copied().find(|info| info.name == name)
}

/// All models that were registered.
pub(crate) fn all() -> Vec<&'static ModelInfo> {
    ALL.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

fn info(own: Own) -> ModelInfo {
    let about = own.about;
    let sides = own.parameters.iter().take(2).map(|spec| (spec.name, spec.range.0, spec.range.1));
    let plane: &'static [(&'static str, f64, f64)] = Vec::leak(sides.collect());
    ModelInfo {
        name: about.name,
        title: about.title,
        equations: about.equations,
        source: about.source,
        stepper: about.stepper,
        rtol: 1e-9,
        tolerance_ratio: 1e3,
        look: about.look,
        budget: 200.0 * about.look,
        size: about.size,
        display: Display { sample: about.look / 4000.0, speed: about.look / 25.0, plane },
        weight: |_| 1.0,
        resolution: None,
        inner: Source::Own(Box::leak(Box::new(own))),
    }
}

/// Values of parameters other than the defaults.
fn others(specs: &[ParameterSpec]) -> Vec<f64> {
    let other = |spec: &ParameterSpec| {
        let value = spec.range.0 + 0.618 * (spec.range.1 - spec.range.0);
        if spec.whole { spec.default } else { value }
    };
    specs.iter().map(other).collect()
}

/// A few states of this size for each body.
fn probes(bodies: &[Option<Box<dyn Model>>], size: f64) -> Vec<(&dyn Model, Vec<f64>)> {
    let state = |dim: usize, k: u8| -> Vec<f64> {
        (1..=dim).map(|i| size * (0.3 * f64::from(k) / i as f64 - 0.2)).collect()
    };
    let mut all = Vec::new();
    for body in bodies.iter().flatten() {
        all.extend((1..=3).map(|k| (body.as_ref(), state(body.dim(), k))));
    }
    all
}

/// Digits that change with the equations: a hash of the bits of the field and the velocity at a few states,
/// for the default parameters and for others. A result states them, so that it is not continued with other
/// equations of the same name.
fn fingerprint(probes: &[(&dyn Model, Vec<f64>)]) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64; // FNV-1a
    let mut add = |value: f64| {
        for byte in value.to_bits().to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (body, state) in probes {
        let velocity = Shape::<f64>::velocity(*body, state);
        body.rates(state).iter().chain(&velocity).copied().for_each(&mut add);
    }
    format!("{hash:016x}")
}
