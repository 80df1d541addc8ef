//! Stage `Tethers`: no particle gets farther from a pin than its way along the cloth.

use super::World;
use crate::mesh::NONE;

/// Pulls every particle within reach of the pins it is tethered to.
pub(crate) fn solve(world: &mut World) {
    let material = &world.material;
    let rigid = material.stretch_stiffness_warp == 0.0 && material.stretch_stiffness_weft == 0.0;
    let slack = if rigid {
        1.0
    } else if world.settings.max_stretch > 0.0 {
        1.0 + world.settings.max_stretch
    } else {
        return;
    };
    let p = &mut world.particles;
    for set in world.tethers.sets() {
        for (i, (anchor, length)) in set.anchor.iter().zip(&set.length).enumerate() {
            if *anchor == NONE || p.w[i] <= 0.0 {
                continue;
            }
            let pin = p.x.at(*anchor as usize);
            let span = p.x.at(i) - pin;
            let (reach, length2) = (length * slack, span.length_squared());
            if length2 > reach * reach {
                p.x.set(i, pin + span * (reach / length2.sqrt()));
            }
        }
    }
}
