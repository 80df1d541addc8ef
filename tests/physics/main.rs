//! Motion, bending, drape and strain limits, compared with closed forms and measured references.

#[path = "../common/mod.rs"]
mod common;

mod bending;
mod closed_forms;
mod conservation;
mod crumpling;
mod drape;
mod energy_gains;
mod far_from_zero;
mod fold_hardening;
mod frame_poses;
mod frame_poses_far_away;
mod maps;
mod masses;
mod material_laws;
mod momentum;
mod moving_frame;
mod plastic_bending;
mod pressure;
mod random_scenes;
mod resolution_independence;
mod sewing;
mod sleep;
mod strain_limit;
