//! The stages of a tick, as profile slots, demo rows and benchmark columns.
//!
//! This list is the only one: profile, statistics, bindings and benchmarks follow it. `pipeline`
//! runs the stages and adds the time of each to its variant.
//! Invariant: variants, order and names are public; `ALL[stage as usize] == stage`.

/// A stage of a tick. The variants follow the order in which most ticks run them; some stages run
/// several times per tick, and their times add up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Stage {
    /// Broad phase of the colliders for the motion of the tick, and the end of their motion.
    Colliders,
    /// Gravity and aerodynamics: the acceleration of each particle.
    Forces,
    /// Prediction: each particle moves by its history and its acceleration.
    Predict,
    /// Kinematic constraints: pins, grabs, attachments, and anchors with max distance and backstop.
    Hold,
    /// Long-range attachments to the pins.
    Tethers,
    /// Stretch constraints: line solver, distance links and their damping.
    Stretch,
    /// Shear constraints.
    Shear,
    /// Bending elements, and the plastic change of folds.
    Bend,
    /// Broad phase and mid phase of all collisions: candidate pairs.
    Pairs,
    /// Narrow phase and contact solver of self-collision.
    SelfContacts,
    /// Narrow phase and response of contacts with colliders.
    Contacts,
    /// Velocities from positions (BDF), damping and friction.
    Velocities,
    /// Tears: vertices of overstretched links split.
    Tear,
    /// Strain limiting by `max_stretch`.
    Limit,
    /// Recovery: particles with invalid numbers return to their last valid position.
    Guard,
    /// Normals, tangents and vertex streams for the renderer.
    Outputs,
}

impl Stage {
    /// Number of stages.
    pub const COUNT: usize = 16;

    /// All stages, in order.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Colliders,
        Self::Forces,
        Self::Predict,
        Self::Hold,
        Self::Tethers,
        Self::Stretch,
        Self::Shear,
        Self::Bend,
        Self::Pairs,
        Self::SelfContacts,
        Self::Contacts,
        Self::Velocities,
        Self::Tear,
        Self::Limit,
        Self::Guard,
        Self::Outputs,
    ];

    /// Name of the stage in tables and statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Colliders => "colliders",
            Self::Forces => "forces",
            Self::Predict => "predict",
            Self::Hold => "hold",
            Self::Tethers => "tethers",
            Self::Stretch => "stretch",
            Self::Shear => "shear",
            Self::Bend => "bend",
            Self::Pairs => "pairs",
            Self::SelfContacts => "self-contacts",
            Self::Contacts => "contacts",
            Self::Velocities => "velocities",
            Self::Tear => "tear",
            Self::Limit => "limit",
            Self::Guard => "guard",
            Self::Outputs => "outputs",
        }
    }
}
