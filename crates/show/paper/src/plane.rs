//! A model over two of its parameters.

use motiform_analysis::{Error as Refused, Result as Found};
use motiform_continuation::{Branch, CurvePoint, End, Family2, Point, Settings, switch};
use motiform_dynamics::{Equivariant, Watch};
use motiform_models::ModelInfo;
use motiform_models::parameters::index_of;
use motiform_study::{Error, Study};

/// The bodies of a study over two of its parameters.
pub(crate) struct Plane {
    info: &'static ModelInfo,
    values: Vec<f64>,
    places: [usize; 2],
}

impl Plane {
    /// The plane of the parameters of these names.
    pub(crate) fn new(study: &Study, names: [&str; 2]) -> Result<Self, Error> {
        let info = study.info()?;
        let place = |name| index_of(info.parameters(), info.name, name);
        Ok(Self { info, values: study.values()?, places: [place(names[0])?, place(names[1])?] })
    }

    /// The bodies over the first parameter where the second is `second`.
    pub(crate) fn row(&self, second: f64) -> impl Fn(f64) -> Found<Box<dyn Equivariant>> + Sync {
        move |first| self.at([first, second])
    }

    /// Returns `true` if the motion that begins at a point of a curve of special points is stable, as the
    /// motion is on one side of it: the transition is continuous. `None` if nothing is found to begin there.
    pub(crate) fn is_continuous(
        &self,
        at: &CurvePoint,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Option<bool> {
        let point = Point {
            parameter: at.parameters[0],
            arclength: 0.0,
            motion: at.motion.clone(),
            unstable: at.unstable,
            neutral: 0,
            family: 0,
            critical: 0,
            slope: 0.0,
            tangent: None,
            special: Some(at.special),
            certificate: None,
        };
        let row = self.row(at.parameters[1]);
        let mut new = switch(&row, &point, settings, watch).ok()?.pop()?.pop()?;
        Some(at.unstable == 0 && new.next()?.unstable == 0)
    }
}

impl Family2 for Plane {
    fn at(&self, parameters: [f64; 2]) -> Found<Box<dyn Equivariant>> {
        let mut values = self.values.clone();
        self.places.iter().zip(parameters).for_each(|(place, value)| values[*place] = value);
        let refuse =
            |why: motiform_models::Error| Refused::NoBody { value: parameters[0], why: why.to_string() };
        let model: Box<dyn Equivariant> = self.info.build(&values).map_err(refuse)?;
        Ok(model)
    }
}

/// The special points of a branch, and its last point.
pub(crate) fn walked(branch: &mut Branch<'_>) -> Result<(Vec<Point>, Point), Error> {
    let mut all: Vec<Point> = branch.by_ref().collect();
    match (branch.end(), all.pop()) {
        (Some(End::Stopped), _) | (_, None) => Err(Error::Interrupted),
        (_, Some(last)) => Ok((all.into_iter().filter(|point| point.special.is_some()).collect(), last)),
    }
}
