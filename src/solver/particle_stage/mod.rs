//! Particle layouts for kernels that gather particles by index, and how they are filled and written
//! back.
//!
//! | layout | file | used by |
//! | --- | --- | --- |
//! | columns (SoA), one array per coordinate | `access` | links and bends of grids |
//! | one list of `[x, y, z, 0]`, inverse masses beside it | `interleaved_particles` | links of meshes |
//! | one list of `[x, y, z, w]` | `interleaved` | self-collision |

pub(crate) mod access;
pub(crate) mod interleaved;
pub(crate) mod interleaved_particles;
