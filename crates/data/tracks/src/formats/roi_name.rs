//! Frame and cell from the name of an ImageJ region.

/// Frame and cell, as read from a name.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Named<'a> {
    pub(super) frame: Option<i64>,
    pub(super) cell: Option<&'a str>,
}

/// Understands `FRAME-CELL`, and ImageJ's own `SLICE-Y-X` and `Y-X` (four digits each, zeros in front), which name no cell.
///
/// `position`: the frame that the region itself holds. It counts before the name. `FRAME-CELL` is believed
/// where there is no position or both agree; they may differ by 1, counted from 0 and from 1.
pub(super) fn named(entry: &str, position: Option<i64>) -> Named<'_> {
    let base = entry.rsplit(['/', '\\']).next().unwrap_or(entry);
    let base = base.rsplit_once('.').map_or(base, |(base, _)| base);
    let parts: Vec<&str> = base.split('-').collect();
    let number = |text: &str| text.parse::<i64>().ok();
    let padded = |text: &&str| text.len() >= 4 && text.bytes().all(|b| b.is_ascii_digit());
    match parts.as_slice() {
        [_, _] if parts.iter().all(|part| padded(part) && part.starts_with('0')) => {
            Named { frame: position, cell: None } // Y-X
        }
        [slice, _, _] if parts.iter().all(padded) => Named { frame: position.or(number(slice)), cell: None },
        [frame, cell] => match (number(frame), position) {
            (Some(named), Some(position)) if named.abs_diff(position) > 1 => {
                Named { frame: Some(position), cell: None }
            }
            (frame, position) => Named { frame: position.or(frame), cell: frame.map(|_| *cell) },
        },
        [alone] => Named { frame: position.or(number(alone)), cell: None },
        _ => Named { frame: position, cell: None },
    }
}
