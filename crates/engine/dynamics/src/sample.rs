//! Numbers of samples: their order, mean, median and quantiles.

/// Sorts numbers, smallest first, by [`f64::total_cmp`].
///
/// A sort is compiled again for every comparison that it is given: this one is compiled once for all crates.
#[inline(never)]
pub fn ascending(values: &mut [f64]) {
    values.sort_unstable_by(f64::total_cmp);
}

/// Sorts by a number of each item, smallest first, by [`f64::total_cmp`]; items of one number keep their order.
pub fn sort_by_number<T>(items: &mut [T], number: impl FnMut(&T) -> f64) {
    let numbers: Vec<f64> = items.iter().map(number).collect();
    let mut ranks = ranks(&numbers);
    for at in 0..items.len() {
        while ranks[at] != at {
            let rank = ranks[at];
            items.swap(at, rank);
            ranks.swap(at, rank);
        }
    }
}

/// The place of each number in ascending order. Compiled once, as [`ascending`] is.
#[inline(never)]
fn ranks(numbers: &[f64]) -> Vec<usize> {
    let mut places: Vec<usize> = (0..numbers.len()).collect();
    places.sort_unstable_by(|&a, &b| numbers[a].total_cmp(&numbers[b]).then(a.cmp(&b)));
    let mut ranks = vec![0; numbers.len()];
    places.iter().enumerate().for_each(|(rank, &place)| ranks[place] = rank);
    ranks
}

/// The mean; `None` of nothing.
pub fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (sum, count) =
        values.into_iter().fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// The median, of an even number the mean of the middle two; `None` of nothing.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    ascending(&mut sorted);
    quantile(&sorted, 0.5)
}

/// The quantile of a share (0 to 1) of numbers in ascending order, linear between them; `None` of nothing.
///
/// q(p) = x_k + (h - k) (x_(k+1) - x_k),   h = p (n - 1), k = floor(h), x_0 the smallest of n numbers
///
/// Source: Hyndman and Fan (1996), Am. Stat. 50, 361, definition 7.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * sorted.len().checked_sub(1)? as f64;
    let low = sorted[place as usize];
    match sorted.get(place as usize + 1) {
        Some(high) if place.fract() > 0.0 => Some((1.0 - place.fract()) * low + place.fract() * high),
        _ => Some(low),
    }
}

#[cfg(test)]
mod tests {
    use super::{mean, median, quantile, sort_by_number};

    /// As the stable sort of the standard library, of all cycles of a permutation, equal numbers, zeros of both signs and no number.
    #[test]
    fn a_sort_by_a_number_is_stable() {
        let numbers = [3.0, -0.0, 7.0, 0.0, f64::NAN, 3.0, -1.0, f64::NEG_INFINITY, 7.0, 2.0, 3.0];
        for length in 0..=numbers.len() {
            let items: Vec<(usize, f64)> = numbers[..length].iter().copied().enumerate().collect();
            let (mut ours, mut theirs) = (items.clone(), items);
            sort_by_number(&mut ours, |item| -item.1);
            theirs.sort_by(|a, b| b.1.total_cmp(&a.1));
            let places = |items: &[(usize, f64)]| items.iter().map(|item| item.0).collect::<Vec<_>>();
            assert_eq!(places(&ours), places(&theirs));
        }
    }

    /// By hand; the last ones as `numpy.quantile` has them.
    #[test]
    fn means_medians_and_quantiles() {
        assert_eq!([mean([]), mean([1.0, 4.0])], [None, Some(2.5)]);
        assert_eq!([median([]), median([3.0]), median([3.0, 1.0, 9.0])], [None, Some(3.0), Some(3.0)]);
        assert_eq!(median([8.0, 1.0, 3.0, 4.0]), Some(3.5));
        let values = [1.0, 2.0, 4.0, 8.0, 16.0];
        assert_eq!(
            [0.0, 0.25, 0.875, 1.0].map(|share| quantile(&values, share)),
            [1.0, 2.0, 12.0, 16.0].map(Some)
        );
        assert_eq!(quantile(&[f64::MAX, f64::MAX], 0.5), Some(f64::MAX));
    }
}
