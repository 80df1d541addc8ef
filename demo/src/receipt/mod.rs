//! ReceiptApp: a receipt that hangs from two pins, to fold, crumple and toss. The same behind a window, on a
//! page and in a file, like [`crate::app`].
//!
//! What is drawn is measured in the brief's units, what moves in metres: [`Sheet::unit`] of them a unit.

pub mod crease;
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

use crate::camera::{Camera, CameraRig};
use crate::meter::{Meter, Readout, ResolutionScaler, StageTime};
use crate::picking::Screen;
use crate::pointer::Cursor;
use crease::Creases;
use letter_fold::LetterFold;
use pointers::{PressKind, ReceiptPickContext, ReceiptPointers};
use return_animation::ReturnAnimation;
pub use settings::{ReceiptAction, ReceiptControl, ReceiptSettings};

/// Length of a tick [s], and the longest frame that ticks are run for.
pub const TICK: f32 = 1.0 / 120.0;
const LONGEST_FRAME: f32 = 0.033;
/// What the ticks of a frame may take [s]: where they take longer, as paper does in a fist, time runs slower
/// rather than in jerks.
const PATIENCE: f64 = 0.025;

/// How much farther than the paper reaches a hand may pull until it comes off a pin.
const HOLD: f32 = 1.02;

/// What the camera looks at, in units.
pub const TARGET: Vec3 = Vec3::new(0.0, -1.0, 0.0);

/// The running scene.
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
    /// Time that frames brought and no tick has run yet [s].
    unspent_time: f32,
    meter: Meter,
    resolution_scaler: ResolutionScaler,
    clock: fn() -> f64,
    positions: Vec<Vec3>,
    generation: u32,
    times_stages: bool,
}

impl ReceiptApp {
    /// Hangs the receipt, one of fewer particles if `small`. `clock` counts seconds from anywhere.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn new(settings: ReceiptSettings, small: bool, clock: fn() -> f64) -> Result<Self> {
        let cloth = settings.sheet.hang(small)?;
        let mut tender = Self {
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
        tender.camera.set_drift(false);
        tender.apply_wind()?;
        Ok(tender)
    }

    /// The controls' values.
    pub fn settings(&self) -> &ReceiptSettings {
        &self.settings
    }

