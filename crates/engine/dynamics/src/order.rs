//! The order of numbers.

/// Sorts numbers, smallest first, by [`f64::total_cmp`].
///
/// A sort is compiled again for every comparison that it is given: this one is compiled once for all crates.
#[inline(never)]
pub fn ascending(values: &mut [f64]) {
    values.sort_unstable_by(f64::total_cmp);
}
