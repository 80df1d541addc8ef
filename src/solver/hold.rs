//! Stage `Hold`: pins and grabs put their particles where they are to be.

use super::World;

/// Pins move evenly over the tick; a grabbed particle follows its pointer as fast as it may.
pub(crate) fn hold(world: &mut World, share: f32) {
    let p = &mut world.particles;
    for pin in world.pins.iter() {
        p.x.set(pin.particle as usize, pin.from + (pin.target - pin.from) * share);
    }
    let reach = world.settings.max_displacement * world.spacing;
    for held in world.grabs.iter() {
        let at = held.particle as usize;
        let from = world.scratch.start.at(at);
        let way = held.target - from;
        let length = way.length();
        p.x.set(at, if length <= reach { held.target } else { from + way * (reach / length) });
    }
}
