//! What a window asks of what it shows; the sheet's answers.

use glam::Vec2;
use muslin::Result;
use three_d::{Context, CoreError, RenderTarget, egui};

use super::panel::{Panel, Wish};
use super::store;
use crate::app::App;
use crate::pointer::Cursor;
use crate::render::Renderer;
use crate::tender::hands::Button;

/// A scene with its overlay. Pointers are told in logical pixels; what fails is what the cloth refuses, or
/// the driver where a picture is drawn.
#[expect(clippy::missing_errors_doc, reason = "said above, for all of them")]
pub trait Show {
    /// What the window is called.
    fn title(&self) -> &'static str;
    /// Makes what it needs on the graphics card.
    fn attach(&mut self, context: &Context) -> std::result::Result<(), CoreError>;
    /// The window has this size.
    fn resize(&mut self, size: Vec2);
    /// Whether a point belongs to the overlay.
    fn covers(&self, at: Vec2) -> bool;
    /// A pointer comes down.
    fn press(&mut self, id: u32, at: Vec2, button: Button) -> Result<()>;
    /// A pointer comes down for the second time.
    fn press_twice(&mut self, at: Vec2) -> Result<()>;
    /// A pointer moves.
    fn drag(&mut self, id: u32, to: Vec2) -> Result<()>;
    /// A pointer goes up.
    fn lift(&mut self, id: u32) -> Result<()>;
    /// The mouse has left the window.
    fn leave(&mut self);
    /// The wheel turns by so many pixels, away if positive.
    fn wheel(&mut self, pixels: f32);
    /// A trackpad's pinch, nearer above one.
    fn pinch(&mut self, factor: f32);
    /// Shift goes down or up.
    fn shift(&mut self, held: bool) -> Result<()>;
    /// A key was typed.
    fn key(&mut self, key: char) -> Result<()>;
    /// What the cursor should say.
    fn cursor(&mut self) -> Result<Cursor>;
    /// Lets time pass.
    fn frame(&mut self, seconds: f32) -> Result<()>;
    /// Draws the overlay and notes what the user wants.
    fn overlay(&mut self, ctx: &egui::Context);
    /// Does what the user wanted.
    fn obey(&mut self) -> Result<()>;
    /// Draws the picture.
    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError>;
    /// Writes down what is to be kept; asked once a second and at the end.
    fn keep(&mut self);
}

/// The sheet with its panel.
pub struct Sheet {
    app: App,
    renderer: Option<Renderer>,
    panel: Panel,
    wishes: Vec<Wish>,
    kept: String,
}

impl Sheet {
    /// Around an app.
    pub fn new(app: App) -> Self {
        let kept = app.settings().to_json();
        Self { app, renderer: None, panel: Panel::default(), wishes: Vec::new(), kept }
    }
}

impl Show for Sheet {
    fn title(&self) -> &'static str {
        "Muslin"
    }

    fn attach(&mut self, context: &Context) -> std::result::Result<(), CoreError> {
        self.renderer = Some(Renderer::new(context)?);
        Ok(())
    }

    fn resize(&mut self, size: Vec2) {
        self.app.resize(size);
    }

    fn covers(&self, at: Vec2) -> bool {
        self.panel.covers(at)
    }

    fn press(&mut self, id: u32, at: Vec2, button: Button) -> Result<()> {
        self.panel.hide_help();
        if button == Button::Main { self.app.press(id, at) } else { Ok(()) }
    }

    fn press_twice(&mut self, _: Vec2) -> Result<()> {
        Ok(())
    }

    fn drag(&mut self, id: u32, to: Vec2) -> Result<()> {
        self.app.drag(id, to)
    }

    fn lift(&mut self, id: u32) -> Result<()> {
        self.app.lift(id)
    }

    fn leave(&mut self) {
        self.app.leave();
    }

    fn wheel(&mut self, pixels: f32) {
        self.app.wheel(pixels);
    }

    fn pinch(&mut self, factor: f32) {
        self.app.pinch(factor);
    }

    fn shift(&mut self, held: bool) -> Result<()> {
        self.app.hold_blade(held);
        Ok(())
    }

    fn key(&mut self, key: char) -> Result<()> {
        match key {
            '?' | 'h' | 'H' => self.panel.toggle_help(),
            'c' | 'C' => self.panel.toggle(),
            _ => {
                self.app.key(key, key.is_uppercase())?;
            }
        }
        Ok(())
    }

    fn cursor(&mut self) -> Result<Cursor> {
        self.app.cursor()
    }

    fn frame(&mut self, seconds: f32) -> Result<()> {
        self.app.frame(seconds)
    }

    fn overlay(&mut self, ctx: &egui::Context) {
        self.panel.draw(ctx, &self.app, &mut self.wishes);
    }

    fn obey(&mut self) -> Result<()> {
        for wish in self.wishes.drain(..) {
            match wish {
                Wish::Set(name, value) => self.app.set(name, value)?,
                Wish::Act(action) => self.app.act(action)?,
                Wish::TimeStages(on) => self.app.time_stages(on),
            }
        }
        Ok(())
    }

    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError> {
        match &mut self.renderer {
            Some(renderer) => self.app.draw(renderer, screen),
            None => Ok(()),
        }
    }

    fn keep(&mut self) {
        let now = self.app.settings().to_json();
        if now != self.kept {
            store::write(&now);
            self.kept = now;
        }
    }
}
