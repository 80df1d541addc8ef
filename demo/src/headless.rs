//! OpenGL context without a window, through EGL on any device, including a software rasteriser.
//!
//! Method: EGL device enumeration and a surfaceless context; the first device that offers OpenGL
//! 3.3 is used.
//!
//! Reads the list of devices; makes a context current on this thread.
//!
//! Invariant: the context stays current while [`Headless`] lives.

use std::ffi::CString;
use std::fmt;
use std::sync::Arc;

use glutin::api::egl::context::PossiblyCurrentContext;
use glutin::api::egl::device::Device;
use glutin::api::egl::display::Display;
use glutin::config::{ConfigSurfaceTypes, ConfigTemplateBuilder};
use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, Version};
use glutin::display::GlDisplay;
use three_d::Context;
use three_d::context::HasContext as _;

/// A drawing context without a screen.
pub struct Headless {
    /// Context for three-d.
    pub context: Context,
    _current: PossiblyCurrentContext,
}

/// Reason why there is no context; its message names the packages to install.
#[derive(Debug)]
pub struct NoContext(String);

impl fmt::Display for NoContext {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no OpenGL 3.3 context without a window ({}); on Debian or Ubuntu: apt install libegl1 libgl1-mesa-dri",
            self.0
        )
    }
}

impl std::error::Error for NoContext {}

impl Headless {
    /// Creates a context on the first device that offers one.
    ///
    /// # Errors
    /// [`NoContext`] if EGL is missing or no device offers OpenGL 3.3.
    pub fn new() -> Result<Self, NoContext> {
        let devices = Device::query_devices().map_err(|e| NoContext(e.to_string()))?;
        let mut why = String::from("EGL knows no device");
        for device in devices {
            match Self::on(&device) {
                Ok(headless) => return Ok(headless),
                Err(error) => why = error,
            }
        }
        Err(NoContext(why))
    }

    /// Waits until the driver has finished all drawing.
    pub fn finish(&self) {
        // SAFETY: the context is current.
        unsafe { self.context.finish() }
    }

    /// Returns the name of the renderer as the driver gives it.
    pub fn driver(&self) -> String {
        // SAFETY: the context is current.
        unsafe { self.context.get_parameter_string(three_d::context::RENDERER) }
    }

    fn on(device: &Device) -> Result<Self, String> {
        let to_message = |e: glutin::error::Error| e.to_string();
        // SAFETY: the call passes no native display, so no display can become invalid.
        let display = unsafe { Display::with_device(device, None) }.map_err(to_message)?;
        let template =
            ConfigTemplateBuilder::new().with_surface_type(ConfigSurfaceTypes::empty()).build();
        // SAFETY: the template refers to no native window.
        let config = unsafe { display.find_configs(template) }
            .map_err(to_message)?
            .next()
            .ok_or("the device has no configuration")?;
        let attributes = ContextAttributesBuilder::new()
            .with_profile(GlProfile::Core)
            .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
            .build(None);
        // SAFETY: display and config come from the calls above.
        let context =
            unsafe { display.create_context(&config, &attributes) }.map_err(to_message)?;
        let current = context.make_current_surfaceless().map_err(to_message)?;
        let load = |name: &str| match CString::new(name) {
            Ok(name) => display.get_proc_address(&name),
            Err(_) => std::ptr::null(),
        };
        // SAFETY: the context is current on this thread, and stays so while `_current` lives.
        let gl = unsafe { three_d::context::Context::from_loader_function(load) };
        let context = Context::from_gl_context(Arc::new(gl)).map_err(|e| e.to_string())?;
        Ok(Self { context, _current: current })
    }
}
