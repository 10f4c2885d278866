//! Dataset to figures: what is drawn, and with what words. The drawing itself is in [`crate::figures`].

mod body;
mod diagram;
mod film;
pub mod live;
mod path;
mod return_map;
mod series;
mod space_time;
mod spectrum;
mod words;

use crate::figures::{DEFAULT_SCALE, png};
use crate::{Dataset, Error};
use body::Body;
pub use body::radius_for;
pub use diagram::{boundary_lines, draw_scan, exponents, phase_diagram};
pub(crate) use words::number;

/// A file ready to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// File name.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Draws every figure of a dataset: `path`, `series`, and where the model or the plan has them `return-map`, `phi` and
/// `spectrum` (as SVG and PNG, and PDF if asked and built in), and the animation `motion.png`.
///
/// A dataset whose shown window has fewer than two rows gives no pictures.
///
/// # Errors
/// An unknown model, or numbers that no axis can hold.
pub fn draw(dataset: &Dataset, pdf: bool) -> Result<Vec<Picture>, Error> {
    let body = Body::new(dataset)?;
    if body.rows().len() < 2 {
        return Ok(Vec::new());
    }
    let animated = dataset.manifest.plan.figure.animation;
    // The film takes about as long as the rest: one thread each.
    let (film, stills) = std::thread::scope(|scope| {
        let film = scope.spawn(|| animated.then(|| film::animation(&body).apng()).transpose());
        let stills = stills(&body, pdf);
        (film.join(), stills)
    });
    let mut pictures = stills?;
    let film = film.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    pictures.extend(film.map(|bytes| Picture { name: "motion.png".to_owned(), bytes }));
    Ok(pictures)
}

fn stills(body: &Body<'_>, pdf: bool) -> Result<Vec<Picture>, Error> {
    let mut pictures = Vec::new();
    for (name, svg) in drawings(body)? {
        add(&mut pictures, name, &svg, pdf)?;
    }
    Ok(pictures)
}

/// The still figures of a dataset as SVG, by name: what [`draw`] makes files of.
pub(crate) fn stills_as_svg(dataset: &Dataset) -> Result<Vec<(&'static str, String)>, Error> {
    drawings(&Body::new(dataset)?)
}

/// One still figure of a dataset as SVG: `path` or `series`; `None` for other names, and with fewer than two rows.
///
/// # Errors
/// As [`draw`].
pub fn still(dataset: &Dataset, name: &str) -> Result<Option<String>, Error> {
    let body = Body::new(dataset)?;
    if body.rows().len() < 2 {
        return Ok(None);
    }
    Ok(match name {
        "path" => Some(path::figure(&body).svg()?),
        "series" => Some(series::figure(&body).svg()?),
        _ => None,
    })
}

/// The animation of a dataset as an animated PNG; `None` with fewer than two rows.
///
/// # Errors
/// As [`draw`].
pub fn film(dataset: &Dataset) -> Result<Option<Vec<u8>>, Error> {
    let body = Body::new(dataset)?;
    Ok(if body.rows().len() < 2 { None } else { Some(film::animation(&body).apng()?) })
}

fn drawings(body: &Body<'_>) -> Result<Vec<(&'static str, String)>, Error> {
    let mut all = vec![("path", path::figure(body).svg()?), ("series", series::figure(body).svg()?)];
    if let Some(figure) = return_map::figure(body) {
        all.push(("return-map", figure.svg()?));
    }
    if let Some(figure) = space_time::figure(body) {
        all.push(("phi", figure.svg()?));
    }
    if let Some(figure) = spectrum::figure(body) {
        all.push(("spectrum", figure.svg()?));
    }
    Ok(all)
}

fn add(pictures: &mut Vec<Picture>, name: &str, svg: &str, pdf: bool) -> Result<(), Error> {
    pictures.push(Picture { name: format!("{name}.svg"), bytes: svg.as_bytes().to_vec() });
    pictures.push(Picture { name: format!("{name}.png"), bytes: png(svg, DEFAULT_SCALE, &[])? });
    #[cfg(feature = "pdf")]
    if pdf {
        pictures.push(Picture { name: format!("{name}.pdf"), bytes: crate::figures::pdf(svg)? });
    }
    #[cfg(not(feature = "pdf"))]
    let _ = pdf;
    Ok(())
}
