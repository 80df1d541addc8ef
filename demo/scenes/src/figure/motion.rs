//! Motion of the figure: it walks in a circle, and kicks once with each leg on the way.
//!
//! ```text
//! step k: foot k moves from footprint k − 2 to footprint k     ●k−2    ●k−1     ●k
//!         the other one stands on footprint k − 1               ╰───────────────╯
//! ```
//! Method: footprints on a circle; analytic inverse kinematics of two bones puts the legs on them,
//! so no foot slides. Pelvis, trunk and arms swing as functions of the phase of the step.
//!
//! Reads a number of ticks; returns a [`Pose`].
//!
//! Invariant: the motion repeats after [`LOOP_TICKS`] ticks, and is continuous.

use super::skeleton::{ANKLE, Bone, LEG_BONE, Pose, SIDES};
use crate::stage::FLOOR;
use glam::{Mat3, Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// Steps of a lap. An even number, so that the feet alternate from lap to lap.
const STEPS: u32 = 10;
/// Steps with a kick: one of each leg.
const KICKS: [u32; 2] = [3, 8];
/// Duration of a step [ticks].
const STEP_TICKS: u32 = 34;
/// Duration of a step with a kick [ticks].
const KICK_TICKS: u32 = 108;
/// Duration of a lap [ticks].
pub const LOOP_TICKS: u32 = 8 * STEP_TICKS + 2 * KICK_TICKS;
/// Time from the start in which the arms come down to the sides [ticks].
const ARMS_DOWN_TICKS: f32 = 70.0;
/// Radius of the lap [m].
const RADIUS: f32 = 0.64;
/// Distance of the feet from the line that the figure walks along [m].
const HALF_TRACK: f32 = 0.082;
/// Height of the hips in a double support, and its rise in the middle of a step [m].
const HIP_HEIGHT: [f32; 2] = [0.862, 0.022];
/// Ball and heel of the foot, seen from the ankle in the rest pose [m].
const BALL: Vec3 = Vec3::new(0.0, -ANKLE, 0.105);
const HEEL: Vec3 = Vec3::new(0.0, -ANKLE, -0.045);

/// Pitch of the foot over a swing, toes down [°], at shares of the step.
const SWING_PITCH: [(f32, f32); 5] =
    [(0.0, 36.0), (0.16, 52.0), (0.52, 12.0), (0.85, -14.0), (1.0, -12.0)];
/// Direction of the leg in a kick, forward from straight down [°].
const KICK_ANGLE: [(f32, f32); 8] = [
    (0.0, -20.0),
    (0.17, -40.0),
    (0.38, 20.0),
    (0.52, 72.0),
    (0.60, 72.0),
    (0.78, 34.0),
    (0.92, 16.0),
    (1.0, 15.0),
];
/// Distance from hip to ankle in a kick, relative to the straight leg.
const KICK_REACH: [(f32, f32); 7] = [
    (0.0, 0.97),
    (0.17, 0.86),
    (0.36, 0.84),
    (0.52, 0.985),
    (0.62, 0.985),
    (0.8, 0.93),
    (1.0, 0.98),
];

/// A moment within a lap.
#[derive(Clone, Copy, Debug)]
struct Moment {
    /// Number of the step.
    step: u32,
    /// Share of the step that is over, 0 to 1.
    share: f32,
    /// How far the figure has walked, in steps.
    progress: f32,
}

/// Returns the pose of the figure `ticks` ticks of 1/60 s after the start.
pub fn pose_at(ticks: u32) -> Pose {
    let moment = Moment::at(ticks % LOOP_TICKS);
    let arms_down = smooth(0.0, ARMS_DOWN_TICKS, ticks.min(LOOP_TICKS) as f32);
    let mut pose = Pose::default();
    place_trunk(&mut pose, moment);
    for side in 0..2 {
        place_leg(&mut pose, moment, side);
        place_arm(&mut pose, moment, side, arms_down);
    }
    pose
}

fn step_ticks(step: u32) -> u32 {
    if KICKS.contains(&(step % STEPS)) { KICK_TICKS } else { STEP_TICKS }
}

impl Moment {
    fn at(ticks: u32) -> Self {
        let (mut step, mut since) = (0, ticks);
        while since >= step_ticks(step) {
            since -= step_ticks(step);
            step += 1;
        }
        let share = since as f32 / step_ticks(step) as f32;
        // A cubic Hermite spline whose speed at the start of a step is the harmonic mean of the
        // speeds around it (Fritsch and Carlson, 1980), which keeps it monotonic.
        let length = |step: u32| step_ticks(step) as f32;
        let slope = |before: u32, after: u32| 2.0 / (length(before) + length(after));
        let (own, last, next) = (step + STEPS, step + STEPS - 1, step + STEPS + 1);
        let [m0, m1] = [slope(last, own) * length(own), slope(own, next) * length(own)];
        let progress = step as f32 + hermite(share, [0.0, 1.0], [m0, m1]);
        Self { step, share, progress }
    }

    fn is_kick(self) -> bool {
        KICKS.contains(&self.step)
    }

    /// Weight of the gesture of a kick, 0 at both ends of the step.
    fn kick(self) -> f32 {
        let sine = (PI * self.share).sin();
        if self.is_kick() { sine * sine } else { 0.0 }
    }

    /// Side of the foot that stands: 0 left, 1 right.
    fn standing(self) -> usize {
        (self.step as usize + 1) % 2
    }

    /// Swing of the limbs of a side, −1 (foot behind) to 1 (foot in front).
    fn swing(self, side: usize) -> f32 {
        let forward = (PI * self.share).cos();
        if side == self.standing() { forward } else { -forward }
    }
}

/// Returns position and heading [rad] on the lap, after this number of steps.
fn on_lap(steps: f32) -> (Vec3, f32) {
    // The first kick faces +z, towards the camera.
    let angle = TAU * (steps / STEPS as f32 + 0.5);
    (Vec3::new(RADIUS * angle.sin(), FLOOR, RADIUS * angle.cos()), angle + FRAC_PI_2)
}

/// Returns the place below the ankle on a footprint, and its heading [rad].
fn footprint(step: f32, side: usize) -> (Vec3, f32) {
    let (middle, heading) = on_lap(step);
    (middle + Quat::from_rotation_y(heading) * Vec3::X * (SIDES[side] * HALF_TRACK), heading)
}

fn place_trunk(pose: &mut Pose, moment: Moment) {
    let Moment { share, progress, .. } = moment;
    // At the start of a step the trunk is midway between both footprints.
    let (middle, heading) = on_lap(progress - 1.5);
    let (kick, stance) = (moment.kick(), SIDES[moment.standing()]);
    let facing = Quat::from_rotation_y(heading);
    let arch = (PI * share).sin();
    let aside = stance * arch * if moment.is_kick() { 0.045 } else { 0.022 };
    let [low, rise] = HIP_HEIGHT;
    let height = low + rise * arch * arch;
    // The left hip is in front when the left foot is.
    let twist = -0.08 * moment.swing(0);
    let roll = -stance * arch * 0.05;
    let tilt = 0.03 - 0.12 * kick;
    let pelvis = facing
        * Quat::from_rotation_y(twist)
        * Quat::from_rotation_z(roll)
        * Quat::from_rotation_x(tilt);
    let up = height + Bone::Pelvis.joint().y - Bone::Thigh(0).joint().y;
    let at = middle + facing * Vec3::new(aside, up, 0.0);
    pose.set(Bone::Pelvis, at, pelvis);
    let chest = facing
        * Quat::from_rotation_y(-0.6 * twist)
        * Quat::from_rotation_z(-0.4 * roll)
        * Quat::from_rotation_x(0.04 - 0.20 * kick);
    pose.set(Bone::Chest, pose.carry(Bone::Pelvis, Bone::Chest.joint()), chest);
    let head = facing * Quat::from_rotation_x(0.02 + 0.05 * kick);
    pose.set(Bone::Head, pose.carry(Bone::Chest, Bone::Head.joint()), head);
}

fn place_arm(pose: &mut Pose, moment: Moment, side: usize, arms_down: f32) {
    // Arms swing against the legs.
    let swing = moment.swing(1 - side);
    let kick = moment.kick();
    let forward = 0.03 + 0.30 * swing * arms_down * (1.0 - 0.6 * kick);
    let away = 0.62 + arms_down * (0.32 - 0.62) + 0.22 * kick;
    let bend = 0.36 + 0.16 * swing;
    let chest = pose.bone(Bone::Chest).rotation;
    let upper = chest * Quat::from_rotation_z(SIDES[side] * away) * Quat::from_rotation_x(-forward);
    pose.set(Bone::UpperArm(side), pose.carry(Bone::Chest, Bone::UpperArm(side).joint()), upper);
    let elbow = pose.carry(Bone::UpperArm(side), Bone::Forearm(side).joint());
    pose.set(Bone::Forearm(side), elbow, upper * Quat::from_rotation_x(-bend));
}

fn place_leg(pose: &mut Pose, moment: Moment, side: usize) {
    let Moment { step, share, .. } = moment;
    let hip = pose.carry(Bone::Pelvis, Bone::Thigh(side).joint());
    let is_standing = side == moment.standing();
    let (place, heading, pitch) = if is_standing {
        let (place, heading) = footprint(step as f32 - 1.0, side);
        let landing = -12.0 * (1.0 - smooth(0.0, 0.16, share));
        // The heel stays down while the other leg kicks.
        let leaving = 36.0 * smooth(if moment.is_kick() { 0.82 } else { 0.55 }, 1.0, share);
        (place, heading, landing + leaving)
    } else {
        let (from, first) = footprint(step as f32 - 2.0, side);
        let (to, last) = footprint(step as f32, side);
        let moved = smooth(0.04, 0.98, share);
        let arch = (PI * share).sin();
        let lift = Vec3::Y * (0.075 * arch * arch);
        (from.lerp(to, moved) + lift, first + moved * (last - first), at_key(&SWING_PITCH, share))
    };
    let foot = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch.to_radians());
    // The foot turns about its ball while the heel is up, and about the heel while the toes are.
    let pivot = if pitch > 0.0 { BALL } else { HEEL };
    let mut ankle = place + Quat::from_rotation_y(heading) * pivot.with_y(0.0) - foot * pivot;
    let pelvis = pose.bone(Bone::Pelvis).rotation;
    let (_, course) = on_lap(moment.progress - 1.5);
    let mut pointed = 0.0;
    if !is_standing && moment.is_kick() {
        let angle = at_key(&KICK_ANGLE, share).to_radians();
        let leg = Vec3::new(0.0, -angle.cos(), angle.sin())
            * (2.0 * LEG_BONE * at_key(&KICK_REACH, share));
        pointed = smooth(0.05, 0.24, share) * (1.0 - smooth(0.74, 0.98, share));
        ankle = ankle.lerp(hip + Quat::from_rotation_y(course) * leg, pointed);
    }
    let [thigh, shin] = two_bones(hip, ankle, pelvis * Vec3::X);
    pose.set(Bone::Thigh(side), hip, thigh);
    pose.set(Bone::Shin(side), hip - thigh * Vec3::Y * LEG_BONE, shin);
    // The toes stay on the floor while the heel leaves it.
    let planted =
        if is_standing { smooth(0.0, 6.0, pitch) } else { 1.0 - smooth(0.15, 0.5, share) };
    let toes = foot.slerp(Quat::from_rotation_y(heading), planted);
    let stretched = shin * Quat::from_rotation_x(0.7);
    let foot = foot.slerp(stretched, pointed);
    pose.set(Bone::Foot(side), pose.carry(Bone::Shin(side), Bone::Foot(side).joint()), foot);
    let ball = pose.carry(Bone::Foot(side), Bone::Toes(side).joint());
    pose.set(Bone::Toes(side), ball, toes.slerp(stretched, pointed));
}

