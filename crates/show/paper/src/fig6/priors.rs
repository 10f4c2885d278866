//! The dependence of speeds and turns on the a priori distribution of the error function, which the paper
//! does not give.
//!
//! The error function is not fed back into the shape, so the shapes are the same for every prior: what is computed again is the velocity.

use super::super::claims::check;
use super::super::context::Context;
use super::lengths::{modes_for, study};
use super::tracks::Track;
use motiform_analysis::Regime;
use motiform_analysis::symmetry::wrap;
use motiform_dynamics::Shape;
use motiform_dynamics::sample::ascending;
use motiform_figures::report::{Cell as Field, Claim, Table};
use motiform_study::{Dataset, Error};

/// Priors n^-p: in a full, and in a quick run; the one that is used elsewhere is the middle one.
const PRIORS: (&[f64], &[f64]) = (&[2.0, 3.0, 4.0, 5.0, 6.0], &[2.0, 4.0, 6.0]);

/// A straight and a rectangular motion, which no panel of Fig. 6 shows.
const FURTHER: [f64; 2] = [9.0, 13.4];

/// Turns within this many degrees are of one kind.
const ALIKE: f64 = 8.0;

/// The largest difference of turns between priors (degrees).
const SAME: f64 = 6.0;

/// Recorded shapes of a length.
#[derive(Clone)]
pub(super) struct Shapes {
    pub(super) length: f64,
    pub(super) shapes: Vec<Vec<f64>>,
}

/// The speed and the turns that a prior gives to shapes.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    /// Mean speed over the shapes that could be closed.
    pub(super) speed: f64,
    /// The kinds of turns (degrees), smallest first; none where a boundary could not be closed.
    pub(super) turns: Vec<f64>,
    /// Shapes whose boundary could not be closed.
    failed: usize,
}

/// For each prior what it makes of each length.
#[derive(Clone)]
pub(super) struct Priors {
    priors: Vec<f64>,
    lengths: Vec<f64>,
    /// The places of motions with orderly turns.
    turning: Vec<usize>,
    found: Vec<Vec<Seen>>,
}

impl Priors {
    pub(super) fn find(context: &Context<'_>, tracks: &[Track]) -> Result<Self, Error> {
        let found = context.kept.once("priors of Fig. 6", || Self::computed(context, tracks))?;
        let change = |seen: Seen| Seen {
            speed: context.number(seen.speed),
            turns: seen.turns.into_iter().map(|turn| context.number(turn)).collect(),
            ..seen
        };
        let change = |row: Vec<Seen>| row.into_iter().map(change).collect();
        Ok(Self { found: found.found.into_iter().map(change).collect(), ..found })
    }

    fn computed(context: &Context<'_>, tracks: &[Track]) -> Result<Self, Error> {
        let [one, other] = FURTHER.map(|length| recorded(context, length));
        let mut all = vec![one?, other?];
        for track in tracks {
            let mut shapes = shapes_of(&track.dataset)?;
            if track.verdict.regime != Regime::Zigzag {
                // a mean speed needs no order
                shapes.shapes = shapes.shapes.into_iter().step_by(context.choose(1, 8)).collect();
            }
            all.push(shapes);
        }
        let priors = context.choose(PRIORS.0, PRIORS.1);
        let found = context.each(priors, |prior| {
            all.iter().map(|shapes| seen(shapes, *prior)).collect::<Result<Vec<Seen>, Error>>()
        })?;
        let orderly =
            tracks.iter().zip(FURTHER.len()..).filter(|(track, _)| track.verdict.regime == Regime::Zigzag);
        let turning = std::iter::once(1).chain(orderly.map(|(_, place)| place)).collect();
        Ok(Self {
            priors: priors.to_vec(),
            lengths: all.iter().map(|shapes| shapes.length).collect(),
            turning,
            found,
        })
    }

