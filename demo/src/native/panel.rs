//! Panel of the window: draws the table of controls with egui, in the colours of the page.
//!
//! Method: immediate mode; the panel collects commands, and the caller runs them after drawing.
//!
//! Reads [`App`]; writes [`PanelCommand`]s.
//!
//! Invariant: drawing the panel does not change the application.

use std::path::PathBuf;

use glam::Vec2;
use three_d::egui::{
    self, Align, Align2, Area, Button, CollapsingHeader, Color32, Context, CornerRadius, Frame, Id,
    Layout, Margin, Rect, RichText, ScrollArea, Sense, Slider, Stroke, StrokeKind, Ui, vec2,
};

use crate::app::App;
use crate::controls::{Action, CONTROLS, Control, Kind};

const SURFACE: Color32 = Color32::from_rgba_premultiplied(9, 12, 20, 184);
const HAIRLINE: Color32 = Color32::from_rgba_premultiplied(20, 20, 20, 20);
const TRACK: Color32 = Color32::from_rgba_premultiplied(31, 31, 31, 31);
const TEXT: Color32 = Color32::from_rgb(0xe7, 0xec, 0xf5);
const MUTED: Color32 = Color32::from_rgb(0x8a, 0x93, 0xa8);
const ACCENT: Color32 = Color32::from_rgb(0x7c, 0xc0, 0xff);
const WARM: Color32 = Color32::from_rgb(0xff, 0xb8, 0x6b);
const DEEP: Color32 = Color32::from_rgb(0x05, 0x07, 0x0d);

/// Width of the rows [px].
const WIDTH: f32 = 236.0;

/// Height that the instructions take at the bottom [px].
const HELP_HEIGHT: f32 = 92.0;

/// A command of the user, to be run after the panel is drawn.
pub enum PanelCommand {
    /// Set the control of this name.
    Set(&'static str, f32),
    /// Run the action of a button.
    Act(Action),
    /// Switch the timing of the stages on or off.
    TimeStages(bool),
    /// Save a photo.
    SavePhoto,
}

/// State of the panel, and the rectangles that it covers.
pub struct Panel {
    open: bool,
    help: bool,
    rects: Vec<Rect>,
    styled: bool,
    /// What became of the last photo.
    photo: String,
}

impl Default for Panel {
    fn default() -> Self {
        Self { open: true, help: true, rects: Vec::new(), styled: false, photo: String::new() }
    }
}

impl Panel {
    /// Opens or closes the panel.
    pub fn toggle(&mut self) {
        self.open = !self.open;
    }

    /// Shows or hides the instructions.
    pub fn toggle_help(&mut self) {
        self.help = !self.help;
    }

    /// Hides the instructions, because the user has touched the scene.
    pub fn hide_help(&mut self) {
        self.help = false;
    }

    /// Shows where a photo was saved, or why it was not.
    pub fn show_photo(&mut self, saved: Result<PathBuf, String>) {
        self.photo = match saved {
            Ok(path) => format!("Saved {}", path.display()),
            Err(error) => format!("Not saved: {error}"),
        };
    }

    /// Returns whether a point of the window belongs to the panel.
    pub fn covers(&self, at: Vec2) -> bool {
        self.rects.iter().any(|r| r.contains(egui::pos2(at.x, at.y)))
    }

    /// Returns how far the panel reaches into the window from left, top, right and bottom [px].
    pub fn insets(&self) -> [f32; 4] {
        let left = if self.open { WIDTH + 64.0 } else { 0.0 };
        [left, 0.0, 0.0, HELP_HEIGHT]
    }

