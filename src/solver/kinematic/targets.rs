//! Stage `Hold`, targets: pins and grabs move their particles to kinematic targets.
//!
//! ```text
//! hard pin   x ← target, w = 0
//! soft pin   spring of stiffness k:   x ← x + k s² w (target − x),   w = 1 / (m + k s²)
//! grab       x ← towards the pointer, at most max_displacement per substep, w = 0
//! s: velocity step of the integration scheme [s]
//! ```
//! Method: a soft pin is solved implicitly together with the inertia of its particle, m / s². Both
//! are springs, so their sum is one spring of stiffness (m + k s²) / s² about their common minimum.
//! Later stages see this spring as a larger effective mass, m + k s², and leave it in balance, so
//! no sweep has to solve the pin again, however stiff it is.
//!
//! Reads pins, grabs, attachments and the predicted positions; writes positions. Invariant: targets
//! move evenly over the substeps and are reached exactly in the last one. A grabbed particle whose
//! target is too far away moves at the largest allowed speed.

use crate::geometry::transform::Transform;
use crate::solver::world::World;
use crate::state::attachments::Attachments;
use crate::state::pins::Pin;
use glam::Vec3;

/// Moves pinned and grabbed particles to their targets after substep `number` of the tick.
pub(crate) fn apply(world: &mut World, number: u32) {
    let count = world.substeps;
    let share = (number + 1) as f32 / count as f32;
    let share_of_rest = 1.0 / (count - number) as f32;
    let step = world.regular_scheme().velocity_step;
    let mut frames = AttachmentFrames::default();
    let p = &mut world.particles;
    for pin in world.pins.iter() {
        let at = pin.particle as usize;
        let to = if pin.attachment == 0 {
            pin.from + (pin.target - pin.from) * share
        } else {
            frames.update(&world.attachments, pin.attachment, number + 1, count);
            frames.target(pin, share)
        };
        if pin.is_soft() {
            let from = p.x.get(at);
            p.x.set(at, from + (to - from) * (pin.stiffness * step * step * p.w[at]));
        } else {
            p.x.set(at, to);
        }
    }
    let max_length = world.settings.max_displacement * world.mean_edge;
    for grab in world.grabs.iter() {
        let at = grab.particle as usize;
        let from = world.scratch.predicted.get(at);
        let displacement = (grab.target - from) * share_of_rest;
        let length = displacement.length();
        let to = if number + 1 == count { grab.target } else { from + displacement };
        let is_in_range = length <= max_length;
        p.x.set(at, if is_in_range { to } else { from + displacement * (max_length / length) });
    }
}

/// Ends the motion of attachments and anchors: their poses at the end of the tick become those at
/// the start of the next.
pub(crate) fn finish_tick(world: &mut World) {
    world.attachments.iter_mut().for_each(|pose| pose.last = pose.next);
    world.anchors.finish_tick();
}

/// Transforms of one attachment at the start of the tick and now, cached because consecutive pins
/// mostly share their attachment.
#[derive(Default)]
struct AttachmentFrames {
    attachment: u32,
    frames: Option<[Transform; 2]>,
    /// See `AttachmentPose::offset_left`.
    offset_left: f32,
}

impl AttachmentFrames {
    /// Computes the transforms of `attachment` after substep `moment` of `count`, unless they are
    /// cached.
    fn update(&mut self, attachments: &Attachments, attachment: u32, moment: u32, count: u32) {
        if self.attachment == attachment {
            return;
        }
        let pose = attachments.get(attachment, "attachment").ok();
        self.attachment = attachment;
        self.offset_left = pose.map_or(0.0, |pose| pose.offset_left);
        self.frames = pose.map(|pose| {
            [
                pose.last.to_transform(),
                pose.last.at_substep(&pose.next, moment, count).to_transform(),
            ]
        });
    }

    /// Target of a pin after a `share` of the tick [m]. The initial offset of a pin from its place
    /// on the attachment decreases evenly, to zero in the last tick of an `advance`.
    fn target(&self, pin: &Pin, share: f32) -> Vec3 {
        let Some([last, now]) = &self.frames else { return pin.target };
        let offset = pin.from - last.point_to_world(pin.local);
        now.point_to_world(pin.local) + offset * (1.0 - share * (1.0 - self.offset_left))
    }
}

impl World {
    /// Computes the effective mass of each particle [kg]: its mass plus k · step² of a soft pin.
    ///
    /// `None` without soft pins. The list is a scratch buffer: give it back to
    /// `scratch.effective_mass` after use.
    pub fn compute_effective_mass(&mut self) -> Option<Vec<f32>> {
        if !self.pins.has_soft() {
            return None;
        }
        let mut effective_mass = core::mem::take(&mut self.scratch.effective_mass);
        let step = self.regular_scheme().velocity_step;
        effective_mass.clone_from(&self.particles.mass);
        for pin in self.pins.iter().filter(|pin| pin.is_soft()) {
            effective_mass[pin.particle as usize] += pin.stiffness * step * step;
        }
        Some(effective_mass)
    }

    /// Reserves the buffer of the effective masses, if there are soft pins.
    pub fn reserve_effective_mass(&mut self) {
        let (capacity, effective_mass) =
            (self.allocated_particles(), &mut self.scratch.effective_mass);
        if self.pins.has_soft() {
            effective_mass.clear();
            effective_mass.reserve_exact(capacity);
        }
    }

    /// Updates the inverse masses of particles with soft pins, after the length of a substep
    /// changed.
    pub fn refresh_soft_pin_masses(&mut self) {
        let step = self.regular_scheme().velocity_step;
        let (pins, grabs, p) = (&self.pins, &self.grabs, &mut self.particles);
        for pin in pins.iter().filter(|pin| pin.is_soft()) {
            let at = pin.particle as usize;
            if p.w[at] > 0.0 && grabs.iter().all(|held| held.particle != pin.particle) {
                p.w[at] = pin.effective_inverse_mass(p.mass[at], step);
            }
        }
    }
}
