//! Screenshots without a window: runs a scene for some ticks and writes one frame as PNG, or
//! several frames side by side (a film strip).
//!
//! Method: an EGL context, an off-screen canvas and the same applications as in the window.
//!
//! Reads a [`Shot`]; writes a [`Picture`].
//!
//! Invariant: the same shot gives the same picture on the same driver, because ticks are counted
//! and no clock is read.

use std::path::Path;

use glam::Vec2;

use crate::app::App;
use crate::camera::Camera;
use crate::fabric::Fabric;
use crate::gesture::{Gesture, GesturePlayer};
use crate::headless::Headless;
use crate::meter::StageTime;
use crate::native;
use crate::receipt::{self, ReceiptApp};
use crate::render::receipt_renderer::ReceiptRenderer;
use crate::render::{OffscreenCanvas, Renderer};
use crate::settings::Settings;

/// Description of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Width and height [px] of a frame.
    pub size: [u32; 2],
    /// Ticks to run in total.
    pub ticks: u32,
    /// Gesture to run in the last of these ticks.
    pub play: Option<Gesture>,
    /// Number of frames side by side.
    pub strip: u32,
    /// Whether to draw one frame with each fabric, and one of the receipt, instead of a strip.
    pub fabrics: bool,
    /// Whether every tick is drawn and timed.
    pub times: bool,
    /// Values of the controls.
    pub settings: Settings,
    /// Drag of the camera from its start pose, in screen heights.
    pub orbit: Vec2,
    /// Factor of the distance of the camera.
    pub zoom: f32,
    /// The receipt; if present, it replaces the cloth scene of `settings`.
    pub receipt: Option<ReceiptShot>,
}

/// Description of a picture of the receipt.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReceiptShot {
    /// Settings of the receipt.
    pub settings: receipt::ReceiptSettings,
    /// Whether to use the smaller sheet.
    pub small: bool,
    /// Gesture to run in the last ticks.
    pub play: Option<receipt::gestures::ReceiptGesture>,
}

impl Default for Shot {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            ticks: 240,
            play: None,
            strip: 1,
            fabrics: false,
            times: false,
            settings: Settings::default(),
            orbit: Vec2::ZERO,
            zoom: 1.0,
            receipt: None,
        }
    }
}

/// A picture: rows from the top, three bytes per pixel.
pub struct Picture {
    /// Durations of the stages of a frame, if they were measured.
    pub times: Vec<StageTime>,
    /// Name of the renderer, and frames per second from the first measured tick to the end of the
    /// last one.
    pub rate: Option<(String, f64)>,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Red, green and blue of each pixel.
    pub rgb: Vec<u8>,
}

type Failure = Box<dyn std::error::Error>;

impl Shot {
    /// Runs the scene and draws the picture.
    ///
    /// # Errors
    /// [`crate::headless::NoContext`] if there is no OpenGL context, or the error of the cloth or
    /// the driver.
    pub fn take(&self) -> Result<Picture, Failure> {
        if self.fabrics {
            return self.take_fabrics();
        }
        let headless = Headless::new()?;
        let mut subject: Box<dyn ShotSubject> = match &self.receipt {
            None => Box::new(self.start_cloth(Renderer::new(&headless.context)?)?),
            Some(receipt) => {
                Box::new(self.start_receipt(receipt, ReceiptRenderer::new(&headless.context)?)?)
            }
        };
        let [width, height] = self.size;
        let canvas = OffscreenCanvas::new(&headless.context, width, height);
        let mut strip = Picture::black([width * self.strip, height]);
        // Gestures use the default camera, whatever view the picture has, so that the gesture is
        // always the same.
        let hands_view = subject.camera().clone();
        if self.times {
            // The first frame also creates buffers, so it is drawn before the measurement starts.
            subject.draw(&canvas)?;
            headless.finish();
        }
        let start = native::clock();
        let mut ticks = 0;
        for i in 0..self.strip {
            let until = self.ticks_before_frame(i);
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
            strip.copy_frame(i * width, self.size, &canvas.pixels());
        }
        if self.times {
            strip.times = subject.times();
        }
        Ok(strip)
    }

