//! The receipt scene ("Tender"): a paper receipt on two pins, to fold, crumple and toss. Like
//! [`crate::app`], it is independent of the platform.
//!
//! Method: fixed ticks of 1/120 s; slow frames run in slow motion and drop the backlog.
//!
//! Reads events, frame times and [`ReceiptSettings`]; writes the cloth, the camera and the pixels
//! of the render target.
//!
//! Invariant: drawing and camera use units, the simulation uses metres; [`Sheet::unit`] converts.

pub mod camera_rig;
pub mod crease;
pub mod crease_map;
mod draw;
pub mod gestures;
pub mod ink_map;
pub mod letter_fold;
#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod pointers;
pub mod receipt_text;
pub mod return_animation;
pub mod settings;

use glam::{Vec2, Vec3};
use muslin::{Cloth, Result};
use muslin_scenes::receipt::Sheet;
use muslin_scenes::squeeze::Squeeze;

use crate::camera::Camera;
use crate::meter::{Meter, Readout, ResolutionScaler, StageTime};
use crate::picking::Screen;
use crate::pointer::Cursor;
pub use camera_rig::TARGET;
use camera_rig::rig;
use crease::Creases;
use letter_fold::LetterFold;
use pointers::{PressKind, ReceiptPickContext, ReceiptPointers};
use return_animation::ReturnAnimation;
pub use settings::{ReceiptAction, ReceiptControl, ReceiptSettings};

/// Duration of a tick [s], and longest frame time that ticks are run for [s].
pub const TICK: f32 = 1.0 / 120.0;
const LONGEST_FRAME: f32 = 0.033;
/// Time limit for the ticks of a frame [s]; beyond it the scene runs in slow motion.
const MAX_TICK_SECONDS: f64 = 0.025;

/// Factor of the rest distance to a pin; a grab that is farther away pulls the paper off the pin.
const PULL_OFF_FACTOR: f32 = 1.02;

/// The running receipt scene.
pub struct ReceiptApp {
    settings: ReceiptSettings,
    small: bool,
    reduced_motion: bool,
    cloth: Cloth,
    camera: Camera,
    pointers: ReceiptPointers,
    creases: Creases,
    squeeze: Option<Squeeze>,
    letter_fold: Option<LetterFold>,
    return_animation: Option<ReturnAnimation>,
    screen: Screen,
    /// Frame time that no tick has used yet [s].
    unspent_time: f32,
    meter: Meter,
    resolution_scaler: ResolutionScaler,
    clock: fn() -> f64,
    positions: Vec<Vec3>,
    generation: u32,
    times_stages: bool,
}

