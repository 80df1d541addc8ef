//! The methods of `full.rs` in the module of `muslin/light`: each throws.
//!
//! Both modules have the same exports, so that one script serves both.

use crate::RawCloth;
use crate::error::{Result, missing};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Throws.
    pub fn restore(_buffer: &[u8]) -> Result<RawCloth> {
        Err(missing("`Cloth.restore`"))
    }

    /// Throws.
    pub fn save(&self) -> Result<Vec<u8>> {
        Err(missing("`save`"))
    }

    /// Throws.
    pub fn duplicate(&self) -> Result<RawCloth> {
        Err(missing("`duplicate`"))
    }

    /// Throws.
    pub fn cut(&mut self, _blade: &[f64]) -> Result<u32> {
        Err(missing("`cut`"))
    }

    /// Throws.
    pub fn sew(
        &mut self,
        _pairs: &[u32],
        _speed: f32,
        _is_stitch: bool,
        _tear_force: f32,
    ) -> Result<()> {
        Err(missing("`sew`"))
    }

    /// Throws.
    pub fn update_collider(&mut self, _collider: u32, _positions: &[f32]) -> Result<()> {
        Err(missing("`Collider.update`"))
    }

    /// Throws.
    pub fn collide_with(&mut self, _other: &RawCloth, _collider: u32) -> Result<u32> {
        Err(missing("`collideWith`"))
    }
}
