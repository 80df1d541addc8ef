//! Drawing of the receipt: converts its state from metres to units and passes it to the renderer.
//!
//! Method: one [`ClothSurface`] per frame with scaled positions.
//!
//! Reads [`ReceiptApp`]; writes the output target and the frame timing.
//!
//! Invariant: the simulation does not change.

use glam::Vec3;
use three_d::{CoreError, RenderTarget};

use super::ReceiptApp;
use crate::meter::ResolutionScaler;
use crate::render::ClothSurface;
use crate::render::receipt_renderer::{ReceiptFrame, ReceiptRenderer};

impl ReceiptApp {
    /// Draws few pixels until the first frames have shown that the machine is fast enough for all.
    pub fn start_low(&mut self) {
        self.resolution_scaler = ResolutionScaler::starting_low();
    }

    /// Draws the current state of the receipt.
    ///
    /// # Errors
    /// As [`ReceiptRenderer::draw`].
    pub fn draw(
        &mut self,
        renderer: &mut ReceiptRenderer,
        output: &RenderTarget<'_>,
    ) -> Result<(), CoreError> {
        // This call computes the normals, so their time counts as time of the simulation.
        self.cloth.normals();
        if self.times_stages {
            self.meter.record_stages(&self.cloth.stats().seconds);
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
        // The reset animation moves the paper without ticks.
        self.creases.record(&self.cloth, self.settings.sheet, self.grid_size());
        let view = self.cloth.view();
        self.positions.clear();
        self.positions.extend(view.positions.iter().map(|at| *at / unit));
        let surface = ClothSurface {
            positions: &self.positions,
            unit: 1.0,
            normals: view.normals,
            uvs: view.uvs,
            frayed: view.frayed,
            hollows: &[],
            indices: view.indices,
            coarse_indices: &[],
            lines: &[],
            span,
            is_round: false,
            revision,
        };
        let density = output.width() as f32 / self.screen.size.x.max(1.0);
        let start = (self.clock)();
        renderer.upload_paper(&surface, &mut self.creases.map);
        let uploaded = (self.clock)();
        let view = ReceiptFrame {
            view: self.camera.view(),
            pins: &pins,
            resolution_scale: self.resolution_scaler.scale(density),
            is_low: self.resolution_scaler.is_low(),
        };
        renderer.draw(&view, output)?;
        self.meter.record_drawing(uploaded - start, (self.clock)() - uploaded);
        Ok(())
    }
}
