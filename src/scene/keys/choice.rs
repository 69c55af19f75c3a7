//! Keys of a table whose value is one of several names, or a list of them.

use toml::Spanned;
use toml::de::DeValue;

use super::spelling::suggestion;
use super::table::{Table, declared};
use super::value::{Field, Kind, Variant, shown};
use crate::text::clipped;

/// A name, what it means, and how the keys beside it are read.
type NamedReader<T> = (&'static str, &'static str, fn(&mut Table) -> T);

impl Table<'_> {
    /// Reads one of several names.
    pub(in crate::scene) fn choice<T: Clone>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        of: &[(&'static str, T)],
    ) -> Option<T> {
        let names: Vec<&'static str> = of.iter().map(|(name, _)| *name).collect();
        let index = self.name_among(name, &names);
        self.declare(name, doc, Kind::Choice(names));
        index.map(|index| of[index].1.clone())
    }

    /// Reads one of several names, with one that counts if the key is left out.
    pub(in crate::scene) fn choice_or<T: Clone + PartialEq>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        of: &[(&'static str, T)],
        default: T,
    ) -> T {
        let chosen = self.choice(name, doc, of);
        if let Some(field) = self.fields.last_mut() {
            field.default = of.iter().find(|(_, value)| *value == default).map(|(name, _)| (*name).into());
        }
        chosen.unwrap_or(default)
    }

    /// Reads one of several names, or a list of them.
    pub(in crate::scene) fn choices<T: Copy + PartialEq>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        of: &[(&'static str, T)],
        default: &[T],
    ) -> Vec<T> {
        let names: Vec<&'static str> = of.iter().map(|(name, _)| *name).collect();
        let kind = Kind::OneOrMore(names.clone());
        let entries = self.entry(name).map(|(_, value)| match value.get_ref() {
            DeValue::Array(list) if !list.is_empty() || default.is_empty() => list.iter().collect(),
            _ => vec![value],
        });
        let chosen = entries.map(|entries| {
            let mut chosen: Vec<T> = Vec::new();
            for entry in entries {
                let found = self.one_of(name, entry, of);
                if found.is_some_and(|value| chosen.contains(&value)) {
                    let reason = format!("`{name}` has {} twice", shown(entry.get_ref()));
                    self.report(entry.span(), reason, || "name it once".into());
                }
                chosen.extend(found);
            }
            chosen
        });
        let usual: Vec<&str> = of.iter().filter(|(_, value)| default.contains(value)).map(|(name, _)| *name).collect();
        self.fields.push(Field { name, doc, kind, default: Some(usual.into()), required: false });
        chosen.unwrap_or_else(|| default.to_vec())
    }

    fn one_of<T: Copy>(&self, name: &str, entry: &Spanned<DeValue>, of: &[(&'static str, T)]) -> Option<T> {
        let names: Vec<&'static str> = of.iter().map(|(name, _)| *name).collect();
        let Some(text) = entry.get_ref().as_str() else {
            let (found, kind) = (shown(entry.get_ref()), Kind::OneOrMore(names.clone()).sentence());
            let remedy = || format!("write for example {name} = [\"{}\"]", names[0]);
            self.report(entry.span(), format!("`{name}` is {found}, it must be {kind}"), remedy);
            return None;
        };
        let found = of.iter().find(|(candidate, _)| *candidate == text);
        if found.is_none() {
            self.report(entry.span(), format!("there is no {name} `{}`", clipped(text)), || {
                suggestion("names", text, &names)
            });
        }
        found.map(|(_, value)| *value)
    }

    /// Reads a name that decides which other keys this table has.
    pub(in crate::scene) fn variants<T>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        of: &[NamedReader<T>],
    ) -> Option<T> {
        let names: Vec<&'static str> = of.iter().map(|(name, ..)| *name).collect();
        let index = self.name_among(name, &names);
        let variants = of.iter().map(|&(name, doc, read)| Variant { name, doc, fields: declared(read) }).collect();
        self.declare(name, doc, Kind::Variants(variants));
        self.any_keys |= self.has(name) && index.is_none();
        index.map(|index| of[index].2(self))
    }

    fn name_among(&self, name: &str, names: &[&'static str]) -> Option<usize> {
        let (_, value) = self.entry(name)?;
        let Some(text) = value.get_ref().as_str() else {
            let reason = format!("`{name}` is {}, it must be a name in quotes", shown(value.get_ref()));
            self.report(value.span(), reason, || suggestion("names", "", names));
            return None;
        };
        let index = names.iter().position(|candidate| *candidate == text);
        if index.is_none() {
            self.report(value.span(), format!("there is no {name} `{}`", clipped(text)), || {
                suggestion("names", text, names)
            });
        }
        index
    }
}
