//! JavaScript interface of the cloth scenes for `demo/web/main.js`.
//!
//! Method: thin wasm-bindgen wrappers around [`App`].
//!
//! Reads events, frame times and settings from the page; writes pixels, and JSON for the panel.
//!
//! Invariant: the page owns canvas, events, storage and HTML controls; all decisions are in modules
//! that the window uses too.

use std::sync::Arc;

use glam::Vec2;
use three_d::{Context, RenderTarget};
use wasm_bindgen::prelude::*;

use crate::app::App;
use crate::controls;
use crate::render::Renderer;
use crate::settings::Settings;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    pub(crate) fn now() -> f64;
}

/// The running demo with its GPU resources.
#[wasm_bindgen]
pub struct Demo {
    app: App,
    renderer: Option<Renderer>,
}

pub(crate) fn js_error(error: impl std::fmt::Display) -> JsError {
    JsError::new(&error.to_string())
}

/// Wraps the WebGL context of the page for three-d.
pub(crate) fn context_from_webgl(gl: web_sys::WebGl2RenderingContext) -> Result<Context, JsError> {
    let gl = three_d::context::Context::from_webgl2_context(gl);
    #[expect(clippy::arc_with_non_send_sync, reason = "three-d asks for an Arc everywhere")]
    let gl = Arc::new(gl);
    Context::from_gl_context(gl).map_err(js_error)
}

#[wasm_bindgen]
impl Demo {
    /// Starts with the saved settings; with the defaults if there are none or they are corrupt.
    /// Then come the `choices` of a link: names of controls with numbers of options, such as
    /// `scene=4&fabric=2`.
    #[wasm_bindgen(constructor)]
    pub fn new(kept: Option<String>, choices: &str) -> Result<Demo, JsError> {
        let mut settings =
            kept.and_then(|text| Settings::from_json(&text).ok()).unwrap_or_default();
        for (name, option) in choices.split('&').filter_map(|choice| choice.split_once('=')) {
            if let (Some(control), Ok(option)) = (controls::find_control(name), option.parse()) {
                control.set(&mut settings, option);
            }
        }
        let mut app = App::new(settings, || now() * 1.0e-3).map_err(js_error)?;
        app.start_low();
        Ok(Self { app, renderer: None })
    }

    /// Creates the renderer in a WebGL 2 context, also after a lost one.
    pub fn attach(&mut self, gl: web_sys::WebGl2RenderingContext) -> Result<(), JsError> {
        self.renderer = None;
        self.renderer = Some(Renderer::new(&context_from_webgl(gl)?).map_err(js_error)?);
        Ok(())
    }

    /// Drops the renderer: its context is lost.
    pub fn detach(&mut self) {
        self.renderer = None;
    }

    /// Returns the table of controls as JSON.
    pub fn controls() -> String {
        controls::to_json()
    }

    /// Returns the settings as JSON, for storage.
    pub fn settings(&self) -> String {
        self.app.settings().to_json()
    }

    /// Returns the value of a control: a switch is 0 or 1, a choice is the index of its option.
    pub fn get(&self, name: &str) -> f32 {
        controls::find_control(name).map_or(0.0, |c| c.get(self.app.settings()))
    }

    /// Returns the value of a control as text.
    pub fn text(&self, name: &str) -> String {
        controls::find_control(name).map_or_else(String::new, |c| c.text(self.app.settings()))
    }

    /// Returns whether a control has an effect in the current scene.
    #[wasm_bindgen(js_name = isEnabled)]
    pub fn is_enabled(&self, name: &str) -> bool {
        controls::find_control(name).is_some_and(|c| c.is_enabled(self.app.settings()))
    }

    /// Sets a control, or presses it if it is a button.
    pub fn set(&mut self, name: &str, value: f32) -> Result<(), JsError> {
        self.app.set(name, value).map_err(js_error)
    }

    /// Applies the control that belongs to a key; returns whether there is one.
    pub fn key(&mut self, key: char, shift: bool) -> Result<bool, JsError> {
        self.app.key(key, shift).map_err(js_error)
    }

    /// Ends the drift of the camera: there was an input.
    #[wasm_bindgen(js_name = noteInput)]
    pub fn note_input(&mut self) {
        self.app.camera().note_input();
    }

    /// Sets whether the user prefers reduced motion.
    #[wasm_bindgen(js_name = setReducedMotion)]
    pub fn set_reduced_motion(&mut self, reduced_motion: bool) -> Result<(), JsError> {
        self.app.set_reduced_motion(reduced_motion).map_err(js_error)
    }

