//! Time integration: substeps, forces, prediction, velocities, momentum of free pieces, recovery,
//! sleep.
//!
//! `time_step` sets the number of substeps and `forces` runs once per tick; `predict` starts and
//! `velocities` ends each substep. `pressure` inflates closed pieces, `momentum` removes spurious spin, `recover` replaces invalid
//! numbers, `elastic_corrections` counts bending after the settings changed the substep length, and
//! `sleep` skips the ticks of a cloth at rest.

pub(crate) mod elastic_corrections;
pub(crate) mod expected_momentum;
pub(crate) mod forces;
pub(crate) mod impact_momentum;
pub(crate) mod momentum;
pub(crate) mod momentum_sums;
pub(crate) mod piece_momentum;
pub(crate) mod predict;
pub(crate) mod pressure;
pub(crate) mod recover;
pub(crate) mod rigid_motion;
pub(crate) mod sleep;
pub(crate) mod sleep_timer;
pub(crate) mod time_step;
pub(crate) mod velocities;
