//! A question to the program, and its answer.

use super::subjects::{Subject, System};
use crate::common::Folder;
use serde_json::Value;

/// A motion to ask for.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// `tensor`, `cell`, or a study file.
    pub(crate) model: String,
    pub(crate) set: Vec<(String, f64)>,
    pub(crate) initial: Vec<(String, f64)>,
    pub(crate) rtol: Option<f64>,
    pub(crate) seed: u64,
    /// Units of time and length against those of the subject.
    pub(crate) time: f64,
    pub(crate) length: f64,
}

/// Output of a command.
#[derive(Clone, Debug)]
pub(crate) struct Answer(pub(crate) Value);

impl Answer {
    pub(crate) fn regime(&self) -> &str {
        self.0["regime"].as_str().unwrap_or("undetermined")
    }

    pub(crate) fn number(&self, path: &str) -> Option<f64> {
        self.0.pointer(path)?.as_f64()
    }

    /// Values and errors of the exponents.
    pub(crate) fn exponents(&self) -> Vec<(f64, f64)> {
        let list = self.0["exponents"].as_array().cloned().unwrap_or_default();
        list.iter().filter_map(|one| Some((one["value"].as_f64()?, one["error"].as_f64()?))).collect()
    }
}

impl Request {
    pub(crate) fn of(folder: &Folder, subject: &Subject) -> Self {
        let model = match &subject.system {
            System::BuiltIn(model) => (*model).to_owned(),
            System::Text(text) => write(folder, "model.toml", &text.study(1.0, 1.0)),
        };
        let set = subject.set.clone();
        Self { model, set, initial: Vec::new(), rtol: None, seed: subject.seed, time: 1.0, length: 1.0 }
    }

    /// The command line after the name of the command.
    pub(crate) fn words(&self) -> String {
        let mut words = format!("{} --seed {}", self.model, self.seed);
        for (option, pairs) in [("--set", &self.set), ("--initial", &self.initial)] {
            for (name, value) in pairs {
                words += &format!(" {option} {name}={value:?}");
            }
        }
        if let Some(rtol) = self.rtol {
            words += &format!(" --rtol {rtol:?}");
        }
        words
    }

    /// A command's answer; `null` where it refuses.
    pub(crate) fn ask(&self, folder: &Folder, command: &str, more: &str) -> Answer {
        let done = folder.run(&format!("{command} {} --json {more}", self.words()));
        Answer(serde_json::from_str(&done.stdout).unwrap_or(Value::Null))
    }

    pub(crate) fn classify(&self, folder: &Folder) -> Answer {
        self.ask(folder, "classify", "")
    }

    /// The same with a start on the motion: the state after a long run. `None` where the run does not reach its end.
    pub(crate) fn settled(&self, folder: &Folder) -> Option<Self> {
        let time = if self.model == "cell" { 20_000.0 } else { 4000.0 };
        let more = format!("--transient {time} --t-end 1 --out settled --force");
        let done = self.ask(folder, "simulate", &more);
        if done.0.pointer("/outcome/kind")?.as_str()? != "completed" {
            return None;
        }
        let names = done.0.pointer("/manifest/plan/computation/initial")?.as_object()?;
        let state = done.0["state"].as_object()?;
        let known = state.iter().filter(|(name, _)| names.contains_key(*name));
        let initial = known.filter_map(|(name, value)| Some((name.clone(), value.as_f64()?))).collect();
        Some(Self { initial, ..self.clone() })
    }
}

/// Writes a file and gives its name.
pub(crate) fn write(folder: &Folder, name: &str, text: &str) -> String {
    folder.write(name, text);
    name.to_owned()
}
