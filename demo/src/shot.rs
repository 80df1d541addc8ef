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
        let [width, height] = self.size;
        app.resize(Vec2::new(width as f32, height as f32));
        app.camera().set_drift(false);
        app.camera().orbit(self.orbit);
        app.camera().zoom(self.zoom);
        for _ in 0..600 {
            app.camera().advance(1.0 / 60.0, true);
        }
        if self.tear {
            let before = self.ticks.saturating_sub(75);
            app.play(before);
            self.rip(&mut app, self.ticks - before)?;
        } else {
            app.play(self.ticks);
        }
        Ok(app)
    }

    /// A hand takes the cloth a little right of its middle and yanks it down and aside.
    fn rip(&self, app: &mut App, ticks: u32) -> Result<(), Failure> {
        let n = app.settings().resolution;
        let taken = n * 2 / 5 * n + n * 3 / 5;
        let Some(from) = app.particle_on_screen(taken) else {
            return Ok(());
        };
        const HAND: u32 = 1;
        app.press(HAND, from)?;
        let pull = Vec2::new(0.16, 0.42) * self.size[1] as f32;
        for tick in 0..ticks {
            let share = (tick as f32 / 40.0).min(1.0);
            app.drag(HAND, from + pull * share)?;
            app.play(1);
            if tick == 48 {
                app.lift(HAND)?;
            }
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
        let file = std::io::BufWriter::new(std::fs::File::create(path)?);
        let mut encoder = png::Encoder::new(file, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.rgb)?;
        Ok(())
    }
}
