//! Decompression by Lempel, Ziv and Welch as TIFF has it: codes of 9 to 12 bits, the highest bits first.

const CLEAR: usize = 256;
const END: usize = 257;
const MOST_BITS: u32 = 12;

/// The bytes, at most `most`; `None` where a code stands for nothing.
///
/// Source: TIFF revision 6.0 (1992), section 13.
pub(super) fn unpack(packed: &[u8], most: usize) -> Option<Vec<u8>> {
    // each code is an earlier one and a byte
    let mut table: Vec<(usize, u8)> = Vec::new();
    let (mut out, mut before) = (Vec::with_capacity(most), None::<usize>);
    let (mut bits, mut left, mut width) = (0_u32, 0_u32, 9_u32);
    let mut string = Vec::new();
    for &byte in packed {
        bits = bits << 8 | u32::from(byte);
        left += 8;
        if left < width {
            continue;
        }
        left -= width;
        let code = (bits >> left & ((1 << width) - 1)) as usize;
        match code {
            CLEAR => {
                table.clear();
                (width, before) = (9, None);
                continue;
            }
            END => break,
            _ => {}
        }
        spell(&table, if code < 258 + table.len() { code } else { before? }, &mut string)?;
        let first = *string.first()?;
        if code >= 258 + table.len() {
            string.push(first);
        }
        out.extend_from_slice(&string);
        if let Some(before) = before {
            table.push((before, first));
        }
        if out.len() >= most {
            break;
        }
        before = Some(code);
        // a code is written with a bit more from one code before it is needed
        let next = 258 + table.len() + 1;
        width = (9..=MOST_BITS).find(|width| next < 1 << width).unwrap_or(MOST_BITS);
    }
    out.truncate(most);
    Some(out)
}

/// The bytes of a code.
fn spell(table: &[(usize, u8)], mut code: usize, string: &mut Vec<u8>) -> Option<()> {
    string.clear();
    while code >= 258 {
        let (earlier, byte) = *table.get(code - 258)?;
        string.push(byte);
        code = earlier;
    }
    string.push(u8::try_from(code).ok()?);
    string.reverse();
    Some(())
}
