//! A study as typed: everything is optional, nothing is computed yet.

pub use crate::atlas::AtlasSettings;
use crate::described::settings;
pub use crate::follow_settings::FollowSettings;
use crate::input;
use crate::random::Random;
pub use crate::run_settings::RunSettings;
use crate::scales::REACHED_BY_ONE;
use crate::scan::Axis;
pub use crate::study_reader::schema;
use crate::{Error, Scales, Ties, presets};
use motiform_dynamics::Model;
use motiform_models::parameters::index_of;
use motiform_models::registry::Display;
use motiform_models::spelling::canonical;
use motiform_models::{ModelInfo, ModelName};
use serde::Serialize;

/// A study: a model with its parameters, initial state, run settings and drawing settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The model.
    pub model: ModelName,
    /// Short name: that of the preset, or the stem of the file. It is used for the default output folder.
    pub name: String,
    /// Title of the figures.
    pub title: String,
    /// One sentence on what the study shows.
    pub about: String,
    /// The parameters that span the paper's diagram, if this study represents one.
    pub free: Vec<String>,
    /// Parameters that are given, in registry order.
    pub parameters: Vec<(String, f64)>,
    /// Parameters that follow from others.
    pub ties: Ties,
    /// Initial values that are given, in the order of the coordinates; the others are 0, or random if none is given.
    pub initial: Vec<(String, f64)>,
    /// The distribution of random starts; by default one start is small ([`Random::SMALL`]), and several sample basins
    /// ([`Random::basins`]).
    pub random: Option<Random>,
    /// Size of the random values that replace zeros of a given start for classification, relative to its largest value: see
    /// [`Study::perturbed`].
    pub perturb: f64,
    /// The run.
    pub run: RunSettings,
    /// The scan.
    pub scan: ScanSettings,
    /// Branches and curves.
    pub follow: FollowSettings,
    /// The lines of an atlas.
    pub atlas: AtlasSettings,
    /// The return map, if any.
    pub return_map: Option<ReturnMapSettings>,
    /// Settings of figures.
    pub figure: FigureSettings,
    /// The initial display in the explorer.
    pub display: DisplaySettings,
}

settings! {
    /// The settings of a scan.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct ScanSettings {
        /// One or two axes, each a parameter, or a coordinate of the initial shape for a map of basins: "kappa2=0.1:1.6:64" is 64 values
        /// from 0.1 to 1.6, both ends included; "kappa2=0.1,0.2" lists them.
        pub axes: Vec<Axis>,
        /// Initial states per cell, by default 1: all random, except that the first one has the initial values that are given.
        pub samples: u64,
        /// Maximum model time for classifying one motion; 0 chooses the model's default.
        pub budget: f64,
    }
}

impl Default for ScanSettings {
    fn default() -> Self {
        Self { axes: Vec::new(), samples: 1, budget: 0.0 }
    }
}

settings! {
    /// A return map: x at each crossing of a horizontal segment by the path.
    #[derive(Clone, Debug, PartialEq, Serialize, serde::Deserialize)]
    pub struct ReturnMapSettings {
        /// The segment lies at this y.
        pub y: f64,
        /// Left end.
        pub x_min: f64,
        /// Right end.
        pub x_max: f64,
        /// Shift the centre of the path (its time average) to the origin first.
        pub centre: bool,
    }
}

settings! {
    /// Settings of the figures of a dataset. They do not affect results.
    #[derive(Clone, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
    #[serde(default)]
    pub struct FigureSettings {
        /// Radius R0 of the undeformed body (model length); 0 chooses it so that the deformation is visible.
        pub radius: f64,
        /// Scale of the outlines relative to the path; 0 chooses a readable scale.
        pub scale: f64,
        /// Number of outlines along the path; 0 chooses.
        pub outlines: u64,
        /// Path, series and animation show the recording from this time.
        pub from: f64,
        /// They show it to this time; 0 is the end.
        pub to: f64,
        /// Draw the animation.
        pub animation: bool,
        /// A unit of length and one of time in the laboratory, for axes in these: "20um,1min"; nothing: model units.
        #[serde(skip_serializing_if = "String::is_empty")]
        pub units: String,
    }
}

