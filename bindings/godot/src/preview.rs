//! What the picture of a cloth in the editor follows from.

use crate::choices::PinMode;
use crate::parameters::Parameters;
use crate::source::GridSize;
use godot::builtin::PackedInt32Array;
use godot::obj::InstanceId;

/// What the picture in the editor follows from.
#[derive(PartialEq)]
pub struct Preview {
    pub grid: GridSize,
    pub weld_distance: f32,
    pub simplify_below: f32,
    pub extra_particles: i64,
    pub pins: (PinMode, PackedInt32Array),
    pub mesh: [Option<InstanceId>; 2],
    pub parameters: Parameters,
}
