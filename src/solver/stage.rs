//! The stages of a tick: the only list of them.

/// A stage of a tick, in the order they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
#[allow(missing_docs)]
pub enum Stage {
    Colliders,
    Forces,
    Predict,
    Hold,
    Tethers,
    Stretch,
    Shear,
    Bend,
    Pairs,
    SelfContacts,
    Contacts,
    Velocities,
    Tear,
    Limit,
    Guard,
    Outputs,
}

impl Stage {
    /// How many there are.
    pub const COUNT: usize = 16;

    /// All of them, in order.
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

    /// What to call it in a table.
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