settings! {
    /// The initial display of a body in the explorer. These settings do not affect results.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct DisplaySettings {
        /// Model time between the samples of the animation.
        pub sample: f64,
        /// Model time per second.
        pub speed: f64,
        /// Sides of the map, one or two: "kappa2=0.05,1.65" is the parameter with its lowest and highest value.
        pub plane: Vec<Axis>,
    }
}

/// Samples per second at the highest speed that the explorer offers: 50 in each of 60 pictures.
const MOST_SAMPLES: f64 = 3000.0;

impl DisplaySettings {
    /// The default display of a model.
    pub fn of_model(info: &ModelInfo) -> Self {
        let side =
            |&(name, low, high): &(&str, f64, f64)| Axis { name: name.to_owned(), values: vec![low, high] };
        let Display { sample, speed, plane } = info.display;
        Self { sample, speed, plane: plane.iter().map(side).collect() }
    }

    /// The lowest and the highest speed that the explorer offers (model time per second).
    pub fn speeds(&self) -> [f64; 2] {
        [2.0 * self.sample, MOST_SAMPLES * self.sample]
    }
}

impl Study {
    /// A study of `model` with its defaults and nothing else.
    pub fn of_model(info: &'static ModelInfo) -> Self {
        Self {
            model: ModelName::from(info),
            name: info.name.to_owned(),
            title: String::new(),
            about: String::new(),
            free: Vec::new(),
            parameters: Vec::new(),
            ties: Ties::default(),
            initial: Vec::new(),
            random: None,
            perturb: Self::PERTURB,
            run: RunSettings { stepper: info.stepper.to_owned(), rtol: info.rtol, ..RunSettings::default() },
            scan: ScanSettings::default(),
            follow: FollowSettings::default(),
            atlas: AtlasSettings::default(),
            return_map: None,
            figure: FigureSettings { animation: true, ..FigureSettings::default() },
            display: DisplaySettings::of_model(info),
        }
    }

