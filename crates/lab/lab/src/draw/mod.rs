//! Dataset to figures: their contents and texts. The drawing itself is in [`motiform_figures`].

mod body;
mod diagram;
mod film;
pub mod lifetimes;
pub mod live;
mod path;
mod return_map;
mod series;
mod space_time;
mod spectrum;
pub mod words;

use body::Body;
pub use body::radius_for;
pub use diagram::{boundary_lines, exponents, phase_diagram, scan_figures, symbol, uneven};
use motiform_figures::{Drawn, Figure, FigureError, Style, png};
use motiform_study::{Dataset, Error, Plan, Shown, Ties};

/// The error of a figure, as an error of a study.
#[allow(clippy::needless_pass_by_value, reason = "for map_err")]
pub fn undrawable(error: FigureError) -> Error {
    Error::Figure(error.to_string())
}

/// The parameters of a plan as a line of a caption of a figure in these units.
///
/// # Errors
/// An unknown model.
pub fn parameters(plan: &Plan, units: &Shown) -> Result<String, Error> {
    Ok(words::named_in(plan.info()?, &plan.computation.parameters, &[], &Ties::default(), units))
}

/// Draws a figure, with its data.
///
/// # Errors
/// [`Error::Figure`]: numbers that do not fit on an axis.
pub fn sheet(figure: &dyn Figure) -> Result<Drawn, Error> {
    figure.drawn().map_err(undrawable)
}

/// Draws a figure in a style, with its data.
///
/// # Errors
/// As [`sheet`], and a width without room for the figure.
pub fn sheet_in(mut figure: impl Figure, style: &Style) -> Result<Drawn, Error> {
    style.draw(&mut figure).map_err(undrawable)
}

/// A file ready to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// File name.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// The formats of figures: files, style and units.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FigureFormat {
    /// Also PDF.
    pub pdf: bool,
    /// Title, caption and size instead of the defaults.
    pub style: Style,
    /// Units of the axes, for results that have none of their own.
    pub units: Shown,
}

/// Draws every figure that a dataset has (as SVG and PNG, and PDF if requested), and the animation `motion.png`.
///
/// A dataset whose shown window has fewer than two rows gives no pictures.
///
/// # Errors
/// An unknown model, or numbers that do not fit on an axis.
pub fn draw(dataset: &Dataset, format: &FigureFormat) -> Result<Vec<Picture>, Error> {
    let body = Body::new(dataset)?;
    if body.rows().len() < 2 {
        return Ok(Vec::new());
    }
    let animated = dataset.manifest.plan.figure.animation;
    // The film takes about as long as the rest: one thread each.
    let (film, stills) = std::thread::scope(|scope| {
        let film =
            scope.spawn(|| animated.then(|| film::animation(&body).apng()).transpose().map_err(undrawable));
        let stills = files(figures(&body), false, format);
        (film.join(), stills)
    });
    let mut pictures = stills?;
    let film = film.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    pictures.extend(film.map(|bytes| Picture { name: "motion.png".to_owned(), bytes }));
    Ok(pictures)
}

/// The still figures of a dataset. None with fewer than two rows.
///
/// # Errors
/// An unknown model.
pub fn dataset_figures(dataset: &Dataset) -> Result<Figures, Error> {
    let body = Body::new(dataset)?;
    Ok(if body.rows().len() < 2 { Vec::new() } else { figures(&body) })
}

/// The still figures of a dataset in a style, with their data, by name: the contents of the files of [`draw`]. None with fewer than two
/// rows.
///
/// # Errors
/// As [`draw`].
pub fn drawn(dataset: &Dataset, style: &Style) -> Result<Vec<(&'static str, Drawn)>, Error> {
    let draw = |(name, mut figure): (&'static str, Box<dyn Figure>)| {
        Ok((name, style.draw(figure.as_mut()).map_err(undrawable)?))
    };
    dataset_figures(dataset)?.into_iter().map(draw).collect()
}

/// One still figure of a dataset as SVG, by the name of its file; `None` for other names, for a figure that the dataset does not have,
/// and with fewer than two rows.
///
/// # Errors
/// As [`draw`].
pub fn still(dataset: &Dataset, name: &str) -> Result<Option<String>, Error> {
    let body = Body::new(dataset)?;
    let known = FIGURES.iter().find(|known| known.0 == name && body.rows().len() >= 2);
    let figure = known.and_then(|(_, figure)| figure(&body));
    figure.map(|figure| Ok(sheet(figure.as_ref())?.svg)).transpose()
}

/// The animation of a dataset as an animated PNG; `None` with fewer than two rows.
///
/// # Errors
/// As [`draw`].
pub fn film(dataset: &Dataset) -> Result<Option<Vec<u8>>, Error> {
    let body = Body::new(dataset)?;
    Ok(if body.rows().len() < 2 { None } else { Some(film::animation(&body).apng().map_err(undrawable)?) })
}

/// A figure of a body; `None` if its model or its plan does not have it.
type Still = fn(&Body<'_>) -> Option<Box<dyn Figure>>;

/// The still figures of a dataset by the names of their files, in their order.
const FIGURES: [(&str, Still); 5] = [
    ("path", |body| Some(Box::new(path::figure(body)))),
    ("series", |body| Some(Box::new(series::figure(body)))),
    ("return-map", |body| Some(Box::new(return_map::figure(body)?))),
    ("phi", |body| Some(Box::new(space_time::figure(body)?))),
    ("spectrum", |body| Some(Box::new(spectrum::figure(body)?))),
];

fn figures(body: &Body<'_>) -> Figures {
    FIGURES.iter().filter_map(|(name, figure)| Some((*name, figure(body)?))).collect()
}

/// Figures with their names, which are those of their files.
pub type Figures = Vec<(&'static str, Box<dyn Figure>)>;

/// Draws figures as SVG and PNG, and as PDF if requested; with `numbers` what they show as CSV, too. A style
/// that leaves out captions leaves them as text.
///
/// # Errors
/// [`Error::Figure`]: numbers that do not fit on an axis.
pub fn files<N: std::fmt::Display>(
    figures: Vec<(N, Box<dyn Figure>)>,
    numbers: bool,
    format: &FigureFormat,
) -> Result<Vec<Picture>, Error> {
    let mut pictures = Vec::new();
    for (name, mut figure) in figures {
        let Drawn { svg, data, caption } = format.style.draw(figure.as_mut()).map_err(undrawable)?;
        pictures.extend(formats(&name, svg, format)?);
        let mut push =
            |ending: &str, bytes| pictures.push(Picture { name: format!("{name}.{ending}"), bytes });
        if numbers {
            push("csv", data.into_bytes());
        }
        if let Some(caption) = caption.filter(|caption| !caption.is_empty()) {
            push("txt", caption.into_bytes());
        }
    }
    Ok(pictures)
}

/// The drawing of a figure as files of this name: SVG, PNG, and PDF if requested.
///
/// # Errors
/// [`Error::Figure`]: no SVG of this program.
pub fn formats(
    name: &dyn std::fmt::Display,
    svg: String,
    format: &FigureFormat,
) -> Result<Vec<Picture>, Error> {
    let file = |ending: &str, bytes| Picture { name: format!("{name}.{ending}"), bytes };
    let dots = file("png", png(&svg, format.style.png_scale(), &[]).map_err(undrawable)?);
    let page = format.pdf.then(|| motiform_figures::pdf(&svg).map_err(undrawable)).transpose()?;
    let page = page.map(|page| file("pdf", page));
    Ok([file("svg", svg.into_bytes()), dots].into_iter().chain(page).collect())
}
