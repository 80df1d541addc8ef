//! JavaScript interface of the receipt for `demo/web/tender.js`.
//!
//! Method: thin wasm-bindgen wrappers around [`ReceiptApp`].
//!
//! Reads events and frame times from the page; writes pixels, and JSON for the counter.
//!
//! Invariant: the page owns canvas, events and buttons; all decisions are in modules that the
//! window uses too.

use glam::Vec2;
use three_d::RenderTarget;
use wasm_bindgen::prelude::*;

use super::pointers::PressKind;
use super::{ReceiptApp, ReceiptSettings, settings};
use crate::camera::FreeArea;
use crate::render::receipt_renderer::ReceiptRenderer;
use crate::web::{context_from_webgl, js_error, now};

/// The running receipt with its GPU resources.
#[wasm_bindgen]
pub struct Receipt {
    app: ReceiptApp,
    renderer: Option<ReceiptRenderer>,
    /// Size of the canvas, and how far overlays reach into it [px].
    size: Vec2,
    insets: [f32; 4],
}

#[wasm_bindgen]
impl Receipt {
    /// Creates the receipt; `small` selects the sheet with fewer particles.
    #[wasm_bindgen(constructor)]
    pub fn new(small: bool) -> Result<Receipt, JsError> {
        let mut app = ReceiptApp::new(ReceiptSettings::default(), small, || now() * 1.0e-3)
            .map_err(js_error)?;
        app.start_low();
        Ok(Self { app, renderer: None, size: Vec2::ONE, insets: [0.0; 4] })
    }

    /// Creates the renderer in a WebGL 2 context, also after a lost one.
    pub fn attach(&mut self, gl: web_sys::WebGl2RenderingContext) -> Result<(), JsError> {
        self.renderer = None;
        self.renderer = Some(ReceiptRenderer::new(&context_from_webgl(gl)?).map_err(js_error)?);
        Ok(())
    }

    /// Drops the renderer: its context is lost.
    pub fn detach(&mut self) {
        self.renderer = None;
    }

    /// Returns the table of controls as JSON.
    pub fn controls() -> String {
        settings::to_json()
    }

    /// Returns whether a control is on; nothing for an action without a state.
    #[wasm_bindgen(js_name = isOn)]
    pub fn is_on(&self, name: &str) -> Option<bool> {
        settings::find_control(name).and_then(|control| control.is_on(self.app.settings()))
    }

    /// Runs the action of a control; an unknown name does nothing.
    pub fn act(&mut self, name: &str) -> Result<(), JsError> {
        settings::find_control(name)
            .map_or(Ok(()), |control| self.app.run_action(control.action).map_err(js_error))
    }

    /// Runs the action of a key; returns whether it has one.
    pub fn key(&mut self, key: char) -> Result<bool, JsError> {
        self.app.key(key).map_err(js_error)
    }

    /// Sets whether the user prefers reduced motion.
    #[wasm_bindgen(js_name = setReducedMotion)]
    pub fn set_reduced_motion(&mut self, reduced_motion: bool) -> Result<(), JsError> {
        self.app.set_reduced_motion(reduced_motion).map_err(js_error)
    }

    /// Sets the size of the canvas in CSS pixels.
    pub fn resize(&mut self, width: f32, height: f32) {
        self.size = Vec2::new(width, height);
        self.update_free_area();
        self.app.resize(self.size);
    }

    /// Sets how far overlays reach into the canvas, in CSS pixels.
    #[wasm_bindgen(js_name = setInsets)]
    pub fn set_insets(&mut self, left: f32, top: f32, right: f32, bottom: f32) {
        self.insets = [left, top, right, bottom];
        self.update_free_area();
    }

    /// Handles a pressed pointer, in CSS pixels of the canvas; `turns` orbits the camera in any
    /// case.
    pub fn press(&mut self, id: u32, x: f32, y: f32, turns: bool) -> Result<(), JsError> {
        let button = if turns { PressKind::Turn } else { PressKind::Main };
        self.app.press(id, Vec2::new(x, y), button).map_err(js_error)
    }

    /// Handles a moved pointer.
    pub fn drag(&mut self, id: u32, x: f32, y: f32) {
        self.app.drag(id, Vec2::new(x, y));
    }

    /// Handles a released or lost pointer.
    pub fn lift(&mut self, id: u32) -> Result<(), JsError> {
        self.app.lift(id).map_err(js_error)
    }

    /// Handles a mouse that leaves the canvas.
    #[wasm_bindgen(js_name = clearHover)]
    pub fn clear_hover(&mut self) {
        self.app.clear_hover();
    }

    /// Sets whether released pointers leave their grabs in place.
    #[wasm_bindgen(js_name = setLeaveInPlace)]
    pub fn set_leave_in_place(&mut self, on: bool) -> Result<(), JsError> {
        self.app.set_leave_in_place(on).map_err(js_error)
    }

    /// Creases the bend at a position; returns whether there is one.
    pub fn crease(&mut self, x: f32, y: f32) -> Result<bool, JsError> {
        self.app.crease(Vec2::new(x, y)).map_err(js_error)
    }

    /// Zooms by the wheel, in CSS pixels.
    pub fn wheel(&mut self, pixels: f32) {
        self.app.wheel(pixels);
    }

    /// Orbits the camera by a drag, in screen heights.
    pub fn orbit(&mut self, x: f32, y: f32) {
        self.app.camera().orbit(Vec2::new(x, y));
    }

    /// Returns the position of the camera, in units.
    pub fn eye(&mut self) -> Box<[f32]> {
        Box::new(self.app.camera().view().eye.to_array())
    }

    /// Returns the CSS name of the cursor.
    pub fn cursor(&mut self) -> Result<String, JsError> {
        self.app.cursor().map(|cursor| cursor.css().into()).map_err(js_error)
    }

    /// Advances by `seconds` [s] and draws into a canvas of `width` × `height` device pixels.
    pub fn frame(&mut self, seconds: f32, width: u32, height: u32) -> Result<(), JsError> {
        self.app.frame(seconds).map_err(js_error)?;
        if let Some(renderer) = &mut self.renderer {
            let context = renderer.context().clone();
            let screen = RenderTarget::screen(&context, width, height);
            self.app.draw(renderer, &screen).map_err(js_error)?;
        }
        Ok(())
    }

    /// Runs exactly `ticks` ticks, independent of the clock.
    pub fn play(&mut self, ticks: u32) -> Result<(), JsError> {
        self.app.play(ticks).map_err(js_error)
    }

    /// Returns the numbers of the counter as JSON.
    pub fn readout(&self) -> String {
        serde_json::to_string(&self.app.readout()).unwrap_or_default()
    }

    /// Returns the state hash of the cloth as a hexadecimal number; it is the same on every
    /// platform.
    #[wasm_bindgen(js_name = stateHash)]
    pub fn state_hash(&self) -> String {
        format!("{:016x}", self.app.cloth().state_hash())
    }

    /// Returns x and y of a particle in CSS pixels of the canvas; nothing if it is behind the
    /// camera.
    #[wasm_bindgen(js_name = particleScreen)]
    pub fn particle_screen(&self, particle: u32) -> Option<Box<[f32]>> {
        let at = self.app.on_screen(self.app.particle(particle)?)?;
        Some(Box::new([at.x, at.y]))
    }
}

impl Receipt {
    /// Centres the paper in what overlays leave free.
    fn update_free_area(&mut self) {
        self.app.camera().set_free_area(FreeArea::from_insets(self.insets, self.size));
    }
}
