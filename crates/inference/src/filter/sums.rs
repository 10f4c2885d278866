//! Sums of scores and informations over frames.

use super::correct::{MARKS, Marks};
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
}

impl<B: Bundle> Sums<B> {
    #[inline(always)]
    pub(crate) fn new(blocks: usize) -> Self {
        let zero = B::splat(0.0);
        Self {
            blocks,
            gradient: vec![zero; blocks],
            scores: vec![zero; blocks],
            information: vec![zero; blocks * B::LANES * blocks],
            marks: vec![0.0; MARKS * blocks * B::LANES],
        }
    }

    /// Notes what a frame says about a block.
    #[inline(always)]
    pub(crate) fn note(&mut self, block: usize, found: &Marks<B>) {
        self.gradient[block] += found.score;
        self.scores[block] = found.score;
        let width = self.blocks * B::LANES;
        for mark in 0..MARKS {
            found.marks[mark].store(&mut self.marks[mark * width + block * B::LANES..]);
        }
    }

    /// Adds the information of the frame.
    #[inline(always)]
    pub(crate) fn add(&mut self) {
        let width = self.blocks * B::LANES;
        for row in 0..width {
            for block in row / B::LANES..self.blocks {
                let mut sum = self.information[row * self.blocks + block];
                for mark in 0..MARKS {
                    let own = B::splat(self.marks[mark * width + row]);
                    sum += own * B::load(&self.marks[mark * width + block * B::LANES..]);
                }
                self.information[row * self.blocks + block] = sum;
            }
        }
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
