//! The class and functions of `skins.rs` in the module of `muslin/light`: no skin can be made.
//!
//! Both modules have the same exports, so that one script serves both.

use crate::RawCloth;
use crate::error::{Result, missing};
use core::convert::Infallible;
use wasm_bindgen::prelude::wasm_bindgen;

/// A skin, of which there is none.
#[wasm_bindgen]
pub struct RawSkin {
    none: Infallible,
}

#[wasm_bindgen]
impl RawCloth {
    /// Throws.
    pub fn skin(
        &self,
        _positions: &[f32],
        _indices: &[u32],
        _uvs: &[f32],
        _smoothness: f32,
    ) -> Result<RawSkin> {
        Err(missing("`skin`"))
    }
}

#[wasm_bindgen]
impl RawSkin {
    /// Never called.
    pub fn refresh(&mut self, _cloth: &RawCloth) -> Result<()> {
        match self.none {}
    }

    /// Never called.
    pub fn vertex_count(&self) -> u32 {
        match self.none {}
    }

    /// Never called.
    pub fn vertex_capacity(&self) -> u32 {
        match self.none {}
    }

    /// Never called.
    pub fn index_count(&self) -> u32 {
        match self.none {}
    }

    /// Never called.
    pub fn positions_ptr(&self) -> *const f32 {
        match self.none {}
    }

    /// Never called.
    pub fn normals_ptr(&self) -> *const f32 {
        match self.none {}
    }

    /// Never called.
    pub fn uvs_ptr(&self) -> *const f32 {
        match self.none {}
    }

    /// Never called.
    pub fn indices_ptr(&self) -> *const u32 {
        match self.none {}
    }

    /// Never called.
    pub fn source_vertices_ptr(&self) -> *const u32 {
        match self.none {}
    }

    /// Never called.
    pub fn frayed_ptr(&self) -> *const u8 {
        match self.none {}
    }

    /// Never called.
    pub fn topology_revision(&self) -> u32 {
        match self.none {}
    }

    /// Never called.
    pub fn write_vertices(
        &mut self,
        _cloth: &mut RawCloth,
        _streams: &[f64],
        _desc: &[f64],
    ) -> Result<()> {
        match self.none {}
    }
}

/// Returns the default smoothness of a skin, which `skin` ignores.
#[wasm_bindgen]
pub fn default_smoothness() -> f32 {
    1.0
}
