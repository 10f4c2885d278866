//! Curves of special points as data: which kinds, over which two parameters.

use crate::branches::{Along, BranchComputation, BranchPlan};
use crate::plan::{Plan, Question};
use crate::{Error, Study};
use motiform_models::ModelName;
use motiform_models::parameters::index_of;
use motiform_models::spelling::ascii;
use motiform_store::Kind;
use serde::{Deserialize, Serialize};

/// Version of the meaning of a plan of curves; part of the hash. A change that moves a number raises it.
pub const CURVE_FORMAT: u32 = 2;

motiform_dynamics::named! {
    /// A kind of special point that can be followed over two parameters, in the order of messages and legends.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum CurveKind by name {
        /// An oscillation of the shape begins.
        Hopf = "hopf",
        /// A branch turns back.
        Fold = "fold",
        /// A steady motion loses a symmetry.
        Pitchfork = "pitchfork",
        /// A zigzag loses its mirror symmetry.
        SymmetryBreaking = "symmetry-breaking",
        /// An orbit of twice the period begins.
        PeriodDoubling = "period-doubling",
        /// An invariant torus begins.
        Torus = "torus",
    }
}

impl CurveKind {
    /// The kind of this name.
    ///
    /// # Errors
    /// [`Error::UnknownName`] with the nearest name.
    pub fn parse(name: &str) -> Result<Self, Error> {
        let known = Self::ALL.map(Self::name);
        let points = "the special points that can be followed over two parameters are";
        Self::find(name)
            .ok_or_else(|| Error::unknown("curve", name, &known, format!("{points} {}", known.join(", "))))
    }

    /// Reads names separated by commas, each kind once.
    ///
    /// # Errors
    /// [`Error::UnknownName`].
    pub fn list(text: &str) -> Result<Vec<Self>, Error> {
        let mut all = Vec::new();
        for name in text.split(',') {
            let kind = Self::parse(name.trim())?;
            if !all.contains(&kind) {
                all.push(kind);
            }
        }
        Ok(all)
    }
}

/// The plane of two parameters, across and upwards, each with its range if one is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane(pub [(String, Option<(f64, f64)>); 2]);

impl Plane {
    /// Reads `NAME,NAME`, each of them also as `NAME=LOW:HIGH`.
    ///
    /// # Errors
    /// [`Error::Plane`] with the remedy.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let form =
            || wrong(text.to_owned(), "write NAME,NAME=LOW:HIGH, e.g. kappa2,kappa3=0.02:1".to_owned());
        let side = |text: &str| {
            if !text.contains('=') {
                let name = text.trim();
                return (!name.is_empty()).then(|| (ascii(name), None));
            }
            let Along { name, from, to } = Along::parse(text).ok()?;
            Some((name, Some((from, to))))
        };
        let (first, second) = text.split_once(',').ok_or_else(form)?;
        Ok(Self([side(first).ok_or_else(form)?, side(second).ok_or_else(form)?]))
    }
}

impl std::fmt::Display for Plane {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (number, (name, range)) in self.0.iter().enumerate() {
            f.write_str(if number > 0 { "," } else { "" })?;
            match range {
                Some((from, to)) => write!(f, "{name}={from:?}:{to:?}")?,
                None => write!(f, "{name}")?,
            }
        }
        Ok(())
    }
}

/// Which curves are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSettings {
    /// The kinds, at least one.
    pub kinds: Vec<CurveKind>,
    /// The plane; one of its parameters is that of the branches.
    pub plane: Plane,
}

/// The plan of curves: branches along one parameter, and the special points on them over two.
pub type CurvePlan = Plan<CurveComputation>;

/// Everything that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveComputation {
    /// [`CURVE_FORMAT`].
    pub format: u32,
    /// The kinds of special points.
    pub kinds: Vec<CurveKind>,
    /// The plane, across and upwards.
    pub plane: [Along; 2],
    /// The branches whose special points are followed.
    pub branches: BranchComputation,
}

impl Question for CurveComputation {
    type Figure = ();
    const KIND: Kind = Kind::Curves;
    const KEY: &'static str = "curves";

    fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    fn model(&self) -> &ModelName {
        self.branches.model()
    }

    fn title(&self, _: &str) -> String {
        format!("{} model: curves of bifurcations", crate::titles::capital(self.model().as_str()))
    }
}

