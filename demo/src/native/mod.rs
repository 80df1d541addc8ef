//! Window of the demo: three-d's context, winit's events, and egui over the picture.
//!
//! Method: one winit event loop that forwards events to a [`WindowApp`] and draws a frame on every
//! redraw.
//!
//! Reads window events; writes frames, and errors to standard error.
//!
//! Invariant: pointer positions are in logical pixels, and events over the overlay do not reach the
//! scene.

pub mod panel;
pub mod photo_file;
pub mod receipt_window;
pub mod settings_file;
pub mod window_app;

use std::fmt;
use std::sync::OnceLock;
use std::time::Instant;

use glam::Vec2;
use three_d::{CoreError, FrameInputGenerator, GUI, SurfaceSettings, WindowedContext};
use winit::dpi::LogicalSize;
use winit::event::{
    ElementState, Event, MouseButton, MouseScrollDelta, TouchPhase, VirtualKeyCode, WindowEvent,
};
use winit::event_loop::{ControlFlow, EventLoop};
use winit::window::{CursorIcon, Window, WindowBuilder};

use crate::pointer::Cursor;
use crate::receipt::pointers::PressKind;
use window_app::WindowApp;

/// Pointer id of the left mouse button; fingers count from one.
const LEFT_BUTTON: u32 = 0;
/// Pointer id of the right mouse button.
const RIGHT_BUTTON: u32 = u32::MAX;
/// Longest time between the two presses of a double press [s].
const DOUBLE_PRESS_SECONDS: f64 = 0.35;
/// Pixels per notch of a mouse wheel.
const NOTCH_PIXELS: f32 = 100.0;

/// Reason why there is no window; its message names the alternatives.
#[derive(Debug)]
pub struct NoWindow(String);

impl fmt::Display for NoWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no window ({}); `--web` serves the demo as a page, `--shot FILE.png` draws it without a screen",
            self.0
        )
    }
}

impl std::error::Error for NoWindow {}

/// Returns the seconds since the first call.
pub fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// Opens a window for `app` and runs it until the window is closed.
///
/// # Errors
/// [`NoWindow`] if there is no display or it has no OpenGL 3.3.
pub fn run(mut app: impl WindowApp + 'static) -> Result<(), NoWindow> {
    let event_loop = event_loop()?;
    let to_message = |e: &dyn fmt::Display| NoWindow(e.to_string());
    let window = WindowBuilder::new()
        .with_title(app.title())
        .with_inner_size(LogicalSize::new(1280.0, 720.0))
        .with_min_inner_size(LogicalSize::new(320.0, 320.0))
        .build(&event_loop)
        .map_err(|e| to_message(&e))?;
    // The scene has its own multisampled render target.
    let surface = SurfaceSettings { multisamples: 0, ..SurfaceSettings::default() };
    let context =
        WindowedContext::from_winit_window(&window, surface).map_err(|e| to_message(&e))?;
    app.attach(&context).map_err(|e| to_message(&e))?;
    let mut window_state = WindowState {
        input: FrameInputGenerator::from_winit_window(&window),
        gui: GUI::new(&context),
        mouse: Vec2::ZERO,
        pressed: (f64::NEG_INFINITY, Vec2::ZERO),
        arrows: [false; 4],
        last: clock(),
        app,
        context,
        window,
    };
    window_state.update_size();
    event_loop.run(move |event, _, flow| match event {
        Event::WindowEvent { event, .. } => window_state.handle_event(&event, flow),
        Event::MainEventsCleared => window_state.window.request_redraw(),
        Event::RedrawRequested(_) => {
            *flow = ControlFlow::Poll;
            if let Err(error) = window_state.frame() {
                eprintln!("{error}");
                *flow = ControlFlow::ExitWithCode(1);
            }
        }
        Event::LoopDestroyed => window_state.app.save_settings(),
        _ => {}
    })
}

/// Creates the event loop. Without a display winit panics; this function returns an error instead.
fn event_loop() -> Result<EventLoop<()>, NoWindow> {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(all(unix, not(target_os = "macos"))) && !set("DISPLAY") && !set("WAYLAND_DISPLAY") {
        return Err(NoWindow("there is no display".into()));
    }
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let made = std::panic::catch_unwind(EventLoop::new);
    std::panic::set_hook(hook);
    made.map_err(|_| NoWindow("the display cannot be opened".into()))
}

/// The window with its context and application.
struct WindowState<A> {
    app: A,
    gui: GUI,
    input: FrameInputGenerator,
    context: WindowedContext,
    mouse: Vec2,
    /// Time [s] and position of the last press.
    pressed: (f64, Vec2),
    /// Which of the keys left, right, down and up are held.
    arrows: [bool; 4],
    last: f64,
    window: Window,
}

impl<A: WindowApp> WindowState<A> {
    /// Passes the size of the window in logical pixels to the application.
    fn update_size(&mut self) {
        let size = self.window.inner_size().to_logical(self.window.scale_factor());
        self.app.resize(Vec2::new(size.width, size.height));
    }

