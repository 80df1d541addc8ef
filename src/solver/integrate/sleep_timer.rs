//! Sleep timer: counts the ticks for which the cloth has been at rest.
//!
//! Data only; `sleep` decides when the count grows and when the cloth sleeps. Save and restore keep
//! it, so a sleeping cloth still sleeps after a restore.

use serde::{Deserialize, Serialize};

/// Number of ticks for which the cloth has been at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SleepTimer {
    /// Consecutive ticks in which no particle was faster than `sleep_speed`.
    pub still_ticks: u32,
}
