//! The application of the cloth scenes, independent of the platform: cloth, camera, pointers and
//! controls.
//!
//! Method: a window, a page or a screenshot passes events and frame times to [`App`] and asks it to
//! draw.
//!
//! Reads events, frame times and [`Settings`]; writes the cloths, the camera and the pixels of the
//! render target.
//!
//! Invariant: the settings stay in their ranges, and a settings change that fails leaves them as
//! they were.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Result, Stage};
use muslin_scenes::SceneInstance;
use three_d::{CoreError, RenderTarget};

use crate::afterglow::Afterglow;
use crate::camera::{Camera, FreeArea};
use crate::controls::{self, Action, Kind};
use crate::meter::{Meter, Readout, ResolutionScaler, StageTime};
use crate::picking::{PickContext, Screen};
use crate::pointer::{Cursor, Pointers};
use crate::render::trail::TrailPoint;
use crate::render::{FrameScene, Renderer};
use crate::scene;
use crate::settings::Settings;
use crate::smooth_surface::SmoothSurface;
use crate::surfaces::{self, WireframeLines};

/// Longest frame time that the camera animation uses [s].
const LONGEST_FRAME: f32 = 0.1;
/// Simulation time per frame above which the sheet does not collide with itself [ms].
const SLOW_SIMULATION: f32 = 10.0;

/// The running demo with one of the cloth scenes.
pub struct App {
    settings: Settings,
    scene: SceneInstance,
    camera: Camera,
    pointers: Pointers,
    /// Whether the key for the blade is held.
    blade: bool,
    /// Direction that held keys walk a person in: right, and away from the camera.
    stride: Vec2,
    afterglow: Afterglow,
    trail_points: Vec<TrailPoint>,
    screen: Screen,
    /// How far overlays reach into the screen from left, top, right and bottom [px].
    insets: [f32; 4],
    /// Whether the size of the screen is known and the camera fits it.
    is_fitted: bool,
    reduced_motion: bool,
    /// Whether no pointer was pressed yet.
    is_untouched: bool,
    /// Whether time stands still for a photo.
    is_photo: bool,
    meter: Meter,
    resolution_scaler: ResolutionScaler,
    clock: fn() -> f64,
    times_stages: bool,
    lines: Vec<WireframeLines>,
    smooth: Vec<SmoothSurface>,
    /// Time that the picture has been moving for [s]; stands still with reduced motion.
    time: f32,
    /// Number of rebuilds of the scene. New cloths restart their topology revision, so this number
    /// tells them apart.
    generation: u32,
}

impl App {
    /// Builds the scene of `settings`. `clock` returns seconds since any fixed time; the demo uses
    /// it only to measure durations.
    ///
    /// # Errors
    /// As [`scene::build`].
    pub fn new(mut settings: Settings, clock: fn() -> f64) -> Result<Self> {
        settings.clamp();
        let mut scene = scene::build(&settings, false)?;
        scene::start::settle(&mut scene, &settings, false)?;
        Ok(Self {
            scene,
            camera: Camera::new(scene::camera_rig(settings.scene)),
            settings,
            pointers: Pointers::default(),
            blade: false,
            stride: Vec2::ZERO,
            afterglow: Afterglow::default(),
            trail_points: Vec::new(),
            screen: Screen { size: Vec2::new(1280.0, 720.0) },
            insets: [0.0; 4],
            is_fitted: false,
            reduced_motion: false,
            is_untouched: true,
            is_photo: false,
            meter: Meter::default(),
            resolution_scaler: ResolutionScaler::default(),
            clock,
            times_stages: false,
            lines: Vec::new(),
            smooth: Vec::new(),
            time: 0.0,
            generation: 0,
        })
    }

    /// Draws few pixels until the first frames have shown that the machine is fast enough for all.
    pub fn start_low(&mut self) {
        self.resolution_scaler = ResolutionScaler::starting_low();
    }

