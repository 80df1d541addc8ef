//! Interface between a window and its application, and its implementation for the cloth scenes.
//!
//! Method: a trait with one function per event.
//!
//! Reads window events; writes the state of the application and the frame.
//!
//! Invariant: pointer positions are in logical pixels.

use std::path::Path;

use glam::Vec2;
use muslin::Result;
use three_d::{Context, CoreError, RenderTarget, egui};

use super::panel::{Panel, PanelCommand};
use super::{photo_file, settings_file};
use crate::app::App;
use crate::pointer::Cursor;
use crate::receipt::pointers::PressKind;
use crate::render::Renderer;
use crate::scene_kind::SceneKind;

/// Typed characters of two keys.
const ESCAPE: char = '\u{1b}';
const RETURN: char = '\r';

/// An application with an overlay. Pointer positions are in logical pixels. Functions fail with the
/// error of the cloth, or of the driver when they draw.
#[expect(clippy::missing_errors_doc, reason = "said above, for all of them")]
pub trait WindowApp {
    /// Returns the title of the window.
    fn title(&self) -> &'static str;
    /// Creates the GPU resources.
    fn attach(&mut self, context: &Context) -> std::result::Result<(), CoreError>;
    /// Sets the size of the window.
    fn resize(&mut self, size: Vec2);
    /// Returns whether a point belongs to the overlay.
    fn covers(&self, at: Vec2) -> bool;
    /// Handles a pressed pointer.
    fn press(&mut self, id: u32, at: Vec2, press: PressKind) -> Result<()>;
    /// Handles the second press of a double press.
    fn press_twice(&mut self, at: Vec2) -> Result<()>;
    /// Handles a moved pointer.
    fn drag(&mut self, id: u32, to: Vec2) -> Result<()>;
    /// Handles a released pointer.
    fn lift(&mut self, id: u32) -> Result<()>;
    /// Handles a mouse that leaves the window.
    fn clear_hover(&mut self);
    /// Zooms by the wheel; positive `pixels` move the camera away.
    fn wheel(&mut self, pixels: f32);
    /// Zooms by a pinch on a trackpad; a `factor` above one moves the camera nearer.
    fn pinch(&mut self, factor: f32);
    /// Handles the Shift key.
    fn shift(&mut self, held: bool) -> Result<()>;
    /// Handles the arrow keys: right, and up or away, while they are held.
    fn arrows(&mut self, held: Vec2) {
        let _ = held;
    }
    /// Handles a typed key.
    fn key(&mut self, key: char) -> Result<()>;
    /// Returns the shape of the mouse cursor.
    fn cursor(&mut self) -> Result<Cursor>;
    /// Advances by `seconds` [s].
    fn frame(&mut self, seconds: f32) -> Result<()>;
    /// Draws the overlay and collects the commands of the user.
    fn draw_overlay(&mut self, ctx: &egui::Context);
    /// Runs the collected commands.
    fn run_commands(&mut self) -> Result<()>;
    /// Draws the picture.
    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError>;
    /// Saves the settings if they have changed; called once a second and at the end.
    fn save_settings(&mut self);
}

/// The cloth scenes with their panel.
pub struct ClothWindow {
    app: App,
    renderer: Option<Renderer>,
    panel: Panel,
    commands: Vec<PanelCommand>,
    saved_settings: String,
    /// Whether the next frame saves a photo.
    wants_photo: bool,
}

impl ClothWindow {
    /// Creates the window state for an application.
    pub fn new(mut app: App) -> Self {
        let panel = Panel::default();
        app.set_insets(panel.insets());
        let saved_settings = app.settings().to_json();
        let commands = Vec::new();
        Self { app, renderer: None, panel, commands, saved_settings, wants_photo: false }
    }

    /// Takes a photo and saves it in the current folder; the panel says where, or why not.
    fn save_photo(&mut self) -> std::result::Result<(), CoreError> {
        let Some(renderer) = &mut self.renderer else {
            return Ok(());
        };
        let photo = self.app.take_photo(renderer)?;
        let scene = SceneKind::NAMES[self.app.settings().scene as usize].to_lowercase();
        let saved = photo_file::save(Path::new("."), &scene, &photo);
        self.panel.show_photo(saved.map_err(|error| error.to_string()));
        Ok(())
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

    fn arrows(&mut self, held: Vec2) {
        self.app.camera().note_input();
        self.app.walk(held);
    }

    fn key(&mut self, key: char) -> Result<()> {
        self.app.camera().note_input();
        match key {
            ESCAPE if self.app.is_photo() => self.app.set_photo(false)?,
            RETURN if self.app.is_photo() => self.wants_photo = true,
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
        let is_photo = self.app.is_photo();
        self.app.set_insets(if is_photo { [0.0; 4] } else { self.panel.insets() });
    }

    fn run_commands(&mut self) -> Result<()> {
        for command in self.commands.drain(..) {
            if !matches!(command, PanelCommand::TimeStages(_)) {
                self.app.camera().note_input();
            }
            match command {
                PanelCommand::Set(name, value) => self.app.set(name, value)?,
                PanelCommand::Act(action) => self.app.run_action(action)?,
                PanelCommand::TimeStages(on) => self.app.time_stages(on),
                PanelCommand::SavePhoto => self.wants_photo = true,
            }
        }
        Ok(())
    }

    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError> {
        if std::mem::take(&mut self.wants_photo) {
            self.save_photo()?;
        }
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