    /// Reads a study file.
    ///
    /// # Errors
    /// [`Error::Store`], and the errors of [`Study::parse`].
    pub fn read(path: &std::path::Path) -> Result<Self, Error> {
        let text = input::text(path, input::STUDY).map_err(|error| Error::unreadable(path, error))?;
        let stem =
            path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned());
        Self::parse(&text, &path.display().to_string(), &stem)
    }

    /// The registry entry of its model.
    ///
    /// # Errors
    /// [`motiform_models::Error::UnknownModel`] if the model name was changed manually.
    pub fn info(&self) -> Result<&'static ModelInfo, Error> {
        Ok(self.model.info()?)
    }

    /// The distribution of so many random starts: the given one; otherwise one start is small ([`Random::SMALL`]), and several sample
    /// basins ([`Random::basins`]). Of equations given as text their size is twice that at which terms balance, where it is no ordinary
    /// one.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub fn starts(&self, samples: u64) -> Result<Random, Error> {
        self.starts_over(samples, &[])
    }

    /// The same where axes replace parameters: terms balance at the ends of the axes, whatever the values that these replace.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub fn starts_over(&self, samples: u64, axes: &[Axis]) -> Result<Random, Error> {
        if let Some(random) = self.random {
            return Ok(random);
        }
        let (info, all) = (self.info()?, self.values_over(axes)?);
        if samples > 1 {
            return Ok(Random::basins(Scales::starts(info, &all, &REACHED_BY_ONE)?.unwrap_or(info.size)));
        }
        Random::small(info, &all)
    }

    /// Its scales where axes replace parameters: those of the equations at the ends of the axes.
    pub(crate) fn scales_over(&self, axes: &[Axis]) -> Result<Scales, Error> {
        Scales::over(self.info()?, &self.values_over(axes)?)
    }

    /// All parameter values, in registry order.
    ///
    /// # Errors
    /// An unknown model, a parameter that it does not have (with the nearest name).
    pub fn values(&self) -> Result<Vec<f64>, Error> {
        let given = |name: &str| self.parameters.iter().find(|(known, _)| known == name).map(|entry| entry.1);
        let info = self.info()?;
        let specs = info.parameters();
        for (name, _) in &self.parameters {
            index_of(specs, info.name, name)?;
        }
        let mut values: Vec<_> = specs.iter().map(|spec| given(spec.name).unwrap_or(spec.default)).collect();
        self.ties.apply(specs, &mut values);
        Ok(values)
    }

    /// The same at the ends of these axes, for those that replace parameters; those of the study without any.
    pub(crate) fn values_over(&self, axes: &[Axis]) -> Result<Vec<Vec<f64>>, Error> {
        let specs = self.info()?.parameters();
        let mut corners = vec![self.values()?];
        for axis in axes {
            let Some(place) = specs.iter().position(|spec| spec.name == axis.name) else { continue };
            let ends = || axis.values.first().into_iter().chain(axis.values.last());
            let at = |values: &Vec<f64>, end: f64| {
                let mut values = values.clone();
                values[place] = end;
                self.ties.apply(specs, &mut values);
                values
            };
            corners = corners.iter().flat_map(|values| ends().map(move |&end| at(values, end))).collect();
        }
        Ok(corners)
    }

    /// The body that it describes: its model at its parameters.
    ///
    /// # Errors
    /// An unknown model, or parameters that it refuses.
    pub fn body(&self) -> Result<Box<dyn Model>, Error> {
        Ok(self.info()?.build(&self.values()?)?)
    }

    /// Ties a parameter to an expression of others ([`Ties`]), replacing a value.
    ///
    /// # Errors
    /// An unknown name (with the nearest one); [`Error::Tie`].
    pub fn tie(&mut self, name: &str, formula: &str) -> Result<(), Error> {
        let (info, before) = (self.info()?, self.values()?);
        let name = canonical(info.parameters(), name);
        self.ties.tie(info, name, formula)?;
        self.parameters.retain(|(given, _)| given != name);
        if self.values()? != before {
            self.untitle();
        }
        Ok(())
    }

    /// Sets several parameters; a tied one may be among them, with the value that it has anyway.
    ///
    /// # Errors
    /// Those of [`Study::set`].
    pub fn set_all<'n>(&mut self, values: impl IntoIterator<Item = (&'n str, f64)>) -> Result<(), Error> {
        let mut tied = Vec::new();
        for (name, value) in values {
            match self.ties.get(name) {
                Some(_) => tied.push((name, value)),
                None => self.set(name, value)?,
            }
        }
        tied.into_iter().try_for_each(|(name, value)| self.set(name, value))
    }

    /// Sets a parameter, replacing an earlier value. Title and sentence of a preset, which refer to another value, are removed.
    ///
    /// # Errors
    /// An unknown name (with the nearest one); another value for a tied parameter.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let info = self.info()?;
        let name = canonical(info.parameters(), name);
        let index = index_of(info.parameters(), info.name, name)?;
        let now = self.values()?[index];
        if let Some(formula) = self.ties.get(name) {
            let problem =
                format!("{name} cannot be {value} as well: set what it is tied to, or leave out the tie");
            let refused = Error::Tie { name: name.to_owned(), formula: formula.to_owned(), problem };
            return if now == value { Ok(()) } else { Err(refused) };
        }
        if now != value {
            self.untitle();
        }
        let order: Vec<_> = info.parameters().iter().map(|spec| spec.name).collect();
        replace(&mut self.parameters, name, value, &order);
        Ok(())
    }

    /// Removes title and sentence of a preset, because they describe another motion. Those typed by the user are kept.
    fn untitle(&mut self) {
        for text in [&mut self.title, &mut self.about] {
            if !text.is_empty() && presets::says(self.model.as_str(), text) {
                text.clear();
            }
        }
    }

    /// Sets an initial value, replacing an earlier one; title and sentence as in [`Study::set`].
    ///
    /// # Errors
    /// An unknown name (with the nearest one).
    pub fn set_initial(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let (info, values) = (self.info()?, self.values()?);
        info.coordinate(&values, name)?;
        let names = info.coordinates(&values).iter().map(|coordinate| coordinate.name);
        let order: Vec<_> = names.chain(["x", "y"]).collect();
        if !self.initial.iter().any(|entry| entry.0 == name && entry.1 == value) {
            self.untitle();
        }
        replace(&mut self.initial, name, value, &order);
        Ok(())
    }
}

/// Inserts a value at the position that `order` gives its name, independent of the order of typing.
fn replace(list: &mut Vec<(String, f64)>, name: &str, value: f64, order: &[&str]) {
    list.retain(|(known, _)| known != name);
    list.push((name.to_owned(), value));
    list.sort_by_key(|(known, _)| order.iter().position(|name| name == known));
}