    /// Draws the panel and appends the commands of the user.
    pub fn draw(&mut self, ctx: &Context, app: &App, commands: &mut Vec<PanelCommand>) {
        if !self.styled {
            ctx.set_visuals(visuals());
            self.styled = true;
        }
        self.rects.clear();
        if app.is_photo() {
            let bar = Area::new(Id::new("photo"))
                .anchor(Align2::CENTER_BOTTOM, vec2(0.0, -24.0))
                .show(ctx, |ui| glass().show(ui, |ui| self.photo_bar(ui, app, commands)));
            self.rects.push(bar.response.rect);
            return;
        }
        self.photo.clear();
        let panel = Area::new(Id::new("panel")).anchor(Align2::LEFT_TOP, vec2(16.0, 16.0)).show(
            ctx,
            |ui| {
                glass().show(ui, |ui| {
                    ui.set_width(WIDTH);
                    self.title(ui);
                    if self.open {
                        // In a low window the rows scroll, so that the panel fits.
                        let room = ctx.content_rect().height() - 112.0;
                        ScrollArea::vertical()
                            .min_scrolled_height(room.max(80.0))
                            .max_height(room.max(80.0))
                            .show(ui, |ui| rows(ui, app, commands));
                    }
                });
            },
        );
        self.rects.push(panel.response.rect);
        if self.help {
            let help = Area::new(Id::new("help"))
                .anchor(Align2::CENTER_BOTTOM, vec2(0.0, -24.0))
                .show(ctx, |ui| glass().show(ui, |ui| self.instructions(ui, app)));
            self.rects.push(help.response.rect);
        }
    }

    fn photo_bar(&self, ui: &mut Ui, app: &App, commands: &mut Vec<PanelCommand>) {
        ui.horizontal(|ui| {
            let [width, height] = app.photo_size();
            let save = Button::new(format!("Save {width} × {height}")).min_size(vec2(150.0, 30.0));
            if ui.add(save).on_hover_text("Save (Enter)").clicked() {
                commands.push(PanelCommand::SavePhoto);
            }
            let leave = Button::new("Leave").min_size(vec2(72.0, 30.0));
            if ui.add(leave).on_hover_text("Leave (Escape)").clicked() {
                commands.push(PanelCommand::Act(Action::Photo));
            }
            if !self.photo.is_empty() {
                ui.label(RichText::new(&self.photo).color(TEXT));
            }
        });
    }

    fn title(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.label(RichText::new("Muslin").size(19.0).strong().color(TEXT));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let arrow = if self.open { "–" } else { "+" };
                let size = vec2(28.0, 28.0);
                if ui.add(Button::new(arrow).min_size(size)).on_hover_text("Panel (C)").clicked() {
                    self.toggle();
                }
                if ui
                    .add(Button::new("?").min_size(size))
                    .on_hover_text("Instructions (H)")
                    .clicked()
                {
                    self.toggle_help();
                }
            });
        });
    }

    fn instructions(&mut self, ui: &mut Ui, app: &App) {
        let text = "Drag the cloth to pull it  ·  Drag the background to orbit  ·  Scroll to zoom  ·  Hold Shift and swipe to cut  ·  Toggle wind & tearing in the panel";
        ui.spacing_mut().interact_size.y = 28.0;
        ui.horizontal(|ui| {
            if app.walker().is_some() {
                let walk = "Move the mouse or hold arrow keys to walk  ·";
                ui.label(RichText::new(walk).color(TEXT));
            }
            ui.label(RichText::new(text).color(TEXT));
            if ui.add(Button::new("Got it").min_size(vec2(64.0, 28.0))).clicked() {
                self.help = false;
            }
        });
    }
}

fn rows(ui: &mut Ui, app: &App, commands: &mut Vec<PanelCommand>) {
    ui.spacing_mut().item_spacing = vec2(8.0, 4.0);
    for control in CONTROLS {
        if matches!(control.kind, Kind::Button(_)) {
            continue;
        }
        ui.add_space(8.0);
        let hint = format!("{} ({})", control.about, control.key_name());
        let is_enabled = control.is_enabled(app.settings());
        let row = ui.add_enabled_ui(is_enabled, |ui| row(ui, app, control, commands));
        row.response.on_hover_text(hint);
    }
    ui.add_space(12.0);
    ui.horizontal(|ui| {
        for control in CONTROLS {
            if let Kind::Button(action) = control.kind {
                let size = vec2((WIDTH - 16.0) / 3.0, 30.0);
                let hint = format!("{} ({})", control.about, control.key_name());
                let button = Button::new(control.label).min_size(size);
                let is_enabled = control.is_enabled(app.settings());
                if ui.add_enabled(is_enabled, button).on_hover_text(hint).clicked() {
                    commands.push(PanelCommand::Act(action));
                }
            }
        }
    });
    ui.add_space(8.0);
    let r = app.readout();
    let figures = format!(
        "{} particles  ·  {} constraints\n{:.0} fps  ·  {:.2} ms simulation",
        r.particles, r.constraints, r.fps, r.milliseconds
    );
    ui.label(RichText::new(figures).size(12.0).color(MUTED));
    let title = RichText::new("Time per stage").size(12.0).color(MUTED);
    let stages = CollapsingHeader::new(title).id_salt("stages").show(ui, |ui| {
        for time in app.stage_times() {
            ui.horizontal(|ui| {
                ui.label(RichText::new(time.name).size(12.0).color(MUTED));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let figure = format!("{:.3} ms", time.milliseconds);
                    ui.label(RichText::new(figure).size(12.0).color(TEXT));
                });
            });
        }
    });
    commands.push(PanelCommand::TimeStages(stages.fully_open()));
}

