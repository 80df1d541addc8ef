//! What a window asks of what it shows; the sheet's answers.

use glam::Vec2;
use muslin::Result;
use three_d::{Context, CoreError, RenderTarget, egui};

use super::panel::{Panel, PanelCommand};
use super::settings_file;
use crate::app::App;
use crate::pointer::Cursor;
use crate::receipt::pointers::PressKind;
use crate::render::Renderer;

/// A scene with its overlay. Pointers are told in logical pixels; what fails is what the cloth refuses, or
/// the driver where a picture is drawn.
#[expect(clippy::missing_errors_doc, reason = "said above, for all of them")]
pub trait WindowApp {
    /// What the window is called.
    fn title(&self) -> &'static str;
    /// Makes what it needs on the graphics card.
    fn attach(&mut self, context: &Context) -> std::result::Result<(), CoreError>;
    /// The window has this size.
    fn resize(&mut self, size: Vec2);
    /// Whether a point belongs to the overlay.
    fn covers(&self, at: Vec2) -> bool;
    /// A pointer comes down.
    fn press(&mut self, id: u32, at: Vec2, press: PressKind) -> Result<()>;
    /// A pointer comes down for the second time.
    fn press_twice(&mut self, at: Vec2) -> Result<()>;
    /// A pointer moves.
    fn drag(&mut self, id: u32, to: Vec2) -> Result<()>;
    /// A pointer goes up.
    fn lift(&mut self, id: u32) -> Result<()>;
    /// The mouse has left the window.
    fn clear_hover(&mut self);
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
    fn draw_overlay(&mut self, ctx: &egui::Context);
    /// Does what the user wanted.
    fn run_commands(&mut self) -> Result<()>;
    /// Draws the picture.
    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError>;
    /// Writes down what is to be saved_settings; asked once a second and at the end.
    fn save_settings(&mut self);
}

/// The sheet with its panel.
pub struct ClothWindow {
    app: App,
    renderer: Option<Renderer>,
    panel: Panel,
    commands: Vec<PanelCommand>,
    saved_settings: String,
}

impl ClothWindow {
    /// Around an app.
    pub fn new(app: App) -> Self {
        let saved_settings = app.settings().to_json();
        Self { app, renderer: None, panel: Panel::default(), commands: Vec::new(), saved_settings }
    }
}

impl WindowApp for ClothWindow {
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

    fn press(&mut self, id: u32, at: Vec2, press: PressKind) -> Result<()> {
        self.panel.hide_help();
        if press == PressKind::Main { self.app.press(id, at) } else { Ok(()) }
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

    fn clear_hover(&mut self) {
        self.app.clear_hover();
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

    fn draw_overlay(&mut self, ctx: &egui::Context) {
        self.panel.draw(ctx, &self.app, &mut self.commands);
    }

    fn run_commands(&mut self) -> Result<()> {
        for command in self.commands.drain(..) {
            match command {
                PanelCommand::Set(name, value) => self.app.set(name, value)?,
                PanelCommand::Act(action) => self.app.act(action)?,
                PanelCommand::TimeStages(on) => self.app.time_stages(on),
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

    fn save_settings(&mut self) {
        let now = self.app.settings().to_json();
        if now != self.saved_settings {
            settings_file::write(&now);
            self.saved_settings = now;
        }
    }
}
