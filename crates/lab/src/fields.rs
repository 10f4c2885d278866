//! Dataset to fields: phi(s, t) and the outlines, for models with a field on the boundary.

use motiform_dynamics::Outline;
use motiform_files::{Fields, Format, Staged};
use motiform_study::{Dataset, Error};

/// Maximum number of times that are kept (beyond it, rows are skipped evenly).
const TIMES: usize = 2000;

/// Points along the boundary, of phi and of an outline.
const POINTS: usize = 128;

/// Writes a dataset with its fields into a staged folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_dataset(dataset: &Dataset, format: Format, staged: &Staged) -> Result<(), Error> {
    motiform_files::write_dataset(dataset, fields(dataset)?.as_ref(), format, staged)
}

/// The fields of a dataset; `None` for models without a field on the boundary.
///
/// # Errors
/// An unknown model, or a dataset without its columns.
pub fn fields(dataset: &Dataset) -> Result<Option<Fields>, Error> {
    let manifest = &dataset.manifest;
    let values = manifest.plan.computation.parameters.values();
    let model = manifest.plan.info()?.build(&values)?;
    let table = &dataset.trajectory;
    let (Some(radius), Some(times)) = (model.radius(), table.get("t")) else { return Ok(None) };
    let columns: Vec<&[f64]> = model.coordinates().iter().filter_map(|c| table.get(c.name)).collect();
    let (Some(x), Some(y)) = (table.get("x"), table.get("y")) else { return Ok(None) };
    if columns.len() != model.coordinates().len() || times.is_empty() {
        return Ok(None);
    }
    let stride = times.len().div_ceil(TIMES);
    let length = std::f64::consts::TAU * radius;
    let mut fields = Fields {
        times: Vec::new(),
        arcs: (0..POINTS).map(|j| length * j as f64 / POINTS as f64).collect(),
        phi: Vec::new(),
        outlines: Vec::new(),
        points: POINTS,
        attributes: vec![
            ("motiform".to_owned(), serde_json::to_string(manifest).unwrap_or_default()),
            ("every_nth_row".to_owned(), stride.to_string()),
        ],
    };
    let mut shape = vec![0.0; columns.len()];
    for row in (0..times.len()).step_by(stride) {
        let named: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        model.encode(&named, &mut shape);
        let Some(phi) = model.profile(&shape, POINTS) else { return Ok(None) };
        fields.times.push(times[row]);
        fields.phi.extend(phi);
        if let Outline::Curve(points) = model.outline(&shape, radius, POINTS) {
            fields.outlines.extend(points.iter().flat_map(|p| [x[row] + p[0], y[row] + p[1]]));
        } else {
            fields.outlines.extend(std::iter::repeat_n(f64::NAN, 2 * POINTS));
        }
    }
    Ok(Some(fields))
}
