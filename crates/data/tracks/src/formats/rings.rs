//! Well-known text of polygons -> rings.

use crate::input::shorten;
use crate::{Error, Place, Result};

/// The outer ring of `POLYGON ((x y, x y, ...))`, also with Z, and of a `MULTIPOLYGON` with one polygon. Empty for `EMPTY`.
///
/// # Errors
/// [`Error::Structure`] for several polygons, holes, and numbers that are none.
pub(super) fn outer_ring(text: &str, place: &Place) -> Result<Vec<[f64; 2]>> {
    let wrong = |found: String| Error::structure(place, found, "one POLYGON ((x y, x y, ...)) without holes");
    let Some(open) = text.find('(') else {
        return if text.to_ascii_uppercase().contains("EMPTY") {
            Ok(Vec::new())
        } else {
            Err(wrong(format!("{:?}", shorten(text))))
        };
    };
    let Some(close) = text.rfind(')') else {
        return Err(Error::Truncated { place: place.clone(), missing: "the end of a polygon".to_owned() });
    };
    let inner = text.get(open..=close).unwrap_or_default();
    let mut rings = inner.split(['(', ')']).filter(|ring| ring.contains(|c: char| c.is_alphanumeric()));
    let ring = rings.next().ok_or_else(|| wrong("no vertex".to_owned()))?;
    if rings.next().is_some() {
        return Err(wrong("several rings (holes or parts)".to_owned()));
    }
    ring.split(',')
        .map(|vertex| self::vertex(vertex).ok_or_else(|| wrong(format!("{:?}", shorten(vertex)))))
        .collect()
}

/// `x y`, `x y z` or `x y z m`.
fn vertex(text: &str) -> Option<[f64; 2]> {
    let mut words = text.split_ascii_whitespace();
    let [x, y] = [words.next()?.parse().ok()?, words.next()?.parse().ok()?];
    (words.count() <= 2).then_some([x, y])
}