    /// Takes other values.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn set_settings(&mut self, settings: ReceiptSettings) -> Result<()> {
        let rehang = settings.sheet != self.settings.sheet;
        self.settings = settings;
        if rehang { self.rebuild_cloth() } else { self.apply_wind() }
    }

    /// Does what a key does, and says whether it was one.
    ///
    /// # Errors
    /// As [`ReceiptApp::act`].
    pub fn key(&mut self, key: char) -> Result<bool> {
        let Some(control) = settings::find_control_by_key(key) else {
            return Ok(false);
        };
        self.act(control.action)?;
        Ok(true)
    }

    /// Does what a control says.
    ///
    /// # Errors
    /// As [`Sheet::hang`] and [`Cloth::grab_particle`].
    pub fn act(&mut self, action: ReceiptAction) -> Result<()> {
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

    /// Whether people ask for less motion: no wind, and no more than the smaller sheet.
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

    /// The screen has this size, in the pixels that pointers count in.
    pub fn resize(&mut self, size: Vec2) {
        if size.is_finite() && size.min_element() >= 1.0 && size != self.screen.size {
            self.screen.size = size;
            self.camera.fit_to_aspect(self.screen.aspect());
        }
    }

    /// A pointer comes down.
    ///
    /// # Errors
    /// As [`ReceiptPointers::press`].
    pub fn press(&mut self, id: u32, at: Vec2, button: PressKind) -> Result<()> {
        // What is on its way back cannot be held.
        if self.return_animation.is_some() && button == PressKind::Main {
            return Ok(());
        }
        let (pointers, mut pick) = self.pick_context();
        pointers.press(id, at, button, &mut pick)
    }

    /// A pointer moves.
    pub fn drag(&mut self, id: u32, to: Vec2) {
        let (pointers, mut pick) = self.pick_context();
        pointers.drag(id, to, &mut pick);
    }

    /// A pointer goes up, or is lost.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.lift(id, &mut pick)
    }

    /// The mouse has left the screen.
    pub fn clear_hover(&mut self) {
        self.pointers.clear_hover();
    }

    /// The key that leaves pointers where they are goes down, or up, and they let go.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn set_leave_in_place(&mut self, on: bool) -> Result<()> {
        let (pointers, mut pick) = self.pick_context();
        pointers.set_leave_in_place(on, &mut pick)
    }

    /// A finger runs along the bend under a point of the screen and makes it a crease; says whether there
    /// was one. Only paper keeps it.
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

    /// The wheel turns by so many pixels, away from the paper if positive.
    pub fn wheel(&mut self, pixels: f32) {
        self.camera.zoom((0.0012 * pixels.clamp(-400.0, 400.0)).exp());
    }

    /// A trackpad's pinch: the camera comes nearer by `factor` above one.
    pub fn pinch(&mut self, factor: f32) {
        self.camera.zoom(1.0 / factor);
    }

    /// What the cursor should say.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn cursor(&mut self) -> Result<Cursor> {
        let (pointers, pick) = self.pick_context();
        pointers.cursor(&pick)
    }

    /// Lets `seconds` pass.
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
            self.run_ticks_while(ticks, || clock() - start < PATIENCE)?;
            self.meter.record_simulation(clock() - start);
        }
        self.meter.record_frame(seconds);
        self.resolution_scaler.record_frame(seconds);
        Ok(())
    }

    /// Runs exactly so many ticks, whatever the clock says.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn play(&mut self, ticks: u32) -> Result<()> {
        self.run_ticks_while(ticks, || true)
    }

    /// Runs so many ticks, one at least, as long as there is time.
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
        }
        Ok(())
    }

    /// Times every stage of a frame from now on, or no longer.
    pub fn time_stages(&mut self, on: bool) {
        self.times_stages = on;
        self.cloth.set_clock(on.then_some(self.clock));
    }

    /// How long each stage takes, while [`ReceiptApp::time_stages`] is on.
    pub fn stage_times(&self) -> Vec<StageTime> {
        self.meter.stages()
    }

    /// The numbers of the counter.
    pub fn readout(&self) -> Readout {
        self.meter.readout(std::slice::from_ref(&self.cloth))
    }

    /// The receipt.
    pub fn cloth(&self) -> &Cloth {
        &self.cloth
    }

    /// The camera rig, in units.
    pub fn camera(&mut self) -> &mut Camera {
        &mut self.camera
    }

    /// Width and height of the sheet, in units.
    pub fn span(&self) -> Vec2 {
        self.settings.sheet.span(self.small)
    }

    /// Particles across and down.
    pub fn grid_size(&self) -> [u32; 2] {
        self.settings.sheet.grid_size(self.small)
    }

    /// Where a particle is, in units.
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        let at = self.cloth.positions().get(particle as usize)?;
        Some(*at / self.settings.sheet.unit())
    }

    /// Where on the screen a place appears that is given in units.
    pub fn on_screen(&self, at: Vec3) -> Option<Vec2> {
        let normal = self.camera.view().project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// Whether the receipt is on its way back to its pins.
    pub fn is_returning(&self) -> bool {
        self.return_animation.is_some()
    }

    /// Whether it is being crumpled.
    pub fn is_crumpling(&self) -> bool {
        self.squeeze.is_some()
    }

    /// A fresh receipt.
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

    /// Half a second's way back to the pins, from wherever it is.
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

    /// The way back is done: the receipt is as new.
    fn finish_reset(&mut self) {
        self.cloth.reset();
        self.clear_actions();
        // Creases are gone, those of the roll too, and the brief's masses.
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
        let (pointers, mut pick) = self.pick_context();
        pointers.release_all(&mut pick)?;
        self.cloth.unpin_all();
        let unit = self.settings.sheet.unit();
        self.squeeze = Some(Squeeze::new(&mut self.cloth, unit)?);
        Ok(())
    }

    fn fold(&mut self) -> Result<()> {
        if self.is_busy() {
            return Ok(());
        }
        let (pointers, mut pick) = self.pick_context();
        pointers.release_all(&mut pick)?;
        self.cloth.unpin_all();
        let sheet = self.settings.sheet;
        let desc = sheet.desc(self.small);
        self.letter_fold = Some(LetterFold::new(&mut self.cloth, desc, sheet.unit())?);
        Ok(())
    }

    /// Whether pointers of its own do something with it.
    fn is_busy(&self) -> bool {
        self.squeeze.is_some() || self.letter_fold.is_some() || self.return_animation.is_some()
    }

    /// Paper comes off a pin that a hand pulls it away from.
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
                particle == pin || to.distance(at) > HOLD * place(particle).distance(place(pin))
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

/// The camera of the brief, in units.
fn rig() -> CameraRig {
    CameraRig {
        target: TARGET,
        polar: 0.15..=1.56,
        radius: 4.0..=30.0,
        start: [0.26, 1.43, 17.4],
        half_width: 2.9,
    }
}

#[cfg(test)]
mod tests;