    /// Mean speeds and turns.
    pub(super) fn table(&self) -> Table {
        let mut head = vec!["prior".to_owned()];
        head.extend(self.lengths.iter().map(|length| format!("*L* = {length}: speed × 10^4")));
        head.push("turns (degrees)".to_owned());
        head.push("not closed".to_owned());
        let row = |(prior, seen): (&f64, &Vec<Seen>)| {
            let mut row = vec![Field::text(format!("*n*^{{-{prior}}}"))];
            row.extend(seen.iter().map(|seen| Field::number(format!("{:.3}", 1e4 * seen.speed))));
            let named = |place: &usize| self.turning.contains(place) && !seen[*place].turns.is_empty();
            let turns = (0..seen.len()).filter(named).map(|place| (self.lengths[place], &seen[place]));
            let words = |(length, seen): (f64, &Seen)| {
                let turns: Vec<String> = seen.turns.iter().map(|turn| format!("{turn:.0}")).collect();
                format!("{} at {length}", turns.join(" and "))
            };
            row.push(Field::text(turns.map(words).collect::<Vec<_>>().join("; ")));
            row.push(Field::number(seen.iter().map(|seen| seen.failed).sum::<usize>().to_string()));
            row
        };
        Table {
            caption: "Mean speed and turns of the same shapes with other priors of the error function \
                (width *n*^{-*p*} of its mode *n*; *p* = 4 is used everywhere else). Not closed: shapes for \
                which no most likely error function was found; turns are given where all were closed."
                .to_owned(),
            head,
            rows: self.priors.iter().zip(&self.found).map(row).collect(),
        }
    }

    /// With the prior that is used elsewhere.
    fn used(&self) -> &[Seen] {
        &self.found[self.found.len() / 2]
    }

    /// The largest over the smallest speed at a length.
    fn ratio(&self, place: usize) -> f64 {
        let speeds = || self.found.iter().map(|row| row[place].speed);
        speeds().fold(0.0, f64::max) / speeds().fold(f64::INFINITY, f64::min)
    }

    /// The distance of turns from those of the prior that is used; infinite where others are found.
    fn apart(&self, place: usize) -> f64 {
        let used = &self.used()[place].turns;
        let of = |row: &Vec<Seen>| {
            let turns = &row[place].turns;
            match (turns.is_empty(), turns.len() == used.len()) {
                (true, _) => 0.0,
                (false, false) => f64::INFINITY,
                _ => turns.iter().zip(used).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
            }
        };
        self.found.iter().map(of).fold(0.0, f64::max)
    }

    /// Turns hardly depend on it, speeds do.
    pub(super) fn claim(&self, tracks: &[Track]) -> Claim {
        let apart = self.turning.iter().map(|place| self.apart(*place)).fold(0.0, f64::max);
        let ratios: Vec<String> = self
            .lengths
            .iter()
            .enumerate()
            .map(|(place, length)| format!("{:.3} at *L* = {length}", self.ratio(place)))
            .collect();
        // the last two lengths are those of (c) and (d)
        let named = tracks.iter().zip(&self.used()[FURTHER.len()..]).skip(2).all(|(track, seen)| {
            let turns = track.turns();
            turns.len() == seen.turns.len()
                && turns.iter().zip(&seen.turns).all(|(a, b)| (a - b).abs() < SAME)
        });
        check(
            "Turns and speeds hardly depend on the prior of the error function, which the paper does not give.",
            format!(
                "between priors *n*^{{-2}} and *n*^{{-6}} the turns at {} lengths change by up to \
                {apart:.1} degrees; the mean speeds by a factor of {}",
                self.turning.len(),
                ratios.join(", ")
            ),
            "the same recorded shapes, closed with each prior; changes of the heading from the top speed of \
            a leg to that of the next one, kinds within 8 degrees taken together; within 6 degrees of those \
            with *n*^{-4}, which are those that the classifier finds for (c) and (d), and 90 at *L* = 13.4; \
            the speeds within a factor of 1.25.",
            self.turning.len() >= 3
                && apart < SAME
                && named
                && matches!(self.used()[1].turns[..], [turn] if (turn - 90.0).abs() < 3.0)
                && (0..self.lengths.len()).all(|place| (1.0..1.25).contains(&self.ratio(place))),
        )
    }
}

/// Shapes of a run from a random start.
fn recorded(context: &Context<'_>, length: f64) -> Result<Shapes, Error> {
    let mut study = study(length, modes_for(length))?;
    let time = if length < 10.0 { 10.0 } else { 1500.0 };
    (study.run.transient, study.run.t_end, study.run.dt_out) = (4000.0, time, 0.5);
    shapes_of(&context.simulate(&study)?)
}

