//! Time of what moves by itself, and the camera that follows the figure.
//!
//! Method: on an upright screen the camera keeps the middle of the clothes where the middle of the
//! walk would be, so that the figure can be drawn larger than its whole walk.
//!
//! Reads frame times and the positions of the clothes; writes the time and the camera.
//!
//! Invariant: scenes without a figure do not move the camera here.

use glam::Vec3;

use super::App;

/// Period of [`FrameScene::time`](crate::render::FrameScene::time), so that it stays exact [s].
const TIME_PERIOD: f32 = 3600.0;

impl App {
    /// Advances the time of halos and dust, and lets the camera follow the figure.
    pub(super) fn pass_time(&mut self, seconds: f32) {
        if !self.reduced_motion && !self.is_photo {
            self.time = (self.time + seconds) % TIME_PERIOD;
        }
        if self.scene.figure().is_some() {
            let clothes = self.scene.cloths[0].positions();
            let middle = clothes.iter().sum::<Vec3>() / clothes.len().max(1) as f32;
            self.camera.follow(middle);
        }
    }
}
