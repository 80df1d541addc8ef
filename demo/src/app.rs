//! The demo itself, the same behind a window, on a page and in a file: cloth, camera, hands and
//! controls. It knows no platform; those bring events and time, and take pictures.

use glam::{Vec2, Vec3};
use muslin::{Cloth, LinkKind, Result, Stage};
use muslin_scenes::SceneInstance;
use three_d::{CoreError, RenderTarget};

use crate::blade::Afterglow;
use crate::camera::Camera;
use crate::controls::{self, Action, Kind};
use crate::meter::{Governor, Meter, Readout, StageTime};
use crate::pointer::{Cursor, Pointers, Scene, Screen};
use crate::render::trail::Spark;
use crate::render::{Frame, Renderer, Surface};
use crate::settings::Settings;
use crate::stage::{self, Show};

/// The longest frame that the camera eases through [s].
const LONGEST_FRAME: f32 = 0.1;

/// The running demo.
pub struct App {
    settings: Settings,
    cast: SceneInstance,
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
    lines: Vec<Lines>,
    /// Which cloths these are: new ones may count their topology from the start again.
    generation: u32,
}

/// The links of a cloth, as the wireframe shows them.
#[derive(Debug, Default)]
struct Lines {
    ends: Vec<u32>,
    revision: Option<u64>,
}

impl App {
    /// Hangs the sheet. `clock` counts seconds from anywhere; it only times the simulation.
    ///
    /// # Errors
    /// As [`stage::build`].
    pub fn new(mut settings: Settings, clock: fn() -> f64) -> Result<Self> {
        settings.clamp();
        Ok(Self {
            cast: stage::build(&settings, false)?,
            camera: Camera::new(stage::rig(settings.scene)),
            settings,
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
            stage::tune(&mut self.cast, &settings, self.calm)?;
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
                self.cast.cloths.iter_mut().for_each(Cloth::unpin_all);
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
        stage::tune(&mut self.cast, &self.settings, calm)
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
    /// As [`SceneInstance::advance`].
    pub fn frame(&mut self, seconds: f32) -> Result<()> {
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        self.camera.advance(seconds.min(LONGEST_FRAME), self.hands.any());
        let (hands, mut scene) = self.hands();
        hands.follow(&mut scene)?;
        if !self.settings.paused {
            let start = (self.clock)();
            self.cast.advance(seconds)?;
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
        self.set_clocks();
    }

    /// How long each stage takes, while [`App::time_stages`] is on.
    pub fn stage_times(&self) -> Vec<StageTime> {
        self.meter.stages()
    }

    /// Runs exactly so many ticks, whatever the clock says.
    pub fn play(&mut self, ticks: u32) {
        let start = (self.clock)();
        self.cast.step(ticks);
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
        self.lines.resize_with(self.cast.cloths.len(), Lines::default);
        let mut seconds = [0.0; Stage::COUNT];
        for (cloth, lines) in self.cast.cloths.iter_mut().zip(&mut self.lines) {
            lines.follow(cloth, self.generation);
            // Asking for normals makes them, which belongs to the stages.
            cloth.normals();
            for (sum, spent) in seconds.iter_mut().zip(cloth.stats().seconds) {
                *sum += spent;
            }
        }
        if self.times_stages {
            self.meter.simulated_in(&seconds);
        }
        self.sparks.clear();
        self.sparks.extend(self.afterglow.sparks());
        let density = output.width() as f32 / self.screen.size.x.max(1.0);
        let (solids, looks) =
            (stage::solids(&self.settings, &self.cast), stage::looks(&self.settings));
        let frame = Frame {
            solids: &solids,
            sight: self.camera.sight(),
            looks: &looks,
            trail: &self.sparks,
            wireframe: self.settings.wireframe,
            share: self.governor.share(density),
        };
        let start = (self.clock)();
        renderer.expect(self.cast.cloths.len());
        for (i, (cloth, lines)) in self.cast.cloths.iter_mut().zip(&self.lines).enumerate() {
            let view = cloth.view();
            let surface = Surface {
                positions: view.positions,
                unit: stage::unit(self.settings.scene),
                normals: view.normals,
                uvs: view.uvs,
                frayed: view.frayed,
                indices: view.indices,
                lines: &lines.ends,
                span: stage::span(&self.settings),
                is_round: self.settings.scene == Show::Discs,
                revision: lines.revision.unwrap_or_default(),
            };
            renderer.take(i, &surface);
        }
        let taken = (self.clock)();
        renderer.draw(&frame, output)?;
        self.meter.drawn(taken - start, (self.clock)() - taken);
        Ok(())
    }

    /// The numbers of the panel.
    pub fn readout(&self) -> Readout {
        self.meter.readout(&self.cast.cloths)
    }

    /// The screen, in the pixels that pointers count in.
    pub fn screen(&self) -> Screen {
        self.screen
    }

    /// The camera rig.
    pub fn camera(&mut self) -> &mut Camera {
        &mut self.camera
    }

    /// Particles across and down the sheet, as it was woven; of discs there is no such thing.
    pub fn weave(&self) -> Option<[u32; 2]> {
        stage::weave(&self.settings)
    }

    /// Where a particle of the first cloth is, as it is drawn [m].
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        let at = self.cast.cloths.first()?.positions().get(particle as usize)?;
        Some(*at / stage::unit(self.settings.scene))
    }

    /// Where on the screen a particle of the first cloth appears, in the pixels that pointers count in.
    pub fn particle_on_screen(&self, particle: u32) -> Option<Vec2> {
        let at = self.particle(particle)?;
        let sight = self.camera.sight();
        let normal = sight.project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// The hash of the cloths' states; one cloth's own if there is one.
    pub fn state_hash(&self) -> u64 {
        let hashes = self.cast.cloths.iter().map(Cloth::state_hash);
        hashes.fold(0, |all, hash| all.rotate_left(1) ^ hash)
    }

    fn hang(&mut self, settings: &Settings) -> Result<()> {
        self.cast = stage::build(settings, self.calm)?;
        self.set_clocks();
        if settings.scene != self.settings.scene {
            self.camera.go_to(stage::rig(settings.scene), self.screen.aspect());
        }
        self.hands.forget();
        self.generation = self.generation.wrapping_add(1);
        Ok(())
    }

    fn set_clocks(&mut self) {
        let clock = self.times_stages.then_some(self.clock);
        self.cast.cloths.iter_mut().for_each(|cloth| cloth.set_clock(clock));
    }

    fn hands(&mut self) -> (&mut Pointers, Scene<'_>) {
        let unit = stage::unit(self.settings.scene);
        let scene = Scene {
            unit,
            sight: self.camera.sight().scaled(unit),
            spacing: stage::spacing(&self.settings),
            span: stage::span(&self.settings),
            blade: self.blade || self.settings.blade,
            afterglow: &mut self.afterglow,
            screen: self.screen,
            cloths: &mut self.cast.cloths,
            camera: &mut self.camera,
        };
        (&mut self.hands, scene)
    }
}

impl Lines {
    /// Finds the links anew if others hold than before.
    fn follow(&mut self, cloth: &Cloth, generation: u32) {
        let revision = (u64::from(generation) << 32) | u64::from(cloth.topology_revision());
        if self.revision != Some(revision) {
            self.revision = Some(revision);
            self.ends.clear();
            let woven = cloth.links().filter(|link| link.2 == LinkKind::Stretch);
            self.ends.extend(woven.flat_map(|(a, b, _)| [a, b]));
        }
    }
}

#[cfg(test)]
mod tests;
