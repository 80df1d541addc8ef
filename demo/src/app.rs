//! The demo itself, the same behind a window, on a page and in a file: cloth, camera, hands and
//! controls. It knows no platform; those bring events and time, and take pictures.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Result};
use serde::Serialize;
use three_d::{CoreError, RenderTarget};

use crate::blade::Afterglow;
use crate::camera::Camera;
use crate::controls::{self, Action, Kind};
use crate::meter::{Governor, Meter};
use crate::pointer::{Cursor, Pointers, Scene, Screen};
use crate::render::trail::Spark;
use crate::render::{Frame, Renderer, Surface};
use crate::settings::Settings;
use crate::stage;

/// The longest frame that the camera eases through [s].
const LONGEST_FRAME: f32 = 0.1;

/// The running demo.
pub struct App {
    settings: Settings,
    cloth: Cloth,
    camera: Camera,
    hands: Pointers,
    /// The blade is out for as long as a key is held.
    blade: bool,
    afterglow: Afterglow,
    sparks: Vec<Spark>,
    screen: Screen,
    calm: bool,
    meter: Meter,
    governor: Governor,
    clock: fn() -> f64,
    times_stages: bool,
    lines: Vec<u32>,
    /// Which cloth this is: a new one may count its topology from the start again.
    generation: u32,
    lines_of: Option<u64>,
}

/// The numbers that the panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Readout {
    /// Particles, those that tears have added included.
    pub particles: u32,
    /// Constraints that still hold.
    pub constraints: u32,
    /// Pieces that the cloth is in.
    pub pieces: u32,
    /// Frames a second, smoothed.
    pub fps: f32,
    /// Simulation in a frame [ms], smoothed.
    pub milliseconds: f32,
}

/// How long a stage takes in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StageTime {
    /// What it is called.
    pub name: &'static str,
    /// How long it takes [ms], smoothed.
    pub milliseconds: f32,
}

impl App {
    /// Hangs the sheet. `clock` counts seconds from anywhere; it only times the simulation.
    ///
    /// # Errors
    /// As [`stage::build`].
    pub fn new(mut settings: Settings, clock: fn() -> f64) -> Result<Self> {
        settings.clamp();
        Ok(Self {
            cloth: stage::build(&settings, false)?,
            settings,
            camera: Camera::default(),
            hands: Pointers::default(),
            blade: false,
            afterglow: Afterglow::default(),
            sparks: Vec::new(),
            screen: Screen { size: Vec2::new(1280.0, 720.0) },
            calm: false,
            meter: Meter::default(),
            governor: Governor::default(),
            clock,
            times_stages: false,
            lines: Vec::new(),
            generation: 0,
            lines_of: None,
        })
    }

    /// The controls' values.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Takes other values, clamped: rebuilds the sheet if it must, tunes it otherwise.
    ///
    /// # Errors
    /// As [`stage::build`]; the old values stay.
    pub fn set_settings(&mut self, mut settings: Settings) -> Result<()> {
        settings.clamp();
        let rebuild = settings.resolution != self.settings.resolution
            || settings.pinning != self.settings.pinning
            || settings.fabric != self.settings.fabric
            || settings.scene != self.settings.scene;
        if rebuild {
            self.hang(&settings)?;
        } else {
            stage::tune(&mut self.cloth, &settings, self.calm)?;
        }
        self.settings = settings;
        Ok(())
    }

    /// Gives one control a value; an unknown name changes nothing.
    ///
    /// # Errors
    /// As [`App::set_settings`].
    pub fn set(&mut self, name: &str, value: f32) -> Result<()> {
        let Some(control) = controls::find(name) else {
            return Ok(());
        };
        if let Kind::Button(action) = control.kind {
            return self.act(action);
        }
        let mut settings = self.settings.clone();
        control.set(&mut settings, value);
        self.set_settings(settings)
    }

    /// Does what a key of the table does, and says whether it was one.
    ///
    /// # Errors
    /// As [`App::set_settings`].
    pub fn key(&mut self, key: char, shift: bool) -> Result<bool> {
        let Some(control) = controls::of_key(key) else {
            return Ok(false);
        };
        let mut settings = self.settings.clone();
        match control.press(&mut settings, shift) {
            Some(action) => self.act(action)?,
            None => self.set_settings(settings)?,
        }
        Ok(true)
    }

