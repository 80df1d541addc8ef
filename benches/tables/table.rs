//! A table that reads well as it is and as Markdown.

use std::fmt;

/// Words in the first columns, numbers in the others.
pub struct Table {
    /// How many columns hold words.
    words: usize,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(words: &[&str], numbers: &[&str]) -> Self {
        let head = words.iter().chain(numbers).map(ToString::to_string).collect();
        Self { words: words.len(), rows: vec![head] }
    }

    /// Adds a row and says to the terminal that it is there, as the table itself comes late.
    pub fn push(&mut self, row: Vec<String>) {
        eprintln!("  {}", row.join("  "));
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
        for (at, row) in self.rows.iter().enumerate() {
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                if column < self.words {
                    write!(f, "| {cell:width$} ")?;
                } else {
                    write!(f, "| {cell:>width$} ")?;
                }
            }
            writeln!(f, "|")?;
            if at == 0 {
                for (column, width) in widths.iter().enumerate() {
                    let (dashes, end) = ("-".repeat(width - 1), column >= self.words);
                    write!(f, "| {dashes}{} ", if end { ":" } else { "-" })?;
                }
                writeln!(f, "|")?;
            }
        }
        Ok(())
    }
}

/// A number with so many digits after the point.
pub fn number(value: f64, digits: usize) -> String {
    format!("{value:.digits$}")
}

/// A share as a percentage.
pub fn percent(share: f32) -> String {
    format!("{:.3} %", 100.0 * share)
}

/// A ratio.
pub fn times(ratio: f64) -> String {
    format!("{ratio:.1} x")
}

/// What there is no figure for.
pub fn none() -> String {
    "-".into()
}
