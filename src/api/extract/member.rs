//! What is wrong with a member of a request, in words that need no knowledge of the parser.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::api::problem::Problem;

/// The member of `document` that keeps it from being a `T`; `None` if it is one.
pub fn wrong_member<T: DeserializeOwned>(document: &Value) -> Option<Problem> {
    let (path, message) = failure::<T>(document)?;
    let field = |name: &str| if path == "body" { name.to_owned() } else { format!("{path}.{name}") };
    let quoted = message.split('`').nth(1).unwrap_or("");
    let value = at(document, &path).cloned().unwrap_or(Value::Null);
    if message.starts_with("missing field") {
        return Some(Problem::field("invalid_member", field(quoted), Value::Null, "given"));
    }
    if message.starts_with("unknown field") {
        // The path of an unknown member ends with the member itself.
        let bound = match names(&message) {
            known if known.is_empty() => "left out: there is no such member".to_owned(),
            known => {
                let meant = known.iter().find(|name| are_alike(name, quoted));
                let meant = meant.map_or_else(String::new, |name| format!(" (`{name}`?)"));
                format!("left out{meant}: the members here are {}", listed(&known))
            }
        };
        return Some(Problem::field("invalid_member", path, value, bound));
    }
    // The parser takes a list for an object's members in order, and blames the list's items.
    if let Some((list, item)) = path.rsplit_once('[')
        && item.ends_with(']')
        && expected_at::<T>(document, list).is_some_and(|message| message.contains("expected struct "))
    {
        let value = at(document, list).cloned().unwrap_or(Value::Null);
        return Some(Problem::field("invalid_member", list, value, "an object"));
    }
    let probed = expected_at::<T>(document, &path);
    let bound = probed.as_deref().and_then(in_words).or_else(|| in_words(&message));
    Some(Problem::field("invalid_member", path, value, bound.unwrap_or(message)))
}

/// What the parser says of a text at `path`: of lists and of one of several names it then tells what it
/// expects.
fn expected_at<T: DeserializeOwned>(document: &Value, path: &str) -> Option<String> {
    let (place, message) = failure::<T>(&probe(document, path)?)?;
    (place == path).then_some(message)
}

/// Path and message of the first member that does not fit.
fn failure<T: DeserializeOwned>(document: &Value) -> Option<(String, String)> {
    let error = serde_path_to_error::deserialize::<_, T>(document).err()?;
    let path = error.path().to_string();
    Some((if path == "." { "body".to_owned() } else { path }, error.inner().to_string()))
}

/// What a message says to be expected.
fn in_words(message: &str) -> Option<String> {
    let (_, expected) = message.split_once("expected ")?;
    if message.starts_with("unknown variant") {
        return Some(match names(message).as_slice() {
            [] => return None,
            [name] => format!("`{name}`"),
            names => format!("one of {}", listed(names)),
        });
    }
    if let Some(length) = expected.strip_prefix("an array of length ") {
        return Some(format!("a list of {length} numbers"));
    }
    Some(match expected {
        "f64" => "a number".to_owned(),
        "u32" | "u64" | "usize" => "a whole number of at least 0".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a string" => "a text".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a map" => "an object".to_owned(),
        other if other.starts_with("struct ") => "an object".to_owned(),
        other => other.to_owned(),
    })
}

/// The names that a message quotes behind what it expects.
fn names(message: &str) -> Vec<String> {
    let expected = message.split_once("expected ").map_or("", |(_, expected)| expected);
    expected.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn listed(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The value at a path such as `object.center[2]`.
fn at<'a>(document: &'a Value, path: &str) -> Option<&'a Value> {
    segments(path).try_fold(document, |found, segment| match segment {
        Segment::Index(index) => found.get(index),
        Segment::Name(name) => found.get(name),
    })
}

/// `document` with a text in place of the value at `path`.
fn probe(document: &Value, path: &str) -> Option<Value> {
    let mut probe = document.clone();
    let place = segments(path).try_fold(&mut probe, |found, segment| match segment {
        Segment::Index(index) => found.get_mut(index),
        Segment::Name(name) => found.get_mut(name),
    })?;
    *place = Value::String("?".to_owned());
    Some(probe)
}

