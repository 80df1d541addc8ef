//! Orbit camera: it turns around a target, zooms, and eases towards its goal.
//!
//! ```text
//! eye = target + radius · (sin φ · sin θ, cos θ, cos φ · sin θ)      φ azimuth, θ polar angle
//! ```
//! Method: drags and zooms change a goal pose; each frame moves the current pose by the share 1 −
//! exp(−[`EASE_RATE`] · dt) of its distance to the goal, so the motion does not depend on the frame
//! rate.
//!
//! Reads drags, zoom factors and frame times; writes the pose, from which [`CameraView`] is
//! computed.
//!
//! Invariant: the goal pose is always within the limits of the [`CameraRig`], and input that is not
//! finite changes nothing.

use std::ops::RangeInclusive;

use glam::camera::rh::{proj, view};
use glam::{Mat4, Vec2, Vec3};

use crate::render::light::STAGE_CENTRE;

/// Target, limits and start pose of an orbit camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraRig {
    /// Point that the camera looks at [m].
    pub target: Vec3,
    /// Limits of the angle from straight up [rad].
    pub polar: RangeInclusive<f32>,
    /// Limits of the distance to the target [m].
    pub radius: RangeInclusive<f32>,
    /// Start pose: azimuth [rad], polar angle [rad] and distance [m].
    pub start: [f32; 3],
    /// Half the width that must fit on the screen at the distance of the target [m].
    pub half_width: f32,
    /// View for upright screens, if `start` would leave most of one empty.
    pub upright: Option<UprightView>,
}

/// View that fills an upright screen: of a row from a corner, so that it recedes; of a figure that
/// walks about, without the width of its walk, because the camera follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UprightView {
    /// Start pose: azimuth [rad] and polar angle [rad].
    pub start: [f32; 2],
    /// Half the width that must fit on the screen at the distance of the target [m].
    pub half_width: f32,
}

impl Default for CameraRig {
    /// Returns the rig for the hanging sheet.
    fn default() -> Self {
        Self {
            target: STAGE_CENTRE,
            polar: 0.15..=1.5,
            radius: 3.0..=14.0,
            start: [0.42, 1.38, 4.7],
            half_width: 1.2,
            upright: None,
        }
    }
}

/// Part of the screen that overlays leave free, as fractions of its sides from the top left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeArea {
    /// Top left corner.
    pub min: Vec2,
    /// Bottom right corner.
    pub max: Vec2,
}

impl Default for FreeArea {
    /// Returns the whole screen.
    fn default() -> Self {
        Self { min: Vec2::ZERO, max: Vec2::ONE }
    }
}

impl FreeArea {
    /// Returns the area that insets from left, top, right and bottom [px] leave free of a screen of
    /// `size` [px]; at least half of each side.
    pub fn from_insets([left, top, right, bottom]: [f32; 4], size: Vec2) -> Self {
        let limit = |inset: f32, side: f32| {
            if inset.is_finite() { (inset / side.max(1.0)).clamp(0.0, 0.5) } else { 0.0 }
        };
        let min = Vec2::new(limit(left, size.x), limit(top, size.y));
        let max = Vec2::ONE - Vec2::new(limit(right, size.x), limit(bottom, size.y));
        Self { min, max: max.max(min + 0.5) }
    }

    fn size(self) -> Vec2 {
        self.max - self.min
    }

    /// Returns its centre in normalised device coordinates (y up).
    fn centre(self) -> Vec2 {
        (self.min + self.max - 1.0) * Vec2::new(1.0, -1.0)
    }
}

/// Vertical field of view [rad].
const FIELD_OF_VIEW: f32 = 0.60;
/// Rate at which the pose approaches its goal [1/s].
const EASE_RATE: f32 = 9.0;
/// Rate at which an upright screen follows [1/s].
const FOLLOW_RATE: f32 = 3.0;
/// Angle of a drag across the height of the screen [rad].
const DRAG_ANGLE: f32 = 3.6;
/// Time after the last input after which the camera starts to drift [s].
const IDLE_SECONDS: f32 = 6.0;

/// Pose in spherical coordinates around the target.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OrbitPose {
    azimuth: f32,
    polar: f32,
    radius: f32,
}

