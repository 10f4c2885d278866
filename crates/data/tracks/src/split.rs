//! A line of a table -> its fields.

use std::borrow::Cow;

/// The fields between separators; those in double quotes may contain separators, and `""` for a quote.
pub(crate) fn split<'a>(line: &'a str, separator: u8, fields: &mut Vec<Cow<'a, str>>) {
    fields.clear();
    let separator = char::from(separator);
    if !line.contains('"') {
        fields.extend(line.split(separator).map(Cow::Borrowed));
        return;
    }
    let mut field = String::new();
    let mut quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                field.push('"');
            }
            '"' => quoted = !quoted,
            c if c == separator && !quoted => fields.push(Cow::Owned(std::mem::take(&mut field))),
            c => field.push(c),
        }
    }
    fields.push(Cow::Owned(field));
}