impl ReceiptApp {
    /// Creates the receipt on its pins, with fewer particles if `small`. `clock` returns seconds.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn new(settings: ReceiptSettings, small: bool, clock: fn() -> f64) -> Result<Self> {
        let cloth = settings.sheet.hang(small)?;
        let mut app = Self {
            camera: Camera::new(rig()),
            cloth,
            settings,
            small,
            reduced_motion: false,
            pointers: ReceiptPointers::default(),
            creases: Creases::default(),
            squeeze: None,
            letter_fold: None,
            return_animation: None,
            screen: Screen { size: Vec2::new(1280.0, 720.0) },
            unspent_time: 0.0,
            meter: Meter::default(),
            resolution_scaler: ResolutionScaler::default(),
            clock,
            positions: Vec::new(),
            generation: 0,
            times_stages: false,
        };
        app.camera.set_drift(false);
        app.apply_wind()?;
        Ok(app)
    }

    /// Returns the values of the controls.
    pub fn settings(&self) -> &ReceiptSettings {
        &self.settings
    }

    /// Applies new settings; a new sheet type rebuilds the cloth.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn set_settings(&mut self, settings: ReceiptSettings) -> Result<()> {
        let rehang = settings.sheet != self.settings.sheet;
        self.settings = settings;
        if rehang { self.rebuild_cloth() } else { self.apply_wind() }
    }

    /// Runs the action of a key; returns whether it has one.
    ///
    /// # Errors
    /// As [`ReceiptApp::run_action`].
    pub fn key(&mut self, key: char) -> Result<bool> {
        let Some(control) = settings::find_control_by_key(key) else {
            return Ok(false);
        };
        self.run_action(control.action)?;
        Ok(true)
    }

    /// Runs the action of a control.
    ///
    /// # Errors
    /// As [`Sheet::hang`] and [`Cloth::grab_particle`].
    pub fn run_action(&mut self, action: ReceiptAction) -> Result<()> {
        let mut settings = self.settings.clone();
        match action {
            ReceiptAction::Wind => settings.wind = !settings.wind,
            ReceiptAction::Pause => settings.paused = !settings.paused,
            ReceiptAction::Counter => settings.counter = !settings.counter,
            ReceiptAction::Sheet => settings.sheet = settings.sheet.other(),
            ReceiptAction::Reset => return self.reset(),
            ReceiptAction::Drop => self.cloth.unpin_all(),
            ReceiptAction::Crumple => return self.crumple(),
            ReceiptAction::Fold => return self.fold(),
        }
        self.set_settings(settings)
    }

    /// Sets whether the user prefers reduced motion: no wind, and the smaller sheet.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn set_reduced_motion(&mut self, reduced_motion: bool) -> Result<()> {
        self.reduced_motion = reduced_motion;
        if reduced_motion && !self.small {
            self.small = true;
            return self.rebuild_cloth();
        }
        self.apply_wind()
    }

    /// Sets the size of the screen, in logical pixels.
    pub fn resize(&mut self, size: Vec2) {
        if size.is_finite() && size.min_element() >= 1.0 && size != self.screen.size {
            self.screen.size = size;
            self.camera.fit_to_aspect(self.screen.aspect());
        }
    }

    /// Handles a pressed pointer, in logical pixels.
    ///
    /// # Errors
    /// As [`ReceiptPointers::press`].
    pub fn press(&mut self, id: u32, at: Vec2, button: PressKind) -> Result<()> {
        // The paper cannot be grabbed while the reset animation runs.
        if self.return_animation.is_some() && button == PressKind::Main {
            return Ok(());
        }
        let (pointers, mut pick) = self.pick_context();
        pointers.press(id, at, button, &mut pick)
    }

    /// Handles a moved pointer, in logical pixels.
    pub fn drag(&mut self, id: u32, to: Vec2) {
        let (pointers, mut pick) = self.pick_context();
        pointers.drag(id, to, &mut pick);
    }

    /// Handles a released or lost pointer.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.lift(id, &mut pick)
    }

    /// Handles a mouse that leaves the screen: there is no hover position any more.
    pub fn clear_hover(&mut self) {
        self.pointers.clear_hover();
    }

    /// Sets whether released pointers leave their grabs in place; switching it off releases those
    /// grabs.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn set_leave_in_place(&mut self, on: bool) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.set_leave_in_place(on, &mut pick)
    }

    /// Creases the bend under a point of the screen; returns whether there is one. Only the paper
    /// sheet keeps creases.
    ///
    /// # Errors
    /// As [`Cloth::crease`].
    pub fn crease(&mut self, at: Vec2) -> Result<bool> {
        if self.settings.sheet != Sheet::Paper || self.return_animation.is_some() {
            return Ok(false);
        }
        let (_, pick) = self.pick_context();
        let ray = pick.ray(at);
        let Some(hit) = pick.cloth.raycast(pick.view.eye, ray, f32::INFINITY)? else {
            return Ok(false);
        };
        let desc = self.settings.sheet.desc(self.small);
        self.creases.press(&mut self.cloth, &desc, hit.particle)
    }

    /// Zooms by the wheel; positive `pixels` move the camera away from the paper.
    pub fn wheel(&mut self, pixels: f32) {
        self.camera.zoom((0.0012 * pixels.clamp(-400.0, 400.0)).exp());
    }

    /// Zooms by a pinch gesture; a `factor` above one moves the camera nearer.
    pub fn pinch(&mut self, factor: f32) {
        self.camera.zoom(1.0 / factor);
    }

    /// Returns the shape of the mouse cursor.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn cursor(&mut self) -> Result<Cursor> {
        let (pointers, pick) = self.pick_context();
        pointers.cursor(&pick)
    }

    /// Advances camera, grabs and cloth by a frame of `seconds` [s].
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn frame(&mut self, seconds: f32) -> Result<()> {
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        let step = seconds.min(LONGEST_FRAME);
        self.camera.advance(step, self.pointers.is_any_down());
        if let Some(mut return_animation) = self.return_animation.take() {
            if return_animation.advance(step, &mut self.cloth)? {
                self.return_animation = Some(return_animation);
            } else {
                self.finish_reset();
            }
        } else if !self.settings.paused {
            self.unspent_time += step;
            let ticks = (self.unspent_time / TICK) as u32;
            self.unspent_time -= ticks as f32 * TICK;
            let (clock, start) = (self.clock, (self.clock)());
            self.run_ticks_while(ticks, || clock() - start < MAX_TICK_SECONDS)?;
            self.meter.record_simulation(clock() - start);
        }
        self.meter.record_frame(seconds);
        self.resolution_scaler.record_frame(seconds);
        Ok(())
    }

    /// Runs exactly `ticks` ticks, independent of the clock.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn play(&mut self, ticks: u32) -> Result<()> {
        self.run_ticks_while(ticks, || true)
    }

    /// Runs up to `ticks` ticks, at least one, while `has_time` returns true.
    fn run_ticks_while(&mut self, ticks: u32, has_time: impl Fn() -> bool) -> Result<()> {
        if ticks > 0 {
            let (pointers, mut pick) = self.pick_context();
            pointers.update_targets(&mut pick)?;
        }
        for tick in 0..ticks {
            if tick > 0 && !has_time() {
                return Ok(());
            }
            self.pointers.tick(TICK, &mut self.cloth)?;
            self.unpin_pulled()?;
            if let Some(mut squeeze) = self.squeeze.take()
                && squeeze.tick(TICK, &mut self.cloth)?
            {
                self.squeeze = Some(squeeze);
            }
            if let Some(mut letter_fold) = self.letter_fold.take()
                && letter_fold.tick(TICK, &mut self.cloth)?
            {
                self.letter_fold = Some(letter_fold);
            }
            self.cloth.step(1);
            self.creases.record(&self.cloth, self.settings.sheet, self.grid_size());
        }
        Ok(())
    }

    /// Switches the timing of every stage of a frame on or off.
    pub fn time_stages(&mut self, on: bool) {
        self.times_stages = on;
        self.cloth.set_clock(on.then_some(self.clock));
    }

    /// Returns how long each stage takes in a frame, while [`ReceiptApp::time_stages`] is on.
    pub fn stage_times(&self) -> Vec<StageTime> {
        self.meter.stages()
    }

    /// Returns the numbers that the counter shows.
    pub fn readout(&self) -> Readout {
        self.meter.readout(std::slice::from_ref(&self.cloth))
    }

    /// Returns the cloth of the receipt.
    pub fn cloth(&self) -> &Cloth {
        &self.cloth
    }

    /// Returns the camera, in units.
    pub fn camera(&mut self) -> &mut Camera {
        &mut self.camera
    }

    /// Returns width and height of the sheet, in units.
    pub fn span(&self) -> Vec2 {
        self.settings.sheet.span(self.small)
    }

    /// Returns the numbers of particles across and down.
    pub fn grid_size(&self) -> [u32; 2] {
        self.settings.sheet.grid_size(self.small)
    }

    /// Returns the position of a particle, in units.
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        let at = self.cloth.positions().get(particle as usize)?;
        Some(*at / self.settings.sheet.unit())
    }

    /// Projects a position in units to the screen [px].
    pub fn on_screen(&self, at: Vec3) -> Option<Vec2> {
        let normal = self.camera.view().project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// Returns whether the reset animation runs.
    pub fn is_returning(&self) -> bool {
        self.return_animation.is_some()
    }

    /// Returns whether the crumple animation runs.
    pub fn is_crumpling(&self) -> bool {
        self.squeeze.is_some()
    }

    /// Replaces the cloth by a new one on its pins.
    fn rebuild_cloth(&mut self) -> Result<()> {
        self.cloth = self.settings.sheet.hang(self.small)?;
        self.cloth.set_clock(self.times_stages.then_some(self.clock));
        self.pointers.clear();
        self.clear_actions();
        self.apply_wind()
    }

    fn apply_wind(&mut self) -> Result<()> {
        let blows = self.settings.wind && !self.reduced_motion;
        self.cloth.set_wind(self.settings.sheet.wind(blows))
    }

    /// Starts the animation of half a second that brings the receipt back to its pins.
    fn reset(&mut self) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.release_all(&mut pick)?;
        if let Some(squeeze) = self.squeeze.take() {
            squeeze.release(&mut self.cloth)?;
        }
        if let Some(letter_fold) = self.letter_fold.take() {
            letter_fold.release(&mut self.cloth)?;
        }
        let desc = self.settings.sheet.desc(self.small);
        self.return_animation = Some(ReturnAnimation::new(&self.cloth, &desc));
        Ok(())
    }

    /// Ends the reset animation: the receipt is in its initial state.
    fn finish_reset(&mut self) {
        self.cloth.reset();
        self.clear_actions();
        // The reset of the cloth also removed the initial curl and the specified masses.
        if let Err(error) = self.settings.sheet.apply_initial_state(&mut self.cloth, self.small) {
            unreachable!("the scene's own sheet: {error}");
        }
    }

    fn clear_actions(&mut self) {
        self.creases = Creases::default();
        self.squeeze = None;
        self.letter_fold = None;
        self.return_animation = None;
        self.unspent_time = 0.0;
        self.generation = self.generation.wrapping_add(1);
    }

    fn crumple(&mut self) -> Result<()> {
        if self.is_busy() {
            return Ok(());
        }
        self.free_paper()?;
        let unit = self.settings.sheet.unit();
        self.squeeze = Some(Squeeze::new(&mut self.cloth, unit)?);
        Ok(())
    }

    fn fold(&mut self) -> Result<()> {
        if self.is_busy() {
            return Ok(());
        }
        self.free_paper()?;
        let sheet = self.settings.sheet;
        let desc = sheet.desc(self.small);
        self.letter_fold = Some(LetterFold::new(&mut self.cloth, desc, sheet.unit())?);
        Ok(())
    }

    /// Releases all grabs and pins.
    fn free_paper(&mut self) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.release_all(&mut pick)?;
        self.cloth.unpin_all();
        Ok(())
    }

    /// Returns whether an animation moves the paper.
    fn is_busy(&self) -> bool {
        self.squeeze.is_some() || self.letter_fold.is_some() || self.return_animation.is_some()
    }

    /// Unpins the particles whose pin a grab pulls the paper away from.
    fn unpin_pulled(&mut self) -> Result<()> {
        if self.settings.sheet != Sheet::Paper || !self.pointers.holds_cloth() {
            return Ok(());
        }
        let desc = self.settings.sheet.desc(self.small);
        let place = |particle: u32| {
            let [row, column] = [particle / desc.columns, particle % desc.columns];
            Vec2::new(column as f32, row as f32) * desc.spacing
        };
        let pins: Vec<u32> = self.cloth.pinned().collect();
        for pin in pins {
            let at = self.cloth.positions()[pin as usize];
            let pulled = self.pointers.grabs().any(|(particle, to)| {
                particle == pin
                    || to.distance(at) > PULL_OFF_FACTOR * place(particle).distance(place(pin))
            });
            if pulled {
                self.cloth.unpin(pin)?;
            }
        }
        Ok(())
    }

    fn pick_context(&mut self) -> (&mut ReceiptPointers, ReceiptPickContext<'_>) {
        let unit = self.settings.sheet.unit();
        let pick = ReceiptPickContext {
            view: self.camera.view().scaled(unit),
            columns: self.grid_size()[0],
            slides: self.settings.sheet == Sheet::Paper,
            unit,
            screen: self.screen,
            cloth: &mut self.cloth,
            camera: &mut self.camera,
        };
        (&mut self.pointers, pick)
    }
}

#[cfg(test)]
mod tests;
