//! A cloth goes along with a body that jumps, or runs.

use crate::cloth::Cloth;
use crate::error::{Result, check};
use crate::geometry::transform::Transform;
use crate::math::float_env::with_float_env;
use crate::solver::world::World;
use crate::state::pose::{Pose, check_pose};
use glam::{Quat, Vec3};

/// What the numbers of a frame's pose are called.
const OF_FRAME: [&str; 2] = ["position", "rotation"];

impl Cloth {
    /// Says where the body is that wears the cloth, and how it is turned: [`Cloth::teleport`] and
    /// [`Cloth::move_frame`] go from there. At first, and after a reset, that is the origin. It moves nothing.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion.
    pub fn set_frame(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, OF_FRAME)?;
            self.world.reference_pose = Pose::new(position, rotation);
            Ok(())
        })
    }

    /// Takes the cloth along as the body that wears it jumps from where [`Cloth::set_frame`], [`Cloth::move_frame`]
    /// or the last `teleport` had it: at once, as a solid body, and without feeling it. Velocities turn with it.
    /// Pins, attachments, grabs and anchors go along; colliders do not, see [`Cloth::teleport_collider`].
    ///
    /// A call in the same frame as `move_attachment` or `set_anchors` comes first: those tell where things go
    /// from there.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite or a rotation that is no
    /// unit quaternion, or if something would get farther off than a number can say. Then nothing moved.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, OF_FRAME)?;
            self.world.jump(Pose::new(position, rotation))
        })?;
        self.changed_state();
        Ok(())
    }

    /// Takes the cloth along as the body that wears it runs and turns on from where [`Cloth::set_frame`],
    /// [`Cloth::teleport`] or the last `move_frame` had it: over the next tick, and with only a share of its
    /// `inertia`. At 1 it feels all of the body's motion, as if nothing were said; at 0 none, as if the body
    /// stood still and the rest of the world moved past; between, so much of it, both of the way and of the turn.
    ///
    /// What is not felt takes particles along at once, as a solid body; over the tick they, pins, attachments
    /// and anchors get to where the body has them then. Colliders and grabs stay where they are told to be, on the
    /// body or off it, and the cloth meets them as one who goes with the body sees them move. Air goes along
    /// as far as the motion is not felt.
    ///
    /// A call in the same frame as `move_attachment`, `move_collider` or `set_anchors` comes first: those tell
    /// where things get to.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite, a rotation that is no
    /// unit quaternion, an `inertia` that is not from 0 to 1, or if something would get farther off than a number
    /// can say. Then nothing moved.
    pub fn move_frame(&mut self, position: Vec3, rotation: Quat, inertia: f32) -> Result<()> {
        with_float_env(|| {
            check_pose(position, rotation, OF_FRAME)?;
            check((0.0..=1.0).contains(&inertia), "inertia", "be from 0 to 1")?;
            self.world.go_along(Pose::new(position, rotation), inertia)
        })?;
        self.changed_state();
        Ok(())
    }
}

/// From where a body was to where it is.
#[derive(Clone, Copy)]
struct Move {
    from: Pose,
    to: Pose,
    frames: [Transform; 2],
}

impl Move {
    fn new(from: Pose, to: Pose) -> Self {
        Self { from, to, frames: [from.to_transform(), to.to_transform()] }
    }

    fn point(&self, x: Vec3) -> Vec3 {
        self.frames[1].point_to_world(self.frames[0].point_to_local(x))
    }

    fn turn(&self, v: Vec3) -> Vec3 {
        self.frames[1].vector_to_world(self.frames[0].vector_to_local(v))
    }

    fn pose(&self, pose: &Pose) -> Pose {
        pose.moved_with(&self.from, &self.to)
    }
}

impl World {
    /// Moves all but colliders with the body that it goes along with.
    fn jump(&mut self, to: Pose) -> Result<()> {
        let all = Move::new(self.reference_pose, to);
        self.check_reach(&all, &all)?;
        self.carry(&all, &all);
        self.grabs.iter_mut().for_each(|held| held.target = all.point(held.target));
        self.reference_pose = to;
        Ok(())
    }

