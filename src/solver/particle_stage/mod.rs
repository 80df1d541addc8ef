//! Particle layouts for kernels that gather particles by index, and how they are filled and written
//! back.
//!
//! | layout | file | used by |
//! | --- | --- | --- |
//! | columns (SoA), one array per coordinate | `access` | links and bends of grids |
//! | `[x, y, z, 0]`, and a list of w | `interleaved_particles` | links of meshes |
//! | `[x, y, z, w]` | `interleaved` | self-collision |

pub(crate) mod access;
pub(crate) mod interleaved;
pub(crate) mod interleaved_particles;
