//! The stage that the scenes share.

/// Height of the floor [m]; in a scene that is drawn enlarged, in enlarged metres.
pub const FLOOR: f32 = -1.4;
