//! Photo mode: time stands still, every pointer turns the camera, and a large picture is taken.
//!
//! Method: the scene is drawn once more into an off-screen canvas of the size of the picture, with
//! the finest cloth, and read back.
//!
//! Reads the scene and the camera; returns pixels.
//!
//! Invariant: a picture changes nothing of the scene, and no pointer holds cloth in this mode.

use muslin::Result;
use three_d::CoreError;

use super::App;
use crate::render::{OffscreenCanvas, Renderer};

/// Longer and shorter side of a picture [px].
const SIDES: [u32; 2] = [3840, 2160];

/// A picture.
pub struct Photo {
    /// Width and height [px].
    pub size: [u32; 2],
    /// Red, green, blue and alpha of each pixel, from the top row.
    pub pixels: Vec<[u8; 4]>,
}

impl App {
    /// Returns whether the photo mode is on.
    pub fn is_photo(&self) -> bool {
        self.is_photo
    }

    /// Begins or ends the photo mode; all pointers let go.
    ///
    /// # Errors
    /// As [`App::lift`].
    pub fn set_photo(&mut self, on: bool) -> Result<()> {
        self.is_photo = on;
        let (pointers, mut pick) = self.pick_context();
        pointers.lift_all(&mut pick)
    }

    /// Returns width and height of the pictures [px]: upright on an upright screen.
    pub fn photo_size(&self) -> [u32; 2] {
        let [long, short] = SIDES;
        if self.screen.aspect() < 1.0 { [short, long] } else { [long, short] }
    }

    /// Takes a picture of what the screen shows, whose height it keeps; the width follows from
    /// [`App::photo_size`].
    ///
    /// # Errors
    /// As [`Renderer::draw`].
    pub fn take_photo(&mut self, renderer: &mut Renderer) -> std::result::Result<Photo, CoreError> {
        let size = self.photo_size();
        let context = renderer.context().clone();
        let canvas = OffscreenCanvas::new(&context, size[0], size[1]);
        self.draw_at(renderer, &canvas.target(), 1.0, false)?;
        Ok(Photo { size, pixels: canvas.pixels() })
    }
}
