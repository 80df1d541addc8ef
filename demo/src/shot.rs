//! A picture without a window: so many ticks of the scene, then one frame into a PNG, or several side
//! by side: a film strip.

use std::path::Path;

use glam::Vec2;

use crate::app::App;
use crate::camera::Camera;
use crate::gesture::{Gesture, GesturePlayer};
use crate::headless::Headless;
use crate::meter::StageTime;
use crate::native;
use crate::receipt::{self, ReceiptApp};
use crate::render::receipt_renderer::ReceiptRenderer;
use crate::render::{OffscreenCanvas, Renderer};
use crate::settings::Settings;

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Ticks that the scene plays first.
    pub ticks: u32,
    /// What hands do in the last of them.
    pub play: Option<Gesture>,
    /// How many frames there are, side by side.
    pub strip: u32,
    /// Whether every tick is drawn and timed.
    pub times: bool,
    /// The controls.
    pub settings: Settings,
    /// How far the camera is dragged from where it starts, in heights of the screen.
    pub orbit: Vec2,
    /// What the camera's distance is multiplied by.
    pub zoom: f32,
    /// The receipt, in place of the cloth that the controls tell of.
    pub receipt: Option<ReceiptShot>,
}

/// The receipt in a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReceiptShot {
    /// Its controls.
    pub settings: receipt::ReceiptSettings,
    /// Whether it has fewer particles.
    pub small: bool,
    /// What hands do in the last ticks.
    pub play: Option<receipt::gestures::ReceiptGesture>,
}

impl Default for Shot {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            ticks: 240,
            play: None,
            strip: 1,
            times: false,
            settings: Settings::default(),
            orbit: Vec2::ZERO,
            zoom: 1.0,
            receipt: None,
        }
    }
}

/// A picture: rows from the top, three bytes a pixel.
pub struct Picture {
    /// What the stages of a frame took, if they were timed.
    pub times: Vec<StageTime>,
    /// What drew it, and how many frames of the timed ones a second, from the first tick until the last was finished.
    pub rate: Option<(String, f64)>,
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
        let mut subject: Box<dyn ShotSubject> = match &self.receipt {
            None => Box::new(self.begin(Renderer::new(&headless.context)?)?),
            Some(receipt) => {
                Box::new(self.begin_receipt(receipt, ReceiptRenderer::new(&headless.context)?)?)
            }
        };
        let [width, height] = self.size;
        let canvas = OffscreenCanvas::new(&headless.context, width, height);
        let mut strip = Picture::black([width * self.strip, height]);
        // The hands work before the usual camera, whatever the picture: the same gesture in each.
        let hands_view = subject.camera().clone();
        if self.times {
            // What is made at the first frame is none of the others' time.
            subject.draw(&canvas)?;
            headless.finish();
        }
        let start = native::clock();
        let mut ticks = 0;
        for i in 0..self.strip {
            let until = self.moment(i);
            while ticks < until {
                subject.tick()?;
                ticks += 1;
                if self.times {
                    subject.draw(&canvas)?;
                }
            }
            if self.times && i + 1 == self.strip {
                headless.finish();
                strip.rate =
                    Some((headless.driver(), f64::from(ticks) / (native::clock() - start)));
            }
            *subject.camera() = self.view(&hands_view);
            subject.draw(&canvas)?;
            *subject.camera() = hands_view.clone();
            strip.put(i * width, self.size, &canvas.pixels());
        }
        if self.times {
            strip.times = subject.times();
        }
        Ok(strip)
    }

    /// The scene after as many ticks as come before the gesture, and the gesture.
    fn begin(&self, renderer: Renderer) -> Result<ClothSubject, Failure> {
        let mut settings = self.settings.clone();
        settings.tearing |= matches!(self.play, Some(Gesture::Tear | Gesture::Yank));
        let mut app = App::new(settings, native::clock)?;
        app.camera().set_drift(false);
        app.play(self.ticks - self.played());
        app.time_stages(self.times);
        let play = self.play.map(|gesture| GesturePlayer::new(gesture, &mut app));
        Ok(ClothSubject { app, play, renderer })
    }

    /// The same of the receipt.
    fn begin_receipt(
        &self,
        receipt: &ReceiptShot,
        desk: ReceiptRenderer,
    ) -> Result<ReceiptSubject, Failure> {
        let mut tender = ReceiptApp::new(receipt.settings.clone(), receipt.small, native::clock)?;
        tender.play(self.ticks - self.played())?;
        tender.time_stages(self.times);
        let play = receipt.play.map(receipt::gestures::ReceiptGesturePlayer::new);
        Ok(ReceiptSubject { tender, play, desk })
    }

    /// Ticks that are played with hands, or from the first picture of a strip to the last.
    fn played(&self) -> u32 {
        let gesture = match &self.receipt {
            None => self.play.map(Gesture::ticks),
            Some(receipt) => receipt.play.map(receipt::gestures::ReceiptGesture::ticks),
        };
        let still = if self.times {
            self.ticks
        } else if self.strip > 1 {
            60
        } else {
            0
        };
        gesture.unwrap_or(still).min(self.ticks)
    }

    /// After how many of these the picture of this number is taken.
    fn moment(&self, i: u32) -> u32 {
        self.played() * (i + 1) / self.strip
    }

    /// The camera of the picture.
    fn view(&self, usual: &Camera) -> Camera {
        let [width, height] = self.size.map(|side| side as f32);
        let mut camera = usual.clone();
        camera.fit_to_aspect(width / height);
        camera.orbit(self.orbit);
        camera.zoom(self.zoom);
        for _ in 0..600 {
            camera.advance(1.0 / 60.0, true);
        }
        camera
    }
}

