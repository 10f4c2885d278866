//! Sums of scores and informations over frames.

use super::correct::{Marks, marks_of};
use motiform_dynamics::Bundle;

/// Sums over frames; parameters are padded to whole blocks.
pub(crate) struct Sums<B> {
    blocks: usize,
    gradient: Vec<B>,
    /// Scores of the frame.
    scores: Vec<B>,
    /// Rows of parameters times blocks of parameters, from the row's own block on.
    information: Vec<B>,
    /// Marks of the frame: parameter within blocks.
    marks: Vec<f64>,
    /// Number of marks of each block that are not 0.
    counts: Vec<usize>,
}

impl<B: Bundle> Sums<B> {
    /// `counts`: how many marks of each block are not 0.
    #[inline(always)]
    pub(crate) fn new<const SHAPE: usize>(counts: Vec<usize>) -> Self {
        let (blocks, zero) = (counts.len(), B::splat(0.0));
        Self {
            blocks,
            gradient: vec![zero; blocks],
            scores: vec![zero; blocks],
            information: vec![zero; blocks * B::LANES * blocks],
            marks: vec![0.0; marks_of(SHAPE) * blocks * B::LANES],
            counts,
        }
    }

    /// Notes what a frame says about a block.
    #[inline(always)]
    pub(crate) fn note<const SHAPE: usize>(&mut self, block: usize, found: &Marks<B, SHAPE>) {
        self.gradient[block] += found.score;
        self.scores[block] = found.score;
        let (width, mut place) = (self.blocks * B::LANES, block * B::LANES);
        for mark in &found.mean {
            mark.store(&mut self.marks[place..]);
            place += width;
        }
        if self.counts[block] > SHAPE {
            for i in 0..SHAPE {
                for mark in &found.covariance[i][..=i] {
                    mark.store(&mut self.marks[place..]);
                    place += width;
                }
            }
        }
    }

    /// Adds the information of the frame.
    #[inline(always)]
    pub(crate) fn add(&mut self) {
        for row in 0..self.blocks * B::LANES {
            let mut block = row / B::LANES;
            let count = self.counts[block];
            while block + 4 <= self.blocks {
                self.add_to::<4>(row, block, count);
                block += 4;
            }
            if block + 2 <= self.blocks {
                self.add_to::<2>(row, block, count);
                block += 2;
            }
            if block < self.blocks {
                self.add_to::<1>(row, block, count);
            }
        }
    }

    /// Adds to `N` blocks of a row at once: their sums do not wait for each other.
    #[inline(always)]
    fn add_to<const N: usize>(&mut self, row: usize, block: usize, count: usize) {
        let (width, place) = (self.blocks * B::LANES, row * self.blocks + block);
        let mut sums = [B::splat(0.0); N];
        sums.copy_from_slice(&self.information[place..place + N]);
        for mark in 0..count {
            let marks = &self.marks[mark * width..(mark + 1) * width];
            let own = B::splat(marks[row]);
            let others = &marks[block * B::LANES..(block + N) * B::LANES];
            for n in 0..N {
                sums[n] += own * B::load(&others[n * B::LANES..]);
            }
        }
        self.information[place..place + N].copy_from_slice(&sums);
    }

    /// Number of padded parameters.
    pub(crate) fn width(&self) -> usize {
        self.blocks * B::LANES
    }

    /// The scores of the frame.
    #[inline(always)]
    pub(crate) fn take_scores(&self) -> Vec<f64> {
        let mut scores = vec![0.0; self.width()];
        for block in 0..self.blocks {
            self.scores[block].store(&mut scores[block * B::LANES..]);
        }
        scores
    }

    /// Gradient and information (rows of all padded parameters).
    #[inline(always)]
    pub(crate) fn finish(&self) -> (Vec<f64>, Vec<f64>) {
        let width = self.blocks * B::LANES;
        let (mut gradient, mut information) = (vec![0.0; width], vec![0.0; width * width]);
        for block in 0..self.blocks {
            self.gradient[block].store(&mut gradient[block * B::LANES..]);
            for row in 0..width {
                let place = row * width + block * B::LANES;
                self.information[row * self.blocks + block].store(&mut information[place..]);
            }
        }
        (gradient, information)
    }
}