    /// As a tick is to begin, all goes along but for what is felt of a body's motion, and that is left to the
    /// tick. Seen from there colliders come from elsewhere.
    fn go_along(&mut self, to: Pose, inertia: f32) -> Result<()> {
        let from = self.reference_pose;
        if from == to {
            return Ok(());
        }
        let unfelt = match inertia {
            1.0 => from,
            0.0 => to,
            felt => to.interpolate(&from, felt),
        };
        let (unfelt, all) = (Move::new(from, unfelt), Move::new(from, to));
        self.check_reach(&unfelt, &all)?;
        self.reference_pose = to;
        self.carry(&unfelt, &all);
        if unfelt.from != unfelt.to {
            self.colliders.iter_mut().for_each(|body| body.last = unfelt.pose(&body.last));
        }
        Ok(())
    }

    /// Whether all that `carry` moves, and grabs and colliders, get to where numbers can say.
    fn check_reach(&self, now: &Move, then: &Move) -> Result<()> {
        let p = &self.particles;
        let is_near = |i: usize| {
            let places = [&p.x, &p.x_prev_tick].map(|places| now.point(places.at(i)));
            let ways = [&p.v, &p.v_extrapolated, &p.displacement].map(|ways| now.turn(ways.at(i)));
            places.iter().chain(&ways).all(|v| v.is_finite())
        };
        let mut bodies = self.colliders.iter();
        let mut carriers = self.attachments.iter();
        let mut pins = self.pins.iter();
        let mut leashes = self.anchors.iter();
        let are_near = (0..p.len()).all(is_near)
            && bodies.all(|body| now.pose(&body.last).position.is_finite())
            && self.grabs.iter().all(|held| now.point(held.target).is_finite())
            && carriers.all(|carrier| {
                let ends = [now.pose(&carrier.last), then.pose(&carrier.next)];
                ends.iter().all(|pose| pose.position.is_finite())
            })
            && pins.all(|pin| {
                let target = match self.attachments.get(pin.attachment, "attachment") {
                    Ok(carrier) => {
                        then.pose(&carrier.next).to_transform().point_to_world(pin.local)
                    }
                    Err(_) => then.point(pin.target),
                };
                target.is_finite() && now.point(pin.from).is_finite()
            })
            && leashes.all(|leash| {
                then.point(leash.anchor).is_finite() && now.point(leash.from).is_finite()
            });
        check(are_near, "position", "keep all of the cloth where numbers can say")
    }

    /// Moves particles and where things are by `now`, and where they get to over the tick by `then`.
    fn carry(&mut self, now: &Move, then: &Move) {
        if now.from != now.to {
            self.carry_starts(now);
        }
        self.attachments.iter_mut().for_each(|carrier| carrier.next = then.pose(&carrier.next));
        for pin in self.pins.iter_mut() {
            pin.target = match self.attachments.get(pin.attachment, "attachment") {
                Ok(carrier) => carrier.next.to_transform().point_to_world(pin.local),
                Err(_) => then.point(pin.target),
            };
        }
        for leash in self.anchors.iter_mut() {
            (leash.anchor, leash.normal) = (then.point(leash.anchor), then.turn(leash.normal));
        }
        self.wake();
    }

    fn carry_starts(&mut self, by: &Move) {
        let p = &mut self.particles;
        for i in 0..p.len() {
            for places in [&mut p.x, &mut p.x_prev_tick] {
                places.set(i, by.point(places.at(i)));
            }
            for ways in [&mut p.v, &mut p.v_extrapolated, &mut p.displacement] {
                ways.set(i, by.turn(ways.at(i)));
            }
        }
        self.attachments.iter_mut().for_each(|carrier| carrier.last = by.pose(&carrier.last));
        self.pins.iter_mut().for_each(|pin| pin.from = by.point(pin.from));
        for leash in self.anchors.iter_mut() {
            leash.from = by.point(leash.from);
            leash.normal_from = by.turn(leash.normal_from);
        }
        self.scratch.contacts.nearby.invalidate();
        // Turned, pins are as far apart as they were but for rounding, which a restored cloth would measure anew.
        self.is_pin_stretch_current = false;
    }
}
