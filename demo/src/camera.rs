//! The camera rig: it orbits and zooms around the cloth, eases towards where it is sent, and keeps
//! to sane angles and distances.

use std::ops::RangeInclusive;

use glam::camera::rh::{proj, view};
use glam::{Mat4, Vec2, Vec3};

use crate::render::light::STAGE_CENTRE;

/// What a rig turns around and how far it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraRig {
    /// What the camera looks at [m].
    pub target: Vec3,
    /// Angle from straight up [rad].
    pub polar: RangeInclusive<f32>,
    /// Distance from the target [m].
    pub radius: RangeInclusive<f32>,
    /// Angle around the target and from straight up [rad], and distance [m], to start from.
    pub start: [f32; 3],
    /// Half of what must fit across the screen at the target's distance [m].
    pub half_width: f32,
}

impl Default for CameraRig {
    /// The rig around the hanging sheet.
    fn default() -> Self {
        Self {
            target: STAGE_CENTRE,
            polar: 0.15..=1.5,
            radius: 3.0..=14.0,
            start: [0.42, 1.38, 4.7],
            half_width: 1.34,
        }
    }
}

/// Vertical field of view [rad].
const FIELD: f32 = 0.60;
/// How fast the rig closes in on its goal [1/s].
const EASE: f32 = 9.0;
/// Turn for a drag across the height of the screen [rad].
const TURN: f32 = 3.6;
/// Seconds without a touch until the rig starts to drift by itself.
const PATIENCE: f32 = 6.0;

/// Spherical place of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OrbitPose {
    azimuth: f32,
    polar: f32,
    radius: f32,
}

/// The rig: where it is, and where it is easing to.
#[derive(Clone, Debug)]
pub struct Camera {
    rig: CameraRig,
    now: OrbitPose,
    goal: OrbitPose,
    idle: f32,
    drift: bool,
}

/// A camera's view, fixed for one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// Where the eye is [m].
    pub eye: Vec3,
    /// What it looks at [m].
    pub target: Vec3,
}

impl Default for Camera {
    fn default() -> Self {
        Self::new(CameraRig::default())
    }
}

impl Camera {
    /// A camera at the start of its rig.
    pub fn new(rig: CameraRig) -> Self {
        let [azimuth, polar, radius] = rig.start;
        let place = OrbitPose { azimuth, polar, radius };
        Self { rig, now: place, goal: place, idle: 0.0, drift: true }
    }

    /// Turns the rig by a drag, given in heights of the screen: right and down are positive.
    pub fn orbit(&mut self, drag: Vec2) {
        if drag.is_finite() {
            self.goal.azimuth -= drag.x * TURN;
            self.goal.polar -= drag.y * TURN * 0.6;
            self.clamp_goal();
        }
    }

    /// Brings the camera nearer (`factor` below one) or takes it away.
    pub fn zoom(&mut self, factor: f32) {
        if factor.is_finite() && factor > 0.0 {
            self.goal.radius *= factor;
            self.clamp_goal();
        }
    }

    /// Steps back until the cloth fits across a screen of this width over height.
    pub fn fit_to_aspect(&mut self, aspect: f32) {
        if aspect.is_finite() && aspect > 0.0 {
            let across = self.rig.half_width / ((FIELD * 0.5).tan() * aspect);
            self.goal.radius = across.max(self.rig.start[2]);
            self.clamp_goal();
            self.now.radius = self.goal.radius;
        }
    }

    /// Goes to the start of another rig.
    pub fn reset_to_rig(&mut self, rig: CameraRig, aspect: f32) {
        *self = Self { drift: self.drift, ..Self::new(rig) };
        self.fit_to_aspect(aspect);
    }

    /// Lets the rig sway gently once it has not been touched for a while, or forbids it.
    pub fn set_drift(&mut self, drift: bool) {
        self.drift = drift;
    }

    /// Eases for `dt` [s]; `touched` says that a hand is on the scene.
    pub fn advance(&mut self, dt: f32, touched: bool) {
        self.idle = if touched { 0.0 } else { self.idle + dt };
        if self.drift && self.idle > PATIENCE {
            let time = self.idle - PATIENCE;
            // Starts from rest and swings to both sides of where it was left.
            self.goal.azimuth += 0.035 * (0.25 * time).cos() * time.min(1.0) * dt;
        }
        let share = 1.0 - (-EASE * dt).exp();
        self.now.azimuth += (self.goal.azimuth - self.now.azimuth) * share;
        self.now.polar += (self.goal.polar - self.now.polar) * share;
        self.now.radius += (self.goal.radius - self.now.radius) * share;
    }

    /// The view from where the rig is now.
    pub fn view(&self) -> CameraView {
        let OrbitPose { azimuth, polar, radius } = self.now;
        let around = Vec3::new(azimuth.sin(), 0.0, azimuth.cos()) * polar.sin();
        let target = self.rig.target;
        CameraView { eye: target + (around + Vec3::Y * polar.cos()) * radius, target }
    }

