//! Stage `Stretch` and its bounds: distance constraints, line solver, tethers, strain limit,
//! damping.

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
pub(crate) mod sparse;
pub(crate) mod strain_limit;
pub(crate) mod sweep_order;
pub(crate) mod tethers;
#[cfg(feature = "parallel")]
pub(crate) mod tiling;
pub(crate) mod tridiagonal;