    /// Sets the size of the canvas in CSS pixels.
    pub fn resize(&mut self, width: f32, height: f32) {
        self.app.resize(Vec2::new(width, height));
    }

    /// Sets how far overlays reach into the canvas, in CSS pixels.
    #[wasm_bindgen(js_name = setInsets)]
    pub fn set_insets(&mut self, left: f32, top: f32, right: f32, bottom: f32) {
        self.app.set_insets([left, top, right, bottom]);
    }

    /// Handles a pressed pointer, in CSS pixels of the canvas.
    pub fn press(&mut self, id: u32, x: f32, y: f32) -> Result<(), JsError> {
        self.app.press(id, Vec2::new(x, y)).map_err(js_error)
    }

    /// Handles a moved pointer.
    pub fn drag(&mut self, id: u32, x: f32, y: f32) -> Result<(), JsError> {
        self.app.drag(id, Vec2::new(x, y)).map_err(js_error)
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

    /// Zooms by the wheel, in CSS pixels.
    pub fn wheel(&mut self, pixels: f32) {
        self.app.wheel(pixels);
    }

    /// Orbits the camera by a drag, in screen heights.
    pub fn orbit(&mut self, x: f32, y: f32) {
        self.app.camera().orbit(Vec2::new(x, y));
    }

    /// Returns the position of the camera [m].
    pub fn eye(&mut self) -> Box<[f32]> {
        Box::new(self.app.camera().view().eye.to_array())
    }

    /// Returns the position of the walker [m]; nothing in scenes without one.
    pub fn walker(&self) -> Box<[f32]> {
        self.app.walker().iter().flat_map(|at| at.to_array()).collect()
    }

    /// Walks the person to the right and away from the camera while these are not both zero;
    /// returns whether there is a person.
    pub fn walk(&mut self, right: f32, away: f32) -> bool {
        self.app.walk(Vec2::new(right, away))
    }

    /// Sets whether the key for the blade is held.
    #[wasm_bindgen(js_name = holdBlade)]
    pub fn hold_blade(&mut self, out: bool) {
        self.app.hold_blade(out);
    }

    /// Returns the CSS name of the cursor.
    pub fn cursor(&mut self) -> Result<String, JsError> {
        self.app.cursor().map(|c| c.css().into()).map_err(js_error)
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

    /// Returns whether the photo mode is on.
    #[wasm_bindgen(js_name = isPhoto)]
    pub fn is_photo(&self) -> bool {
        self.app.is_photo()
    }

    /// Begins or ends the photo mode.
    #[wasm_bindgen(js_name = setPhoto)]
    pub fn set_photo(&mut self, on: bool) -> Result<(), JsError> {
        self.app.set_photo(on).map_err(js_error)
    }

    /// Returns width and height of the pictures [px].
    #[wasm_bindgen(js_name = photoSize)]
    pub fn photo_size(&self) -> Box<[u32]> {
        Box::new(self.app.photo_size())
    }

    /// Takes a picture: red, green, blue and alpha of each pixel, from the top row. Nothing while
    /// the context is lost.
    #[wasm_bindgen(js_name = takePhoto)]
    pub fn take_photo(&mut self) -> Result<Option<Box<[u8]>>, JsError> {
        let Some(renderer) = &mut self.renderer else {
            return Ok(None);
        };
        let photo = self.app.take_photo(renderer).map_err(js_error)?;
        Ok(Some(photo.pixels.into_flattened().into()))
    }

    /// Returns the numbers of the panel as JSON.
    pub fn readout(&self) -> String {
        serde_json::to_string(&self.app.readout()).unwrap_or_default()
    }

    /// Switches the timing of the stages of a frame on or off.
    #[wasm_bindgen(js_name = timeStages)]
    pub fn time_stages(&mut self, on: bool) {
        self.app.time_stages(on);
    }

    /// Returns name and duration [ms] of each stage as JSON.
    #[wasm_bindgen(js_name = stageTimes)]
    pub fn stage_times(&self) -> String {
        serde_json::to_string(&self.app.stage_times()).unwrap_or_default()
    }

    /// Returns the state hash of the cloth as a hexadecimal number; it is the same on every
    /// platform.
    #[wasm_bindgen(js_name = stateHash)]
    pub fn state_hash(&self) -> String {
        format!("{:016x}", self.app.state_hash())
    }

    /// Returns x and y of a particle in CSS pixels of the canvas; nothing if it is behind the
    /// camera.
    #[wasm_bindgen(js_name = particleScreen)]
    pub fn particle_screen(&mut self, particle: u32) -> Option<Box<[f32]>> {
        let at = self.app.particle_on_screen(particle)?;
        Some(Box::new([at.x, at.y]))
    }
}
