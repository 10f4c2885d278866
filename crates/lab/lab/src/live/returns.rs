//! Return maps of a recorded motion: of the maxima of its speed, or of its path through a segment.

use super::Record;
use crate::recorder::Centre;
use motiform_dynamics::Model;
use motiform_dynamics::model::velocity;
use motiform_store::table::Table;
use motiform_study::quantity::state::{RISING, T, X, Y};
use motiform_study::study::ReturnMapSettings;

/// The maxima of the speed, in order: each is the vertex of the parabola through three samples, so its error is of order
/// `dt^4`. None if the speed does not vary beyond its errors.
pub fn maxima_of_speed(record: &Record) -> Vec<f64> {
    let speeds: Vec<f64> = record.rows().map(|row| row.read[0]).collect();
    if !record.accuracy().varies(speeds.iter().copied()) {
        return Vec::new();
    }
    let vertex = |three: &[f64]| {
        let [a, b, c] = [three[0], three[1], three[2]];
        let bend = a - 2.0 * b + c;
        (b > a && b >= c).then(|| b - (c - a) * (c - a) / (8.0 * bend))
    };
    speeds.windows(3).filter_map(vertex).collect()
}

/// The crossings of a horizontal segment by the path, in either direction: `t, x, y, rising`, and the centre of the path, which
/// is first shifted to the origin if the settings require it. Between samples the path is the cubic with their positions and
/// velocities, an error of order `dt^4`.
pub fn crossings_of_path(
    record: &Record,
    model: &dyn Model,
    settings: &ReturnMapSettings,
) -> (Table, [f64; 2]) {
    let centre = if settings.centre { centre(record) } else { [0.0; 2] };
    let height = centre[1] + settings.y;
    let mut found: [Vec<f64>; 4] = Default::default();
    for (a, b) in record.rows().zip(record.rows().skip(1)) {
        let (below, above) = (a.position()[1] - height, b.position()[1] - height);
        if (below > 0.0) == (above > 0.0) {
            continue;
        }
        let shape = ..a.state.len() - 2;
        let piece = Piece {
            span: b.t - a.t,
            ends: [a.position(), b.position()],
            velocities: [velocity(model, &a.state[shape]), velocity(model, &b.state[shape])],
        };
        let s = piece.crossing(height, above > 0.0);
        let x = piece.at(s, 0) - centre[0];
        if settings.x_min < x && x < settings.x_max {
            let row = [a.t + s * piece.span, x, settings.y, f64::from(u8::from(above > 0.0))];
            found.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        }
    }
    (Table::of(&[&T, &X, &Y, &RISING], found.into()), centre)
}

/// The centre of the recorded path.
fn centre(record: &Record) -> [f64; 2] {
    let mut ends = record.rows().map(|row| row.t);
    let (Some(start), Some(end)) = (ends.next(), ends.next_back()) else { return [0.0; 2] };
    let mut centre = Centre::new(start, end);
    record.rows().for_each(|row| centre.add(row.t, row.position()));
    centre.found()
}

/// The path between two samples.
struct Piece {
    span: f64,
    ends: [[f64; 2]; 2],
    velocities: [[f64; 2]; 2],
}

impl Piece {
    /// A coordinate at the fraction `s` of the interval (cubic Hermite).
    fn at(&self, s: f64, axis: usize) -> f64 {
        let r = 1.0 - s;
        let [a, b] = self.ends.map(|end| end[axis]);
        let [da, db] = self.velocities.map(|velocity| self.span * velocity[axis]);
        r * r * ((1.0 + 2.0 * s) * a + s * da) + s * s * ((1.0 + 2.0 * r) * b - r * db)
    }

    /// The fraction of the interval at which the path passes a height, by bisection.
    fn crossing(&self, height: f64, rising: bool) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if (self.at(middle, 1) > height) == rising { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    }
}