/// Returns the rotations of thigh and shin that put the ankle at its target, or as near as the leg
/// reaches. The knee bends forward, in the plane across `side`, the axis from right to left.
fn two_bones(hip: Vec3, ankle: Vec3, side: Vec3) -> [Quat; 2] {
    let reach = (ankle - hip).length().clamp(0.3, 1.996 * LEG_BONE);
    let down = (ankle - hip).normalize_or(Vec3::NEG_Y);
    let side = side.reject_from_normalized(down).normalize_or(Vec3::X);
    let forward = down.cross(side);
    let (cos, sin) = {
        let cos = 0.5 * reach / LEG_BONE;
        (cos, (1.0 - cos * cos).max(0.0).sqrt())
    };
    [sin, -sin].map(|sin| {
        let along = down * cos + forward * sin;
        Quat::from_mat3(&Mat3::from_cols(side, -along, along.cross(side)))
    })
}

/// Returns 0 below `from`, 1 above `to`, and a smooth value between.
pub fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let share = ((x - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Evaluates the cubic Hermite polynomial with these values and slopes at 0 and 1.
fn hermite(x: f32, [a, b]: [f32; 2], [m0, m1]: [f32; 2]) -> f32 {
    let (x2, x3) = (x * x, x * x * x);
    a * (2.0 * x3 - 3.0 * x2 + 1.0)
        + m0 * (x3 - 2.0 * x2 + x)
        + b * (3.0 * x2 - 2.0 * x3)
        + m1 * (x3 - x2)
}

/// Evaluates a curve through keyframes (time, value) with the slopes of finite differences.
fn at_key(keys: &[(f32, f32)], time: f32) -> f32 {
    let last = keys.len() - 1;
    let i = keys.iter().rposition(|key| key.0 <= time).unwrap_or(0).min(last - 1);
    let slope = |i: usize| {
        let (before, after) = (keys[i.saturating_sub(1)], keys[(i + 1).min(last)]);
        (after.1 - before.1) / (after.0 - before.0)
    };
    let (from, to) = (keys[i], keys[i + 1]);
    let length = to.0 - from.0;
    hermite((time - from.0) / length, [from.1, to.1], [slope(i) * length, slope(i + 1) * length])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest distance that the joint of a bone moves in a tick of a lap [m].
    fn largest_move(bone: Bone) -> f32 {
        let at = |tick: u32| pose_at(tick).bone(bone).position;
        let laps = LOOP_TICKS..2 * LOOP_TICKS;
        laps.map(|tick| at(tick).distance(at(tick + 1))).fold(0.0, f32::max)
    }

    #[test]
    fn the_motion_is_continuous_and_the_foot_of_a_kick_is_fast() {
        assert!(largest_move(Bone::Pelvis) < 0.03);
        for side in 0..2 {
            let speed = 60.0 * largest_move(Bone::Foot(side));
            assert!((3.0..5.0).contains(&speed), "the foot moves at {speed} m/s");
            assert!(60.0 * largest_move(Bone::Forearm(side)) < 3.0);
        }
    }

    #[test]
    fn a_lap_ends_where_it_began() {
        let (start, end) = (pose_at(LOOP_TICKS), pose_at(2 * LOOP_TICKS));
        for bone in [Bone::Pelvis, Bone::Head, Bone::Foot(0), Bone::Foot(1), Bone::Forearm(0)] {
            assert!(start.bone(bone).position.distance(end.bone(bone).position) < 1.0e-5);
        }
    }

    #[test]
    fn the_standing_foot_does_not_slide_and_no_foot_is_below_the_floor() {
        for tick in LOOP_TICKS..2 * LOOP_TICKS {
            let (pose, moment) = (pose_at(tick), Moment::at(tick % LOOP_TICKS));
            for side in 0..2 {
                let ankle = Bone::Foot(side).joint();
                let tip = ankle + BALL + Vec3::Z * 0.07;
                for (bone, point) in [
                    (Bone::Foot(side), ankle + BALL),
                    (Bone::Foot(side), ankle + HEEL),
                    (Bone::Toes(side), tip),
                ] {
                    let sole = pose.carry(bone, point);
                    assert!(sole.y > FLOOR - 0.006, "tick {tick}: {}", sole.y - FLOOR);
                }
            }
            if !(0.2..0.5).contains(&moment.share) {
                continue;
            }
            let side = moment.standing();
            let sole = |pose: &Pose| pose.carry(Bone::Foot(side), Bone::Foot(side).joint() + HEEL);
            let slide = sole(&pose).distance(sole(&pose_at(tick + 1)));
            assert!(slide < 1.0e-3, "tick {tick}: the foot slides by {slide} m");
        }
    }
}
