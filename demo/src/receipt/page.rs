//! The page's face of the receipt: what `demo/web/tender.js` calls.

use glam::Vec2;
use three_d::RenderTarget;
use wasm_bindgen::prelude::*;

use super::pointers::PressKind;
use super::{ReceiptApp, ReceiptSettings, settings};
use crate::render::receipt_renderer::ReceiptRenderer;
use crate::web::{context_from_webgl, js_error, now};

/// The running receipt, and what it has on the graphics card.
#[wasm_bindgen]
pub struct Receipt {
    tender: ReceiptApp,
    renderer: Option<ReceiptRenderer>,
}

#[wasm_bindgen]
impl Receipt {
    /// Hangs the receipt, one of fewer particles if `small`.
    #[wasm_bindgen(constructor)]
    pub fn new(small: bool) -> Result<Receipt, JsError> {
        let tender = ReceiptApp::new(ReceiptSettings::default(), small, || now() * 1.0e-3)
            .map_err(js_error)?;
        Ok(Self { tender, renderer: None })
    }

    /// Takes a WebGL 2 context; again after one was lost.
    pub fn attach(&mut self, gl: web_sys::WebGl2RenderingContext) -> Result<(), JsError> {
        self.renderer = None;
        self.renderer = Some(ReceiptRenderer::new(&context_from_webgl(gl)?).map_err(js_error)?);
        Ok(())
    }

    /// The context is lost: lets go of everything in it.
    pub fn detach(&mut self) {
        self.renderer = None;
    }

    /// The pick of controls as JSON.
    pub fn controls() -> String {
        settings::to_json()
    }

    /// Whether a control is on; nothing for what only happens once.
    #[wasm_bindgen(js_name = isOn)]
    pub fn is_on(&self, name: &str) -> Option<bool> {
        settings::find_control(name).and_then(|control| control.is_on(self.tender.settings()))
    }

    /// Does what a control says; an unknown name does nothing.
    pub fn act(&mut self, name: &str) -> Result<(), JsError> {
        settings::find_control(name)
            .map_or(Ok(()), |control| self.tender.act(control.action).map_err(js_error))
    }

    /// Does what a key does, and says whether it does anything.
    pub fn key(&mut self, key: char) -> Result<bool, JsError> {
        self.tender.key(key).map_err(js_error)
    }

    /// Whether the visitor asks for reduced motion.
    #[wasm_bindgen(js_name = setReducedMotion)]
    pub fn set_reduced_motion(&mut self, reduced_motion: bool) -> Result<(), JsError> {
        self.tender.set_reduced_motion(reduced_motion).map_err(js_error)
    }

    /// The canvas has this size in CSS pixels.
    pub fn resize(&mut self, width: f32, height: f32) {
        self.tender.resize(Vec2::new(width, height));
    }

    /// A pointer comes down, in CSS pixels of the canvas; `turns` takes the camera, whatever is there.
    pub fn press(&mut self, id: u32, x: f32, y: f32, turns: bool) -> Result<(), JsError> {
        let button = if turns { PressKind::Turn } else { PressKind::Main };
        self.tender.press(id, Vec2::new(x, y), button).map_err(js_error)
    }

    /// A pointer moves.
    pub fn drag(&mut self, id: u32, x: f32, y: f32) {
        self.tender.drag(id, Vec2::new(x, y));
    }

    /// A pointer goes up, or is lost.
    pub fn lift(&mut self, id: u32) -> Result<(), JsError> {
        self.tender.lift(id).map_err(js_error)
    }

    /// The mouse has left the canvas.
    #[wasm_bindgen(js_name = clearHover)]
    pub fn clear_hover(&mut self) {
        self.tender.clear_hover();
    }

    /// The key that leaves pointers where they are goes down or up.
    #[wasm_bindgen(js_name = setLeaveInPlace)]
    pub fn set_leave_in_place(&mut self, on: bool) -> Result<(), JsError> {
        self.tender.set_leave_in_place(on).map_err(js_error)
    }

    /// Makes the bend at a place a crease, and says whether there was one.
    pub fn crease(&mut self, x: f32, y: f32) -> Result<bool, JsError> {
        self.tender.crease(Vec2::new(x, y)).map_err(js_error)
    }

    /// The wheel turns, in CSS pixels.
    pub fn wheel(&mut self, pixels: f32) {
        self.tender.wheel(pixels);
    }

    /// Turns the camera as a drag would, in heights of the screen.
    pub fn orbit(&mut self, x: f32, y: f32) {
        self.tender.camera().orbit(Vec2::new(x, y));
    }

    /// Where the camera is, in units.
    pub fn eye(&mut self) -> Box<[f32]> {
        Box::new(self.tender.camera().view().eye.to_array())
    }

    /// The CSS cursor that fits.
    pub fn cursor(&mut self) -> Result<String, JsError> {
        self.tender.cursor().map(|cursor| cursor.css().into()).map_err(js_error)
    }

    /// Lets `seconds` pass and draws into a canvas of so many device pixels.
    pub fn frame(&mut self, seconds: f32, width: u32, height: u32) -> Result<(), JsError> {
        self.tender.frame(seconds).map_err(js_error)?;
        if let Some(renderer) = &mut self.renderer {
            let context = renderer.context().clone();
            let screen = RenderTarget::screen(&context, width, height);
            self.tender.draw(renderer, &screen).map_err(js_error)?;
        }
        Ok(())
    }

    /// Runs exactly so many ticks, whatever the clock says.
    pub fn play(&mut self, ticks: u32) -> Result<(), JsError> {
        self.tender.play(ticks).map_err(js_error)
    }

    /// The numbers of the counter as JSON.
    pub fn readout(&self) -> String {
        serde_json::to_string(&self.tender.readout()).unwrap_or_default()
    }

    /// The hash of the cloth's state, as the same hexadecimal number everywhere.
    #[wasm_bindgen(js_name = stateHash)]
    pub fn state_hash(&self) -> String {
        format!("{:016x}", self.tender.cloth().state_hash())
    }

    /// Where a particle appears, x and y in CSS pixels of the canvas; nothing if it does not.
    #[wasm_bindgen(js_name = particleScreen)]
    pub fn particle_screen(&self, particle: u32) -> Option<Box<[f32]>> {
        let at = self.tender.on_screen(self.tender.particle(particle)?)?;
        Some(Box::new([at.x, at.y]))
    }
}
