//! Finished bodies as items of a journal: their tracks, number by number.

use crate::statistics::bodies::Body;
use motiform_dynamics::Outcome;
use motiform_statistics::Track;
use motiform_store::Journal;
use motiform_study::Error;
use std::path::Path;

/// The journal of the bodies of a study.
pub(crate) struct Kept<'j>(pub(crate) &'j dyn Journal);

impl Kept<'_> {
    /// The bodies from `first` on that an earlier run finished together.
    pub(crate) fn read(&self, first: usize) -> Option<Vec<Body>> {
        decode(&self.0.finished(&item(first))?)
    }

    /// Keeps bodies that were finished together, the first of which has this number.
    pub(crate) fn write(&self, first: usize, bodies: &[Body]) -> Result<(), Error> {
        let item = item(first);
        let content = encode(bodies).map_err(|error| Error::write_failed(Path::new(&item), error))?;
        Ok(self.0.finish(&item, &content)?)
    }
}

fn item(first: usize) -> String {
    format!("bodies-{first}.bin")
}

/// A line of JSON, then the numbers of all tracks.
fn encode(bodies: &[Body]) -> serde_json::Result<Vec<u8>> {
    let head: Vec<(Outcome, usize, usize)> = bodies
        .iter()
        .flatten()
        .map(|(outcome, track)| (*outcome, track.position.len(), track.modes.len()))
        .collect();
    let mut content = serde_json::to_vec(&head)?;
    content.push(b'\n');
    for (_, track) in bodies.iter().flatten() {
        let columns = [&track.position, &track.velocity].into_iter().chain(&track.modes).chain(&track.rates);
        columns.flatten().flatten().for_each(|number| content.extend(number.to_le_bytes()));
    }
    Ok(content)
}

/// `None` for what [`encode`] does not give.
fn decode(content: &[u8]) -> Option<Vec<Body>> {
    let line = content.iter().position(|&byte| byte == b'\n')?;
    let head: Vec<(Outcome, usize, usize)> = serde_json::from_slice(&content[..line]).ok()?;
    let mut pairs = content[line + 1..]
        .chunks_exact(16)
        .map(|pair| [0, 8].map(|at| f64::from_le_bytes(std::array::from_fn(|byte| pair[at + byte]))));
    let needed: usize = head.iter().map(|(_, rows, modes)| rows * (3 + 2 * modes)).sum();
    if pairs.len() != needed {
        return None;
    }
    let mut column = |rows: usize| -> Vec<[f64; 2]> { pairs.by_ref().take(rows).collect() };
    let body = |(outcome, rows, modes): (Outcome, usize, usize)| {
        let (position, velocity) = (column(rows), column(rows));
        let mut columns = |count: usize| (0..count).map(|_| column(rows)).collect();
        Some((outcome, Track { position, velocity, modes: columns(modes), rates: columns(modes + 1) }))
    };
    Some(head.into_iter().map(body).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn bodies_come_back_to_the_bit() {
        let track = |rows: usize| Track {
            position: (0..rows).map(|k| [0.1 * k as f64, -0.0]).collect(),
            velocity: (0..rows).map(|k| [1.0 / (k + 1) as f64, f64::MIN_POSITIVE]).collect(),
            modes: vec![(0..rows).map(|k| [k as f64, 1e300]).collect(); 2],
            rates: vec![(0..rows).map(|k| [-(k as f64), 1e-300]).collect(); 3],
        };
        let bodies = vec![
            Some((Outcome::Completed { t: 0.1 + 0.2 }, track(3))),
            Some((Outcome::Completed { t: 1.0 }, track(0))),
        ];
        let content = encode(&bodies).unwrap();
        assert_eq!(decode(&content).unwrap(), bodies);
        assert!(decode(&content[..content.len() - 16]).is_none() && decode(b"[]").is_none());
    }
}