/// The recorded shapes.
pub(super) fn shapes_of(dataset: &Dataset) -> Result<Shapes, Error> {
    let c = &dataset.manifest.plan.computation;
    let length = c.parameters.get("length").unwrap_or(f64::NAN);
    let model = dataset.manifest.plan.body()?;
    let columns: Vec<&[f64]> =
        model.coordinates().iter().filter_map(|one| dataset.trajectory.get(one.name)).collect();
    let shape = |row: usize| {
        let state: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        model.encoded(&state)
    };
    let shapes = (0..dataset.trajectory.rows()).map(shape).collect();
    Ok(Shapes { length, shapes })
}

/// Speeds and turns with a prior.
pub(super) fn seen(shapes: &Shapes, prior: f64) -> Result<Seen, Error> {
    let modes = shapes.shapes.first().map_or(1, Vec::len) / 2;
    let mut study = study(shapes.length, modes)?;
    study.set("prior", prior)?;
    let model = study.body()?;
    let velocity = |shape: &Vec<f64>| {
        model.obstacle(shape).is_none().then(|| Shape::<f64>::velocity(model.as_ref(), shape))
    };
    let moves: Vec<Option<[f64; 2]>> = shapes.shapes.iter().map(velocity).collect();
    let speeds: Vec<f64> = moves.iter().flatten().map(|[x, y]| libm::hypot(*x, *y)).collect();
    let failed = moves.len() - speeds.len();
    let turns =
        if failed == 0 { kinds(&moves.into_iter().flatten().collect::<Vec<_>>()) } else { Vec::new() };
    Ok(Seen { speed: speeds.iter().sum::<f64>() / speeds.len() as f64, turns, failed })
}

/// The kinds of turns (degrees) between the speed maxima of consecutive legs: means of those that are alike.
/// Between two legs the speed falls below half of either maximum; maxima below a tenth of the top speed are
/// none.
fn kinds(velocities: &[[f64; 2]]) -> Vec<f64> {
    let speed = |i: usize| libm::hypot(velocities[i][0], velocities[i][1]);
    let top = (0..velocities.len()).map(speed).fold(0.0, f64::max);
    let mut peaks: Vec<usize> = Vec::new();
    let mut least = f64::INFINITY;
    for i in 1..velocities.len().saturating_sub(1) {
        least = least.min(speed(i));
        let is_peak = speed(i - 1) <= speed(i) && speed(i) > speed(i + 1) && speed(i) > 0.1 * top;
        match peaks.last_mut() {
            _ if !is_peak => continue,
            Some(last) if 2.0 * least > speed(*last).min(speed(i)) => {
                if speed(i) > speed(*last) {
                    *last = i;
                }
            }
            _ => peaks.push(i),
        }
        least = f64::INFINITY;
    }
    let heading = |i: usize| libm::atan2(velocities[i][1], velocities[i][0]);
    let mut turns: Vec<f64> =
        peaks.windows(2).map(|pair| wrap(heading(pair[1]) - heading(pair[0])).to_degrees().abs()).collect();
    turns.retain(|turn| *turn > ALIKE); // a leg may have two maxima
    ascending(&mut turns);
    let alike = turns.chunk_by(|a, b| b - a < ALIKE);
    alike.map(|group| group.iter().sum::<f64>() / group.len() as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::kinds;
    use std::f64::consts::PI;

    /// Legs whose speed rises and falls as a sine, one after the other with these headings, in degrees.
    fn path(headings: &[f64], small: f64) -> Vec<[f64; 2]> {
        let leg = |heading: f64, size: f64| {
            let (sin, cos) = libm::sincos(heading.to_radians());
            (0..50).map(move |i| size * libm::sin(PI * f64::from(i) / 50.0)).map(move |v| [v * cos, v * sin])
        };
        headings.iter().flat_map(|heading| leg(*heading, 1.0).chain(leg(heading + 77.0, small))).collect()
    }

    #[test]
    fn turns_are_those_between_the_legs() {
        let near = |found: &[f64], wanted: &[f64]| {
            found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9)
        };
        let zigzag = [0.0, 180.0, 135.0, 315.0, 0.0, 180.0];
        assert!(near(&kinds(&path(&zigzag, 0.05)), &[45.0, 180.0]), "a twitch is no leg");
        assert!(near(&kinds(&path(&[10.0, 100.0, 190.0], 0.0)), &[90.0]));
        assert!(kinds(&path(&[10.0], 0.0)).is_empty() && kinds(&[]).is_empty());
    }
}
