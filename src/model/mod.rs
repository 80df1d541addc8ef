//! The recipe of a cloth: its material, its links, and how far each particle is from the pins.

pub(crate) mod bend_elements;
pub(crate) mod chain_blocks;
pub(crate) mod chains;
pub(crate) mod coloring;
pub(crate) mod constraints;
pub(crate) mod crack_tips;
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
pub(crate) mod material;
pub(crate) mod pin_order;
pub(crate) mod plate_elements;
pub(crate) mod sparse_links;
pub(crate) mod tethers;