    /// Returns the values of the controls.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Clamps and applies new settings; rebuilds the scene if resolution, pinning, fabric or scene
    /// changes.
    ///
    /// # Errors
    /// As [`scene::build`]; the old settings stay.
    pub fn set_settings(&mut self, mut settings: Settings) -> Result<()> {
        settings.clamp();
        let rebuild = settings.resolution != self.settings.resolution
            || settings.pinning != self.settings.pinning
            || settings.fabric != self.settings.fabric
            || settings.scene != self.settings.scene;
        if rebuild {
            self.rebuild_scene(&settings)?;
        } else {
            scene::apply_settings(&mut self.scene, &settings, self.reduced_motion)?;
        }
        self.settings = settings;
        Ok(())
    }

    /// Sets one control, or presses it if it is a button. An unknown name changes nothing.
    ///
    /// # Errors
    /// As [`App::set_settings`].
    pub fn set(&mut self, name: &str, value: f32) -> Result<()> {
        let Some(control) = controls::find_control(name) else {
            return Ok(());
        };
        if let Kind::Button(action) = control.kind {
            return self.run_action(action);
        }
        let mut settings = self.settings.clone();
        control.set(&mut settings, value);
        self.set_settings(settings)
    }

    /// Applies the control that belongs to a key; returns whether there is one. In the photo mode
    /// there is only the one that ends it.
    ///
    /// # Errors
    /// As [`App::set_settings`].
    pub fn key(&mut self, key: char, shift: bool) -> Result<bool> {
        let Some(control) = controls::find_control_by_key(key) else {
            return Ok(false);
        };
        if self.is_photo && !matches!(control.kind, Kind::Button(Action::Photo)) {
            return Ok(false);
        }
        let mut settings = self.settings.clone();
        match control.press(&mut settings, shift) {
            Some(action) => self.run_action(action)?,
            None => self.set_settings(settings)?,
        }
        Ok(true)
    }

    /// Runs the action of a button.
    ///
    /// # Errors
    /// As [`scene::build`].
    pub fn run_action(&mut self, action: Action) -> Result<()> {
        match action {
            Action::Reset => {
                let settings = self.settings.clone();
                self.rebuild_scene(&settings)
            }
            Action::DropPins => {
                self.scene.cloths.iter_mut().for_each(Cloth::unpin_all);
                Ok(())
            }
            Action::Photo => self.set_photo(!self.is_photo),
        }
    }

    /// Reduces the changes of the wind and stops the camera drift, for users who prefer reduced
    /// motion.
    ///
    /// # Errors
    /// As [`scene::apply_settings`].
    pub fn set_reduced_motion(&mut self, reduced_motion: bool) -> Result<()> {
        self.reduced_motion = reduced_motion;
        self.camera.set_drift(!reduced_motion);
        scene::apply_settings(&mut self.scene, &self.settings, reduced_motion)
    }

    /// Sets the size of the screen, in logical pixels.
    pub fn resize(&mut self, size: Vec2) {
        if size.is_finite()
            && size.min_element() >= 1.0
            && (size != self.screen.size || !self.is_fitted)
        {
            self.screen.size = size;
            self.is_fitted = true;
            self.camera.set_free_area(FreeArea::from_insets(self.insets, size));
            self.camera.fit_to_aspect(self.screen.aspect());
        }
    }

    /// Sets how far overlays reach into the screen from left, top, right and bottom, in logical
    /// pixels. The picture moves into what they leave free while no pointer is down.
    pub fn set_insets(&mut self, insets: [f32; 4]) {
        self.insets = insets;
    }

    /// Handles a pointer that is pressed at `at`, in logical pixels.
    ///
    /// # Errors
    /// As [`Pointers::press`].
    pub fn press(&mut self, id: u32, at: Vec2) -> Result<()> {
        self.is_untouched = false;
        if self.is_photo {
            self.lift(id)?;
            self.pointers.press_camera(id, at);
            return Ok(());
        }
        if self.is_on_walkway(at)? {
            self.lift(id)?;
            self.pointers.press_walker(id, at);
            return Ok(());
        }
        let (pointers, mut pick) = self.pick_context();
        pointers.press(id, at, &mut pick)
    }

