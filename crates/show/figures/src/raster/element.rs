//! The elements and texts of an SVG document, one after the other.

use quick_xml::XmlVersion::Implicit1_0;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use crate::error::{FigureError, Result};

const VERSION: XmlVersion = Implicit1_0;

/// A piece of a document.
pub(crate) enum Piece {
    Open(Element),
    Text(String),
    Close(String),
}

/// An element with its attributes.
pub(crate) struct Element {
    pub(crate) name: String,
    attributes: Vec<(String, String)>,
}

pub(crate) fn refused(why: impl Into<String>) -> FigureError {
    FigureError::Svg { why: why.into() }
}

impl Element {
    fn new(tag: &BytesStart<'_>) -> Result<Self> {
        let attributes = tag.attributes().map(|attribute| {
            let attribute = attribute.map_err(|error| refused(error.to_string()))?;
            let value = attribute.normalized_value(VERSION).map_err(|error| refused(error.to_string()))?;
            Ok((attribute.key.as_ref().to_owned(), value.into_owned()))
        });
        Ok(Self { name: tag.name().as_ref().to_owned(), attributes: attributes.collect::<Result<_>>()? })
    }

    /// The value of an attribute.
    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }

    /// The value of an attribute that must be there.
    pub(crate) fn need(&self, name: &str) -> Result<&str> {
        self.get(name).ok_or_else(|| refused(format!("<{}> without {name}", self.name)))
    }

    /// The number of an attribute, if it is there.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f32>> {
        self.get(name).map(number).transpose()
    }

    /// The numbers of attributes that must be there.
    pub(crate) fn numbers<const N: usize>(&self, names: [&str; N]) -> Result<[f32; N]> {
        let mut all = [0.0; N];
        for (value, name) in all.iter_mut().zip(names) {
            *value = number(self.need(name)?)?;
        }
        Ok(all)
    }
}

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f32> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite());
    number.ok_or_else(|| refused(format!("{text:?} is not a number")))
}

/// Gives the pieces of a document to `take`, in their order.
pub(crate) fn pieces(svg: &str, mut take: impl FnMut(Piece) -> Result<()>) -> Result<()> {
    let mut reader = Reader::from_str(svg);
    let (mut open, mut any) = (0_usize, false);
    loop {
        match reader.read_event().map_err(|error| refused(error.to_string()))? {
            Event::Start(tag) => {
                open += 1;
                take(Piece::Open(Element::new(&tag)?))?;
            }
            Event::Empty(tag) => {
                let element = Element::new(&tag)?;
                let name = element.name.clone();
                take(Piece::Open(element))?;
                take(Piece::Close(name))?;
            }
            Event::End(tag) => {
                open = open.saturating_sub(1);
                take(Piece::Close(tag.name().as_ref().to_owned()))?;
            }
            Event::Text(text) => take(Piece::Text(text.xml_content(VERSION).into_owned()))?,
            Event::GeneralRef(name) => take(Piece::Text(character(&name)?.into()))?,
            Event::Eof if open == 0 && any => return Ok(()),
            Event::Eof => return Err(refused("the document ends before its elements do")),
            _ => {}
        }
        any |= open > 0;
    }
}

/// The character of `&#39;` or `&lt;`.
fn character(name: &quick_xml::events::BytesRef<'_>) -> Result<char> {
    let numbered = name.resolve_char_ref().map_err(|error| refused(error.to_string()))?;
    let named = || quick_xml::escape::resolve_predefined_entity(name).and_then(|text| text.chars().next());
    numbered.or_else(named).ok_or_else(|| refused(format!("an unknown entity {:?}", &**name)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_attributes_are_what_was_escaped() {
        let hard = "a<b & \"c\" > 'd'";
        let escaped = crate::svg::escape(hard);
        let (mut text, mut label) = (String::new(), None);
        let document = format!("<svg label=\"{escaped}\">{escaped}</svg>");
        let read = pieces(&document, |piece| {
            match piece {
                Piece::Open(element) => label = element.get("label").map(str::to_owned),
                Piece::Text(more) => text += &more,
                Piece::Close(_) => {}
            }
            Ok(())
        });
        assert!(read.is_ok());
        assert_eq!((text.as_str(), label.as_deref()), (hard, Some(hard)));
    }

    #[test]
    fn broken_documents_are_refused() {
        for broken in ["", "no svg", "<svg>", "<svg><g></svg>", "<svg x=1/>", "<svg>&nothing;</svg>"] {
            assert!(pieces(broken, |_| Ok(())).is_err(), "{broken}");
        }
    }
}
