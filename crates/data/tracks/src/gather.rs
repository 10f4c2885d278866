//! Vertices in the order of a file -> cells with one outline per frame.

use crate::resolve::{Resolved, resolve};
use crate::{Apart, Cell, Error, Limits, Note, Outline, Place, Result};
use std::collections::{BTreeMap, HashMap};

/// A vertex: its place along the outline, and its coordinates.
pub(crate) type Vertex = (i64, [f64; 2]);

/// The cell and the frame that a vertex or an outline belongs to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key<'a> {
    pub(crate) cell: &'a str,
    pub(crate) frame: i64,
}

#[derive(Default)]
struct Draft {
    vertices: Vec<Vertex>,
    t: Option<f64>,
}

struct DraftCell {
    name: String,
    frames: BTreeMap<i64, Draft>,
}

/// Collects the vertices of one file.
pub(crate) struct Gather {
    limits: Limits,
    cells: Vec<DraftCell>,
    index: HashMap<String, usize>,
    vertices: u64,
    outlines: u64,
    /// Cell, frame and next place of the block of rows that is being read.
    block: Option<(usize, i64, i64)>,
}

impl Gather {
    pub(crate) fn new(limits: Limits) -> Self {
        Self { limits, cells: Vec::new(), index: HashMap::new(), vertices: 0, outlines: 0, block: None }
    }

    /// One row of a table; without `i` the order of the rows is that of the vertices.
    pub(crate) fn row(&mut self, key: Key<'_>, i: Option<i64>, point: [f64; 2], place: &Place) -> Result<()> {
        let cell = self.cell(key.cell);
        let next = match self.block {
            Some((same, frame, next)) if same == cell && frame == key.frame => next,
            _ => 0,
        };
        self.block = Some((cell, key.frame, next + 1));
        self.count(1, place)?;
        self.draft(cell, key.frame, place)?.vertices.push((i.unwrap_or(next), point));
        Ok(())
    }

    /// A whole outline, with its time where the file has one.
    pub(crate) fn outline(
        &mut self,
        key: Key<'_>,
        t: Option<f64>,
        points: &[[f64; 2]],
        place: &Place,
    ) -> Result<()> {
        let cell = self.cell(key.cell);
        self.count(points.len() as u64, place)?;
        let draft = self.draft(cell, key.frame, place)?;
        draft.t = draft.t.or(t);
        draft.vertices.extend((0..).zip(points.iter().copied()));
        self.block = None;
        Ok(())
    }

    /// The cells, with times `frame` where the file has none. `apart`: the remedy where several cells have one name.
    pub(crate) fn finish(self, place: &Place, apart: Apart) -> Result<(Vec<Cell>, Vec<Note>)> {
        let mut notes = Vec::new();
        let mut cells = Vec::with_capacity(self.cells.len());
        for draft in self.cells {
            cells.push(finished(draft, &mut notes, place, apart)?);
        }
        cells.retain(|cell| !cell.frames.is_empty());
        Ok((cells, notes))
    }

    fn cell(&mut self, name: &str) -> usize {
        if let Some(&at) = self.index.get(name) {
            return at;
        }
        self.index.insert(name.to_owned(), self.cells.len());
        self.cells.push(DraftCell { name: name.to_owned(), frames: BTreeMap::new() });
        self.cells.len() - 1
    }

    fn draft(&mut self, cell: usize, frame: i64, place: &Place) -> Result<&mut Draft> {
        let limit = self.limits.outlines;
        let outlines = &mut self.outlines;
        let frames = &mut self.cells[cell].frames;
        let draft = frames.entry(frame).or_insert_with(|| {
            *outlines += 1;
            Draft::default()
        });
        if *outlines > limit {
            return Err(Error::Limit { place: place.clone(), what: "outlines", limit, key: "outlines" });
        }
        Ok(draft)
    }

    fn count(&mut self, more: u64, place: &Place) -> Result<()> {
        self.vertices += more;
        let limit = self.limits.vertices;
        if self.vertices > limit {
            return Err(Error::Limit { place: place.clone(), what: "vertices", limit, key: "vertices" });
        }
        Ok(())
    }
}

fn finished(draft: DraftCell, notes: &mut Vec<Note>, place: &Place, apart: Apart) -> Result<Cell> {
    let (name, total) = (draft.name, draft.frames.len());
    let (mut same, mut conflicts, mut missing) = (Vec::new(), Vec::new(), Vec::new());
    let mut frames = Vec::with_capacity(total);
    for (frame, draft) in draft.frames {
        let t = draft.t.unwrap_or(frame as f64);
        match resolve(draft.vertices) {
            Resolved::One { points, copies, missing: lost } => {
                same.extend((copies > 1).then_some(frame));
                missing.extend((lost > 0).then_some(frame));
                frames.push(Outline { frame, t, points, missing: lost });
            }
            Resolved::Conflict => conflicts.push(frame),
        }
    }
    if let Some(&first) = conflicts.first()
        && 2 * conflicts.len() >= total
    {
        let file = place.path().to_owned();
        let conflicts = conflicts.len();
        return Err(Error::MixedCells { file, name, conflicts, frames: total, first, remedy: apart });
    }
    let cell = || name.clone();
    notes.extend((!same.is_empty()).then(|| Note::SameFrameTwice { cell: cell(), frames: same }));
    notes
        .extend((!conflicts.is_empty()).then(|| Note::ConflictingFrames { cell: cell(), frames: conflicts }));
    notes.extend((!missing.is_empty()).then(|| Note::MissingVertices { cell: cell(), frames: missing }));
    Ok(Cell { name, frames })
}
