//! Common interface of all static figures.

use super::error::Result;
use super::room::Room;
use super::svg::Svg;
use super::text::Label;
use std::fmt::Write as _;

/// A static figure: its texts, its drawing, and the plotted numbers.
pub trait Figure {
    /// Draws the sheet for a width.
    ///
    /// # Errors   those of the figure's own `svg_in`
    fn sheet(&self, room: Room) -> Result<Svg>;

    /// The plotted data, as a CSV table with a header line: numbers in full precision, labels without markup.
    fn data(&self) -> String;

    /// The title and the paragraphs of the caption, to be changed before drawing.
    fn words(&mut self) -> (&mut String, &mut Vec<String>);

    /// The sheet at its own width, with its data.
    ///
    /// # Errors   those of [`Figure::sheet`]
    fn drawn(&self) -> Result<Drawn> {
        Ok(Drawn { svg: self.sheet(Room::OWN)?.finish(), data: self.data(), caption: None })
    }
}

/// A drawn figure, and the numbers behind it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawn {
    /// Self-contained SVG text.
    pub svg: String,
    /// A CSV table with a header line.
    pub data: String,
    /// Title and caption as plain text, where the picture leaves them to the text around it.
    pub caption: Option<String>,
}

/// A CSV table under construction.
pub(super) struct Csv(String);

impl Csv {
    /// A table with these columns, whose names may be markup.
    pub(super) fn new<S: AsRef<str>>(header: impl IntoIterator<Item = S>) -> Self {
        let names: Vec<String> = header.into_iter().map(|name| field(name.as_ref())).collect();
        Self(names.join(",") + "\n")
    }

    /// Adds a row: labels (markup) first, then numbers; `None` leaves a field empty.
    pub(super) fn row(&mut self, labels: &[&str], numbers: impl IntoIterator<Item = Option<f64>>) {
        let mut comma = "";
        for label in labels {
            let _ = write!(self.0, "{comma}{}", field(label));
            comma = ",";
        }
        for number in numbers {
            self.0.push_str(comma);
            if let Some(number) = number {
                let _ = write!(self.0, "{number:?}"); // the shortest digits that give the same bits back
            }
            comma = ",";
        }
        self.0.push('\n');
    }

    pub(super) fn finish(self) -> String {
        self.0
    }
}

/// A label without its markup, quoted where CSV needs it.
fn field(markup: &str) -> String {
    let plain = Label::parse(markup).terminal();
    if plain.contains([',', '"', '\n']) { format!("\"{}\"", plain.replace('"', "\"\"")) } else { plain }
}

/// `svg` and [`Figure`] for a type with `svg_in`, `csv`, `title` and `caption`.
macro_rules! figure {
    ($type:ty) => {
        impl $type {
            /// Draws the figure at its own width.
            ///
            /// # Errors   those of `svg_in`
            pub fn svg(&self) -> $crate::Result<String> {
                Ok(self.svg_in($crate::Room::OWN)?.finish())
            }
        }

        impl $crate::figure::Figure for $type {
            fn sheet(&self, room: $crate::Room) -> $crate::Result<$crate::svg::Svg> {
                self.svg_in(room)
            }

            fn data(&self) -> String {
                self.csv()
            }

            fn words(&mut self) -> (&mut String, &mut Vec<String>) {
                (&mut self.title, &mut self.caption)
            }
        }
    };
}
pub(super) use figure;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_lose_their_markup_and_commas_are_quoted() {
        let mut csv = Csv::new(["part", "*x*_*n*", "*λ*_1, first"]);
        csv.row(&["a \"b\""], [Some(0.1), None]);
        csv.row(&["c"], [Some(-1e300), Some(2.0)]);
        assert_eq!(csv.finish(), "part,x_n,\"λ_1, first\"\n\"a \"\"b\"\"\",0.1,\nc,-1e300,2.0\n");
    }
}