impl CurvePlan {
    /// Makes the plane explicit and checks it. A range that is not given is that of the branches, or of the study's own plane
    /// ([`crate::study::DisplaySettings::plane`]).
    ///
    /// # Errors
    /// [`Error::Plane`], an unknown parameter (with the nearest name).
    pub fn new(study: &Study, branches: BranchPlan, settings: &CurveSettings) -> Result<Self, Error> {
        let CurveSettings { kinds, plane } = settings;
        let info = study.info()?;
        for (name, _) in &plane.0 {
            index_of(info.parameters(), info.name, name)?;
        }
        study.ties.check_free(plane.0.iter().map(|(name, _)| name.as_str()))?;
        let along = &branches.computation.along;
        let varied = plane.0.iter().filter(|side| side.0 == along.name).count();
        if varied != 1 {
            let problem = format!(
                "give two different parameters, one of them {}, along which the branches are followed",
                along.name
            );
            return Err(wrong(plane.to_string(), problem));
        }
        let [first, second] = [0, 1].map(|side| range(study, &branches, &plane.0[side]));
        let plane = [first?, second?];
        let BranchPlan { name, title, computation, .. } = branches;
        let computation =
            CurveComputation { format: CURVE_FORMAT, kinds: kinds.clone(), plane, branches: computation };
        Ok(Self::of(&name, &title, computation))
    }

    /// The branches whose special points are followed.
    pub fn branches(&self) -> BranchPlan {
        BranchPlan::of(&self.name, &self.title, self.computation.branches.clone())
    }

    /// Which side of the plane the branches are followed along: 0 or 1.
    pub fn varied(&self) -> usize {
        usize::from(self.computation.plane[1].name == self.computation.branches.along.name)
    }

    /// The other side's value at the start.
    pub fn fixed_value(&self) -> f64 {
        let name = &self.computation.plane[1 - self.varied()].name;
        self.computation.branches.start.parameters.get(name).unwrap_or(f64::NAN)
    }

    /// All parameters with those of the plane at `values` (across, upwards), in registry order.
    pub fn parameters_at(&self, values: [f64; 2]) -> Vec<f64> {
        let [across, upwards] = &self.computation.plane;
        self.computation.branches.parameters_with(|name| match name {
            name if name == across.name => Some(values[0]),
            name if name == upwards.name => Some(values[1]),
            _ => None,
        })
    }
}

/// One side of the plane with its range.
fn range(
    study: &Study,
    branches: &BranchPlan,
    (name, given): &(String, Option<(f64, f64)>),
) -> Result<Along, Error> {
    let along = &branches.computation.along;
    let own = study.display.plane.iter().find(|side| side.name == *name);
    let own = own.and_then(|side| Some((*side.values.first()?, *side.values.last()?)));
    let inherited = if *name == along.name { Some((along.from, along.to)) } else { own };
    let Some((from, to)) = given.or(inherited) else {
        return Err(wrong(name.clone(), format!("give its range, {name}=LOW:HIGH")));
    };
    let side = Along { name: name.clone(), from, to };
    let value = branches.computation.start.parameters.get(name).unwrap_or(f64::NAN);
    side.check(study.info()?, value)?;
    if *name == along.name && !(from <= along.from && along.to <= to) {
        let problem = format!("the range must hold that of the branches, {along}");
        return Err(wrong(side.to_string(), problem));
    }
    Ok(side)
}

fn wrong(text: String, problem: String) -> Error {
    Error::Plane { text, problem }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_read_back_and_others_are_refused() {
        for text in ["kappa2,kappa3=0.02:1.0", "a,b", "a=-1.0:2.0,b=1e-7:0.30000000000000004"] {
            let plane = Plane::parse(text).unwrap();
            assert_eq!(plane.to_string(), text);
            assert_eq!(Plane::parse(&plane.to_string()).unwrap(), plane);
        }
        for bad in [
            "",
            "kappa2",
            "kappa2,",
            ",kappa3",
            "kappa2,kappa3=",
            "kappa2,kappa3=1",
            "a=1:2:3,b",
            "a,b=nan:1",
        ] {
            assert!(Plane::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn kinds_are_found_by_their_names_and_listed_once() {
        for kind in CurveKind::ALL {
            assert_eq!(CurveKind::parse(kind.name()).unwrap(), kind);
            assert_eq!(serde_json::to_string(&kind).unwrap(), format!("\"{}\"", kind.name()));
        }
        let both = [CurveKind::Fold, CurveKind::Hopf];
        assert_eq!(CurveKind::list("fold, hopf,fold").unwrap(), both);
        assert!(CurveKind::list("fold,").is_err());
    }
}
