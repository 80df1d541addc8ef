//! A text table that is also valid Markdown.

use std::fmt;

/// A table with text in the first columns and numbers in the others.
pub struct Table {
    /// Number of text columns.
    text_columns: usize,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(texts: &[&str], numbers: &[&str]) -> Self {
        let head = texts.iter().chain(numbers).map(ToString::to_string).collect();
        Self { text_columns: texts.len(), rows: vec![head] }
    }

    /// Appends a row, and prints it to stderr as progress: the table itself is printed at the end.
    pub fn push(&mut self, row: Vec<String>) {
        eprintln!("  {}", row.join("  "));
        self.add(row);
    }

    /// Appends a row.
    pub fn add(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| {
            self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0).max(3)
        };
        (0..self.rows[0].len()).map(width).collect()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths = self.widths();
        for (index, row) in self.rows.iter().enumerate() {
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                if column < self.text_columns {
                    write!(f, "| {cell:width$} ")?;
                } else {
                    write!(f, "| {cell:>width$} ")?;
                }
            }
            writeln!(f, "|")?;
            if index == 0 {
                for (column, width) in widths.iter().enumerate() {
                    let (dashes, is_number) = ("-".repeat(width - 1), column >= self.text_columns);
                    write!(f, "| {dashes}{} ", if is_number { ":" } else { "-" })?;
                }
                writeln!(f, "|")?;
            }
        }
        Ok(())
    }
}

/// Formats a number with `digits` decimal places.
pub fn format_number(value: f64, digits: usize) -> String {
    format!("{value:.digits$}")
}

/// Formats a share as a percentage.
pub fn format_percent(share: f32) -> String {
    format!("{:.3} %", 100.0 * share)
}

/// Formats a ratio.
pub fn format_ratio(ratio: f64) -> String {
    format!("{ratio:.1} x")
}

/// Returns the text of a cell without a value.
pub fn no_value() -> String {
    "-".into()
}
