//! The starts of windows: the parts of the tracks over which lagged sums are taken and left out together.

use crate::{Track, Tracks};
use std::ops::Range;

/// Windows that are left out together.
pub(crate) struct Starts<'t> {
    /// Their group.
    pub(crate) group: usize,
    /// The samples.
    pub(crate) track: &'t Track,
    /// The samples at which windows start; they may end beyond.
    pub(crate) range: Range<usize>,
}

impl Starts<'_> {
    /// Returns `true` if windows start at every sample of the track and end within it.
    pub(crate) fn is_whole(&self) -> bool {
        self.range == (0..self.track.position.len())
    }
}

impl Tracks {
    /// All windows, by groups.
    pub(crate) fn starts(&self) -> Vec<Starts<'_>> {
        let Some(pieces) = self.pieces() else {
            let whole = |(unit, track): (usize, &'_ Track)| (self.group(unit), track.position.len());
            let units = self.units().iter().enumerate();
            return units
                .map(|pair| (whole(pair), pair.1))
                .map(|((group, end), track)| Starts { group, track, range: 0..end })
                .collect();
        };
        let of = |(body, track): (usize, &'_ Track)| {
            let samples = track.position.len();
            let edge = move |piece: usize| piece * samples / pieces;
            (0..pieces)
                .map(move |piece| (body * pieces + piece, edge(piece)..edge(piece + 1)))
                .collect::<Vec<_>>()
        };
        let bodies = self.bodies().iter().enumerate();
        bodies
            .flat_map(|pair| {
                of(pair).into_iter().map(move |(group, range)| Starts { group, track: pair.1, range })
            })
            .collect()
    }
}
