//! Dataset to figures: what is drawn, and with what words. The drawing itself is in [`crate::figures`].

mod body;
mod film;
mod path;
mod return_map;
mod series;
mod space_time;
mod spectrum;
mod words;

use crate::figures::{DEFAULT_SCALE, png};
use crate::{Dataset, Error};
use body::Body;

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
    add(&mut pictures, "path", &path::figure(body).svg()?, pdf)?;
    add(&mut pictures, "series", &series::figure(body).svg()?, pdf)?;
    if let Some(figure) = return_map::figure(body) {
        add(&mut pictures, "return-map", &figure.svg()?, pdf)?;
    }
    if let Some(figure) = space_time::figure(body) {
        add(&mut pictures, "phi", &figure.svg()?, pdf)?;
    }
    if let Some(figure) = spectrum::figure(body) {
        add(&mut pictures, "spectrum", &figure.svg()?, pdf)?;
    }
    Ok(pictures)
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
