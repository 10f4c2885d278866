//! A study as the text of a study file.

use crate::described::Described;
use crate::random::Random;
use crate::{Error, Study, amplitudes};
use motiform_models::amplitudes::Definition;
use toml::{Table, Value};

impl Study {
    /// The text of a study file that reads back as this study ([`Study::parse`]): what differs from the model's
    /// defaults, with every digit. Its name is that of the file, and is not in the text.
    ///
    /// # Errors
    /// An unknown model; [`Error::Setting`] for whole numbers of 2^63 and more, which TOML does not have.
    pub fn to_toml(&self) -> Result<String, Error> {
        self.text(self.model.definition(), &self.parameters)
    }

    /// As [`Study::to_toml`], but with these equations. They need not be those of a model of this process, which keeps every model it
    /// has met.
    ///
    /// # Errors
    /// As [`Study::to_toml`].
    pub fn to_toml_with(&self, equations: &Definition) -> Result<String, Error> {
        self.text(Some(equations), &[])
    }

    fn text(&self, equations: Option<&Definition>, parameters: &[(String, f64)]) -> Result<String, Error> {
        let bare = Self::of_model(self.info()?);
        let mut top = Table::new();
        for (key, text) in [("title", &self.title), ("about", &self.about)] {
            if !text.is_empty() {
                top.insert(key.to_owned(), text.clone().into());
            }
        }
        if !self.free.is_empty() {
            top.insert("free".to_owned(), self.free.clone().into());
        }
        // Equations are written line by line, behind what has no table.
        let equations = equations.map(|definition| {
            let head = std::mem::take(&mut top).to_string();
            format!("{head}\n{}\n", amplitudes::written(definition, parameters))
        });
        if equations.is_none() {
            let model = Table::from_iter([(self.model.to_string(), Value::Table(numbers(&self.parameters)))]);
            top.insert("model".to_owned(), model.into());
        }
        let mut initial = numbers(&self.initial);
        if let Some(random) = self.random {
            let value = match random {
                Random::Within(size) => size.into(),
                Random::Sizes { .. } => random.to_string().into(),
            };
            initial.insert("random".to_owned(), value);
        }
        if self.perturb.to_bits() != Self::PERTURB.to_bits() {
            initial.insert("perturb".to_owned(), self.perturb.into());
        }
        let ties = self.ties.iter().map(|(name, formula)| (name.to_owned(), formula.into())).collect();
        let tables = [
            ("ties", ties),
            ("initial", initial),
            ("run", self.run.table(Some(&bare.run))?),
            ("scan", self.scan.table(Some(&bare.scan))?),
            ("continue", self.follow.table(Some(&bare.follow))?),
            ("atlas", self.atlas.table(Some(&bare.atlas))?),
            ("figure", self.figure.table(Some(&bare.figure))?),
            ("display", self.display.table(Some(&bare.display))?),
        ];
        top.extend(
            tables
                .into_iter()
                .filter(|entry| !entry.1.is_empty())
                .map(|(key, table)| (key.to_owned(), table.into())),
        );
        if let Some(map) = &self.return_map {
            top.insert("return_map".to_owned(), map.table(None)?.into());
        }
        Ok(equations.unwrap_or_default() + &top.to_string())
    }
}

fn numbers(entries: &[(String, f64)]) -> Table {
    entries.iter().map(|(name, value)| (name.clone(), Value::Float(*value))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Towards;
    use crate::branches::Along;
    use crate::curves::{CurveKind, Plane};
    use crate::presets::PRESETS;
    use crate::scan::Axis;
    use crate::study::{
        DisplaySettings, FigureSettings, FollowSettings, ReturnMapSettings, RunSettings, ScanSettings,
    };
    use motiform_analysis::Regime;

    fn back(study: &Study) -> Study {
        Study::parse(&study.to_toml().unwrap(), "text", &study.name).unwrap()
    }

    #[test]
    fn presets_read_back_as_they_are() {
        for preset in PRESETS {
            let study = Study::parse(preset.text, preset.name, preset.name).unwrap();
            assert_eq!(back(&study), study, "{}", study.to_toml().unwrap());
        }
    }

    #[test]
    fn every_setting_reads_back() {
        let mut study = Study::parse("preset = \"fig5b\"\n[model.tensor]", "text", "all").unwrap();
        study.title = "quotes \" and \\ and \n lines".to_owned();
        study.set("kappa2", 0.1 + 0.2).unwrap();
        study.tie("b3", "2*d3 + 0.1").unwrap();
        study.set_initial("v1", 1e-300).unwrap();
        study.random = Some(Random::Sizes { min: 0.1 + 0.2, max: 1.0 });
        study.run = RunSettings {
            t_end: 1.0 / 3.0,
            transient: 7.0,
            dt_out: 0.1,
            stepper: "rk4".to_owned(),
            rtol: 1e-7,
            atol: Some(1e-8),
            step: Some(0.01),
            seed: 9,
            max_steps: 1000,
            escape_norm: Some(1e3),
            noise: 0.25,
            noise_velocity: Some(0.0),
        };
        study.scan = ScanSettings {
            axes: vec![Axis::parse("gamma=0.1:0.7:5").unwrap(), Axis::parse("kappa2=0.3").unwrap()],
            samples: 4,
            budget: 12.0,
        };
        study.follow = FollowSettings {
            along: Some(Along { name: "kappa2".to_owned(), from: 0.1 + 0.2, to: 1e-3 + 1.6 }),
            from: Some(Regime::Zigzag),
            curve: vec![CurveKind::Hopf, CurveKind::PeriodDoubling],
            plane: Some(Plane::parse("kappa2,gamma=0.02:1e-7").unwrap()),
            points: 7,
            branches: 3,
            samples: 40,
            first_step: Some(0.1 + 0.2),
            branch_step: Some(1.0 / 3.0),
            tolerance: Some(1e-11),
            direction: Some(Towards::Down),
            steady: true,
            from_stable: true,
            doublings: Some(1),
        };
        study.return_map = Some(ReturnMapSettings { y: 1.0, x_min: -2.0, x_max: 3.5, centre: true });
        study.figure = FigureSettings {
            radius: 1.0,
            scale: 2.0,
            outlines: 3,
            from: 4.0,
            to: 5.0,
            animation: false,
            units: "20um,1min".to_owned(),
        };
        study.display = DisplaySettings {
            sample: 0.1 + 0.2,
            speed: 7.0,
            plane: vec![Axis::parse("gamma=0.1,0.7").unwrap()],
        };
        assert_eq!(back(&study), study, "{}", study.to_toml().unwrap());
    }

    #[test]
    fn a_seed_beyond_toml_is_refused() {
        let mut study = Study::parse("preset = \"fig5b\"", "text", "seed").unwrap();
        study.run.seed = u64::MAX;
        let refusal = study.to_toml().unwrap_err().to_string();
        assert!(refusal.contains("below 2^63"), "{refusal}");
    }
}
