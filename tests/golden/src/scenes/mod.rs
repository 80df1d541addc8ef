//! The golden scenes. Together they use every feature of a cloth.
//!
//! Invariant: every number that a scene passes to a cloth is a literal or an integer times a power
//! of two. Such numbers are exact in every rounding mode. No input comes from `sin`, and outputs of
//! a cloth are rounded to such numbers before they become inputs.

mod animated_bodies;
mod colliders;
mod floor;
mod folds;
mod garment;
mod mesh;
mod painted_maps;
mod particle_collision;
mod pins_and_grabs;
mod sewing_and_pressure;
mod surface_collision;
mod tears;
mod time_and_saves;
mod wind;

use crate::Scene;
use muslin::glam::Vec3;

/// All scenes, in the order of `golden.txt`.
pub const SCENES: &[Scene] = &[
    Scene { name: "hanging-in-gusts", play: wind::hanging_in_gusts },
    Scene { name: "two-corners-in-waves", play: wind::two_corners_in_waves },
    Scene { name: "cotton-in-a-storm", play: wind::cotton_in_a_storm },
    Scene { name: "tube-of-leather", play: mesh::tube_of_leather },
    Scene { name: "patch-torn-by-a-grab", play: mesh::patch_torn_by_a_grab },
    Scene { name: "paper-folded-and-creased", play: folds::paper_folded_and_creased },
    Scene { name: "patch-creased", play: folds::patch_creased },
    Scene { name: "folds-worn", play: folds::folds_worn },
    Scene { name: "vest-ripped-at-a-seam", play: garment::vest_ripped_at_a_seam },
    Scene { name: "sheet-torn-to-pieces", play: tears::sheet_torn_to_pieces },
    Scene { name: "tears-use-up-their-room", play: tears::tears_use_up_their_room },
    Scene { name: "cut-by-blades", play: tears::cut_by_blades },
    Scene { name: "tears-and-cuts-at-random", play: tears::tears_and_cuts_at_random },
    Scene { name: "dropped-on-a-tilting-floor", play: floor::dropped_on_a_tilting_floor },
    Scene { name: "draped-over-solids", play: colliders::draped_over_solids },
    Scene { name: "thrown-on-hills", play: colliders::thrown_on_hills },
    Scene { name: "crumpled-by-particles", play: particle_collision::crumpled_by_particles },
    Scene { name: "crumpled-in-layers", play: surface_collision::crumpled_in_layers },
    Scene { name: "drawn-out-of-itself", play: surface_collision::drawn_out_of_itself },
    Scene { name: "procession-of-pins", play: pins_and_grabs::procession_of_pins },
    Scene { name: "rays-and-grabs", play: pins_and_grabs::rays_and_grabs },
    Scene { name: "garment-on-a-moving-body", play: animated_bodies::garment_on_a_moving_body },
    Scene { name: "cape-in-a-running-frame", play: animated_bodies::cape_in_a_running_frame },
    Scene { name: "cape-at-low-frame-rates", play: animated_bodies::cape_at_low_frame_rates },
    Scene { name: "skirt-on-leashes", play: animated_bodies::skirt_on_leashes },
    Scene { name: "first-order", play: time_and_saves::first_order },
    Scene { name: "receipt", play: time_and_saves::receipt },
    Scene { name: "saved-and-reset", play: time_and_saves::saved_and_reset },
    Scene { name: "changed-in-flight", play: time_and_saves::changed_in_flight },
    Scene { name: "fading-to-nothing", play: time_and_saves::fading_to_nothing },
    Scene { name: "panels-sewn-on-a-body", play: sewing_and_pressure::panels_sewn_on_a_body },
    Scene { name: "balloon", play: sewing_and_pressure::balloon },
    Scene { name: "cushion", play: sewing_and_pressure::cushion },
    Scene { name: "coat-with-painted-maps", play: painted_maps::coat_with_painted_maps },
];

/// The position after `i` steps from `start`.
fn along(start: Vec3, step: Vec3, i: u32) -> Vec3 {
    start + step * i as f32
}
