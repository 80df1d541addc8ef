//! Triangle meshes: topology, repair of given meshes, and the surgery of tears and cuts.
//!
//! | file | content |
//! | --- | --- |
//! | `topology` | corner table: adjacency and vertex fans |
//! | `intake` | repair of a given mesh: weld, drop degenerate, split non-manifold, orient |
//! | `validate` | check of a mesh that must already be sound (saved cloths) |
//! | `grid`, `grid_detection` | the regular grid, and detection of one in a given mesh |
//! | `split_vertex`, `split_edge` | surgery for tears and cuts |
//! | `seams` | render vertices that share a particle |
//! | `report` | what the repair did |

pub(crate) mod grid;
pub(crate) mod grid_detection;
pub(crate) mod intake;
pub(crate) mod quality;
pub(crate) mod report;
pub(crate) mod seams;
pub(crate) mod split_edge;
pub(crate) mod split_vertex;
pub(crate) mod topology;
pub(crate) mod validate;

pub(crate) use topology::{Corner, Fan, Mesh, NONE, next_corner, prev_corner, triangle_of};
