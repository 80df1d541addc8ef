//! The cases, one file for each group.

mod bending;
mod contact;
mod drape;
mod motion;
mod shear;
mod stretch;
mod wind;

use crate::trial::Case;

/// Gravity of most trials [m/s²].
const G: f64 = 9.81;

/// All cases, in the order in which they are printed.
pub fn all() -> Vec<Case> {
    vec![
        shear::sag(),
        bending::slack(),
        bending::cantilever(),
        bending::cantilever_mesh(),
        stretch::catenary(),
        stretch::taut(),
        stretch::hanging(),
        motion::flight(),
        motion::pendulum(),
        motion::swing(),
        motion::hanging_period(),
        motion::spin(),
        wind::bulge(),
        wind::terminal_speed(),
        wind::tilt(),
        contact::friction(),
        contact::restitution(),
        contact::rest_noise(),
        drape::drape(),
    ]
}
