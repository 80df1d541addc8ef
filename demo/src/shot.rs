//! A picture without a window: so many ticks of the scene, then one frame into a PNG.

use std::path::Path;

use glam::Vec2;

use crate::app::App;
use crate::headless::Headless;
use crate::render::{Canvas, Renderer};
use crate::settings::Settings;

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Ticks that the scene plays first.
    pub ticks: u32,
    /// Whether a hand rips the cloth while it plays.
    pub tear: bool,
    /// The controls.
    pub settings: Settings,
    /// How far the camera is dragged from where it starts, in heights of the screen.
    pub orbit: Vec2,
    /// What the camera's distance is multiplied by.
    pub zoom: f32,
}

impl Default for Shot {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            ticks: 240,
            tear: false,
            settings: Settings::default(),
            orbit: Vec2::ZERO,
            zoom: 1.0,
        }
    }
}

/// A picture: rows from the top, three bytes a pixel.
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green, blue.
    pub rgb: Vec<u8>,
}

/// Ticks that a rip takes, until the cloth hangs again.
const RIP: u32 = 110;
/// Ticks of it that the hands pull.
const PULL: u32 = 80;
/// Ticks until they are as far as they go.
const WAY: f32 = 45.0;

type Failure = Box<dyn std::error::Error>;

impl Shot {
    /// Plays and draws; the same picture each time on the same driver.
    ///
    /// # Errors
    /// [`crate::headless::NoContext`] if nothing can draw here, or what the cloth or driver refuses.
    pub fn take(&self) -> Result<Picture, Failure> {
        let headless = Headless::new()?;
        let mut renderer = Renderer::new(&headless.context)?;
        let mut app = self.play()?;
        let [width, height] = self.size;
        let canvas = Canvas::new(&headless.context, width, height);
        app.draw(&mut renderer, &canvas.target())?;
        let rgb = canvas.pixels().iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
        Ok(Picture { size: self.size, rgb })
    }

    fn play(&self) -> Result<App, Failure> {
        let mut settings = self.settings.clone();
        settings.tearing |= self.tear;
        let mut app = App::new(settings, || 0.0)?;
        app.camera().set_drift(false);
        // The hands work before the usual camera, whatever the picture: the same rip in each.
        if self.tear {
            let before = self.ticks.saturating_sub(RIP);
            app.play(before);
            self.rip(&mut app, self.ticks - before)?;
        } else {
            app.play(self.ticks);
        }
        let [width, height] = self.size.map(|side| side as f32);
        app.resize(Vec2::new(width, height));
        app.camera().orbit(self.orbit);
        app.camera().zoom(self.zoom);
        for _ in 0..600 {
            app.camera().advance(1.0 / 60.0, true);
        }
        Ok(app)
    }

    /// Two hands take the hem, a little apart, and pull it asunder; then they let go.
    fn rip(&self, app: &mut App, ticks: u32) -> Result<(), Failure> {
        let n = app.settings().resolution;
        let height = app.screen().size.y;
        let mut hands = Vec::new();
        for (id, column, pull) in [(1, 0.44, [-0.5, 0.0]), (2, 0.54, [0.5, -0.1])] {
            let at = |share: f32| (share * (n - 1) as f32) as u32;
            let Some(from) = app.particle_on_screen(at(0.85) * n + at(column)) else {
                return Ok(());
            };
            app.press(id, from)?;
            hands.push((id, from, Vec2::from_array(pull) * height));
        }
        for tick in 0..ticks {
            let share = (tick as f32 / WAY).min(1.0);
            for (id, from, pull) in &hands {
                if tick < PULL {
                    app.drag(*id, *from + *pull * share)?;
                } else {
                    app.lift(*id)?;
                }
            }
            app.play(1);
        }
        Ok(())
    }
}

impl Picture {
    /// Writes it as PNG.
    ///
    /// # Errors
    /// What the file system says.
    pub fn save(&self, path: &Path) -> Result<(), Failure> {
        let file = std::fs::File::create(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let file = std::io::BufWriter::new(file);
        let mut encoder = png::Encoder::new(file, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.rgb)?;
        Ok(())
    }
}
