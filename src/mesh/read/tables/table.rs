//! Tables of numbers, with columns separated as spreadsheets and programs do: `,`, `;`, tabs or blanks.
//!
//! Readers of CSV take one separator for a whole file, no blanks for one, and no comment behind a row.

use std::borrow::Cow;

use super::header::Columns;
use crate::mesh::read::problem::Problem;
use crate::mesh::read::words::{self, lines, number, parse_number};
use crate::text::decode;

const COMMA: &str = "write a decimal point, or separate columns by `;` where a comma is the decimal mark";

/// The rows of a table without its header, comments and blank lines.
pub(super) struct Table {
    text: String,
    /// The lines on which the first number with a decimal point and with a decimal comma stands.
    marks: [Option<usize>; 2],
}

/// One row: its line in the file, and how its columns are separated.
pub(super) struct Row<'a> {
    pub line: usize,
    separator: Option<char>,
    fields: Vec<&'a str>,
}

impl Table {
    /// `remedy` says what the table should look like.
    pub fn decode(bytes: &[u8], remedy: &'static str) -> Result<Table, Problem> {
        let text = decode(bytes);
        if !text.is_text() {
            return Err(Problem::new("the file is not text", remedy));
        }
        Ok(Table { text: text.text.into_owned(), marks: [None; 2] })
    }

    /// Calls `take` with every row, its columns in the usual order. A first row without any number is a header, which says
    /// where they stand; columns that are not asked for are left out.
    pub fn rows(
        mut self,
        columns: &Columns,
        mut take: impl FnMut(&mut Marks, Row) -> Result<(), Problem>,
    ) -> Result<(), Problem> {
        // Excel writes `sep=;` before everything else.
        let said = |content: &str| content.get(..4).is_some_and(|word| word.eq_ignore_ascii_case("sep="));
        let rows = lines(&self.text).enumerate().skip_while(|(n, (_, content))| *n == 0 && said(content));
        let mut header: Option<(usize, Vec<usize>)> = None;
        for (n, (_, (line, content))) in rows.enumerate() {
            let mut row = Row::split(content, line);
            if n == 0 && row.is_header() {
                header = Some((row.fields.len(), columns.places(&row.fields, line)?));
                continue;
            }
            if let Some((named, places)) = &header {
                if row.fields.len() > *named {
                    let reason = format!("there are {} columns, and the header names {named}", row.fields.len());
                    let remedy = "write a number for each name, and decimals with a point";
                    return Err(Problem::at(line, reason, remedy));
                }
                row.fields = places.iter().map_while(|&place| row.fields.get(place).copied()).collect();
            }
            take(&mut self.marks, row)?;
        }
        Ok(())
    }
}

/// The lines on which the first number with a decimal point and with a decimal comma stands.
type Marks = [Option<usize>; 2];

impl<'a> Row<'a> {
    fn split(content: &'a str, line: usize) -> Row<'a> {
        let separator = [';', '\t', ','].into_iter().find(|&c| content.contains(c));
        let mut quote = None;
        let outside = |c: char| {
            match quote {
                None if c == '"' || c == '\'' => quote = Some(c),
                Some(open) if c == open => quote = None,
                _ => {}
            }
            quote.is_none() && separator.map_or(c.is_whitespace(), |separator| c == separator)
        };
        let fields = content.split(outside).map(|field| field.trim().trim_matches(['"', '\'']).trim());
        let mut fields: Vec<&str> = fields.filter(|field| separator.is_some() || !field.is_empty()).collect();
        while fields.last().is_some_and(|last| last.is_empty()) {
            fields.pop();
        }
        Row { line, separator, fields }
    }

    /// Whether there is no number in it. What is no number among numbers is a mistake, and `nan` is no name.
    fn is_header(&self) -> bool {
        !self.fields.iter().any(|field| field.is_empty() || parse_number(&self.with_point(field)).is_some())
    }

    pub fn columns(&self) -> usize {
        self.fields.len()
    }

    /// A vertex that counts from 0, which spreadsheets may write as `3.0`.
    pub fn index(&self, column: usize, what: &str) -> Result<u32, Problem> {
        let field = self.fields.get(column).copied();
        let whole = field.and_then(|field| parse_number(&self.with_point(field))).filter(|x| x.fract() == 0.0);
        match whole {
            Some(x) if (0.0..=f64::from(u32::MAX)).contains(&x) => Ok(x as u32),
            _ => words::index(field, self.line, what).map_err(|problem| match field {
                Some(field) if field.contains(char::is_whitespace) => Problem { remedy: COMMA.into(), ..problem },
                _ => problem,
            }),
        }
    }

    /// A finite number.
    pub fn number(&self, column: usize, what: &str, marks: &mut Marks) -> Result<f64, Problem> {
        let field = self.fields.get(column).copied();
        for (mark, first) in ['.', ','].into_iter().zip(marks.iter_mut()) {
            if field.is_some_and(|field| field.contains(mark)) {
                first.get_or_insert(self.line);
            }
        }
        if let (Some(field), [Some(point), Some(comma)]) = (field, *marks) {
            let reason = format!(
                "{what} `{field}` may mean two things: line {point} has a decimal point, and line {comma} a decimal comma"
            );
            return Err(Problem::at(self.line, reason, "write all numbers with a decimal point"));
        }
        if let Some(field) = field.filter(|field| self.separator == Some(',') && field.contains(',')) {
            let reason = format!("{what} `{field}` may mean two things, a fraction or thousands");
            return Err(Problem::at(self.line, reason, "write it with a decimal point, and thousands without a mark"));
        }
        number(field.map(|field| self.with_point(field)).as_deref(), self.line, what)
    }

    fn with_point(&self, field: &'a str) -> Cow<'a, str> {
        if self.separator != Some(',') && field.contains(',') { field.replace(',', ".").into() } else { field.into() }
    }
}
