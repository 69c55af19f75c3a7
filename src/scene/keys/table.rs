//! Reading one TOML table: every key is declared where it is read, with its kind, bounds, default and
//! documentation, and what was not declared is reported as unknown. Problems are collected, not returned,
//! so that one pass finds them all; the value read is then a placeholder and the scene is refused.
//! Reading a table that is not there declares its keys all the same: that is where the schema comes from.

use std::marker::PhantomData;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::problems::{Problem, Problems};
use super::spelling::suggestion;
use super::value::{Bounds, Field, Kind, Value, shown};
use crate::text::clipped;

pub(in crate::scene) struct Table<'a> {
    /// In words, for messages: "[camera]".
    title: String,
    entries: Option<&'a DeTable<'a>>,
    /// Where to point if something is missing.
    place: Range<usize>,
    problems: &'a Problems,
    pub(in crate::scene) fields: Vec<Field>,
    /// A misspelt variant: its keys cannot be known.
    pub(super) any_keys: bool,
}

impl<'a> Table<'a> {
    pub(in crate::scene) fn new(
        title: String,
        entries: Option<&'a DeTable<'a>>,
        place: Range<usize>,
        problems: &'a Problems,
    ) -> Self {
        Table { title, entries, place, problems, fields: Vec::new(), any_keys: false }
    }

    /// The table in words: `[camera]`.
    pub(in crate::scene) fn title(&self) -> &str {
        &self.title
    }

    /// Whether the file has this key.
    pub(in crate::scene) fn has(&self, name: &str) -> bool {
        self.entry(name).is_some()
    }

    pub(super) fn entry(&self, name: &str) -> Option<(&'a Spanned<toml::de::DeString<'a>>, &'a Spanned<DeValue<'a>>)> {
        self.entries?.get_key_value(name)
    }

    pub(super) fn report(&self, span: Range<usize>, reason: String, remedy: impl FnOnce() -> String) {
        self.problems.push(span, reason, remedy);
    }

    fn take_up(&self, problem: Problem) {
        self.report(problem.span, problem.reason, || problem.remedy);
    }

    /// Reports that the value of a key, or the table if the key is left out, cannot be.
    pub(in crate::scene) fn complain(&self, name: &str, reason: impl Into<String>, remedy: impl Into<String>) {
        let span = self.entry(name).map_or(self.place.clone(), |(_, value)| value.span());
        self.report(span, reason.into(), || remedy.into());
    }

    /// Whether the table is in the file and has none of the keys.
    pub(in crate::scene) fn has_none_of(&self, names: &[&str]) -> bool {
        self.entries.is_some() && !names.iter().any(|name| self.has(name))
    }

    /// Reports keys that exclude each other. Where a file that is extended has one and the file that extends it another, the
    /// former goes.
    pub(in crate::scene) fn only_one_of(&self, names: &[&str]) {
        let given: Vec<_> = names.iter().filter_map(|name| self.entry(name)).collect();
        let rank = |value: &Spanned<DeValue>| self.problems.rank(value.span().start);
        let highest = given.iter().map(|(_, value)| rank(value)).max();
        let (given, lower): (Vec<_>, Vec<_>) = given.into_iter().partition(|(_, value)| Some(rank(value)) == highest);
        lower.iter().for_each(|(_, value)| self.problems.replace(value.span()));
        let mut given: Vec<_> = given.into_iter().map(|(key, _)| key).collect();
        given.sort_by_key(|key| key.span().start);
        if let [first, second, ..] = given.as_slice() {
            let [one, other] = [first, second].map(|key| key.get_ref());
            let reason = format!("{} has both `{one}` and `{other}`, which exclude each other", self.title);
            self.report(second.span(), reason, || "remove one of them".into());
        }
    }

    /// Whether the table is in the file.
    pub(in crate::scene) fn is_given(&self) -> bool {
        self.entries.is_some()
    }