    /// Handles a pointer that moves to `to`, in logical pixels.
    ///
    /// # Errors
    /// As [`Pointers::drag`].
    pub fn drag(&mut self, id: u32, to: Vec2) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.drag(id, to, &mut pick)
    }

    /// Handles a pointer that is released, or that the platform has lost.
    ///
    /// # Errors
    /// As [`Pointers::lift`].
    pub fn lift(&mut self, id: u32) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.lift(id, &mut pick)
    }

    /// Handles a mouse that leaves the screen: there is no hover position any more.
    pub fn clear_hover(&mut self) {
        self.pointers.clear_hover();
    }

    /// Zooms by the wheel; positive `pixels` move the camera away from the cloth.
    pub fn wheel(&mut self, pixels: f32) {
        self.camera.zoom((0.0012 * pixels.clamp(-400.0, 400.0)).exp());
    }

    /// Zooms by a pinch gesture; a `factor` above one moves the camera nearer.
    pub fn pinch(&mut self, factor: f32) {
        self.camera.zoom(1.0 / factor);
    }

    /// Sets whether the key for the blade is held.
    pub fn hold_blade(&mut self, out: bool) {
        self.blade = out;
    }

    /// Returns the shape of the mouse cursor.
    ///
    /// # Errors
    /// As [`Pointers::cursor`].
    pub fn cursor(&mut self) -> Result<Cursor> {
        let (pointers, mut pick) = self.pick_context();
        pointers.cursor(&mut pick)
    }

    /// Advances camera, grabs and cloth by a frame of `seconds` [s].
    ///
    /// # Errors
    /// As [`SceneInstance::advance`].
    pub fn frame(&mut self, seconds: f32) -> Result<()> {
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        let is_down = self.pointers.is_any_down();
        if !is_down {
            self.camera.set_free_area(FreeArea::from_insets(self.insets, self.screen.size));
        }
        let is_held = is_down || self.is_photo;
        self.camera.advance(seconds.min(LONGEST_FRAME), is_held);
        let (pointers, mut pick) = self.pick_context();
        pointers.update_targets(&mut pick)?;
        if !self.settings.paused && !self.is_photo {
            self.send_walker();
            self.push_under_mouse(seconds)?;
            let start = (self.clock)();
            self.scene.advance(seconds)?;
            self.meter.record_simulation((self.clock)() - start);
        }
        self.afterglow.fade(seconds);
        self.pass_time(seconds);
        self.meter.record_frame(seconds);
        self.resolution_scaler.record_frame(seconds);
        if self.meter.milliseconds() > SLOW_SIMULATION {
            scene::self_collision::drop(&mut self.scene, &self.settings)?;
        }
        Ok(())
    }

    /// Switches the timing of every stage of a frame on or off.
    pub fn time_stages(&mut self, on: bool) {
        self.times_stages = on;
        self.set_clocks();
    }

    /// Returns how long each stage takes in a frame, while [`App::time_stages`] is on.
    pub fn stage_times(&self) -> Vec<StageTime> {
        self.meter.stages()
    }

    /// Runs exactly `ticks` ticks, independent of the clock.
    pub fn play(&mut self, ticks: u32) {
        let start = (self.clock)();
        self.scene.step(ticks);
        self.meter.record_simulation((self.clock)() - start);
        self.afterglow.fade(ticks as f32 / 60.0);
        self.pass_time(ticks as f32 / 60.0);
    }

    /// Draws the current state of the scene.
    ///
    /// # Errors
    /// As [`Renderer::draw`].
    pub fn draw(
        &mut self,
        renderer: &mut Renderer,
        output: &RenderTarget<'_>,
    ) -> std::result::Result<(), CoreError> {
        let density = output.width() as f32 / self.screen.size.x.max(1.0);
        let scaler = &self.resolution_scaler;
        self.draw_at(renderer, output, scaler.scale(density), scaler.is_low())
    }

    /// Draws with `scale` times the pixels of the output along each side; with `is_low` cloths are
    /// not made finer, and pixels have one sample.
    fn draw_at(
        &mut self,
        renderer: &mut Renderer,
        output: &RenderTarget<'_>,
        scale: f32,
        is_low: bool,
    ) -> std::result::Result<(), CoreError> {
        self.lines.resize_with(self.scene.cloths.len(), WireframeLines::default);
        self.smooth.resize_with(self.scene.cloths.len(), SmoothSurface::default);
        let mut seconds = [0.0; Stage::COUNT];
        for (cloth, lines) in self.scene.cloths.iter_mut().zip(&mut self.lines) {
            lines.update(cloth, self.generation);
            // This call computes the normals, so their time counts as time of the simulation.
            cloth.normals();
            for (sum, spent) in seconds.iter_mut().zip(cloth.stats().seconds) {
                *sum += spent;
            }
        }
        if self.times_stages {
            self.meter.record_stages(&seconds);
        }
        self.trail_points.clear();
        self.trail_points.extend(self.afterglow.trail_points());
        let (solids, appearances) = (
            scene::solids::solids(&self.settings, &self.scene),
            scene::appearances(&self.settings),
        );
        let frame = FrameScene {
            solids: &solids,
            view: self.camera.view(),
            appearances: &appearances,
            trail: &self.trail_points,
            wireframe: self.settings.wireframe,
            time: self.time,
            rain: scene::rain(&self.settings),
            resolution_scale: scale,
            is_low,
        };
        let start = (self.clock)();
        surfaces::upload(
            renderer,
            &mut self.scene,
            &self.settings,
            &self.lines,
            (&mut self.smooth, !is_low),
            self.generation,
        );
        let uploaded = (self.clock)();
        renderer.draw(&frame, output)?;
        self.meter.record_drawing(uploaded - start, (self.clock)() - uploaded);
        Ok(())
    }

    /// Returns the numbers that the panel shows.
    pub fn readout(&self) -> Readout {
        self.meter.readout(&self.scene.cloths)
    }

    /// Returns the screen, measured in logical pixels.
    pub fn screen(&self) -> Screen {
        self.screen
    }

    /// Returns the camera.
    pub fn camera(&mut self) -> &mut Camera {
        &mut self.camera
    }

    /// Returns the numbers of particles across and down the sheet; `None` for discs and clothes,
    /// which are no grid.
    pub fn grid_size(&self) -> Option<[u32; 2]> {
        scene::grid::grid_size(&self.settings)
    }

    /// Returns the position of a particle of the first cloth, in drawn metres.
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        let at = self.scene.cloths.first()?.positions().get(particle as usize)?;
        Some(*at / scene::unit(self.settings.scene))
    }

    /// Returns the position of a particle of the first cloth on the screen, in logical pixels.
    pub fn particle_on_screen(&self, particle: u32) -> Option<Vec2> {
        let at = self.particle(particle)?;
        let view = self.camera.view();
        let normal = view.project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// Returns the state hash of all cloths; with one cloth it is the hash of that cloth.
    pub fn state_hash(&self) -> u64 {
        let hashes = self.scene.cloths.iter().map(Cloth::state_hash);
        hashes.fold(0, |all, hash| all.rotate_left(1) ^ hash)
    }

    fn rebuild_scene(&mut self, settings: &Settings) -> Result<()> {
        self.scene = scene::build(settings, self.reduced_motion)?;
        scene::start::settle(&mut self.scene, settings, self.reduced_motion)?;
        self.set_clocks();
        if settings.scene != self.settings.scene {
            self.camera.reset_to_rig(scene::camera_rig(settings.scene), self.screen.aspect());
        }
        self.pointers.clear();
        self.is_photo = false;
        self.generation = self.generation.wrapping_add(1);
        Ok(())
    }

    fn set_clocks(&mut self) {
        let clock = self.times_stages.then_some(self.clock);
        self.scene.cloths.iter_mut().for_each(|cloth| cloth.set_clock(clock));
    }

    fn pick_context(&mut self) -> (&mut Pointers, PickContext<'_>) {
        let unit = scene::unit(self.settings.scene);
        let pick = PickContext {
            unit,
            view: self.camera.view().scaled(unit),
            spacing: scene::grid::spacing(&self.settings),
            span: scene::span(&self.settings),
            blade: self.blade || self.settings.blade,
            afterglow: &mut self.afterglow,
            screen: self.screen,
            cloths: &mut self.scene.cloths,
            camera: &mut self.camera,
        };
        (&mut self.pointers, pick)
    }
}

mod animation;
mod hint;
pub mod photo;
mod walkway;

#[cfg(test)]
mod tests;