    fn handle_event(&mut self, event: &WindowEvent<'_>, flow: &mut ControlFlow) {
        self.input.handle_winit_window_event(event);
        let scale = self.window.scale_factor();
        let done = match event {
            WindowEvent::CloseRequested => {
                *flow = ControlFlow::Exit;
                Ok(())
            }
            WindowEvent::Resized(size) => {
                self.context.resize(*size);
                self.update_size();
                Ok(())
            }
            WindowEvent::ScaleFactorChanged { new_inner_size, .. } => {
                self.context.resize(**new_inner_size);
                self.update_size();
                Ok(())
            }
            WindowEvent::CursorMoved { position, .. } => {
                let at = position.to_logical::<f32>(scale);
                self.mouse = Vec2::new(at.x, at.y);
                let dragged = self.app.drag(LEFT_BUTTON, self.mouse);
                dragged.and_then(|()| self.app.drag(RIGHT_BUTTON, self.mouse))
            }
            WindowEvent::CursorLeft { .. } => {
                self.app.clear_hover();
                Ok(())
            }
            WindowEvent::MouseInput { state, button, .. } => {
                let (id, press) = match button {
                    MouseButton::Left => (LEFT_BUTTON, PressKind::Main),
                    MouseButton::Right => (RIGHT_BUTTON, PressKind::Turn),
                    _ => return,
                };
                match state {
                    ElementState::Pressed if self.app.covers(self.mouse) => Ok(()),
                    ElementState::Pressed => self.press(id, self.mouse, press),
                    ElementState::Released => self.app.lift(id),
                }
            }
            WindowEvent::MouseWheel { delta, .. } if !self.app.covers(self.mouse) => {
                let pixels = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => lines * NOTCH_PIXELS,
                    MouseScrollDelta::PixelDelta(by) => by.to_logical::<f32>(scale).y,
                };
                self.app.wheel(-pixels);
                Ok(())
            }
            WindowEvent::TouchpadMagnify { delta, .. } => {
                self.app.pinch((*delta as f32).exp());
                Ok(())
            }
            WindowEvent::Touch(touch) => {
                let at = touch.location.to_logical::<f32>(scale);
                let at = Vec2::new(at.x, at.y);
                let finger = (touch.id as u32 % (RIGHT_BUTTON - 1)) + 1;
                match touch.phase {
                    TouchPhase::Started if self.app.covers(at) => Ok(()),
                    TouchPhase::Started => self.press(finger, at, PressKind::Main),
                    TouchPhase::Moved => self.app.drag(finger, at),
                    TouchPhase::Ended | TouchPhase::Cancelled => self.app.lift(finger),
                }
            }
            WindowEvent::ModifiersChanged(keys) => self.app.shift(keys.shift()),
            WindowEvent::KeyboardInput { input, .. } => {
                self.arrow(input.virtual_keycode, input.state == ElementState::Pressed);
                Ok(())
            }
            WindowEvent::Focused(false) => {
                self.arrows = [false; 4];
                self.app.arrows(Vec2::ZERO);
                let let_go = self.app.shift(false).and_then(|()| self.app.lift(LEFT_BUTTON));
                let_go.and_then(|()| self.app.lift(RIGHT_BUTTON))
            }
            WindowEvent::ReceivedCharacter(key) => self.key(*key),
            _ => Ok(()),
        };
        if let Err(error) = done {
            eprintln!("{error}");
            *flow = ControlFlow::ExitWithCode(1);
        }
    }

    fn key(&mut self, key: char) -> muslin::Result<()> {
        if self.gui.context().egui_wants_keyboard_input() {
            return Ok(());
        }
        self.app.key(key)
    }

    /// Handles a key that is pressed or released, if it is an arrow.
    fn arrow(&mut self, key: Option<VirtualKeyCode>, is_down: bool) {
        use VirtualKeyCode::{Down, Left, Right, Up};
        let Some(i) = key.and_then(|key| [Left, Right, Down, Up].iter().position(|it| *it == key))
        else {
            return;
        };
        // The overlay uses them in its controls; a release always counts.
        self.arrows[i] = is_down && !self.gui.context().egui_wants_keyboard_input();
        let [left, right, down, up] = self.arrows.map(|held| f32::from(u8::from(held)));
        self.app.arrows(Vec2::new(right - left, up - down));
    }

    /// Handles a press; a second press soon after the first and close to it is a double press.
    fn press(&mut self, id: u32, at: Vec2, press: PressKind) -> muslin::Result<()> {
        let now = clock();
        let (then, there) = std::mem::replace(&mut self.pressed, (now, at));
        if press == PressKind::Main
            && now - then < DOUBLE_PRESS_SECONDS
            && at.distance(there) < 12.0
        {
            self.app.press_twice(at)?;
        }
        self.app.press(id, at, press)
    }

    fn frame(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        let now = clock();
        let seconds = (now - self.last) as f32;
        if now.floor() > self.last.floor() {
            self.app.save_settings();
        }
        self.last = now;
        self.app.frame(seconds)?;

        let mut input = self.input.generate(&self.context);
        let app = &mut self.app;
        self.gui.update(
            &mut input.events,
            input.accumulated_time,
            input.viewport,
            input.device_pixel_ratio,
            |ui| app.draw_overlay(ui.ctx()),
        );
        self.app.run_commands()?;
        let cursor = match self.app.cursor()? {
            _ if self.app.covers(self.mouse) => CursorIcon::Default,
            Cursor::Default => CursorIcon::Default,
            Cursor::Grab => CursorIcon::Grab,
            Cursor::Grabbing => CursorIcon::Grabbing,
            Cursor::Crosshair => CursorIcon::Crosshair,
        };
        self.window.set_cursor_icon(cursor);

        let screen = input.screen();
        self.app.draw(&screen)?;
        screen.write::<CoreError>(|| self.gui.render())?;
        self.context.swap_buffers()?;
        Ok(())
    }
}