    /// Reads a table whose keys are up to the file, in the order in which they stand there.
    pub(in crate::scene) fn map<T: Value>(&mut self, name: &'static str, doc: &'static str) -> Vec<(String, T)> {
        let mut entries = Vec::new();
        if let Some((_, value)) = self.entry(name) {
            match value.get_ref().as_table() {
                Some(table) => entries.extend(table.iter()),
                None => {
                    let reason = format!("`{name}` is {}, it must be a table", shown(value.get_ref()));
                    let remedy = || format!("write [{name}] on a line of its own, with its keys below");
                    self.report(value.span(), reason, remedy);
                }
            }
        }
        entries.sort_by_key(|(key, _)| key.span().start);
        let read = |(key, value): (&Spanned<toml::de::DeString>, &Spanned<DeValue>)| {
            let key = key.get_ref().to_string();
            match T::read(&key, value, Bounds::default(), &format!("{key} = 1")) {
                Ok(value) => Some((key, value)),
                Err(problem) => {
                    self.take_up(problem);
                    None
                }
            }
        };
        let values = entries.into_iter().filter_map(read).collect();
        self.declare(name, doc, Kind::Map(Box::new(T::kind(Bounds::default()))));
        values
    }

    /// Declares a key; the call is completed by [`Key::or`], [`Key::required`] or [`Key::optional`].
    pub(in crate::scene) fn key<T: Value>(&mut self, name: &'static str, doc: &'static str) -> Key<'_, 'a, T> {
        Key { table: self, name, doc, bounds: Bounds::default(), value: PhantomData }
    }

    /// Reads a sub-table; one that is left out has its defaults.
    pub(in crate::scene) fn table<T>(&mut self, name: &'static str, doc: &'static str, read: fn(&mut Table) -> T) -> T {
        let scratch = Problems::default();
        let read_one = |entries, place, problems| {
            let mut table = Table::new(format!("[{name}]"), entries, place, problems);
            let value = read(&mut table);
            table.finish();
            (value, table.fields)
        };
        let (value, fields) = match self.entry(name).map(|(_, value)| (value.get_ref(), value.span())) {
            Some((DeValue::Table(entries), span)) => read_one(Some(entries), span, self.problems),
            other => {
                if let Some((other, span)) = other {
                    let remedy = if other.is_array() {
                        format!("write [{name}] with single brackets, once")
                    } else {
                        format!("write [{name}] on a line of its own, with its keys below")
                    };
                    self.report(span, format!("`{name}` is {}, it must be a table", shown(other)), || remedy);
                }
                read_one(None, 0..0, &scratch)
            }
        };
        self.declare(name, doc, Kind::Table(fields));
        value
    }

    /// Reads a sub-table that may be left out.
    pub(in crate::scene) fn optional_table<T>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        read: fn(&mut Table) -> T,
    ) -> Option<T> {
        let given = self.has(name);
        let value = self.table(name, doc, read);
        given.then_some(value)
    }

    /// Reads a list of tables, `[[name]]`.
    pub(in crate::scene) fn tables<T>(
        &mut self,
        name: &'static str,
        doc: &'static str,
        read: fn(&mut Table) -> T,
    ) -> Vec<T> {
        let values = self.read_tables(name, read);
        self.declare(name, doc, Kind::Tables(declared(read)));
        values
    }

    /// Reads a list of tables of the kind of those in the key `like`, which contains this one.
    pub(in crate::scene) fn tables_like<T>(
        &mut self,
        name: &'static str,
        like: &'static str,
        doc: &'static str,
        read: fn(&mut Table) -> T,
    ) -> Vec<T> {
        let values = self.read_tables(name, read);
        self.declare(name, doc, Kind::TablesLike(like));
        values
    }

    fn read_tables<T>(&mut self, name: &'static str, read: fn(&mut Table) -> T) -> Vec<T> {
        let Some((_, value)) = self.entry(name) else { return Vec::new() };
        let list: Vec<&'a Spanned<DeValue<'a>>> = match value.get_ref() {
            DeValue::Array(list) => list.iter().collect(),
            DeValue::Table(_) => {
                let reason = format!("`{name}` is one table, it must be a list of tables");
                self.report(value.span(), reason, || format!("write [[{name}]] with double brackets"));
                return Vec::new();
            }
            _ => vec![value],
        };
        let mut values = Vec::new();
        for element in list {
            let Some(entries) = element.get_ref().as_table() else {
                let reason = format!("`{name}` holds {}, it must hold tables", shown(element.get_ref()));
                self.report(element.span(), reason, || format!("write [[{name}]] and the keys below it"));
                continue;
            };
            let mut table = Table::new(format!("[[{name}]]"), Some(entries), element.span(), self.problems);
            values.push(read(&mut table));
            table.finish();
        }
        values
    }

    pub(super) fn declare(&mut self, name: &'static str, doc: &'static str, kind: Kind) {
        self.fields.push(Field { name, doc, kind, default: None, required: false });
    }

    /// Whether a key belongs to another variant than the one that a text of higher rank asks for, or to one that it does
    /// without.
    fn is_of_replaced_variant(&self, key: &str, value: &Spanned<DeValue>) -> bool {
        let rank = |value: &Spanned<DeValue>| self.problems.rank(value.span().start);
        let is_replaced = |field: &Field| match &field.kind {
            Kind::Variants(variants) => {
                if !variants.iter().any(|variant| variant.fields.iter().any(|field| field.name == key)) {
                    return false;
                }
                let by = match self.entry(field.name) {
                    Some((_, name)) => Some(rank(name)),
                    None => self.entries.into_iter().flatten().map(|(_, other)| rank(other)).max(),
                };
                by > Some(rank(value))
            }
            _ => false,
        };
        !self.fields.iter().any(|field| field.name == key) && self.fields.iter().any(is_replaced)
    }

    /// Reports the keys nobody asked for.
    pub(in crate::scene) fn finish(&self) {
        if self.any_keys {
            return;
        }
        let names: Vec<&str> = self.fields.iter().map(|field| field.name).collect();
        let mut keys: Vec<_> = self.entries.into_iter().flatten().collect();
        keys.sort_by_key(|(key, _)| key.span().start);
        for (key, value) in keys {
            if self.is_of_replaced_variant(key.get_ref(), value) {
                self.problems.replace(value.span());
            } else if !names.contains(&key.get_ref().as_ref()) {
                let reason = format!("there is no `{}` in {}", clipped(key.get_ref()), self.title);
                self.report(key.span(), reason, || suggestion("keys", key.get_ref(), &names));
            }
        }
    }
}

