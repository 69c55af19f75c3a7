//! Labels with places for values.

use crate::render::{LabelFault, RenderError};

/// Puts values in the places of a template: `{name}` is replaced by the value of that name. `{{` and `}}` are braces.
///
/// # Errors
/// [`RenderError::Label`] if a name has no value or a brace has no partner.
pub fn fill_in(template: &str, values: &[(&str, String)]) -> Result<String, RenderError> {
    let label = |fault: LabelFault| RenderError::Label { text: template.to_owned(), fault };
    let alone = |brace: char| label(LabelFault::LoneBrace(brace));
    let mut filled = String::with_capacity(template.len());
    let mut rest = template;
    while let Some(at) = rest.find(['{', '}']) {
        filled.push_str(&rest[..at]);
        let brace = &rest[at..];
        if let Some(after) = brace.strip_prefix("{{").or_else(|| brace.strip_prefix("}}")) {
            filled.push_str(&brace[..1]);
            rest = after;
            continue;
        }
        let Some(inside) = brace.strip_prefix('{') else { return Err(alone('}')) };
        let (name, after) = inside.split_once('}').ok_or_else(|| alone('{'))?;
        let Some((_, value)) = values.iter().find(|(known, _)| *known == name) else {
            let known = values.iter().map(|(known, _)| (*known).to_owned()).collect();
            return Err(label(LabelFault::UnknownName { name: name.to_owned(), known }));
        };
        filled.push_str(value);
        rest = after;
    }
    filled.push_str(rest);
    Ok(filled)
}
