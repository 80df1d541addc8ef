//! Model of a cloth: all that follows from its descriptor and its topology.
//!
//! | file | content |
//! | --- | --- |
//! | `material` | material parameters and presets |
//! | `folds`, `hardening`, `creases` | plastic bending |
//! | `links`, `link_ends`, `constraints` | distance constraints |
//! | `coloring`, `link_set` | graph colouring, sets of links |
//! | `dynamic_links`, `cut_links`, `crack_tips` | changes of the links by tears and cuts |
//! | `grid_rows`, `grid_cells`, `sparse_links` | layouts for the kernels |
//! | `chains`, `chain_blocks` | straight runs of links for the line solver |
//! | `tethers`, `pin_order` | distances to the pins |
//! | `plate_elements`, `irregular_bend` | bending of grids |
//! | `hinge`, `hinges`, `bend_elements` | bending of other meshes |

pub(crate) mod bend_elements;
pub(crate) mod bend_scale;
pub(crate) mod chain_blocks;
pub(crate) mod chains;
pub(crate) mod coloring;
pub(crate) mod constraints;
pub(crate) mod crack_tips;
pub(crate) mod creases;
#[cfg(feature = "cut")]
pub(crate) mod cut_links;
pub(crate) mod dynamic_links;
pub(crate) mod folds;
pub(crate) mod grid_cells;
pub(crate) mod grid_rows;
pub(crate) mod hardening;
pub(crate) mod hinge;
pub(crate) mod hinges;
pub(crate) mod irregular_bend;
pub(crate) mod link_ends;
pub(crate) mod link_set;
pub(crate) mod links;
pub(crate) mod maps;
pub(crate) mod material;
pub(crate) mod pin_order;
pub(crate) mod plate_elements;
pub(crate) mod sparse_links;
pub(crate) mod tethers;