fn row(ui: &mut Ui, app: &App, control: &Control, commands: &mut Vec<PanelCommand>) {
    let settings = app.settings();
    let label = RichText::new(control.label.to_uppercase()).size(11.5).color(MUTED);
    let mut command = |value: f32| commands.push(PanelCommand::Set(control.name, value));
    match &control.kind {
        Kind::Slider { min, max, step, .. } => {
            ui.horizontal(|ui| {
                ui.label(label);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let value = RichText::new(control.text(settings)).size(12.0);
                    ui.label(value.color(TEXT));
                });
            });
            let mut value = control.get(settings);
            ui.spacing_mut().slider_width = WIDTH;
            let slider = Slider::new(&mut value, *min..=*max)
                .step_by(f64::from(*step))
                .show_value(false)
                .trailing_fill(true);
            if ui.add(slider).changed() {
                command(value);
            }
        }
        Kind::Switch { get, .. } => {
            ui.horizontal(|ui| {
                ui.label(label);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if switch(ui, get(settings)) {
                        command(f32::from(u8::from(!get(settings))));
                    }
                });
            });
        }
        Kind::Choice { options, get, .. } => {
            ui.label(label);
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                let across = if options.len() > 5 { 3 } else { options.len() };
                let gaps = 4.0 * (across - 1) as f32;
                let size = vec2((WIDTH - gaps) / across as f32 - 0.5, 26.0);
                for (i, option) in options.iter().enumerate() {
                    let chosen = get(settings) == i;
                    let text = RichText::new(*option).size(12.0);
                    let button = if chosen {
                        Button::new(text.color(DEEP)).fill(ACCENT)
                    } else {
                        Button::new(text.color(TEXT))
                    };
                    if ui.add(button.min_size(size)).clicked() {
                        command(i as f32);
                    }
                }
            });
        }
        Kind::Button(_) => {}
    }
}

/// Draws a switch; returns whether it was clicked.
fn switch(ui: &mut Ui, on: bool) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(34.0, 18.0), Sense::click());
    let share = ui.ctx().animate_bool(response.id, on);
    let track = if on { ACCENT.gamma_multiply(0.55) } else { TRACK };
    let painter = ui.painter();
    painter.rect_filled(rect, CornerRadius::same(9), track);
    if response.has_focus() {
        let ring = Stroke::new(1.5, ACCENT);
        painter.rect_stroke(rect.expand(2.0), CornerRadius::same(11), ring, StrokeKind::Outside);
    }
    let x = egui::lerp(rect.left() + 9.0..=rect.right() - 9.0, share);
    painter.circle_filled(egui::pos2(x, rect.center().y), 6.5, if on { TEXT } else { MUTED });
    response.clicked()
}

fn glass() -> Frame {
    Frame::new()
        .fill(SURFACE)
        .stroke(Stroke::new(1.0, HAIRLINE))
        .corner_radius(CornerRadius::same(12))
        .inner_margin(Margin::same(16))
}

fn visuals() -> egui::Visuals {
    let mut v = egui::Visuals::dark();
    v.override_text_color = None;
    v.selection.bg_fill = ACCENT;
    v.selection.stroke = Stroke::new(1.0, DEEP);
    v.slider_trailing_fill = true;
    let round = CornerRadius::same(8);
    for (widget, fill, text) in [
        (&mut v.widgets.inactive, TRACK, TEXT),
        (&mut v.widgets.hovered, Color32::from_white_alpha(44), TEXT),
        (&mut v.widgets.active, WARM.gamma_multiply(0.6), TEXT),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = round;
    }
    v.window_fill = SURFACE;
    v.window_stroke = Stroke::new(1.0, HAIRLINE);
    v
}
