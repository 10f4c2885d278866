//! Streaming through the XML: one element in memory at a time, and what is kept of it.

use super::bounded::Bounded;
use super::model::{Model, Spot, Track};
use super::spot::Open;
use crate::input::{Input, integer, shorten};
use crate::{Error, Image, Limits, Place, Result};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::cell::Cell;
use std::collections::HashSet;
use std::io;
use std::rc::Rc;

/// Reads the elements that matter; others are passed over.
pub(super) fn read(input: Input, limits: Limits) -> Result<Model> {
    let place = input.place.clone();
    let room = Rc::new(Cell::new(limits.piece));
    let mut reader = Reader::from_reader(Bounded { inner: input.into_reader(), room: Rc::clone(&room) });
    reader.config_mut().check_end_names = true;
    let mut collect = Collect { limits, place, model: Model::default(), open: None, vertices: 0, depth: 0 };
    let mut buffer = Vec::new();
    loop {
        buffer.clear();
        room.set(limits.piece);
        let event = reader.read_event_into(&mut buffer);
        collect.place = collect.place.byte(reader.buffer_position());
        match event.map_err(|error| collect.damaged(&error, limits))? {
            Event::Eof => break,
            Event::Start(element) => {
                collect.depth += 1;
                collect.begin(&element, false)?;
            }
            Event::Empty(element) => collect.begin(&element, true)?,
            Event::Text(text) => collect.text(&text)?,
            Event::End(_) => {
                collect.depth -= 1;
                collect.end()?;
            }
            _ => {}
        }
    }
    if collect.depth > 0 {
        let missing = format!("the end of {} open elements", collect.depth);
        return Err(Error::Truncated { place: collect.place, missing });
    }
    Ok(collect.model)
}

struct Collect {
    limits: Limits,
    place: Place,
    model: Model,
    /// The spot whose text is being read, with its position and the count of vertices that it announces.
    open: Option<Open>,
    vertices: u64,
    depth: u64,
}

impl Collect {
    fn begin(&mut self, element: &BytesStart<'_>, empty: bool) -> Result<()> {
        let get = |name: &str| self.attribute(element, name);
        match element.name().as_ref() {
            "Model" => {
                let units = (get("spatialunits")?, get("timeunits")?);
                (self.model.length_unit, self.model.time_unit) = units;
            }
            "Spot" => {
                let spot = self.spot(element)?;
                self.open = Some(spot);
                if empty {
                    self.end()?;
                }
            }
            "Track" => {
                let id = get("TRACK_ID")?.unwrap_or_else(|| self.model.all.len().to_string());
                self.model.all.push(Track { id, links: Vec::new() });
            }
            "Edge" => {
                let ends = [self.whole(element, "SPOT_SOURCE_ID")?, self.whole(element, "SPOT_TARGET_ID")?];
                let outside =
                    || Error::structure(&self.place, "a link outside of a track", "Track around Edge");
                self.model.all.last_mut().ok_or_else(outside)?.links.push(ends);
            }
            "FilteredTracks" => self.model.kept = Some(HashSet::new()),
            "TrackID" => {
                let id = get("TRACK_ID")?;
                self.model.kept.get_or_insert_default().extend(id);
            }
            "ImageData" => self.image(element)?,
            _ => {}
        }
        Ok(())
    }

    fn image(&mut self, element: &BytesStart<'_>) -> Result<()> {
        let number =
            |name: &str| Ok(self.number(element, name)?.filter(|value| value.is_finite() && *value > 0.0));
        let [width, height, pixel, interval] =
            [number("width")?, number("height")?, number("pixelwidth")?, number("timeinterval")?];
        self.model.pixel_size = pixel;
        self.model.interval = interval;
        if let (Some(width), Some(height), Some(pixel)) = (width, height, pixel) {
            self.model.image = Some(Image { size: [width * pixel, height * pixel], pixel });
        }
        Ok(())
    }

    fn spot(&self, element: &BytesStart<'_>) -> Result<Open> {
        let missing = |what: &str| Error::structure(&self.place, format!("a Spot without {what}"), what);
        let position = |name| self.number(element, name)?.ok_or_else(|| missing(name));
        let announced = self.number(element, "ROI_N_POINTS")?.and_then(integer);
        let t = self.number(element, "POSITION_T")?.filter(|t| t.is_finite());
        let frame = self.whole(element, "FRAME")?;
        Ok(Open {
            id: self.whole(element, "ID")?,
            spot: Spot { frame, t, points: Vec::new() },
            position: [position("POSITION_X")?, position("POSITION_Y")?],
            announced: announced.and_then(|count| usize::try_from(count).ok()),
            values: Vec::new(),
        })
    }

    /// Coordinates, which may come in several pieces.
    fn text(&mut self, text: &str) -> Result<()> {
        let Some(open) = self.open.as_mut().filter(|open| open.announced.is_some()) else { return Ok(()) };
        for word in text.split_ascii_whitespace() {
            let found = || format!("{:?} in spot {}", shorten(word), open.id);
            let value =
                word.parse::<f64>().map_err(|_| Error::structure(&self.place, found(), "a number"))?;
            open.values.push(value);
        }
        Ok(())
    }

    fn end(&mut self) -> Result<()> {
        let Some(open) = self.open.take() else { return Ok(()) };
        let (id, spot) = (open.id, open.outlined(&self.place)?);
        self.vertices += spot.points.len() as u64;
        let limits = self.limits;
        let over = |what, limit, key| Err(Error::Limit { place: self.place.clone(), what, limit, key });
        if self.vertices > limits.vertices {
            return over("vertices", limits.vertices, "vertices");
        }
        if self.model.spots.insert(id, spot).is_some() {
            let found = format!("two spots with the ID {id}");
            return Err(Error::structure(&self.place, found, "an ID of its own for each spot"));
        }
        if self.model.spots.len() as u64 > limits.outlines {
            return over("spots", limits.outlines, "outlines");
        }
        Ok(())
    }

    fn attribute(&self, element: &BytesStart<'_>, name: &str) -> Result<Option<String>> {
        let wrong = |error: &dyn std::fmt::Display| {
            Error::structure(&self.place, format!("an attribute that is not XML ({error})"), name)
        };
        let Some(attribute) = element.try_get_attribute(name).map_err(|error| wrong(&error))? else {
            return Ok(None);
        };
        let value =
            attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0).map_err(|error| wrong(&error))?;
        Ok(Some(value.into_owned()))
    }

    fn number(&self, element: &BytesStart<'_>, name: &str) -> Result<Option<f64>> {
        self.attribute(element, name)?.map(|text| crate::input::number(&text, name, &self.place)).transpose()
    }

    fn whole(&self, element: &BytesStart<'_>, name: &str) -> Result<i64> {
        let value = self.attribute(element, name)?;
        let missing = || Error::structure(&self.place, format!("no attribute {name}"), name);
        crate::input::whole(&value.ok_or_else(missing)?, name, &self.place)
    }

    fn damaged(&self, error: &quick_xml::Error, limits: Limits) -> Error {
        let place = self.place.clone();
        match error {
            quick_xml::Error::Io(error) if error.kind() == io::ErrorKind::FileTooLarge => {
                Error::Limit { place, what: "bytes in an element", limit: limits.piece, key: "piece" }
            }
            quick_xml::Error::Syntax(reason) => {
                Error::Truncated { place, missing: format!("sound XML ({reason})") }
            }
            error => Error::structure(&place, format!("damaged XML ({error})"), "sound XML"),
        }
    }
}
