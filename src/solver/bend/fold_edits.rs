//! Edits of the folds from outside a tick: creases that the host asks for, and restored folds.
//!
//! Method: each edit translates between the mesh (grid or hinges) and `model::folds`, which stores
//! a plastic rest angle per bending element.
//!
//! Reads the rest mesh, hinges and plate elements; writes `world.folds`.
//! Invariant: after an edit the lists of `folds` still have one entry per bending element.

use crate::model::creases::CreaseLine;
use crate::model::folds::ElementLengths;
use crate::model::hinge::Hinge;
use crate::model::plate_elements::PerKind;
use crate::solver::world::World;
use glam::Vec3;

impl World {
    /// Replaces all fold angles [rad] by saved ones; false if their number or size does not fit.
    pub fn restore_folds(&mut self, angle: PerKind<Vec<f32>>) -> bool {
        let lengths = match &self.plate_elements {
            Some(plates) => ElementLengths::Grid(plates.spacing),
            None => ElementLengths::Hinges(&self.constraints.hinges.all),
        };
        let fits = self.folds.restore_angles(angle, &lengths);
        self.reserve_for_parameters();
        fits
    }

    /// Replaces the accumulated plastic curvature [1/m] by a saved one; false if it does not fit.
    pub fn restore_hardening(&mut self, curve: Vec<f32>) -> bool {
        let fits = self.folds.hardening.restore(curve);
        self.folds.reserve_hardening(&self.material);
        fits
    }

    /// Folds a grid by `angle` [rad] along a line in its rest plane, given in grid coordinates [m].
    pub fn crease_grid(&mut self, from: [f32; 2], to: [f32; 2], angle: f32) {
        self.reserve_folds();
        if let (Some(plates), true) = (&self.plate_elements, from != to) {
            let wears = self.material.tracks_hardening();
            self.folds.crease_plates(plates, CreaseLine::new(from, to), angle, wears);
        }
    }

    /// Folds any mesh by `angle` [rad] along a line segment on its rest shape [m].
    pub fn crease_mesh(&mut self, line: [Vec3; 2], angle: f32) {
        self.reserve_folds();
        let (mesh, rest) = (&self.mesh, &self.rest);
        let at = |hinge: &Hinge| hinge.particles.map(|v| rest[mesh.source[v as usize] as usize]);
        let (hinges, wears) = (&self.constraints.hinges, self.material.tracks_hardening());
        self.folds.crease_hinges(hinges, at, line, self.mean_edge, angle, wears);
    }
}