/// The keys that a reader asks for.
pub(in crate::scene) fn declared<T>(read: fn(&mut Table) -> T) -> Vec<Field> {
    let scratch = Problems::default();
    let mut table = Table::new(String::new(), None, 0..0, &scratch);
    read(&mut table);
    table.fields
}

/// A key that is being declared.
#[must_use]
pub(in crate::scene) struct Key<'t, 'a, T> {
    table: &'t mut Table<'a>,
    name: &'static str,
    doc: &'static str,
    bounds: Bounds,
    value: PhantomData<T>,
}

impl<T: Value> Key<'_, '_, T> {
    /// Numbers greater than this.
    pub(in crate::scene) fn above(mut self, low: f64) -> Self {
        self.bounds.low = Some((low, true));
        self
    }

    /// Numbers not less than this.
    pub(in crate::scene) fn at_least(mut self, low: f64) -> Self {
        self.bounds.low = Some((low, false));
        self
    }

    /// Numbers less than this.
    pub(in crate::scene) fn below(mut self, high: f64) -> Self {
        self.bounds.high = Some((high, true));
        self
    }

    /// Numbers not greater than this.
    pub(in crate::scene) fn at_most(mut self, high: f64) -> Self {
        self.bounds.high = Some((high, false));
        self
    }

    /// The value, or the default if the key is left out.
    pub(in crate::scene) fn or(self, default: T) -> T {
        self.read(&default, true, false).unwrap_or(default)
    }

    /// The value; a key that is left out is reported, with the example as what to write.
    pub(in crate::scene) fn required(self, example: T) -> T {
        self.read(&example, false, true).unwrap_or(example)
    }

    /// The value, if there is one; the example is for the message about a wrong one.
    pub(in crate::scene) fn optional(self, example: T) -> Option<T> {
        self.read(&example, false, false)
    }

    fn read(self, example: &T, is_default: bool, required: bool) -> Option<T> {
        let Key { table, name, doc, bounds, .. } = self;
        table.fields.push(Field {
            name,
            doc,
            kind: T::kind(bounds),
            default: is_default.then(|| example.json()),
            required,
        });
        let example = format!("{name} = {}", example.json());
        let Some((_, value)) = table.entry(name) else {
            if required {
                let reason = format!("{} has no `{name}`", table.title);
                table.report(table.place.clone(), reason, || format!("add for example {example}"));
            }
            return None;
        };
        T::read(name, value, bounds, &example).map_err(|problem| table.take_up(problem)).ok()
    }
}