/// An orbit camera: its current pose and its goal.
#[derive(Clone, Debug)]
pub struct Camera {
    rig: CameraRig,
    now: OrbitPose,
    goal: OrbitPose,
    idle: f32,
    drift: bool,
    /// Whether there was no input yet.
    is_fresh: bool,
    free: FreeArea,
    /// Whether the pose started as [`CameraRig::upright`].
    is_upright: bool,
    /// Where the target is on the screen, in normalised device coordinates.
    shift: Vec2,
    /// Horizontal distance from the target to what an upright screen follows, and its goal [m].
    followed: Vec3,
    follow_goal: Vec3,
}

/// Position and target of the camera in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// Position of the eye [m].
    pub eye: Vec3,
    /// Point that the eye looks at [m].
    pub target: Vec3,
    /// Where the target is on the screen, in normalised device coordinates (lens shift).
    pub shift: Vec2,
}

impl Default for Camera {
    fn default() -> Self {
        Self::new(CameraRig::default())
    }
}

impl Camera {
    /// Creates a camera at the start pose of `rig`.
    pub fn new(rig: CameraRig) -> Self {
        let [azimuth, polar, radius] = rig.start;
        let place = OrbitPose { azimuth, polar, radius };
        Self {
            rig,
            now: place,
            goal: place,
            idle: 0.0,
            drift: true,
            is_fresh: true,
            free: FreeArea::default(),
            is_upright: false,
            shift: Vec2::ZERO,
            followed: Vec3::ZERO,
            follow_goal: Vec3::ZERO,
        }
    }

    /// Moves the picture to `place` [m] at the height of the target, on upright screens only.
    pub fn follow(&mut self, place: Vec3) {
        self.follow_goal = (place - self.rig.target).with_y(0.0);
    }

    /// Ends the drift because of an input; it begins again some time after the last one.
    pub fn note_input(&mut self) {
        (self.is_fresh, self.idle) = (false, 0.0);
    }

    /// Orbits by a drag, in screen heights; right and down are positive.
    pub fn orbit(&mut self, drag: Vec2) {
        if drag.is_finite() {
            self.note_input();
            self.goal.azimuth -= drag.x * DRAG_ANGLE;
            self.goal.polar -= drag.y * DRAG_ANGLE * 0.6;
            self.clamp_goal();
        }
    }

    /// Multiplies the distance to the target by `factor`.
    pub fn zoom(&mut self, factor: f32) {
        if factor.is_finite() && factor > 0.0 {
            self.note_input();
            self.goal.radius *= factor;
            self.clamp_goal();
        }
    }

    /// Sets the part of the screen that overlays leave free; the target eases to its centre.
    pub fn set_free_area(&mut self, free: FreeArea) {
        self.free = free;
    }

    /// Sets the distance so that the cloth fits into the free area of a screen with this aspect
    /// ratio (width over height), and moves the target to the centre of that area. Where the screen
    /// becomes upright, or no longer is, the pose starts anew if the rig has a view for that.
    pub fn fit_to_aspect(&mut self, aspect: f32) {
        if aspect.is_finite() && aspect > 0.0 {
            let size = self.free.size();
            let upright = self.rig.upright.filter(|_| aspect < 1.0);
            if upright.is_some() != self.is_upright {
                self.is_upright = upright.is_some();
                let [azimuth, polar, _] = self.rig.start;
                let [azimuth, polar] = upright.map_or([azimuth, polar], |view| view.start);
                self.goal = OrbitPose { azimuth, polar, ..self.goal };
                self.now = OrbitPose { azimuth, polar, ..self.now };
            }
            let half_width = upright.map_or(self.rig.half_width, |view| view.half_width);
            let across = half_width / ((FIELD_OF_VIEW * 0.5).tan() * aspect * size.x);
            self.goal.radius = across.max(self.rig.start[2] / size.y);
            self.shift = self.free.centre();
            self.clamp_goal();
            self.now.radius = self.goal.radius;
        }
    }

    /// Moves the camera to the start pose of another rig, without easing.
    pub fn reset_to_rig(&mut self, rig: CameraRig, aspect: f32) {
        let Self { drift, is_fresh, free, .. } = *self;
        *self = Self { drift, is_fresh, free, ..Self::new(rig) };
        self.fit_to_aspect(aspect);
    }

