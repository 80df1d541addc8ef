//! Stage `Stretch` and its bounds: everything that acts along the links.
//!
//! ```text
//! substep   damping::apply            rest lengths and compliances of damped links
//!           line_solver               first sweep: chains as tridiagonal systems
//!           distance                  other sweeps ─┬─ grid_links ─ grid_kernel, tiling
//!                                                   ├─ mesh_kernel
//!                                                   └─ sparse
//!           tethers                   after each sweep
//!           sewn_pairs                at the end of each sweep, and after every later stage
//!           damping::remove
//!           strain_limit              one sweep
//! tick      tether_slack, at its start
//!           strain_limit              sweeps, then rollback
//! ```
//! `link_projection` has the arithmetic of one link. The files `*_scratch`, `rollback_state`,
//! `end_weights` and `line_step` hold data only: `solver::world` imports them, so they do not
//! import it.

pub(crate) mod damping;
pub(crate) mod damping_scratch;
pub(crate) mod distance;
pub(crate) mod end_weights;
pub(crate) mod grid_kernel;
pub(crate) mod grid_links;
pub(crate) mod inverse_masses;
pub(crate) mod line_gather;
pub(crate) mod line_scratch;
pub(crate) mod line_solver;
pub(crate) mod line_step;
pub(crate) mod line_strided;
pub(crate) mod link_projection;
pub(crate) mod mesh_kernel;
pub(crate) mod rollback;
pub(crate) mod rollback_state;
pub(crate) mod sewn_pairs;
pub(crate) mod sparse;
pub(crate) mod strain_limit;
pub(crate) mod sweep_order;
pub(crate) mod tether_slack;
pub(crate) mod tethers;
#[cfg(feature = "parallel")]
pub(crate) mod tiling;
pub(crate) mod tridiagonal;