    /// Does what a button says.
    ///
    /// # Errors
    /// As [`stage::build`].
    pub fn act(&mut self, action: Action) -> Result<()> {
        match action {
            Action::Reset => {
                let settings = self.settings.clone();
                self.hang(&settings)
            }
            Action::DropPins => {
                self.cloth.unpin_all();
                Ok(())
            }
        }
    }

    /// Takes most of the restlessness out of wind and camera, for people who ask their system so.
    ///
    /// # Errors
    /// As [`stage::tune`].
    pub fn set_calm(&mut self, calm: bool) -> Result<()> {
        self.calm = calm;
        self.camera.set_drift(!calm);
        stage::tune(&mut self.cloth, &self.settings, calm)
    }

    /// The screen has this size, in the pixels that pointers count in.
    pub fn resize(&mut self, size: Vec2) {
        if size.is_finite() && size.min_element() >= 1.0 && size != self.screen.size {
            self.screen.size = size;
            self.camera.frame(self.screen.aspect());
        }
    }

    /// A pointer comes down.
    ///
    /// # Errors
    /// As [`Pointers::press`].
    pub fn press(&mut self, id: u32, at: Vec2) -> Result<()> {
        let (hands, mut scene) = self.hands();
        hands.press(id, at, &mut scene)
    }

    /// A pointer moves.
    ///
    /// # Errors
    /// As [`Pointers::drag`].
    pub fn drag(&mut self, id: u32, to: Vec2) -> Result<()> {
        let (hands, mut scene) = self.hands();
        hands.drag(id, to, &mut scene)
    }

    /// A pointer goes up, or is lost.
    ///
    /// # Errors
    /// As [`Pointers::lift`].
    pub fn lift(&mut self, id: u32) -> Result<()> {
        let (hands, mut scene) = self.hands();
        hands.lift(id, &mut scene)
    }

    /// The mouse has left the screen.
    pub fn leave(&mut self) {
        self.hands.leave();
    }

    /// The wheel turns by so many pixels, away from the cloth if positive.
    pub fn wheel(&mut self, pixels: f32) {
        self.camera.zoom((0.0012 * pixels.clamp(-400.0, 400.0)).exp());
    }

    /// A trackpad's pinch: the camera comes nearer by `factor` above one.
    pub fn pinch(&mut self, factor: f32) {
        self.camera.zoom(1.0 / factor);
    }

    /// The key for the blade goes down or up.
    pub fn hold_blade(&mut self, out: bool) {
        self.blade = out;
    }

    /// What the cursor should say.
    ///
    /// # Errors
    /// As [`Pointers::cursor`].
    pub fn cursor(&mut self) -> Result<Cursor> {
        let (hands, mut scene) = self.hands();
        hands.cursor(&mut scene)
    }

    /// Lets `seconds` pass.
    ///
    /// # Errors
    /// As [`Cloth::advance`].
    pub fn frame(&mut self, seconds: f32) -> Result<()> {
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        self.camera.advance(seconds.min(LONGEST_FRAME), self.hands.any());
        let (hands, mut scene) = self.hands();
        hands.follow(&mut scene)?;
        if !self.settings.paused {
            let start = (self.clock)();
            self.cloth.advance(seconds)?;
            self.meter.simulated((self.clock)() - start);
        }
        self.afterglow.fade(seconds);
        self.meter.frame(seconds);
        self.governor.frame(seconds);
        Ok(())
    }

    /// Times every stage of a frame from now on, or no longer.
    pub fn time_stages(&mut self, on: bool) {
        self.times_stages = on;
        self.cloth.set_clock(on.then_some(self.clock));
    }

    /// How long each stage takes, while [`App::time_stages`] is on.
    pub fn stage_times(&self) -> Vec<StageTime> {
        let time = |(name, milliseconds)| StageTime { name, milliseconds };
        self.meter.stages().map(time).collect()
    }

