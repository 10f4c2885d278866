//! Fields over time and arc length.

/// The boundary's field phi(s, t) and the outlines of the domain at the same times.
///
/// # Shapes  `phi`: time x arc (all arcs of the first time, then the next); `outlines`: time x point x 2 likewise
/// # Units   model time and model length
#[derive(Debug, Clone, PartialEq)]
pub struct Fields {
    /// Times.
    pub times: Vec<f64>,
    /// Arc lengths s along the boundary.
    pub arcs: Vec<f64>,
    /// phi(s, t), time by time.
    pub phi: Vec<f64>,
    /// Absolute coordinates of the boundary, time by time; NaN where it could not be closed.
    pub outlines: Vec<f64>,
    /// Number of points of an outline.
    pub points: usize,
    /// Attributes of the file, such as the manifest.
    pub attributes: Vec<(String, String)>,
}
