//! Tender: a receipt that hangs from two pins, to fold, crumple and toss. The same behind a window, on a
//! page and in a file, like [`crate::app`].
//!
//! What is drawn is measured in the brief's units, what moves in metres: [`Sheet::unit`] of them a unit.

pub mod bill;
pub mod crease;
mod drawn;
pub mod hands;
pub mod letter;
#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod play;
pub mod print;
pub mod put_back;
pub mod settings;

use glam::{Vec2, Vec3};
use muslin::{Cloth, Result};
use muslin_scenes::receipt::Sheet;
use muslin_scenes::squeeze::Squeeze;

use crate::camera::{Camera, Rig};
use crate::meter::{Governor, Meter, Readout, StageTime};
use crate::pointer::{Cursor, Screen};
use crease::Creases;
use hands::{Button, Hands, Table};
use letter::Letter;
use put_back::PutBack;
pub use settings::{Action, Control, Settings};

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
pub struct Tender {
    settings: Settings,
    small: bool,
    calm: bool,
    cloth: Cloth,
    camera: Camera,
    hands: Hands,
    creases: Creases,
    squeeze: Option<Squeeze>,
    letter: Option<Letter>,
    put_back: Option<PutBack>,
    screen: Screen,
    /// Time that frames brought and no tick has run yet [s].
    owed: f32,
    meter: Meter,
    governor: Governor,
    clock: fn() -> f64,
    positions: Vec<Vec3>,
    generation: u32,
    times_stages: bool,
}

