//! The solver: one tick of the simulation, its data and its stages.
//!
//! ```text
//! pipeline        order of the stages           world      data that all stages share
//! integrate       forces, prediction, velocities, recovery, sleep
//! kinematic       pins, grabs, attachments, anchors
//! stretch, bend   constraints of the cloth      vertex_sums, particle_stage   shared kernels
//! collide         collision with colliders      self_collide                 with itself
//! rebase          moves the origin along with the cloth
//! topology        tears and cuts                output     normals, tangents, vertices, stats
//! ```
//! Start reading at `pipeline`.

pub(crate) mod bend;
pub(crate) mod collide;
pub(crate) mod integrate;
pub(crate) mod kinematic;
pub(crate) mod output;
pub(crate) mod particle_stage;
pub(crate) mod pipeline;
pub(crate) mod profile;
pub(crate) mod rebase;
pub(crate) mod scratch_pool;
pub(crate) mod self_collide;
pub(crate) mod stage;
pub(crate) mod stretch;
pub(crate) mod tick_scratch;
pub(crate) mod topology;
pub(crate) mod vertex_sums;
pub(crate) mod world;
