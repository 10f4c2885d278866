//! QuimP's `.paQP` beside a `.snQP`: micrometres per pixel and seconds per frame.

use crate::input::{Input, number};
use crate::scale::{Said, Scale};
use crate::{Error, Options, Result};
use std::path::{Path, PathBuf};

/// The scale in the `.paQP` of the same name; nothing where there is no such file.
///
/// # Errors
/// [`Error::Structure`] where it is there but has no numbers in lines 6 and 7.
pub(super) fn beside(nodes: &Path, options: &Options) -> Result<Scale> {
    let Some(path) = find(nodes) else { return Ok(Scale::default()) };
    let mut input = Input::open(&path, options.limits)?;
    let mut line = String::new();
    let mut values = [0.0; 2];
    for number_of_line in 1..=7_usize {
        if !input.line(&mut line)? {
            let missing = "lines 6 and 7, the scale and the frame interval".to_owned();
            return Err(Error::Truncated { place: input.here(), missing });
        }
        if number_of_line == 1 && !line.starts_with("#p2") {
            return Err(Error::structure(
                &input.here(),
                format!("{:?}", crate::input::shorten(&line)),
                "#p2 - QuimP",
            ));
        }
        if let Some(at) = number_of_line.checked_sub(6) {
            values[at] = number(&line, ["micrometres per pixel", "seconds per frame"][at], &input.here())?;
            if !(values[at].is_finite() && values[at] > 0.0) {
                return Err(Error::structure(&input.here(), values[at].to_string(), "a number above 0"));
            }
        }
    }
    let said = |step, unit: &str| Said { step: Some(step), unit: Some(unit.to_owned()), applied: false };
    Ok(Scale { length: said(values[0], "um"), time: said(values[1], "s") })
}

/// The file of the same name with the other extension, in any case of letters.
fn find(nodes: &Path) -> Option<PathBuf> {
    ["paQP", "paqp", "PAQP"]
        .map(|extension| nodes.with_extension(extension))
        .into_iter()
        .find(|path| path.is_file())
}