    /// Draws the scene with each fabric, and then the receipt, side by side.
    fn take_fabrics(&self) -> Result<Picture, Failure> {
        let cloth = |fabric| {
            let settings = Settings { fabric, ..self.settings.clone() };
            Self { settings, fabrics: false, strip: 1, receipt: None, ..self.clone() }
        };
        let mut shots: Vec<_> = Fabric::ALL.into_iter().map(cloth).collect();
        shots.push(Self { receipt: Some(ReceiptShot::default()), ..cloth(Fabric::Silk) });
        let [width, height] = self.size;
        let mut row = Picture::black([width * shots.len() as u32, height]);
        for (i, shot) in (0..).zip(shots) {
            let frame = shot.take()?;
            let pixels: Vec<_> =
                frame.rgb.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect();
            row.copy_frame(i * width, self.size, &pixels);
        }
        Ok(row)
    }

    /// Creates the cloth scene, runs the ticks before the gesture, and starts the gesture.
    fn start_cloth(&self, renderer: Renderer) -> Result<ClothSubject, Failure> {
        let mut settings = self.settings.clone();
        settings.tearing |= matches!(self.play, Some(Gesture::Tear | Gesture::Yank));
        let mut app = App::new(settings, native::clock)?;
        app.camera().set_drift(false);
        app.play(self.ticks - self.gesture_ticks());
        app.time_stages(self.times);
        let play = self.play.map(|gesture| GesturePlayer::new(gesture, &mut app));
        Ok(ClothSubject { app, play, renderer })
    }

    /// Does the same for the receipt.
    fn start_receipt(
        &self,
        receipt: &ReceiptShot,
        desk: ReceiptRenderer,
    ) -> Result<ReceiptSubject, Failure> {
        let mut app = ReceiptApp::new(receipt.settings.clone(), receipt.small, native::clock)?;
        app.play(self.ticks - self.gesture_ticks())?;
        app.time_stages(self.times);
        let play = receipt.play.map(receipt::gestures::ReceiptGesturePlayer::new);
        Ok(ReceiptSubject { app, play, desk })
    }

    /// Returns the number of ticks with a gesture, or between the first and the last frame of a
    /// strip.
    fn gesture_ticks(&self) -> u32 {
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

    /// Returns the number of these ticks before frame `i`.
    fn ticks_before_frame(&self, i: u32) -> u32 {
        self.gesture_ticks() * (i + 1) / self.strip
    }

    /// Returns the camera of the picture.
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

/// An application that a picture can show.
trait ShotSubject {
    fn tick(&mut self) -> Result<(), Failure>;
    fn draw(&mut self, canvas: &OffscreenCanvas) -> Result<(), Failure>;
    fn camera(&mut self) -> &mut Camera;
    fn times(&self) -> Vec<StageTime>;
}

/// The cloth scenes with their gesture.
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

/// The receipt with its gesture.
struct ReceiptSubject {
    app: ReceiptApp,
    play: Option<receipt::gestures::ReceiptGesturePlayer>,
    desk: ReceiptRenderer,
}

impl ShotSubject for ReceiptSubject {
    fn tick(&mut self) -> Result<(), Failure> {
        match &mut self.play {
            Some(play) => play.step(&mut self.app)?,
            None => self.app.play(1)?,
        }
        Ok(())
    }

    fn draw(&mut self, canvas: &OffscreenCanvas) -> Result<(), Failure> {
        Ok(self.app.draw(&mut self.desk, &canvas.target())?)
    }

    fn camera(&mut self) -> &mut Camera {
        self.app.camera()
    }

    fn times(&self) -> Vec<StageTime> {
        self.app.stage_times()
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

    /// Copies the pixels of a frame into this picture, `left` pixels from its left side.
    fn copy_frame(&mut self, left: u32, size: [u32; 2], pixels: &[[u8; 4]]) {
        let [width, height] = size.map(|side| side as usize);
        for row in 0..height {
            let start = 3 * (row * self.size[0] as usize + left as usize);
            let into = self.rgb[start..start + 3 * width].chunks_exact_mut(3);
            for (into, pixel) in into.zip(&pixels[row * width..]) {
                into.copy_from_slice(&pixel[..3]);
            }
        }
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// The error of the file system.
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
