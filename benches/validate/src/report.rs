//! The tables: by quantity the worst error of each quality, all values, and the cost of ticks.
//!
//! A value with a star is of a run that did not settle.

use crate::results::{Played, TrialResult, format_error, format_tolerances, format_value};
use crate::run::{QUALITIES, Quality, RATES};
use crate::table::{Table, format_number};
use crate::trial::{Case, Grade};

/// Returns the tables of a case.
pub fn tables(case: &Case, results: &[TrialResult<'_>]) -> String {
    let blocks = [
        format!("### {}\n\n{}.\n\nReference: {}.\n", case.name, sentence(case.about), case.source),
        verdicts(results).to_string(),
        values(results),
    ];
    blocks.join("\n")
}

/// A text with a capital letter first.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Head of a column with the words of each quality.
fn head_by_quality() -> [&'static str; 3] {
    QUALITIES.map(Quality::name)
}

/// One row for each quantity: the worst run of each quality.
fn verdicts(results: &[TrialResult<'_>]) -> Table {
    let [fast, default, accurate] = head_by_quality();
    let numbers = ["reference", "E / OK", fast, default, accurate];
    let mut table = Table::new(&["quantity"], &numbers);
    for result in results {
        for (index, quantity) in result.trial.quantities.iter().enumerate() {
            let reference = format_value(quantity, quantity.reference);
            let mut row = vec![quantity.name.clone(), reference, format_tolerances(quantity)];
            for quality in QUALITIES {
                let worst = result.worst(index, quality);
                let error = format_error(quantity, worst.error);
                row.push(match worst.unsettled {
                    [0, _] => format!("{error} {}", worst.grade.name()),
                    [count, all] => format!(
                        "{error} {count} of {all} did not settle ({:.1} mm/s)",
                        1.0e3 * worst.speed
                    ),
                });
            }
            table.add(row);
        }
    }
    table
}

/// One row for each quantity and tick: the value of each quality at each number of nodes. One table
/// for each set of numbers of nodes.
fn values(results: &[TrialResult<'_>]) -> String {
    let mut tables: Vec<(&[u32], Table)> = Vec::new();
    for result in results {
        let nodes = result.trial.nodes;
        if tables.last().is_none_or(|(last, _)| *last != nodes) {
            let head = |quality: Quality| {
                nodes.iter().map(move |nodes| format!("{} {nodes}", quality.name()))
            };
            let heads: Vec<String> = QUALITIES.into_iter().flat_map(head).collect();
            let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
            tables.push((nodes, Table::new(&["quantity", "tick"], &heads)));
        }
        let Some((_, table)) = tables.last_mut() else { continue };
        for (index, quantity) in result.trial.quantities.iter().enumerate() {
            for rate in RATES {
                let runs = QUALITIES.into_iter().flat_map(|quality| result.of(quality));
                let runs = runs.filter(|played| played.run.rate == rate);
                let mut row = vec![quantity.name.clone(), format!("1/{rate} s")];
                row.extend(runs.map(|Played { outcome, .. }| {
                    let star = if outcome.settled { "" } else { "*" };
                    format_value(quantity, outcome.values[index]) + star
                }));
                table.add(row);
            }
        }
    }
    let tables: Vec<String> = tables.iter().map(|(_, table)| table.to_string()).collect();
    tables.join("\n")
}

/// The cost of ticks of all cases: mean time of a tick, as a ratio to that at the default quality
/// and the middle number of nodes.
pub struct Costs {
    rows: Vec<Vec<String>>,
    /// Whether it shows the time too, which differs between machines.
    with_times: bool,
}

impl Costs {
    pub fn new(with_times: bool) -> Self {
        Self { rows: Vec::new(), with_times }
    }

    pub fn add(&mut self, case: &Case, results: &[TrialResult<'_>]) {
        let nodes = case.trials[0].nodes;
        let mean = |quality: Quality, nodes: u32| {
            results.iter().map(|result| result.ms(quality, nodes)).sum::<f64>()
                / results.len() as f64
        };
        let one = mean(Quality::Default, nodes[nodes.len() / 2]);
        let mut row = vec![case.name.to_owned()];
        if self.with_times {
            row.push(format_number(one, 4));
        }
        for quality in QUALITIES {
            let ratio = |nodes: &u32| format_number(mean(quality, *nodes) / one, 1);
            row.push(nodes.iter().map(ratio).collect::<Vec<_>>().join(" / "));
        }
        self.rows.push(row);
    }

    /// The table.
    pub fn text(&self) -> String {
        let mut heads = vec!["ms at default"];
        heads.truncate(usize::from(self.with_times));
        heads.extend(QUALITIES.map(Quality::name));
        let mut table = Table::new(&["case"], &heads);
        self.rows.iter().for_each(|row| table.add(row.clone()));
        format!(
            "### Cost of a tick\n\nAt each number of nodes, as a ratio to `default` at the middle \
             one.\n\n{table}"
        )
    }
}

/// Counts of grades of all quantities, and what misses, for each quality.
pub struct Summary {
    counts: [[usize; 3]; 3],
    missed: [Vec<String>; 3],
}

impl Summary {
    pub fn new() -> Self {
        Self { counts: [[0; 3]; 3], missed: [Vec::new(), Vec::new(), Vec::new()] }
    }

    pub fn add(&mut self, case: &Case, results: &[TrialResult<'_>]) {
        for result in results {
            for (index, quantity) in result.trial.quantities.iter().enumerate() {
                for (row, quality) in QUALITIES.into_iter().enumerate() {
                    let worst = result.worst(index, quality);
                    self.counts[row][worst.grade as usize] += 1;
                    if worst.grade == Grade::Missed {
                        let error = format_error(quantity, worst.error);
                        let note = if worst.unsettled[0] > 0 { ", did not settle" } else { "" };
                        let line = format!("- {}: {}: {error}{note}", case.name, quantity.name);
                        self.missed[row].push(line);
                    }
                }
            }
        }
    }

    /// The table of counts, and the lists of what misses.
    pub fn text(&self) -> String {
        let mut table = Table::new(&["quality"], &["quantities", "E", "OK", "neither"]);
        let mut lists = String::new();
        for ((quality, counts), missed) in QUALITIES.into_iter().zip(self.counts).zip(&self.missed)
        {
            let mut row = vec![quality.name().to_owned(), counts.iter().sum::<usize>().to_string()];
            row.extend(counts.iter().map(ToString::to_string));
            table.add(row);
            if !missed.is_empty() {
                let name = quality.name();
                lists += &format!(
                    "\nMeets neither at `{name}`, worst errors:\n\n{}\n",
                    missed.join("\n")
                );
            }
        }
        format!("{table}{lists}")
    }
}
