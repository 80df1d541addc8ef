//! The cases of the benchmarks, from `benches/cases.json`, which the Node benchmarks read too.

use muslin::Settings;
use serde::Deserialize;

/// All cases, by table.
#[derive(Deserialize)]
pub struct Cases {
    pub kernels: Vec<KernelCase>,
    pub ticks: Vec<TickCase>,
    /// Cases for whole ticks on one and on two threads.
    #[cfg_attr(not(feature = "parallel"), allow(dead_code))]
    pub threads: Vec<TickCase>,
}

/// A square sheet for the kernel table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelCase {
    /// Particles per side.
    pub side: u32,
    /// Ticks per round.
    pub ticks: u32,
    pub rounds: u32,
}

/// A sheet and its settings for the tick table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TickCase {
    pub columns: u32,
    pub rows: u32,
    /// Distance between neighbours [m]; by default that of the hanging sheet.
    #[serde(default)]
    pub spacing: Option<f32>,
    /// The fields that differ from the defaults.
    pub settings: Settings,
    /// Whether there is a floor a little below the sheet, as in the receipt scene.
    #[serde(default)]
    pub floor: bool,
    /// Simulated time before measuring [s].
    pub seconds: f32,
    /// Ticks per round.
    pub ticks: u32,
    pub rounds: u32,
}

impl Cases {
    pub fn read() -> Self {
        serde_json::from_str(include_str!("../cases.json")).expect("benches/cases.json is valid")
    }
}

/// Describes the smallest and largest number of rounds.
pub fn describe_rounds(rounds: impl Iterator<Item = u32> + Clone) -> String {
    let (min, max) = (rounds.clone().min().unwrap_or(0), rounds.max().unwrap_or(0));
    format!("{min} to {max} interleaved rounds")
}