enum Segment<'a> {
    Index(usize),
    Name(&'a str),
}

fn segments(path: &str) -> impl Iterator<Item = Segment<'_>> {
    path.split(['.', '[']).filter(|segment| !segment.is_empty() && *segment != "body").map(|segment| {
        match segment.strip_suffix(']').and_then(|index| index.parse().ok()) {
            Some(index) => Segment::Index(index),
            None => Segment::Name(segment),
        }
    })
}

/// Whether one name is a slip of the other: case, `_` and `-` aside, at most two letters put in, left
/// out or mistaken.
fn are_alike(known: &str, given: &str) -> bool {
    let letters = |name: &str| -> Vec<char> {
        let plain = name.chars().filter(|c| !matches!(c, '_' | '-' | ' '));
        plain.take(64).flat_map(char::to_lowercase).collect()
    };
    let (known, given) = (letters(known), letters(given));
    let mut row: Vec<usize> = (0..=given.len()).collect();
    for (i, a) in known.iter().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (cell, b) in row.iter_mut().skip(1).zip(&given) {
            let best = (diagonal + usize::from(a != b)).min(left + 1).min(*cell + 1);
            diagonal = std::mem::replace(cell, best);
            left = best;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    let apart = row.last().copied().unwrap_or(0);
    apart <= 2 && apart < known.len().min(given.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::api::wire::PlanRequestJson;
    use serde_json::json;

    fn refusal(document: Value) -> Problem {
        wrong_member::<PlanRequestJson>(&document).unwrap()
    }

    #[test]
    fn what_is_expected_is_said_without_the_parsers_words() {
        let pose = |orientation: Value| json!({"flange_from_camera": {"position": [0, 0, 0], "orientation": orientation}});
        for (document, field, bound) in [
            (json!({"roll": 5}), "roll", "one of `free`, `fixed`, `sampled`"),
            (json!({"roll": ["free"]}), "roll", "one of `free`, `fixed`, `sampled`"),
            (json!({"robot": "ur5e"}), "robot", "an object"),
            (json!({"keep_out": {}}), "keep_out", "a list"),
            (json!({"object": {"center": [1, 2], "radius": 1}}), "object.center", "a list of 3 numbers"),
            (
                json!({"object": {"center": [1, 2, 3, 4], "radius": 1}}),
                "object.center",
                "a list of 3 numbers",
            ),
            (pose(json!({"w": 1})), "flange_from_camera.orientation", "a list of 4 numbers"),
            (pose(json!([0, 0, 0, "1"])), "flange_from_camera.orientation[3]", "a number"),
            (json!({"timing": {"jerk_limited": 1}}), "timing.jerk_limited", "true or false"),
            (json!({"view_count": 3.5}), "view_count", "a whole number of at least 0"),
            (json!({"limits": []}), "limits", "an object"),
            (json!({"robot": {"urdf": 5}}), "robot.urdf", "a text"),
            (
                json!({"object": {"center": [0, 0, 0], "radius": 1, "shape": 5}}),
                "object.shape",
                "one of `sphere`, `cylinder`, `box`",
            ),
        ] {
            let problem = refusal(document.clone());
            assert_eq!(problem.field.as_deref(), Some(field), "{document}");
            assert_eq!(problem.bound.as_deref(), Some(bound), "{document}");
        }
        assert_eq!(wrong_member::<PlanRequestJson>(&json!(5)).unwrap().field.as_deref(), Some("body"));
        assert!(wrong_member::<PlanRequestJson>(&json!({"view_count": 3})).is_none());
    }

    #[test]
    fn a_slip_of_a_name_is_met_with_the_name() {
        for (given, meant) in [
            ("viewcount", "view_count"),
            ("objekt", "object"),
            ("view-count", "view_count"),
            ("Robot", "robot"),
        ] {
            let problem = refusal(json!({given: 5}));
            let bound = problem.bound.clone().unwrap();
            assert!(bound.starts_with(&format!("left out (`{meant}`?): ")), "{bound}");
        }
        assert!(refusal(json!({"obstacles": []})).bound.as_deref().unwrap().starts_with("left out: "));
    }
}
