//! Options of figures, shared by the commands that draw.

use super::{Bodies, SettingOptions};
use clap::{Args, ValueEnum};
use motiform_figures::{Medium, Style, Width};
use motiform_lab::draw::FigureFormat;
use motiform_study::{Error, Shown, Study};

#[derive(Args)]
pub(crate) struct DrawingOptions {
    /// Do not draw the animation
    #[arg(long)]
    pub(crate) no_animation: bool,
    #[command(flatten)]
    pub(crate) figure: SettingOptions<Bodies>,
    #[command(flatten)]
    pub(crate) units: UnitsOptions,
    /// Also write the animation in this format (needs ffmpeg); give it twice for both
    #[arg(long, value_name = "FORMAT", conflicts_with = "no_animation")]
    pub(crate) film: Vec<FilmFormat>,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
}

/// Units of figures and of what is printed.
#[derive(Args)]
pub(crate) struct UnitsOptions {
    /// Axes and printed results in physical units: what a unit of length and one of time are, such as 20um,1min; parameters, tables,
    /// JSON and what `simulate` prints keep model units (docs/units.md)
    #[arg(long = "units", value_name = "LENGTH,TIME", allow_hyphen_values = true)]
    pub(crate) given: Option<String>,
}

impl UnitsOptions {
    /// The units that are given, or those of a result.
    ///
    /// # Errors
    /// Units that cannot be read.
    pub(crate) fn or(&self, own: &str) -> Result<Shown, Error> {
        Shown::parse(self.given.as_deref().unwrap_or(own))
    }

    /// The units that are given, or those of a study, which keeps them.
    ///
    /// # Errors
    /// Units that cannot be read.
    pub(crate) fn of(&self, study: &mut Study) -> Result<Shown, Error> {
        if let Some(units) = &self.given {
            study.figure.units.clone_from(units);
        }
        Shown::parse(&study.figure.units)
    }
}

/// Options of every command that draws.
#[derive(Args)]
pub(crate) struct StyleOptions {
    /// Title of the figures instead of the default (*letters* between asterisks are italic, _ starts a subscript)
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// Omit the captions; in pages the words below figures, too
    #[arg(long)]
    pub(crate) no_caption: bool,
    /// Where the figures are shown: journal (86 mm wide, title and caption beside them as NAME.txt) or slide (1920 pixels, its caption
    /// as NAME.txt); --width, --title and --no-caption change it
    #[arg(long = "style", value_name = "STYLE", value_enum)]
    pub(crate) medium: Option<ShownIn>,
    /// Width of the figures: 86mm or 3.4in (laid out for it, with text of 8.5 pt), slide (1920 pixels, with text of 18 pt), or
    /// 1200px (scaled) (default: as drawn, about 170 mm)
    #[arg(long, value_name = "WIDTH", value_parser = width)]
    pub(crate) width: Option<Width>,
    /// Also write PDF figures
    #[arg(long)]
    pub(crate) pdf: bool,
}

impl DrawingOptions {
    /// The first given option that is about the body of a dataset, which no other figure has.
    pub(crate) fn of_bodies(&self) -> Option<&'static str> {
        let switches = [("--no-animation", self.no_animation), ("--film", !self.film.is_empty())];
        let given = switches.into_iter().find(|(_, given)| *given).map(|(name, _)| name);
        given.or_else(|| self.figure.options().next())
    }
}

impl StyleOptions {
    /// The first of these options that is given.
    fn first(&self) -> Option<&'static str> {
        let given = [
            ("--style", self.medium.is_some()),
            ("--width", self.width.is_some()),
            ("--title", self.title.is_some()),
            ("--no-caption", self.no_caption),
            ("--pdf", self.pdf),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }

    /// Refuses these options where no figure is drawn.
    ///
    /// # Errors
    /// One of them is given, and `drawn` is false.
    pub(crate) fn refuse_unless(&self, drawn: bool, remedy: &'static str) -> Result<(), Error> {
        match self.first() {
            Some(key) if !drawn => Err(Error::Setting { key, value: "given".to_owned(), remedy }),
            _ => Ok(()),
        }
    }

    /// The way from figures to files, in model units.
    pub(crate) fn format(&self) -> FigureFormat {
        self.format_in(Shown::default())
    }

    /// The way from figures to files, in these units.
    pub(crate) fn format_in(&self, units: Shown) -> FigureFormat {
        let medium = self.medium.map(|shown| match shown {
            ShownIn::Journal => Medium::Journal,
            ShownIn::Slide => Medium::Slide,
        });
        let style =
            Style { medium, title: self.title.clone(), no_caption: self.no_caption, width: self.width };
        FigureFormat { pdf: self.pdf, style, units }
    }
}

/// Where figures are shown.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShownIn {
    /// In a column of a journal
    Journal,
    /// On a slide
    Slide,
}

/// Video formats.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FilmFormat {
    /// H.264 video
    Mp4,
    /// Animated GIF, 256 colours
    Gif,
}

fn width(text: &str) -> Result<Width, String> {
    text.parse().map_err(|error: motiform_figures::FigureError| error.to_string())
}