impl Tender {
    /// Hangs the receipt, one of fewer particles if `small`. `clock` counts seconds from anywhere.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn new(settings: Settings, small: bool, clock: fn() -> f64) -> Result<Self> {
        let cloth = settings.sheet.hang(small)?;
        let mut tender = Self {
            camera: Camera::new(rig()),
            cloth,
            settings,
            small,
            calm: false,
            hands: Hands::default(),
            creases: Creases::default(),
            squeeze: None,
            letter: None,
            put_back: None,
            screen: Screen { size: Vec2::new(1280.0, 720.0) },
            owed: 0.0,
            meter: Meter::default(),
            governor: Governor::default(),
            clock,
            positions: Vec::new(),
            generation: 0,
            times_stages: false,
        };
        tender.camera.set_drift(false);
        tender.blow()?;
        Ok(tender)
    }

    /// The controls' values.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Takes other values.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn set_settings(&mut self, settings: Settings) -> Result<()> {
        let rehang = settings.sheet != self.settings.sheet;
        self.settings = settings;
        if rehang { self.hang() } else { self.blow() }
    }

    /// Does what a key does, and says whether it was one.
    ///
    /// # Errors
    /// As [`Tender::act`].
    pub fn key(&mut self, key: char) -> Result<bool> {
        let Some(control) = settings::of_key(key) else {
            return Ok(false);
        };
        self.act(control.action)?;
        Ok(true)
    }

    /// Does what a control says.
    ///
    /// # Errors
    /// As [`Sheet::hang`] and [`Cloth::grab_particle`].
    pub fn act(&mut self, action: Action) -> Result<()> {
        let mut settings = self.settings.clone();
        match action {
            Action::Wind => settings.wind = !settings.wind,
            Action::Pause => settings.paused = !settings.paused,
            Action::Counter => settings.counter = !settings.counter,
            Action::Sheet => settings.sheet = settings.sheet.other(),
            Action::Reset => return self.reset(),
            Action::Drop => self.cloth.unpin_all(),
            Action::Crumple => return self.crumple(),
            Action::Fold => return self.fold(),
        }
        self.set_settings(settings)
    }

    /// Whether people ask for less motion: no wind, and no more than the smaller sheet.
    ///
    /// # Errors
    /// As [`Sheet::hang`].
    pub fn set_calm(&mut self, calm: bool) -> Result<()> {
        self.calm = calm;
        if calm && !self.small {
            self.small = true;
            return self.hang();
        }
        self.blow()
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
    /// As [`Hands::press`].
    pub fn press(&mut self, id: u32, at: Vec2, button: Button) -> Result<()> {
        // What is on its way back cannot be held.
        if self.put_back.is_some() && button == Button::Main {
            return Ok(());
        }
        let (hands, mut table) = self.hands();
        hands.press(id, at, button, &mut table)
    }

    /// A pointer moves.
    pub fn drag(&mut self, id: u32, to: Vec2) {
        let (hands, mut table) = self.hands();
        hands.drag(id, to, &mut table);
    }

    /// A pointer goes up, or is lost.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32) -> Result<()> {
        let (hands, mut table) = self.hands();
        hands.lift(id, &mut table)
    }

    /// The mouse has left the screen.
    pub fn leave(&mut self) {
        self.hands.leave();
    }

    /// The key that leaves hands where they are goes down, or up, and they let go.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn stay(&mut self, on: bool) -> Result<()> {
        let (hands, mut table) = self.hands();
        hands.stay(on, &mut table)
    }

    /// A finger runs along the bend under a point of the screen and makes it a crease; says whether there
    /// was one. Only paper keeps it.
    ///
    /// # Errors
    /// As [`Cloth::crease`].
    pub fn crease(&mut self, at: Vec2) -> Result<bool> {
        if self.settings.sheet != Sheet::Paper || self.put_back.is_some() {
            return Ok(false);
        }
        let (_, table) = self.hands();
        let ray = table.ray(at);
        let Some(hit) = table.cloth.raycast(table.sight.eye, ray, f32::INFINITY)? else {
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
        let (hands, table) = self.hands();
        hands.cursor(&table)
    }

    /// Lets `seconds` pass.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn frame(&mut self, seconds: f32) -> Result<()> {
        let seconds = if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        let step = seconds.min(LONGEST_FRAME);
        self.camera.advance(step, self.hands.any());
        if let Some(mut put_back) = self.put_back.take() {
            if put_back.advance(step, &mut self.cloth)? {
                self.put_back = Some(put_back);
            } else {
                self.settle();
            }
        } else if !self.settings.paused {
            self.owed += step;
            let ticks = (self.owed / TICK) as u32;
            self.owed -= ticks as f32 * TICK;
            let (clock, start) = (self.clock, (self.clock)());
            self.play_while(ticks, || clock() - start < PATIENCE)?;
            self.meter.simulated(clock() - start);
        }
        self.meter.frame(seconds);
        self.governor.frame(seconds);
        Ok(())
    }

    /// Runs exactly so many ticks, whatever the clock says.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn play(&mut self, ticks: u32) -> Result<()> {
        self.play_while(ticks, || true)
    }

    /// Runs so many ticks, one at least, as long as there is time.
    fn play_while(&mut self, ticks: u32, has_time: impl Fn() -> bool) -> Result<()> {
        if ticks > 0 {
            let (hands, mut table) = self.hands();
            hands.follow(&mut table)?;
        }
        for tick in 0..ticks {
            if tick > 0 && !has_time() {
                return Ok(());
            }
            self.hands.tick(TICK, &mut self.cloth)?;
            self.pull_off()?;
            if let Some(mut squeeze) = self.squeeze.take()
                && squeeze.tick(TICK, &mut self.cloth)?
            {
                self.squeeze = Some(squeeze);
            }
            if let Some(mut letter) = self.letter.take()
                && letter.tick(TICK, &mut self.cloth)?
            {
                self.letter = Some(letter);
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

    /// How long each stage takes, while [`Tender::time_stages`] is on.
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
    pub fn weave(&self) -> [u32; 2] {
        self.settings.sheet.grid_size(self.small)
    }

    /// Where a particle is, in units.
    pub fn particle(&self, particle: u32) -> Option<Vec3> {
        let at = self.cloth.positions().get(particle as usize)?;
        Some(*at / self.settings.sheet.unit())
    }

    /// Where on the screen a place appears that is given in units.
    pub fn on_screen(&self, at: Vec3) -> Option<Vec2> {
        let normal = self.camera.sight().project(at, self.screen.aspect())?;
        Some(self.screen.pixels(normal))
    }

    /// Whether the receipt is on its way back to its pins.
    pub fn is_put_back(&self) -> bool {
        self.put_back.is_some()
    }

    /// Whether it is being crumpled.
    pub fn is_squeezed(&self) -> bool {
        self.squeeze.is_some()
    }

    /// A fresh receipt.
    fn hang(&mut self) -> Result<()> {
        self.cloth = self.settings.sheet.hang(self.small)?;
        self.cloth.set_clock(self.times_stages.then_some(self.clock));
        self.hands.forget();
        self.forget();
        self.blow()
    }

    fn blow(&mut self) -> Result<()> {
        let blows = self.settings.wind && !self.calm;
        self.cloth.set_wind(self.settings.sheet.wind(blows))
    }

    /// Half a second's way back to the pins, from wherever it is.
    fn reset(&mut self) -> Result<()> {
        let (hands, mut table) = self.hands();
        hands.open(&mut table)?;
        if let Some(squeeze) = self.squeeze.take() {
            squeeze.release(&mut self.cloth)?;
        }
        if let Some(letter) = self.letter.take() {
            letter.release(&mut self.cloth)?;
        }
        let desc = self.settings.sheet.desc(self.small);
        self.put_back = Some(PutBack::new(&self.cloth, &desc));
        Ok(())
    }

    /// The way back is done: the receipt is as new.
    fn settle(&mut self) {
        self.cloth.reset();
        self.forget();
        // Creases are gone, those of the roll too, and the brief's masses.
        if let Err(error) = self.settings.sheet.apply_initial_state(&mut self.cloth, self.small) {
            unreachable!("the scene's own sheet: {error}");
        }
    }

    fn forget(&mut self) {
        self.creases = Creases::default();
        self.squeeze = None;
        self.letter = None;
        self.put_back = None;
        self.owed = 0.0;
        self.generation = self.generation.wrapping_add(1);
    }

    fn crumple(&mut self) -> Result<()> {
        if self.is_handled() {
            return Ok(());
        }
        let (hands, mut table) = self.hands();
        hands.open(&mut table)?;
        self.cloth.unpin_all();
        let unit = self.settings.sheet.unit();
        self.squeeze = Some(Squeeze::new(&mut self.cloth, unit)?);
        Ok(())
    }

    fn fold(&mut self) -> Result<()> {
        if self.is_handled() {
            return Ok(());
        }
        let (hands, mut table) = self.hands();
        hands.open(&mut table)?;
        self.cloth.unpin_all();
        let sheet = self.settings.sheet;
        let desc = sheet.desc(self.small);
        self.letter = Some(Letter::new(&mut self.cloth, desc, sheet.unit())?);
        Ok(())
    }

    /// Whether hands of its own do something with it.
    fn is_handled(&self) -> bool {
        self.squeeze.is_some() || self.letter.is_some() || self.put_back.is_some()
    }

    /// Paper comes off a pin that a hand pulls it away from.
    fn pull_off(&mut self) -> Result<()> {
        if self.settings.sheet != Sheet::Paper || !self.hands.holds_paper() {
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
            let pulled = self.hands.grips().any(|(particle, to)| {
                particle == pin || to.distance(at) > HOLD * place(particle).distance(place(pin))
            });
            if pulled {
                self.cloth.unpin(pin)?;
            }
        }
        Ok(())
    }

    fn hands(&mut self) -> (&mut Hands, Table<'_>) {
        let unit = self.settings.sheet.unit();
        let table = Table {
            sight: self.camera.sight().scaled(unit),
            columns: self.weave()[0],
            slides: self.settings.sheet == Sheet::Paper,
            unit,
            screen: self.screen,
            cloth: &mut self.cloth,
            camera: &mut self.camera,
        };
        (&mut self.hands, table)
    }
}

/// The camera of the brief, in units.
fn rig() -> Rig {
    Rig {
        target: TARGET,
        polar: 0.15..=1.56,
        radius: 4.0..=30.0,
        start: [0.26, 1.43, 17.4],
        half_width: 2.9,
    }
}

#[cfg(test)]
mod tests;
