//! Stage `Hold`: pins and grabs put their particles where they are to be.
//!
//! A soft pin is a spring of stiffness k to its target, solved as if it ended the substep there: of inertia
//! m / step² and stiffness k it makes one, (m + k step²) / step², about where both together would have
//! their particle. So the stages after it see the spring as a greater mass, and what they do leaves it
//! in balance: no sweep has to come back to it, however stiff it is.

use crate::geometry::transform::Transform;
use crate::solver::world::World;
use crate::state::attachments::Attachments;
use crate::state::pins::Pin;
use glam::Vec3;

/// Pins and grabs move evenly over the tick, of which substep `number` is run; a grabbed particle
/// follows its pointer as fast as it may.
pub(crate) fn hold(world: &mut World, number: u32) {
    let count = world.settings.substeps;
    let share = (number + 1) as f32 / count as f32;
    let rest_of_way = 1.0 / (count - number) as f32;
    let step = world.settings.scheme().step;
    let mut carriage = Carriage::default();
    let p = &mut world.particles;
    for pin in world.pins.iter() {
        let at = pin.particle as usize;
        let to = if pin.carrier == 0 {
            pin.from + (pin.target - pin.from) * share
        } else {
            carriage.see_to(&world.attachments, pin.carrier, number + 1, count);
            carriage.carry(pin, share)
        };
        if pin.is_soft() {
            let from = p.x.at(at);
            p.x.set(at, from + (to - from) * (pin.stiffness * step * step * p.w[at]));
        } else {
            p.x.set(at, to);
        }
    }
    let reach = world.settings.max_displacement * world.mean_edge;
    for held in world.grabs.iter() {
        let at = held.particle as usize;
        let from = world.scratch.predicted.at(at);
        let way = (held.target - from) * rest_of_way;
        let length = way.length();
        let to = if number + 1 == count { held.target } else { from + way };
        p.x.set(at, if length <= reach { to } else { from + way * (reach / length) });
    }
}

/// The tick is over: what carries pins is where it was to be, and so are anchors.
pub(crate) fn arrive(world: &mut World) {
    world.attachments.iter_mut().for_each(|carrier| carrier.last = carrier.next);
    world.anchors.arrive();
}

/// How one attachment stands: as the tick begins, and now. Pins of one mostly follow each other.
#[derive(Default)]
struct Carriage {
    carrier: u32,
    frames: Option<[Transform; 2]>,
}

impl Carriage {
    fn see_to(&mut self, attachments: &Attachments, carrier: u32, moment: u32, count: u32) {
        if self.carrier == carrier {
            return;
        }
        let pose = attachments.get(carrier, "attachment").ok();
        self.carrier = carrier;
        self.frames = pose
            .map(|pose| [pose.last.frame(), pose.last.after(&pose.next, moment, count).frame()]);
    }

    /// Where a pin is, a `share` of the tick on. One that was not yet where the attachment has it gets there
    /// as the tick ends.
    fn carry(&self, pin: &Pin, share: f32) -> Vec3 {
        let Some([last, now]) = &self.frames else { return pin.target };
        let late = pin.from - last.point_to_world(pin.local);
        now.point_to_world(pin.local) + late * (1.0 - share)
    }
}

impl World {
    /// What resists a push at each particle: its mass, and what a soft pin adds to it [kg]. `None` where that
    /// is its mass everywhere.
    pub fn compute_effective_mass(&mut self) -> Option<Vec<f32>> {
        if !self.pins.are_any_soft() {
            return None;
        }
        let mut inertia = core::mem::take(&mut self.scratch.effective_mass);
        let step = self.settings.scheme().step;
        inertia.clone_from(&self.particles.mass);
        for pin in self.pins.iter().filter(|pin| pin.is_soft()) {
            inertia[pin.particle as usize] += pin.stiffness * step * step;
        }
        Some(inertia)
    }

    /// Sees to room for what soft pins add, if there are any.
    pub fn reserve_effective_mass(&mut self) {
        let (capacity, inertia) = (self.capacity(), &mut self.scratch.effective_mass);
        if self.pins.are_any_soft() {
            inertia.clear();
            inertia.reserve_exact(capacity);
        }
    }

    /// The inverse masses of what soft pins hold, after the length of a substep changed.
    pub fn refresh_soft_pin_masses(&mut self) {
        let step = self.settings.scheme().step;
        let (pins, grabs, p) = (&self.pins, &self.grabs, &mut self.particles);
        for pin in pins.iter().filter(|pin| pin.is_soft()) {
            let at = pin.particle as usize;
            if p.w[at] > 0.0 && grabs.iter().all(|held| held.particle != pin.particle) {
                p.w[at] = pin.weigh(p.mass[at], step);
            }
        }
    }
}