    /// Runs exactly so many ticks, whatever the clock says.
    pub fn play(&mut self, ticks: u32) {
        let start = (self.clock)();
        self.cloth.step(ticks);
        self.meter.simulated((self.clock)() - start);
        self.afterglow.fade(ticks as f32 / 60.0);
    }

    /// Draws the scene as it is now.
    ///
    /// # Errors
    /// As [`Renderer::draw`].
    pub fn draw(
        &mut self,
        renderer: &mut Renderer,
        output: &RenderTarget<'_>,
    ) -> std::result::Result<(), CoreError> {
        let revision =
            (u64::from(self.generation) << 32) | u64::from(self.cloth.topology_revision());
        if self.lines_of != Some(revision) {
            self.lines_of = Some(revision);
            self.lines.clear();
            let woven = self.cloth.links().filter(|link| link.2 == muslin::LinkKind::Stretch);
            self.lines.extend(woven.flat_map(|(a, b, _)| [a, b]));
        }
        // Asking for normals makes them, which belongs to the stages.
        self.cloth.normals();
        if self.times_stages {
            self.meter.simulated_in(&self.cloth.stats().seconds);
        }
        let view = self.cloth.view();
        let surface = Surface {
            positions: view.positions,
            normals: view.normals,
            uvs: view.uvs,
            frayed: view.frayed,
            indices: view.indices,
            lines: &self.lines,
            span: stage::span(&self.settings),
            revision,
        };
        self.sparks.clear();
        self.sparks.extend(self.afterglow.sparks());
        let density = output.width() as f32 / self.screen.size.x.max(1.0);
        let solids = stage::solids(&self.settings);
        let frame = Frame {
            solids: &solids,
            sight: self.camera.sight(),
            look: self.settings.fabric.look(),
            trail: &self.sparks,
            wireframe: self.settings.wireframe,
            share: self.governor.share(density),
        };
        let start = (self.clock)();
        renderer.take(&surface);
        let taken = (self.clock)();
        renderer.draw(&frame, output)?;
        self.meter.drawn(taken - start, (self.clock)() - taken);
        Ok(())
    }

    /// The numbers of the panel.
    pub fn readout(&self) -> Readout {
        let stats = self.cloth.stats();
        Readout {
            particles: stats.particles,
            constraints: stats.active_constraints,
            pieces: stats.pieces,
            fps: self.meter.fps(),
            milliseconds: self.meter.milliseconds(),
        }
    }

    /// The screen, in the pixels that pointers count in.
    pub fn screen(&self) -> Screen {
        self.screen
    }

    /// The camera rig.
    pub fn camera(&mut self) -> &mut Camera {
        &mut self.camera
    }

    /// Particles across and down the sheet, as it was woven.
    pub fn weave(&self) -> [u32; 2] {
        stage::weave(&self.settings)
    }

    /// Where a particle is [m].
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        self.cloth.positions().get(particle as usize).copied()
    }

    /// Where on the screen a particle appears, in the pixels that pointers count in.
    pub fn particle_on_screen(&self, particle: u32) -> Option<Vec2> {
        let at = self.particle(particle)?;
        let sight = self.camera.sight();
        let normal = sight.project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// The hash of the cloth's state.
    pub fn state_hash(&self) -> u64 {
        self.cloth.state_hash()
    }

    fn hang(&mut self, settings: &Settings) -> Result<()> {
        self.cloth = stage::build(settings, self.calm)?;
        self.cloth.set_clock(self.times_stages.then_some(self.clock));
        self.hands.forget();
        self.generation = self.generation.wrapping_add(1);
        Ok(())
    }

    fn hands(&mut self) -> (&mut Pointers, Scene<'_>) {
        let scene = Scene {
            sight: self.camera.sight(),
            spacing: stage::spacing(&self.settings),
            span: stage::span(&self.settings),
            grab_radius: 0.6 * stage::spacing(&self.settings),
            blade: self.blade || self.settings.blade,
            afterglow: &mut self.afterglow,
            screen: self.screen,
            cloth: &mut self.cloth,
            camera: &mut self.camera,
        };
        (&mut self.hands, scene)
    }
}

#[cfg(test)]
mod tests;
