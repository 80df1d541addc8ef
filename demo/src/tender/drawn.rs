//! The receipt handed to its picture, in the brief's units.

use glam::Vec3;
use three_d::{CoreError, RenderTarget};

use super::Tender;
use crate::render::Surface;
use crate::render::desk::{Desk, View};

impl Tender {
    /// Draws the scene as it is now.
    ///
    /// # Errors
    /// As [`Desk::draw`].
    pub fn draw(&mut self, desk: &mut Desk, output: &RenderTarget<'_>) -> Result<(), CoreError> {
        // Asking for normals makes them, which belongs to the stages.
        self.cloth.normals();
        if self.times_stages {
            self.meter.simulated_in(&self.cloth.stats().seconds);
        }
        let unit = self.settings.sheet.unit();
        let revision =
            (u64::from(self.generation) << 32) | u64::from(self.cloth.topology_revision());
        let pins: Vec<Vec3> = self
            .cloth
            .pinned()
            .filter_map(|pin| self.cloth.positions().get(pin as usize).map(|at| *at / unit))
            .collect();
        let span = self.span();
        let view = self.cloth.view();
        self.positions.clear();
        self.positions.extend(view.positions.iter().map(|at| *at / unit));
        let surface = Surface {
            positions: &self.positions,
            unit: 1.0,
            normals: view.normals,
            uvs: view.uvs,
            frayed: view.frayed,
            indices: view.indices,
            lines: &[],
            span,
            is_round: false,
            revision,
        };
        let density = output.width() as f32 / self.screen.size.x.max(1.0);
        let start = (self.clock)();
        desk.take(&surface);
        let taken = (self.clock)();
        let view =
            View { sight: self.camera.sight(), pins: &pins, share: self.governor.share(density) };
        desk.draw(&view, output)?;
        self.meter.drawn(taken - start, (self.clock)() - taken);
        Ok(())
    }
}
