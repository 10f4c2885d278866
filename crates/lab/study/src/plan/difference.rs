//! Differences between two plans, key by key.

use serde_json::Value;
use std::fmt::Display;

/// Most differences in a line.
const MOST: usize = 12;

/// A serialized computation, and the parts of it that are stated in words.
type Side = (Value, Vec<(&'static str, String)>);

/// The differences in one line: `KEY: VALUE there, VALUE requested`, separated by semicolons; the first ones
/// where there are many.
pub(super) fn between((mut there, words): Side, (mut requested, asked): Side) -> String {
    let mut found = Vec::new();
    let formats = [take(&mut there, "format"), take(&mut requested, "format")];
    if formats[0] != formats[1] {
        found.push(other_version(&formats[0], &formats[1]));
    }
    for ((path, left), (_, right)) in words.iter().zip(&asked) {
        take(&mut there, path);
        take(&mut requested, path);
        if left != right {
            found.push(format!("{path}: {left} there, {right} requested"));
        }
    }
    compare("", &there, &requested, &mut found);
    if found.len() > MOST {
        let more = format!("{} more", found.len() - MOST);
        found.truncate(MOST);
        found.push(more);
    }
    found.join("; ")
}

/// The difference where another version of motiform computed other numbers.
pub fn other_version(there: impl Display, here: impl Display) -> String {
    format!(
        "it was computed by another version of motiform with other numbers: format {there} there, {here} here"
    )
}

/// Takes the value at a path with dots out of an object; null where there is none.
fn take(object: &mut Value, path: &str) -> Value {
    let (parents, key) = path.rsplit_once('.').unwrap_or(("", path));
    let mut parents = parents.split('.').filter(|part| !part.is_empty());
    let parent = parents.try_fold(object, |inside, part| inside.get_mut(part));
    parent.and_then(Value::as_object_mut).and_then(|parent| parent.shift_remove(key)).unwrap_or_default()
}

/// Appends the differences of two values with the path of their keys.
fn compare(key: &str, there: &Value, requested: &Value, found: &mut Vec<String>) {
    let (Some(left), Some(right)) = (there.as_object(), requested.as_object()) else {
        if there != requested {
            found.push(format!("{key}: {} there, {} requested", shown(there), shown(requested)));
        }
        return;
    };
    let new = right.keys().filter(|name| !left.contains_key(*name));
    for name in left.keys().chain(new) {
        let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
        compare(&path, &there[name], &requested[name], found);
    }
}

fn shown(value: &Value) -> String {
    if value.is_null() { "none".to_owned() } else { value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn each_key_is_told_with_both_values() {
        let side = |value: Value, axes: &str| (value, vec![("scan.axes", axes.to_owned())]);
        let there =
            json!({ "format": 1, "scan": { "axes": [1, 2], "seed": 1 }, "noise": null, "t_end": 5.0 });
        let asked = json!({ "format": 1, "scan": { "axes": [1, 3], "seed": 2 }, "t_end": 5.0, "lines": 4 });
        let found = between(side(there.clone(), "a=1,2"), side(asked, "a=1,3"));
        let keys = ["scan.axes: a=1,2 there, a=1,3 requested", "scan.seed: 1 there, 2 requested"];
        assert_eq!(found, format!("{}; lines: none there, 4 requested", keys.join("; ")));
        assert_eq!(between(side(there.clone(), "a"), side(there, "a")), "");
    }

    #[test]
    fn formats_come_first_and_many_differences_are_counted() {
        let numbers = |shift: usize| (0..20).map(|k| (format!("p{k}"), json!(k + shift))).collect();
        let side = |format: u32, shift: usize| {
            let mut object: serde_json::Map<String, Value> = numbers(shift);
            object.insert("format".to_owned(), json!(format));
            (Value::Object(object), Vec::new())
        };
        let found = between(side(1, 0), side(2, 1));
        assert!(found.starts_with("it was computed by another version"), "{found}");
        assert!(found.ends_with("p10: 10 there, 11 requested; 9 more"), "{found}");
    }
}
