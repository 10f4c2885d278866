//! Dataset to fields: phi(s, t) and the outlines, for models with a field on the boundary.

use crate::simulate::Run;
use motiform_dynamics::{Model, Outline};
use motiform_store::table::Table;
use motiform_store::{Fields, Format, Staged, read_groups, write_table};
use motiform_study::{Dataset, Error, Manifest};
use std::path::Path;

/// Maximum number of times that are kept (beyond it, rows are skipped evenly).
const TIMES: usize = 2000;

/// Points along the boundary, of phi and of an outline.
const POINTS: usize = 128;

/// Writes a dataset with its fields into a staged folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_dataset(dataset: &Dataset, format: Format, staged: &Staged) -> Result<(), Error> {
    let Dataset { manifest, trajectory, crossings } = dataset;
    let path = staged.path().join(format.file("trajectory"));
    write_table(trajectory, manifest, format, &path).map_err(|error| staged.shown(error))?;
    let fields = fields_in(manifest, trajectory)?;
    crate::dataset::write_rest(manifest, crossings.as_ref(), fields.as_ref(), format, staged)
}

/// Writes what belongs to a trajectory that is in the staged folder already (and `whole` in memory where it
/// is short): crossings, fields and manifest.
///
/// # Errors
/// Files that cannot be read or written.
pub fn write_rest(run: &Run, whole: Option<&Table>, format: Format, staged: &Staged) -> Result<(), Error> {
    let Run { manifest, crossings } = run;
    let fields = match whole {
        Some(table) => fields_in(manifest, table)?,
        None => fields_of(manifest, &staged.path().join(format.file("trajectory")))?,
    };
    crate::dataset::write_rest(manifest, crossings.as_ref(), fields.as_ref(), format, staged)
}

/// The fields of a table of states; `None` for models without a field on the boundary.
fn fields_in(manifest: &Manifest, table: &Table) -> Result<Option<Fields>, Error> {
    let Some(mut made) = Making::new(manifest, table.rows())? else { return Ok(None) };
    made.take(table);
    Ok(made.done())
}

/// The fields of a trajectory that is read a group of rows at a time.
fn fields_of(manifest: &Manifest, path: &Path) -> Result<Option<Fields>, Error> {
    let mut rows = 0;
    if Making::new(manifest, 1)?.is_some() {
        read_groups(path, &mut |group| -> Result<(), Error> {
            rows += group.rows();
            Ok(())
        })?;
    }
    let Some(mut made) = Making::new(manifest, rows)? else { return Ok(None) };
    read_groups(path, &mut |group| -> Result<(), Error> {
        made.take(&group);
        Ok(())
    })?;
    Ok(made.done())
}

/// Fields that are being made.
struct Making {
    model: Box<dyn Model>,
    radius: f64,
    stride: usize,
    /// Rows so far.
    seen: usize,
    fields: Fields,
    /// A row had no field, or a column is missing: there are none.
    without: bool,
}

impl Making {
    /// Those of a trajectory of so many rows; `None` without rows, and for models without a field.
    fn new(manifest: &Manifest, rows: usize) -> Result<Option<Self>, Error> {
        let model = manifest.plan.body()?;
        let Some(radius) = model.radius().filter(|_| rows > 0) else { return Ok(None) };
        let stride = rows.div_ceil(TIMES);
        let length = std::f64::consts::TAU * radius;
        let fields = Fields {
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
        Ok(Some(Self { model, radius, stride, seen: 0, fields, without: false }))
    }

    /// Takes the next rows.
    fn take(&mut self, table: &Table) {
        let Self { model, radius, fields, .. } = self;
        let columns: Vec<&[f64]> = model.coordinates().iter().filter_map(|c| table.get(c.name)).collect();
        let (Some(times), Some(x), Some(y)) = (table.get("t"), table.get("x"), table.get("y")) else {
            self.without = true;
            return;
        };
        self.without |= columns.len() != model.coordinates().len();
        let first = (self.stride - self.seen % self.stride) % self.stride;
        self.seen += times.len();
        let mut shape = vec![0.0; columns.len()];
        for row in (first..times.len()).step_by(self.stride) {
            if self.without {
                return;
            }
            let named: Vec<f64> = columns.iter().map(|column| column[row]).collect();
            model.encode(&named, &mut shape);
            let Some(phi) = model.profile(&shape, POINTS) else {
                self.without = true;
                return;
            };
            fields.times.push(times[row]);
            fields.phi.extend(phi);
            if let Outline::Curve(points) = model.outline(&shape, *radius, POINTS) {
                fields.outlines.extend(points.iter().flat_map(|p| [x[row] + p[0], y[row] + p[1]]));
            } else {
                fields.outlines.extend(std::iter::repeat_n(f64::NAN, 2 * POINTS));
            }
        }
    }

    fn done(self) -> Option<Fields> {
        (!self.without).then_some(self.fields)
    }
}
