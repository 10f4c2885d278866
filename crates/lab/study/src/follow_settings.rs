//! The settings of branches and curves in a study: the table `[continue]`.

use crate::Error;
use crate::branches::{Along, BranchSettings};
use crate::curves::{CurveKind, CurveSettings, Plane};
use crate::described::settings;
use crate::{Stride, Towards};
use motiform_analysis::Regime;
use motiform_models::ModelInfo;
use motiform_models::parameters::index_of;

settings! {
    /// Which motion is followed, and how far.
    #[derive(Clone, Debug, PartialEq)]
    pub struct FollowSettings {
        /// The parameter to vary, with its range: "kappa2=0.3:1.6"; the start lies inside.
        pub along: Option<Along>,
        /// The motion that the start must settle on: motionless, straight, circular, spinning, zigzag, quasi-periodic or
        /// pulsating-straight; any, if not given.
        pub from: Option<Regime>,
        /// Kinds of special points that are followed over two parameters: hopf, fold, pitchfork, symmetry-breaking, period-doubling, torus.
        pub curve: Vec<CurveKind>,
        /// The plane of these curves, across and upwards: "kappa2,kappa3=0.02:1"; one of the parameters is that of `along`. Default
        /// ranges: that of `along`, and the plane of the preset.
        pub plane as "in": Option<Plane>,
        /// Most points of a branch or curve to each side, by default 2000.
        pub points: u64,
        /// Most branches, by default 8; 1 follows the motion alone, and nothing that begins on its branch.
        pub branches: u64,
        /// Number of values of the parameter at which motions are simulated, too: upwards and downwards, each run from the end of the
        /// one before. They are drawn in grey beneath the branches.
        pub samples: u64,
        /// First step along a branch, as a part of the range (and of the size of the shape, and of the period): 0.005, if not given.
        pub first_step: Option<f64>,
        /// Longest step along a branch, in the same units: 0.02, if not given.
        pub branch_step: Option<f64>,
        /// Newton's method has converged on a branch with a step shorter than this: 1e-9, if not given (rtol is the tolerance of the
        /// simulation).
        pub tolerance: Option<f64>,
        /// The sides to which the start is followed: "up" (larger values of the parameter), "down" or "both", if not given.
        pub direction: Option<Towards>,
        /// Follow steady motions alone (motionless, straight, circular), not the orbits that begin at Hopf points.
        pub steady: bool,
        /// Of the orbits follow those alone that begin where a stable motion loses its stability.
        pub from_stable: bool,
        /// Doublings of the period in a row that are followed: 3, if not given. Each one takes twice as long as the one before.
        pub doublings: Option<u64>,
    }
}

impl Default for FollowSettings {
    fn default() -> Self {
        Self {
            along: None,
            from: None,
            curve: Vec::new(),
            plane: None,
            points: 2000,
            branches: 8,
            samples: 0,
            first_step: None,
            branch_step: None,
            tolerance: None,
            direction: None,
            steady: false,
            from_stable: false,
            doublings: None,
        }
    }
}

impl FollowSettings {
    /// The settings of the branches.
    ///
    /// # Errors
    /// [`Error::NoAlong`].
    pub fn branches(&self) -> Result<BranchSettings, Error> {
        let whole = |count: u64| usize::try_from(count).unwrap_or(usize::MAX);
        Ok(BranchSettings {
            along: self.along.clone().ok_or(Error::NoAlong)?,
            origin: self.from,
            points: whole(self.points),
            branches: whole(self.branches),
            samples: whole(self.samples),
            stride: Stride {
                first_step: self.first_step,
                branch_step: self.branch_step,
                tolerance: self.tolerance,
                direction: self.direction.unwrap_or_default(),
                steady: self.steady,
                from_stable: self.from_stable,
                doublings: self.doublings,
            },
            given: None,
        })
    }

    /// The settings of the curves, if there are any.
    ///
    /// # Errors
    /// [`Error::Setting`] for curves without a plane, and a plane without curves.
    pub fn curves(&self) -> Result<Option<CurveSettings>, Error> {
        match (&self.curve[..], &self.plane) {
            ([], None) => Ok(None),
            ([], Some(plane)) => Err(Error::Setting {
                key: "in",
                value: plane.to_string(),
                remedy: "this is the plane of curves: say of which kind they are",
            }),
            (kinds, None) => Err(Error::Setting {
                key: "curve",
                value: kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(","),
                remedy: "curves need a plane of two parameters: give both",
            }),
            (kinds, Some(plane)) => Ok(Some(CurveSettings { kinds: kinds.to_vec(), plane: plane.clone() })),
        }
    }

    /// Refuses parameters that the model does not have.
    pub(crate) fn check(&self, info: &ModelInfo, key: &str) -> Result<(), Error> {
        let known = |name: &str| index_of(info.parameters(), info.name, name).map(|_| ());
        match key {
            "along" => self.along.as_ref().map_or(Ok(()), |along| known(&along.name))?,
            "in" => self.plane.iter().flat_map(|plane| &plane.0).try_for_each(|side| known(&side.0))?,
            _ => {}
        }
        Ok(())
    }
}
