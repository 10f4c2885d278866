//! Differences between two plans, key by key.

use super::Question;
use serde_json::Value;

/// Most differences in a line.
const MOST: usize = 12;

/// The differences in one line: `KEY: VALUE there, VALUE requested`, separated by semicolons; the first ones where there are many.
pub(super) fn between<C: Question>(there: &C, requested: &C) -> String {
    let mut found = Vec::new();
    if there.format() != requested.format() {
        found.push(format!(
            "it was computed by another version of motiform with other numbers: format {} there, {} here",
            there.format(),
            requested.format()
        ));
    }
    let stated = [there.stated(), requested.stated()];
    let differ = stated[0].iter().zip(&stated[1]).filter(|(left, right)| left != right);
    found.extend(differ.map(|((key, left), (_, right))| format!("{key}: {left} there, {right} requested")));
    let said: Vec<&str> = stated[0].iter().map(|(key, _)| *key).chain(["format"]).collect();
    let [left, right] = [there, requested].map(|side| without(side, &said));
    compare("", &left, &right, &mut found);
    if found.len() > MOST {
        let more = format!("{} more", found.len() - MOST);
        found.truncate(MOST);
        found.push(more);
    }
    found.join("; ")
}

/// The serialized computation without the keys (paths with dots) that are said otherwise.
fn without(computation: &impl Question, paths: &[&str]) -> Value {
    let mut value = serde_json::to_value(computation).unwrap_or_default();
    for path in paths {
        let (parents, key) = path.rsplit_once('.').unwrap_or(("", path));
        let mut parent = parents.split('.').filter(|part| !part.is_empty());
        let parent = parent.try_fold(&mut value, |inside, part| inside.get_mut(part));
        parent.and_then(Value::as_object_mut).map(|object| object.shift_remove(key));
    }
    value
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
