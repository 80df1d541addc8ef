//! Window of the receipt: title, instructions, buttons, counter and pause over the picture.
//!
//! Method: egui in immediate mode over the picture of [`ReceiptApp`].
//!
//! Reads window events; writes the overlay, and actions that run after it is drawn.
//!
//! Invariant: a press on a button does not reach the paper.

use glam::Vec2;
use muslin::Result;
use three_d::egui::{
    Align2, Area, Button, Color32, Context as Egui, CornerRadius, FontId, Id, Rect, RichText,
    Stroke, Visuals, pos2, vec2,
};
use three_d::{Context, CoreError, RenderTarget};

use super::window_app::WindowApp;
use crate::pointer::Cursor;
use crate::receipt::ReceiptApp;
use crate::receipt::pointers::PressKind;
use crate::receipt::settings::{RECEIPT_CONTROLS, ReceiptAction};
use crate::render::receipt_renderer::ReceiptRenderer;

const TEXT: Color32 = Color32::from_rgb(0x2c, 0x30, 0x36);
const MUTED: Color32 = Color32::from_rgb(0x5a, 0x61, 0x6b);
const PILL: Color32 = Color32::from_rgba_premultiplied(140, 142, 144, 140);
const HAIRLINE: Color32 = Color32::from_rgba_premultiplied(0, 0, 0, 26);

/// Time that the instructions stay [s], and time that they take to fade [s].
const INSTRUCTION_SECONDS: f32 = 3.0;
const FADE_SECONDS: f32 = 0.8;

/// Instructions for actions without a button.
const INSTRUCTIONS: &str = "Click and drag to grab the paper";
const MORE_INSTRUCTIONS: &str = "Right-drag to orbit  ·  hold Shift to leave a hand in place  ·  double-click a bend to crease it";

/// The receipt with its overlay.
pub struct ReceiptWindow {
    app: ReceiptApp,
    renderer: Option<ReceiptRenderer>,
    commands: Vec<ReceiptAction>,
    buttons: Vec<Rect>,
    age: f32,
}

impl ReceiptWindow {
    /// Creates the window state for a receipt.
    pub fn new(app: ReceiptApp) -> Self {
        Self { app, renderer: None, commands: Vec::new(), buttons: Vec::new(), age: 0.0 }
    }

    fn buttons(&mut self, ctx: &Egui) {
        self.buttons.clear();
        let area = Area::new(Id::new("pills")).anchor(Align2::LEFT_BOTTOM, vec2(20.0, -20.0));
        area.show(ctx, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().button_padding = vec2(16.0, 8.0);
                for control in RECEIPT_CONTROLS.iter().filter(|control| control.is_pill) {
                    let on = control.is_on(self.app.settings()) == Some(true);
                    let [fill, text] = if on { [TEXT, Color32::WHITE] } else { [PILL, TEXT] };
                    let pill = Button::new(RichText::new(control.label).size(14.0).color(text))
                        .fill(fill)
                        .stroke(Stroke::new(1.0, HAIRLINE))
                        .corner_radius(CornerRadius::same(18))
                        .min_size(vec2(0.0, 36.0));
                    let hint = format!("{} ({})", control.about, control.key_name());
                    let response = ui.add(pill).on_hover_text(hint);
                    self.buttons.push(response.rect);
                    if response.clicked() {
                        self.commands.push(control.action);
                    }
                }
            });
        });
    }
}

impl WindowApp for ReceiptWindow {
    fn title(&self) -> &'static str {
        "Tender — Receipt Paper Physics"
    }

    fn attach(&mut self, context: &Context) -> std::result::Result<(), CoreError> {
        self.renderer = Some(ReceiptRenderer::new(context)?);
        Ok(())
    }

    fn resize(&mut self, size: Vec2) {
        self.app.resize(size);
    }

    fn covers(&self, at: Vec2) -> bool {
        self.buttons.iter().any(|rect| rect.contains(pos2(at.x, at.y)))
    }

    fn press(&mut self, id: u32, at: Vec2, press: PressKind) -> Result<()> {
        self.app.press(id, at, press)
    }

    fn press_twice(&mut self, at: Vec2) -> Result<()> {
        self.app.crease(at).map(|_| ())
    }

    fn drag(&mut self, id: u32, to: Vec2) -> Result<()> {
        self.app.drag(id, to);
        Ok(())
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
        self.app.set_leave_in_place(held)
    }

    fn key(&mut self, key: char) -> Result<()> {
        self.app.key(key).map(|_| ())
    }

    fn cursor(&mut self) -> Result<Cursor> {
        self.app.cursor()
    }

    fn frame(&mut self, seconds: f32) -> Result<()> {
        self.age += seconds;
        self.app.frame(seconds)
    }

    fn draw_overlay(&mut self, ctx: &Egui) {
        ctx.set_visuals(Visuals::light());
        let screen = ctx.content_rect();
        let painter = ctx.debug_painter();
        let write = |at, anchor, text: &str, size, colour| {
            painter.text(at, anchor, text, FontId::proportional(size), colour);
        };
        // The title is in small capitals with a large initial.
        write(pos2(24.0, 18.0), Align2::LEFT_TOP, "T", 25.0, TEXT);
        write(pos2(40.0, 24.5), Align2::LEFT_TOP, "E N D E R", 17.0, TEXT);
        let left = 1.0 - ((self.age - INSTRUCTION_SECONDS) / FADE_SECONDS).clamp(0.0, 1.0);
        write(pos2(24.0, 54.0), Align2::LEFT_TOP, INSTRUCTIONS, 15.0, MUTED.gamma_multiply(left));
        write(
            pos2(24.0, 76.0),
            Align2::LEFT_TOP,
            MORE_INSTRUCTIONS,
            13.0,
            MUTED.gamma_multiply(left),
        );
        if self.app.settings().counter {
            let r = self.app.readout();
            let text = format!(
                "{:.0} fps\n{} particles\n{} constraints\n{:.2} ms simulation",
                r.fps, r.particles, r.constraints, r.milliseconds
            );
            write(screen.right_top() + vec2(-24.0, 22.0), Align2::RIGHT_TOP, &text, 13.0, MUTED);
        }
        if self.app.settings().paused {
            let text = "PAUSED — press Space";
            write(screen.center(), Align2::CENTER_CENTER, text, 38.0, TEXT.gamma_multiply(0.75));
        }
        self.buttons(ctx);
    }

    fn run_commands(&mut self) -> Result<()> {
        let commands = std::mem::take(&mut self.commands);
        commands.into_iter().try_for_each(|action| self.app.run_action(action))
    }

    fn draw(&mut self, screen: &RenderTarget<'_>) -> std::result::Result<(), CoreError> {
        match &mut self.renderer {
            Some(renderer) => self.app.draw(renderer, screen),
            None => Ok(()),
        }
    }

    /// The receipt has no saved settings.
    fn save_settings(&mut self) {}
}
