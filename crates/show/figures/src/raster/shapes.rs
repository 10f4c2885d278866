//! Shapes, colours and lines of an element.

use tiny_skia::{Color, Path, PathBuilder, Rect};

use super::element::{Element, number, refused};
use crate::error::Result;

/// The path of `M x y`, `L x y` and `Z`, as `d` has them; `None` if there is nothing to draw.
pub(super) fn path(d: &str) -> Result<Option<Path>> {
    let mut builder = PathBuilder::new();
    let mut rest = d;
    while let Some(command) = rest.chars().next() {
        let numbers = &rest[command.len_utf8()..];
        let end = numbers.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(numbers.len());
        let place = || -> Result<(f32, f32)> {
            let (x, y) = numbers[..end].split_once(' ').ok_or_else(|| refused("a point without y"))?;
            Ok((number(x)?, number(y)?))
        };
        match command {
            'M' => place().map(|(x, y)| builder.move_to(x, y))?,
            'L' => place().map(|(x, y)| builder.line_to(x, y))?,
            'Z' => builder.close(),
            _ => return Err(refused(format!("a path with {command}"))),
        }
        rest = &numbers[end..];
    }
    Ok(builder.finish())
}

/// The rectangle of an element; `None` if it has no area.
pub(super) fn rect(element: &Element) -> Result<Option<Rect>> {
    let [w, h] = element.numbers(["width", "height"])?;
    let [x, y] = [element.number("x")?.unwrap_or(0.0), element.number("y")?.unwrap_or(0.0)];
    Ok(Rect::from_xywh(x, y, w, h).filter(|_| w > 0.0 && h > 0.0))
}

/// The colour of an attribute with its opacity; `None` where there is no paint.
///
/// A shape with an opacity of its own has a filling or a line, not both: where one lies on the other, each would be seen through.
pub(super) fn colour(element: &Element, name: &str) -> Result<Option<Color>> {
    let Some(text) = element.get(name).filter(|text| *text != "none") else { return Ok(None) };
    let digits = text.strip_prefix('#').filter(|digits| digits.is_ascii());
    let part = |digits: &str| u8::from_str_radix(digits, 16).ok();
    let parts: Option<Vec<u8>> = match digits {
        Some(digits) if digits.len() == 3 => (0..3).map(|k| part(&digits[k..=k]).map(|v| 17 * v)).collect(),
        Some(digits) if digits.len() == 6 => (0..3).map(|k| part(&digits[2 * k..2 * k + 2])).collect(),
        _ => None,
    };
    let Some(&[red, green, blue]) = parts.as_deref() else {
        return Err(refused(format!("{text:?} is not a colour")));
    };
    let mut colour = Color::from_rgba8(red, green, blue, 255);
    let own = element.number(&format!("{name}-opacity"))?.unwrap_or(1.0);
    colour.set_alpha(own * element.number("opacity")?.unwrap_or(1.0));
    Ok(Some(colour))
}

/// The pen of a line; its corners are round.
pub(crate) struct Pen {
    pub(crate) width: f32,
    /// `true` if its ends are round, too.
    pub(crate) round: bool,
    /// Lengths of dashes and gaps in turn; empty for an unbroken line.
    pub(crate) dash: Vec<f32>,
    /// Length into them at which the line begins.
    pub(crate) dash_from: f32,
}

/// The pen of the line of an element.
pub(super) fn pen(element: &Element) -> Result<Pen> {
    let dash = element.get("stroke-dasharray").map(|text| text.split(' ').map(number).collect());
    let dash: Option<Vec<f32>> = dash.transpose()?;
    Ok(Pen {
        width: element.number("stroke-width")?.unwrap_or(1.0),
        round: element.get("stroke-linecap") == Some("round"),
        dash: dash.unwrap_or_default(),
        dash_from: element.number("stroke-dashoffset")?.unwrap_or(0.0),
    })
}
