//! An equilibrium of a list.

use super::{Asked, StartPoint};
use motiform_models::ModelName;
use motiform_study::plan::Named;
use motiform_study::{Error, Given, input};
use serde::Deserialize;

/// The part of the output of `motiform equilibria --json` that is read.
#[derive(Deserialize)]
struct List {
    model: ModelName,
    parameters: Named,
    equilibria: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    #[serde(default)]
    motion: String,
    shape: Named,
    #[serde(default)]
    unstable: usize,
}

/// The equilibrium of this number, from 1; the only one, if no number is given.
pub(super) fn point(asked: &Asked<'_>) -> Result<StartPoint, Error> {
    let list: List = input::json(&asked.path)
        .map_err(|error| asked.wrong(format!("this is no list of equilibria ({error}): give one as JSON")))?;
    let chosen = match asked.point {
        None if list.equilibria.len() == 1 => Some(0),
        None => None,
        Some(number) => number.parse::<usize>().ok().and_then(|number| number.checked_sub(1)),
    };
    let entry = chosen.and_then(|place| list.equilibria.get(place)).ok_or_else(|| {
        let problem = asked
            .point
            .map_or("say which one".to_owned(), |point| format!("there is no equilibrium {point:?}"));
        asked.wrong(format!("{problem}: {}", listed(asked, &list.equilibria)))
    })?;
    Ok(StartPoint {
        text: asked.text.to_owned(),
        state: entry.shape.clone(),
        model: Some(list.model),
        name: None,
        parameters: list.parameters,
        given: Given::Equilibrium,
    })
}

/// The equilibria in words, so that one can be chosen.
fn listed(asked: &Asked<'_>, all: &[Entry]) -> String {
    if all.is_empty() {
        return "the list is empty; a search from more starts may find some".to_owned();
    }
    let line = |(number, entry): (usize, &Entry)| {
        let values = entry.shape.0.iter().take(MOST).map(|(name, value)| format!("{name} = {value:.6}"));
        let more = if entry.shape.0.len() > MOST { ", ..." } else { "" };
        let values: Vec<String> = values.collect();
        format!(
            "\n  {}:{}  {}, {} growing, {}{more}",
            asked.shown(),
            number + 1,
            entry.motion,
            entry.unstable,
            values.join(", ")
        )
    };
    format!("give FILE:NUMBER, from 1{}", all.iter().enumerate().map(line).collect::<String>())
}

/// Most coordinates that are shown.
const MOST: usize = 4;
