//! What is measured, as `benches/cases.json` lists it for Rust and for node.

use muslin::Settings;
use serde::Deserialize;

#[derive(Deserialize)]
pub struct Cases {
    pub kernels: Vec<KernelCase>,
    pub ticks: Vec<TickCase>,
    /// Whole ticks on one thread and on several.
    #[cfg_attr(not(feature = "parallel"), allow(dead_code))]
    pub threads: Vec<TickCase>,
}

/// A square sheet, and how much of it makes a figure.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelCase {
    pub side: u32,
    pub ticks: u32,
    pub rounds: u32,
}

/// A sheet, and how its time runs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TickCase {
    pub columns: u32,
    pub rows: u32,
    /// Distance between neighbours [m], if not that of the scene's sheet.
    #[serde(default)]
    pub spacing: Option<f32>,
    /// What differs from the defaults.
    pub settings: Settings,
    /// Whether there is a floor a little below, as in the brief of the receipt.
    #[serde(default)]
    pub floor: bool,
    /// For how long it hangs before it is looked at [s].
    pub seconds: f32,
    /// Ticks of a round.
    pub ticks: u32,
    pub rounds: u32,
}

impl Cases {
    pub fn read() -> Self {
        serde_json::from_str(include_str!("../cases.json")).expect("the benchmarks' own cases")
    }
}

/// The least and the greatest number of rounds, in words.
pub fn rounds(rounds: impl Iterator<Item = u32> + Clone) -> String {
    let (least, most) = (rounds.clone().min().unwrap_or(0), rounds.max().unwrap_or(0));
    format!("{least} to {most} rounds in turn")
}
