//! Tests of the pages of tracked cells.

mod pages;