    fn clamp_goal(&mut self) {
        let CameraRig { polar, radius, .. } = &self.rig;
        self.goal.polar = self.goal.polar.clamp(*polar.start(), *polar.end());
        self.goal.radius = self.goal.radius.clamp(*radius.start(), *radius.end());
    }
}

impl CameraView {
    /// The same view of a world whose lengths are `unit` times as long.
    pub fn scaled(self, unit: f32) -> Self {
        Self { eye: self.eye * unit, target: self.target * unit }
    }

    /// Pixels that a metre covers at a distance of a metre, on a screen so many pixels high.
    pub fn focal_length_pixels(&self, height: f32) -> f32 {
        0.5 * height / (FIELD * 0.5).tan()
    }

    /// The direction of looking.
    pub fn forward(&self) -> Vec3 {
        (self.target - self.eye).normalize()
    }

    /// To the right on the screen.
    pub fn right(&self) -> Vec3 {
        self.forward().cross(Vec3::Y).normalize()
    }

    /// Up on the screen.
    pub fn up(&self) -> Vec3 {
        self.right().cross(self.forward())
    }

    /// Maps the world into GL's clip space for a screen of this width over height.
    pub fn clip_from_world(&self, aspect: f32) -> Mat4 {
        proj::opengl::perspective(FIELD, aspect, 0.1, 60.0)
            * view::look_at_mat4(self.eye, self.target, Vec3::Y)
    }

    /// The unit direction from the eye through a point of the screen, x and y from -1 to 1, y up.
    pub fn ray(&self, screen: Vec2, aspect: f32) -> Vec3 {
        let half = (FIELD * 0.5).tan();
        (self.forward() + self.right() * (screen.x * half * aspect) + self.up() * (screen.y * half))
            .normalize()
    }

    /// Where on the screen a point appears, x and y from -1 to 1, y up; `None` behind the eye.
    pub fn project(&self, at: Vec3, aspect: f32) -> Option<Vec2> {
        let clip = self.clip_from_world(aspect) * at.extend(1.0);
        (clip.w > 0.0).then(|| Vec2::new(clip.x, clip.y) / clip.w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settle(camera: &mut Camera) -> (f32, f32) {
        for _ in 0..600 {
            camera.advance(1.0 / 60.0, true);
        }
        let view = camera.view();
        let arm = view.eye - view.target;
        (arm.length(), (arm.y / arm.length()).acos())
    }

    #[test]
    fn orbit_and_zoom_stop_at_their_limits() {
        let mut camera = Camera::default();
        let CameraRig { polar: polars, radius: radii, .. } = CameraRig::default();
        camera.orbit(Vec2::new(0.3, 100.0));
        camera.zoom(1.0e6);
        let (radius, polar) = settle(&mut camera);
        assert!((radius - radii.end()).abs() < 1.0e-3, "radius {radius}");
        assert!((polar - polars.start()).abs() < 1.0e-3, "polar {polar}");
        camera.orbit(Vec2::new(0.3, -100.0));
        camera.zoom(1.0e-6);
        let (radius, polar) = settle(&mut camera);
        assert!((radius - radii.start()).abs() < 1.0e-3, "radius {radius}");
        assert!((polar - polars.end()).abs() < 1.0e-3, "polar {polar}");
    }

    #[test]
    fn nonsense_leaves_the_camera_where_it_was() {
        let mut camera = Camera::default();
        let before = camera.view();
        camera.orbit(Vec2::new(f32::NAN, f32::INFINITY));
        camera.zoom(f32::NAN);
        camera.zoom(-2.0);
        camera.fit_to_aspect(0.0);
        camera.advance(1.0 / 60.0, true);
        assert_eq!(camera.view(), before);
    }

    #[test]
    fn motion_is_eased_and_never_overshoots() {
        let mut camera = Camera::default();
        let start = camera.view().eye.distance(STAGE_CENTRE);
        camera.zoom(0.7);
        let mut last = start;
        for _ in 0..120 {
            camera.advance(1.0 / 60.0, true);
            let radius = camera.view().eye.distance(STAGE_CENTRE);
            assert!(radius <= last + 1.0e-5 && last - radius < 0.3 * start);
            last = radius;
        }
        assert!((last - 0.7 * start).abs() < 1.0e-3);
    }

    #[test]
    fn a_ray_through_a_projected_point_meets_the_point() {
        let view = Camera::default().view();
        let at = Vec3::new(0.7, 0.6, -0.2);
        let screen = view.project(at, 1.6).unwrap();
        let ray = view.ray(screen, 1.6);
        let miss = (at - view.eye).cross(ray).length();
        assert!(miss < 1.0e-4, "missed by {miss} m");
    }

    #[test]
    fn a_narrow_screen_still_shows_the_whole_sheet() {
        let mut camera = Camera::default();
        let aspect = 390.0 / 844.0;
        camera.fit_to_aspect(aspect);
        for x in [-1.0, 1.0] {
            let at = camera.view().project(Vec3::new(x, STAGE_CENTRE.y, 0.0), aspect).unwrap();
            assert!(at.x.abs() < 1.0, "edge lands at {at}");
        }
    }
}
