//! The recipe of a cloth: its material, its links, and how far each particle is from the pins.

pub(crate) mod abreast;
pub(crate) mod cells;
pub(crate) mod color;
pub(crate) mod divide;
pub(crate) mod elbows;
pub(crate) mod ends;
pub(crate) mod extra;
pub(crate) mod facets;
pub(crate) mod folds;
pub(crate) mod hinges;
pub(crate) mod lines;
pub(crate) mod links;
pub(crate) mod loose;
pub(crate) mod material;
pub(crate) mod outward;
pub(crate) mod palette;
pub(crate) mod plates;
pub(crate) mod rows;
pub(crate) mod strays;
pub(crate) mod tethers;
pub(crate) mod tips;
pub(crate) mod wear;
pub(crate) mod weave;
