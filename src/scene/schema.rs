//! The JSON schema of scene files, from the very declarations that read them.

use serde_json::{Map, Value as Json, json};

use super::data::Scene;
use super::keys::{Bounds, Field, Kind, Variant, declared};
use super::sections::root;

impl Scene {
    /// The JSON schema (draft 2020-12) of a scene file, for editors that check TOML while it is written.
    pub fn schema() -> Json {
        let mut schema = object(&declared(root));
        schema.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
        schema.insert("title".into(), "A scene of immerse".into());
        schema.into()
    }
}

fn object(fields: &[Field]) -> Map<String, Json> {
    let mut properties = Map::new();
    let mut variants: &[Variant] = &[];
    for field in fields {
        if let Kind::Variants(of) = &field.kind {
            variants = of;
        }
        properties.insert(field.name.into(), property(field));
    }
    let required: Vec<&str> = fields.iter().filter(|field| field.required).map(|field| field.name).collect();
    let mut schema = Map::from_iter([("type".into(), "object".into()), ("properties".into(), properties.into())]);
    if !required.is_empty() {
        schema.insert("required".into(), required.into());
    }
    match fields.iter().find(|field| matches!(field.kind, Kind::Variants(_))) {
        None => {
            schema.insert("additionalProperties".into(), false.into());
        }
        Some(selector) => {
            // Keys of the variant count only beside its name.
            let rules: Vec<Json> = variants.iter().map(|variant| rule(selector.name, variant)).collect();
            schema.insert("allOf".into(), rules.into());
            schema.insert("unevaluatedProperties".into(), false.into());
        }
    }
    schema
}

/// Whether a list among these fields, or among those of their variants, is of the kind of the list `name`.
fn refers_to(fields: &[Field], name: &str) -> bool {
    fields.iter().any(|field| match &field.kind {
        Kind::TablesLike(anchor) => *anchor == name,
        Kind::Table(inner) | Kind::Tables(inner) => refers_to(inner, name),
        Kind::Variants(variants) => variants.iter().any(|variant| refers_to(&variant.fields, name)),
        _ => false,
    })
}

fn rule(selector: &str, variant: &Variant) -> Json {
    let mut then = object(&variant.fields);
    then.remove("additionalProperties");
    then.insert("description".into(), variant.doc.into());
    json!({ "if": { "properties": { selector: { "const": variant.name } }, "required": [selector] }, "then": then })
}

fn property(field: &Field) -> Json {
    let mut schema = match &field.kind {
        Kind::Tables(fields) => {
            let mut items = object(fields);
            if refers_to(fields, field.name) {
                // The anchor is what a tree's inner lists refer to.
                items.insert("$anchor".into(), field.name.into());
            }
            Map::from_iter([("type".into(), "array".into()), ("items".into(), items.into())])
        }
        kind => value(kind),
    };
    schema.insert("description".into(), field.doc.into());
    if let Some(default) = &field.default {
        schema.insert("default".into(), default.clone());
    }
    schema.into()
}

fn value(kind: &Kind) -> Map<String, Json> {
    let schema = match kind {
        Kind::Number(bounds) => return number("number", bounds),
        Kind::Integer(bounds) => return number("integer", bounds),
        Kind::Table(fields) | Kind::Tables(fields) => return object(fields),
        Kind::ChangingNumber(bounds, fields) => {
            json!({ "anyOf": [number("number", bounds), { "type": "string" }, object(fields)] })
        }
        Kind::Either(one, other) => json!({ "anyOf": [value(one), value(other)] }),
        Kind::Map(item) => json!({ "type": "object", "additionalProperties": value(item) }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Color => json!({ "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }),
        Kind::Choice(names) => json!({ "enum": names }),
        Kind::OneOrMore(names) => {
            json!({ "anyOf": [{ "enum": names }, { "type": "array", "minItems": 1, "items": { "enum": names } }] })
        }
        Kind::Array { item, length: None } => json!({ "type": "array", "items": value(item) }),
        Kind::Array { item, length: Some(length) } => {
            json!({ "type": "array", "items": value(item), "minItems": length, "maxItems": length })
        }
        Kind::TablesLike(anchor) => {
            json!({ "type": "array", "minItems": 1, "items": { "$ref": format!("#{anchor}") } })
        }
        Kind::Variants(variants) => json!({ "enum": variants.iter().map(|variant| variant.name).collect::<Vec<_>>() }),
    };
    match schema {
        Json::Object(schema) => schema,
        _ => Map::new(),
    }
}

fn number(kind: &str, bounds: &Bounds) -> Map<String, Json> {
    let mut schema = Map::from_iter([("type".into(), kind.into())]);
    if let Some((low, open)) = bounds.low {
        schema.insert(if open { "exclusiveMinimum" } else { "minimum" }.into(), low.into());
    }
    if let Some((high, open)) = bounds.high {
        schema.insert(if open { "exclusiveMaximum" } else { "maximum" }.into(), high.into());
    }
    schema
}
