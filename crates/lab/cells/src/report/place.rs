//! The place on the paper's planes.

use crate::Fitted;
use crate::report::Setting;
use crate::report::maps::beneath;
use crate::report::numbers::{estimate, interval, plain};
use motiform_dynamics::distributions::NORMAL_95;
use motiform_figures::report::{Cell, Section, Table};
use motiform_figures::{MapPlace, PlaceMap, literal};
use motiform_inference::{Coordinate, Place, Placement, Plane, coordinates, draws};
use motiform_lab::draw::symbol;
use motiform_models::ModelInfo;
use motiform_models::parameters::Parameters;
use motiform_models::tensor::TensorParameters;
use motiform_study::Error;

/// Models of the cloud, and the seed of their draws.
const CLOUD: usize = 60;
const SEED: u64 = 1;
/// Points of an ellipse.
const ELLIPSE: usize = 90;
/// 95 % of a normal distribution in the plane lie within this Mahalanobis distance: sqrt(-2 ln 0.05).
const WITHIN: f64 = 2.447_746_830_680_816;
pub(crate) const PLANES: [(Plane, &str); 2] =
    [(Plane::Full, "plane of Fig. 4"), (Plane::Reduced, "plane of Fig. 1")];

pub(crate) fn section(name: &str, fitted: &Fitted, setting: &Setting<'_>) -> Result<Section, Error> {
    let mut section = Section { title: "Place on the paper's diagrams".to_owned(), ..Section::default() };
    if let Some(reasons) = fitted.no_place() {
        let [(_, first), (_, second)] = PLANES;
        section.about =
            format!("No place on the {first} or the {second}: {}.", notation(&reasons.join("; ")));
        return Ok(section);
    }
    for ((plane, plane_name), placement) in PLANES.into_iter().zip(&fitted.places) {
        match placement {
            Placement::Refused { reasons } => {
                section.about +=
                    &format!("No place on the {plane_name}: {}.\n\n", notation(&reasons.join("; ")));
            }
            Placement::Placed(place) => {
                section.tables.push(table(place, plane_name));
                if let Some(map) = map(&[(name, place, Some(fitted))], plane)? {
                    let caption = format!(
                        "The cell on the {plane_name}. Beneath: motions of the tensor model on the paper's slice; what \
                         is off the slice is in the table, so the motion beneath need not be that of the cell."
                    );
                    section.figures.push(setting.figure(map, caption)?);
                }
            }
        }
    }
    Ok(section)
}

/// Places on a plane; `None` without a diagram. Clouds are drawn where fits are given.
///
/// # Errors
/// As [`beneath`].
pub(crate) fn map(
    places: &[(&str, &Place, Option<&Fitted>)],
    plane: Plane,
) -> Result<Option<PlaceMap>, Error> {
    let Some(under) = beneath(plane)? else { return Ok(None) };
    let one = |(name, place, fitted): &(&str, &Place, Option<&Fitted>)| MapPlace {
        name: literal(name),
        at: [place.coordinates[0].estimate.value, place.coordinates[1].estimate.value],
        region: region(place),
        cloud: fitted.map_or_else(Vec::new, |fitted| cloud(fitted, plane)),
    };
    Ok(Some(PlaceMap {
        x_label: under.x_label.clone(),
        y_label: under.y_label.clone(),
        region_label: "95 % region".to_owned(),
        cloud_label: "models drawn from the estimate".to_owned(),
        places: places.iter().map(one).collect(),
        under,
        ..PlaceMap::default()
    }))
}

/// Coordinates of models drawn from the estimate.
fn cloud(fitted: &Fitted, plane: Plane) -> Vec<[f64; 2]> {
    let fit = fitted.model();
    draws(fit, CLOUD, SEED).iter().filter_map(|values| coordinates(fit, plane, values)).collect()
}

/// The boundary of the region that holds 95 % of a normal distribution with the place's covariance, each side of each axis in the
/// proportion in which the 95 % interval of that parameter differs from 1.96 standard deviations: as the table has it.
fn region(place: &Place) -> Vec<[f64; 2]> {
    let sides = [0, 1].map(|k| {
        let estimate = &place.coordinates[k].estimate;
        let deviation = NORMAL_95 * place.covariance[k][k].max(f64::MIN_POSITIVE).sqrt();
        let side = |end: f64| if end.is_finite() { (end - estimate.value).abs() / deviation } else { 1.0 };
        (estimate.value, estimate.interval.map(side))
    });
    let fitted = |(value, [below, above]): (f64, [f64; 2]), x: f64| {
        value + (x - value) * if x < value { below } else { above }
    };
    ellipse(place).into_iter().map(|[x, y]| [fitted(sides[0], x), fitted(sides[1], y)]).collect()
}

/// The boundary of the region that holds 95 % of a normal distribution with the place's covariance.
fn ellipse(place: &Place) -> Vec<[f64; 2]> {
    let [[xx, xy], [_, yy]] = place.covariance;
    let first = xx.max(0.0).sqrt();
    let across = if first > 0.0 { xy / first } else { 0.0 };
    let second = (yy - across * across).max(0.0).sqrt();
    let [x, y] = [0, 1].map(|k| place.coordinates[k].estimate.value);
    let point = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / ELLIPSE as f64;
        let (sin, cos) = (WITHIN * angle.sin(), WITHIN * angle.cos());
        [x + first * cos, y + across * cos + second * sin]
    };
    (0..ELLIPSE).map(point).collect()
}

/// A text with the notation of the paper for names of parameters, `*κ*_2` for `kappa2`, and true minus signs.
pub(crate) fn notation(text: &str) -> String {
    let info = ModelInfo::find(TensorParameters::MODEL).ok();
    let word = |word: &str| {
        let name = word.trim_end_matches([',', ':', ';']);
        let known = info.filter(|info| info.parameters().iter().any(|spec| spec.name == name));
        match known {
            Some(info) => symbol(info, name) + &word[name.len()..],
            None if word == "-" => "−".to_owned(),
            None => literal(word),
        }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

fn table(place: &Place, plane: &str) -> Table {
    let row = |c: &Coordinate| {
        // what is off the slice is that of the best set alone
        let (ends, slice) = match c.slice {
            None => (interval(c.estimate.value, c.estimate.interval), "free".to_owned()),
            Some(slice) => ("of the best set alone".to_owned(), plain(slice)),
        };
        let name = Cell::text(notation(&c.name));
        vec![name, Cell::number(estimate(&c.estimate)), Cell::number(ends), Cell::number(slice)]
    };
    Table {
        caption: format!(
            "The cell in the units of the {plane}: {} off its slice ({} standard errors).",
            plain(place.distance),
            plain(place.deviation)
        ),
        head: ["parameter", "cell", "95 % interval", "value on the slice"].map(str::to_owned).to_vec(),
        rows: place.coordinates.iter().chain(&place.others).map(row).collect(),
    }
}
