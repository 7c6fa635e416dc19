//! The bounds that requests are checked by, as the description declares them: out of the same constants.
//!
//! A bound that depends on other members (a shape within its sphere, a limit beyond the robot's own) is
//! declared as wide as it can be.

use utoipa::openapi::path::Parameter;
use utoipa::openapi::schema::{ArrayItems, SchemaType, Type};
use utoipa::openapi::{OpenApi, RefOr, Schema};
use utoipa::{Modify, Number};

use super::table::{Bound, parameters, schemas};

/// Writes the bounds into the document.
pub(super) struct Bounds;

impl Modify for Bounds {
    fn modify(&self, document: &mut OpenApi) {
        for (schema, member, bound) in schemas() {
            let found = document.components.as_mut().and_then(|c| c.schemas.get_mut(schema));
            let is_there =
                found.and_then(|schema| part(schema, member)).is_some_and(|part| put(part, &bound));
            debug_assert!(is_there, "{schema} has no {member} to be bounded");
        }
        for (path, name, bound) in parameters() {
            let is_there = parameter(document, path, name)
                .and_then(|found| plain(found.schema.as_mut()?))
                .is_some_and(|part| put(part, &bound));
            debug_assert!(is_there, "{path} has no {name} to be bounded");
        }
    }
}

/// The part of a schema at a path such as `cylinder.radius` or `center[]`, the items of a list.
fn part<'a>(schema: &'a mut RefOr<Schema>, path: &str) -> Option<&'a mut Schema> {
    let (first, rest) = path.split_once('.').map_or((path, None), |(first, rest)| (first, Some(rest)));
    let (name, in_items) = first.strip_suffix("[]").map_or((first, false), |name| (name, true));
    let mut found = property(plain(schema)?, name)?;
    if in_items {
        found = match plain(found)? {
            Schema::Array(list) => match &mut list.items {
                ArrayItems::RefOrSchema(items) => items,
                _ => return None,
            },
            _ => return None,
        };
    }
    match rest {
        Some(rest) => part(found, rest),
        None => plain(found),
    }
}

/// The member `name` of an object, or of that of several variants which has it.
fn property<'a>(schema: &'a mut Schema, name: &str) -> Option<&'a mut RefOr<Schema>> {
    match schema {
        Schema::Object(object) => object.properties.get_mut(name),
        Schema::OneOf(variants) => {
            variants.items.iter_mut().find_map(|variant| property(plain(variant)?, name))
        }
        _ => None,
    }
}

fn plain(schema: &mut RefOr<Schema>) -> Option<&mut Schema> {
    match schema {
        RefOr::T(schema) => Some(schema),
        RefOr::Ref(_) => None,
    }
}

fn parameter<'a>(document: &'a mut OpenApi, path: &str, name: &str) -> Option<&'a mut Parameter> {
    let item = document.paths.paths.get_mut(path)?;
    let operation = item.get.as_mut().or(item.post.as_mut())?;
    operation.parameters.as_mut()?.iter_mut().find(|parameter| parameter.name == name)
}

/// False where the schema is of another kind than the bound.
fn put(schema: &mut Schema, bound: &Bound) -> bool {
    match (schema, bound) {
        (Schema::Object(object), Bound::Within(least, most)) => {
            let number = number_like(&object.schema_type);
            (object.minimum, object.maximum) = (Some(number(*least)), Some(number(*most)));
        }
        (Schema::Object(object), Bound::Between(least, most)) => {
            (object.exclusive_minimum, object.exclusive_maximum) =
                (Some(Number::Float(*least)), Some(Number::Float(*most)));
        }
        (Schema::Object(object), Bound::Above(least)) => {
            object.exclusive_minimum = Some(Number::Float(*least));
        }
        (Schema::Object(object), Bound::Length(least, most)) => {
            (object.min_length, object.max_length) = (Some(*least), Some(*most));
        }
        (Schema::Array(list), Bound::Items(least, most)) => {
            (list.min_items, list.max_items) = (Some(*least), Some(*most));
        }
        _ => return false,
    }
    true
}

/// How a bound of this type of number is written.
fn number_like(kind: &SchemaType) -> fn(f64) -> Number {
    let is_whole = match kind {
        SchemaType::Type(kind) => *kind == Type::Integer,
        SchemaType::Array(kinds) => kinds.contains(&Type::Integer),
        SchemaType::AnyValue => false,
    };
    if is_whole { |value| Number::Int(value as isize) } else { Number::Float }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::api::openapi::ApiDocument;

    #[test]
    fn every_bound_has_its_place_in_the_description() {
        let mut document = <ApiDocument as utoipa::OpenApi>::openapi();
        let components = document.components.as_mut().unwrap();
        for (schema, member, bound) in schemas() {
            let found = components.schemas.get_mut(schema).and_then(|schema| part(schema, member));
            assert!(found.is_some_and(|found| put(found, &bound)), "{schema}.{member}");
        }
        for (path, name, bound) in parameters() {
            let found = parameter(&mut document, path, name).and_then(|found| plain(found.schema.as_mut()?));
            assert!(found.is_some_and(|found| put(found, &bound)), "{path} {name}");
        }
    }
}
