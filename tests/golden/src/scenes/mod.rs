//! The scenes. Together they use everything that a cloth has.
//!
//! Every number that a scene gives to a cloth is written down, or is a whole number times a power of
//! two: exact, so that a host that rounds another way still asks for the same. None comes from
//! `sin`, and from what a cloth answered only what was made such a number.

mod air;
mod crowd;
mod floor;
mod folds;
mod garment;
mod hands;
mod layers;
mod mesh;
mod tears;
mod time;
mod touch;
mod worn;

use crate::Scene;
use muslin::glam::Vec3;

/// All of them, in the order of the table.
pub const SCENES: &[Scene] = &[
    Scene { name: "hanging-in-gusts", play: air::hanging_in_gusts },
    Scene { name: "two-corners-in-waves", play: air::two_corners_in_waves },
    Scene { name: "cotton-in-a-storm", play: air::cotton_in_a_storm },
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
    Scene { name: "draped-over-solids", play: touch::draped_over_solids },
    Scene { name: "thrown-on-hills", play: touch::thrown_on_hills },
    Scene { name: "crumpled-by-particles", play: crowd::crumpled_by_particles },
    Scene { name: "crumpled-in-layers", play: layers::crumpled_in_layers },
    Scene { name: "drawn-out-of-itself", play: layers::drawn_out_of_itself },
    Scene { name: "procession-of-pins", play: hands::procession_of_pins },
    Scene { name: "rays-and-grabs", play: hands::rays_and_grabs },
    Scene { name: "garment-on-a-moving-body", play: worn::garment_on_a_moving_body },
    Scene { name: "cape-in-a-running-frame", play: worn::cape_in_a_running_frame },
    Scene { name: "skirt-on-leashes", play: worn::skirt_on_leashes },
    Scene { name: "first-order", play: time::first_order },
    Scene { name: "receipt", play: time::receipt },
    Scene { name: "saved-and-reset", play: time::saved_and_reset },
    Scene { name: "changed-in-flight", play: time::changed_in_flight },
    Scene { name: "fading-to-nothing", play: time::fading_to_nothing },
];

/// Where something is after `i` steps from `start`.
fn along(start: Vec3, step: Vec3, i: u32) -> Vec3 {
    start + step * i as f32
}