/// What a picture is taken of.
trait ShotSubject {
    fn tick(&mut self) -> Result<(), Failure>;
    fn draw(&mut self, canvas: &OffscreenCanvas) -> Result<(), Failure>;
    fn camera(&mut self) -> &mut Camera;
    fn times(&self) -> Vec<StageTime>;
}

/// The cloth of the controls, and who plays with it.
struct ClothSubject {
    app: App,
    play: Option<GesturePlayer>,
    renderer: Renderer,
}

impl ShotSubject for ClothSubject {
    fn tick(&mut self) -> Result<(), Failure> {
        match &mut self.play {
            Some(play) => play.step(&mut self.app)?,
            None => self.app.play(1),
        }
        Ok(())
    }

    fn draw(&mut self, canvas: &OffscreenCanvas) -> Result<(), Failure> {
        Ok(self.app.draw(&mut self.renderer, &canvas.target())?)
    }

    fn camera(&mut self) -> &mut Camera {
        self.app.camera()
    }

    fn times(&self) -> Vec<StageTime> {
        self.app.stage_times()
    }
}

/// The receipt, and who plays with it.
struct ReceiptSubject {
    tender: ReceiptApp,
    play: Option<receipt::gestures::ReceiptGesturePlayer>,
    desk: ReceiptRenderer,
}

impl ShotSubject for ReceiptSubject {
    fn tick(&mut self) -> Result<(), Failure> {
        match &mut self.play {
            Some(play) => play.step(&mut self.tender)?,
            None => self.tender.play(1)?,
        }
        Ok(())
    }

    fn draw(&mut self, canvas: &OffscreenCanvas) -> Result<(), Failure> {
        Ok(self.tender.draw(&mut self.desk, &canvas.target())?)
    }

    fn camera(&mut self) -> &mut Camera {
        self.tender.camera()
    }

    fn times(&self) -> Vec<StageTime> {
        self.tender.stage_times()
    }
}

impl Picture {
    fn black(size: [u32; 2]) -> Self {
        Self {
            times: Vec::new(),
            rate: None,
            size,
            rgb: vec![0; 3 * size[0] as usize * size[1] as usize],
        }
    }

    /// Puts the pixels of a smaller picture into this one, so far from its left side.
    fn put(&mut self, left: u32, size: [u32; 2], pixels: &[[u8; 4]]) {
        let [width, height] = size.map(|side| side as usize);
        for row in 0..height {
            let start = 3 * (row * self.size[0] as usize + left as usize);
            let into = self.rgb[start..start + 3 * width].chunks_exact_mut(3);
            for (into, pixel) in into.zip(&pixels[row * width..]) {
                into.copy_from_slice(&pixel[..3]);
            }
        }
    }

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
