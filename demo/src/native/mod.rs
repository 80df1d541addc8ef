//! The demo in a window: three-d's context, winit's events, an egui panel.

pub mod panel;
pub mod store;

use std::fmt;
use std::sync::OnceLock;
use std::time::Instant;

use glam::Vec2;
use three_d::{CoreError, FrameInputGenerator, GUI, SurfaceSettings, WindowedContext};
use winit::dpi::LogicalSize;
use winit::event::{ElementState, Event, MouseButton, MouseScrollDelta, TouchPhase, WindowEvent};
use winit::event_loop::{ControlFlow, EventLoop};
use winit::window::{CursorIcon, Window, WindowBuilder};

use crate::app::App;
use crate::pointer::Cursor;
use crate::render::Renderer;
use panel::{Panel, Wish};

/// The mouse, among the pointers; fingers count from one.
const MOUSE: u32 = 0;
/// Pixels that one notch of a wheel is worth.
const NOTCH: f32 = 100.0;

/// Why there is no window; says in one line what works instead.
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

/// Seconds since the first call.
pub fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// Opens the window and runs until it is closed.
///
/// # Errors
/// [`NoWindow`] if there is no display or it has no OpenGL 3.3.
pub fn run(app: App) -> Result<(), NoWindow> {
    let event_loop = event_loop()?;
    let told = |e: &dyn fmt::Display| NoWindow(e.to_string());
    let window = WindowBuilder::new()
        .with_title("Muslin")
        .with_inner_size(LogicalSize::new(1280.0, 720.0))
        .with_min_inner_size(LogicalSize::new(320.0, 320.0))
        .build(&event_loop)
        .map_err(|e| told(&e))?;
    // The scene is drawn into a multisampled target of its own.
    let surface = SurfaceSettings { multisamples: 0, ..SurfaceSettings::default() };
    let context = WindowedContext::from_winit_window(&window, surface).map_err(|e| told(&e))?;
    let renderer = Renderer::new(&context).map_err(|e| told(&e))?;
    let mut stage = Stage {
        input: FrameInputGenerator::from_winit_window(&window),
        gui: GUI::new(&context),
        panel: Panel::default(),
        mouse: Vec2::ZERO,
        last: clock(),
        kept: app.settings().to_json(),
        app,
        renderer,
        context,
        window,
    };
    stage.fit();
    event_loop.run(move |event, _, flow| match event {
        Event::WindowEvent { event, .. } => stage.take(&event, flow),
        Event::MainEventsCleared => stage.window.request_redraw(),
        Event::RedrawRequested(_) => {
            *flow = ControlFlow::Poll;
            if let Err(error) = stage.frame() {
                eprintln!("{error}");
                *flow = ControlFlow::ExitWithCode(1);
            }
        }
        Event::LoopDestroyed => stage.keep(),
        _ => {}
    })
}

/// winit panics where there is no display; that becomes an error here.
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

/// Window, context and demo.
struct Stage {
    app: App,
    renderer: Renderer,
    gui: GUI,
    panel: Panel,
    input: FrameInputGenerator,
    context: WindowedContext,
    mouse: Vec2,
    last: f64,
    kept: String,
    window: Window,
}

impl Stage {
    /// The size of the window in logical pixels, the ones that pointers count in.
    fn fit(&mut self) {
        let size = self.window.inner_size().to_logical(self.window.scale_factor());
        self.app.resize(Vec2::new(size.width, size.height));
    }

    fn take(&mut self, event: &WindowEvent<'_>, flow: &mut ControlFlow) {
        self.input.handle_winit_window_event(event);
        let scale = self.window.scale_factor();
        let done = match event {
            WindowEvent::CloseRequested => {
                *flow = ControlFlow::Exit;
                Ok(())
            }
            WindowEvent::Resized(size) => {
                self.context.resize(*size);
                self.fit();
                Ok(())
            }
            WindowEvent::ScaleFactorChanged { new_inner_size, .. } => {
                self.context.resize(**new_inner_size);
                self.fit();
                Ok(())
            }
            WindowEvent::CursorMoved { position, .. } => {
                let at = position.to_logical::<f32>(scale);
                self.mouse = Vec2::new(at.x, at.y);
                self.app.drag(MOUSE, self.mouse)
            }
            WindowEvent::CursorLeft { .. } => {
                self.app.leave();
                Ok(())
            }
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => match state {
                ElementState::Pressed if self.panel.covers(self.mouse) => Ok(()),
                ElementState::Pressed => {
                    self.panel.hide_help();
                    self.app.press(MOUSE, self.mouse)
                }
                ElementState::Released => self.app.lift(MOUSE),
            },
            WindowEvent::MouseWheel { delta, .. } if !self.panel.covers(self.mouse) => {
                let pixels = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => lines * NOTCH,
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
                let finger = (touch.id as u32).wrapping_add(1).max(1);
                match touch.phase {
                    TouchPhase::Started if self.panel.covers(at) => Ok(()),
                    TouchPhase::Started => {
                        self.panel.hide_help();
                        self.app.press(finger, at)
                    }
                    TouchPhase::Moved => self.app.drag(finger, at),
                    TouchPhase::Ended | TouchPhase::Cancelled => self.app.lift(finger),
                }
            }
            WindowEvent::ModifiersChanged(keys) => {
                self.app.hold_blade(keys.shift());
                Ok(())
            }
            WindowEvent::Focused(false) => {
                self.app.hold_blade(false);
                self.app.lift(MOUSE)
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
        match key {
            '?' | 'h' | 'H' => self.panel.toggle_help(),
            'c' | 'C' => self.panel.toggle(),
            _ => {
                self.app.key(key, key.is_uppercase())?;
            }
        }
        Ok(())
    }

    fn frame(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        let now = clock();
        let seconds = (now - self.last) as f32;
        if now.floor() > self.last.floor() {
            self.keep();
        }
        self.last = now;
        self.app.frame(seconds)?;

        let mut input = self.input.generate(&self.context);
        let mut wishes = Vec::new();
        self.gui.update(
            &mut input.events,
            input.accumulated_time,
            input.viewport,
            input.device_pixel_ratio,
            |ui| self.panel.draw(ui.ctx(), &self.app, &mut wishes),
        );
        for wish in wishes {
            match wish {
                Wish::Set(name, value) => self.app.set(name, value)?,
                Wish::Act(action) => self.app.act(action)?,
                Wish::TimeStages(on) => self.app.time_stages(on),
            }
        }
        let cursor = match self.app.cursor()? {
            _ if self.panel.covers(self.mouse) => CursorIcon::Default,
            Cursor::Default => CursorIcon::Default,
            Cursor::Grab => CursorIcon::Grab,
            Cursor::Grabbing => CursorIcon::Grabbing,
            Cursor::Crosshair => CursorIcon::Crosshair,
        };
        self.window.set_cursor_icon(cursor);

        let screen = input.screen();
        self.app.draw(&mut self.renderer, &screen)?;
        screen.write::<CoreError>(|| self.gui.render())?;
        self.context.swap_buffers()?;
        Ok(())
    }

    /// Writes the settings down if they are others than before; asked once a second and at the end.
    fn keep(&mut self) {
        let now = self.app.settings().to_json();
        if now != self.kept {
            store::write(&now);
            self.kept = now;
        }
    }
}
