//! Stage `Hold`: pins and grabs put their particles where they are to be.

use super::World;

/// Pins and grabs move evenly over the tick, of which substep `number` is run; a grabbed particle
/// follows its pointer as fast as it may.
pub(crate) fn hold(world: &mut World, number: u32) {
    let count = world.settings.substeps;
    let share = (number + 1) as f32 / count as f32;
    let rest_of_way = 1.0 / (count - number) as f32;
    let p = &mut world.particles;
    for pin in world.pins.iter() {
        p.x.set(pin.particle as usize, pin.from + (pin.target - pin.from) * share);
    }
    let reach = world.settings.max_displacement * world.spacing;
    for held in world.grabs.iter() {
        let at = held.particle as usize;
        let from = world.scratch.predicted.at(at);
        let way = (held.target - from) * rest_of_way;
        let length = way.length();
        let to = if number + 1 == count { held.target } else { from + way };
        p.x.set(at, if length <= reach { to } else { from + way * (reach / length) });
    }
}