    /// Sets whether the camera drifts slowly until the first input, and some time after the last.
    pub fn set_drift(&mut self, drift: bool) {
        self.drift = drift;
    }

    /// Eases towards the goal for `dt` [s]; `touched` says whether a pointer is down.
    pub fn advance(&mut self, dt: f32, touched: bool) {
        self.idle += dt;
        if touched {
            self.note_input();
        }
        let wait = if self.is_fresh { 0.0 } else { IDLE_SECONDS };
        if self.drift && self.idle > wait {
            let time = self.idle - wait;
            // The drift starts at rest and swings to both sides of the last pose.
            self.goal.azimuth += 0.035 * (0.25 * time).cos() * time.min(1.0) * dt;
        }
        let share = 1.0 - (-EASE_RATE * dt).exp();
        self.now.azimuth += (self.goal.azimuth - self.now.azimuth) * share;
        self.now.polar += (self.goal.polar - self.now.polar) * share;
        self.now.radius += (self.goal.radius - self.now.radius) * share;
        self.shift += (self.free.centre() - self.shift) * share;
        self.followed += (self.follow_goal - self.followed) * (1.0 - (-FOLLOW_RATE * dt).exp());
    }

    /// Returns the view of the current pose.
    pub fn view(&self) -> CameraView {
        let OrbitPose { azimuth, polar, radius } = self.now;
        let around = Vec3::new(azimuth.sin(), 0.0, azimuth.cos()) * polar.sin();
        let followed = if self.is_upright { self.followed } else { Vec3::ZERO };
        let target = self.rig.target + followed;
        let eye = target + (around + Vec3::Y * polar.cos()) * radius;
        CameraView { eye, target, shift: self.shift }
    }

    fn clamp_goal(&mut self) {
        let CameraRig { polar, radius, .. } = &self.rig;
        self.goal.polar = self.goal.polar.clamp(*polar.start(), *polar.end());
        self.goal.radius = self.goal.radius.clamp(*radius.start(), *radius.end());
    }
}

impl CameraView {
    /// Returns the same view with all lengths multiplied by `unit`.
    pub fn scaled(self, unit: f32) -> Self {
        Self { eye: self.eye * unit, target: self.target * unit, ..self }
    }

    /// Returns the focal length [px] on a screen of `height` pixels: the pixels that 1 m covers at
    /// a distance of 1 m.
    pub fn focal_length_pixels(&self, height: f32) -> f32 {
        0.5 * height / (FIELD_OF_VIEW * 0.5).tan()
    }

    /// Returns the unit vector along the view.
    pub fn forward(&self) -> Vec3 {
        (self.target - self.eye).normalize()
    }

    /// Returns the unit vector to the right of the screen.
    pub fn right(&self) -> Vec3 {
        self.forward().cross(Vec3::Y).normalize()
    }

    /// Returns the unit vector to the top of the screen.
    pub fn up(&self) -> Vec3 {
        self.right().cross(self.forward())
    }

    /// Returns the matrix from world space to clip space for this aspect ratio (width over height).
    pub fn clip_from_world(&self, aspect: f32) -> Mat4 {
        Mat4::from_translation(self.shift.extend(0.0))
            * proj::opengl::perspective(FIELD_OF_VIEW, aspect, 0.1, 60.0)
            * view::look_at_mat4(self.eye, self.target, Vec3::Y)
    }

    /// Returns half the width and height of the picture at a distance of one, for this aspect ratio
    /// (width over height).
    pub fn half_extent(&self, aspect: f32) -> Vec2 {
        let half = (FIELD_OF_VIEW * 0.5).tan();
        Vec2::new(half * aspect, half)
    }

    /// Returns the unit direction from the eye through a point in normalised device coordinates (y
    /// up).
    pub fn ray(&self, screen: Vec2, aspect: f32) -> Vec3 {
        let side = (screen - self.shift) * self.half_extent(aspect);
        (self.forward() + self.right() * side.x + self.up() * side.y).normalize()
    }

    /// Projects a point to normalised device coordinates (y up); `None` behind the eye.
    pub fn project(&self, at: Vec3, aspect: f32) -> Option<Vec2> {
        let clip = self.clip_from_world(aspect) * at.extend(1.0);
        (clip.w > 0.0).then(|| Vec2::new(clip.x, clip.y) / clip.w)
    }
}

#[cfg(test)]
mod tests;
