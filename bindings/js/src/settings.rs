//! Settings, material and wind of a live cloth, as flat lists in the order of `packing`.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Returns the settings as a flat list.
    pub fn settings(&self) -> Vec<f64> {
        packing::pack_settings(self.cloth.settings())
    }

    /// Replaces all settings; they apply from the next tick on.
    pub fn set_settings(&mut self, settings: &[f64]) -> Result<()> {
        self.cloth.set_settings(packing::unpack_settings(settings)).map_err(to_js_error)
    }

    /// Returns the material as a flat list.
    pub fn material(&self) -> Vec<f64> {
        packing::pack_material(self.cloth.material())
    }

    /// Replaces the whole material; it applies from the next tick on.
    pub fn set_material(&mut self, material: &[f64]) -> Result<()> {
        self.cloth.set_material(packing::unpack_material(material)).map_err(to_js_error)
    }

    /// Returns the wind as a flat list.
    pub fn wind(&self) -> Vec<f64> {
        packing::pack_wind(self.cloth.wind())
    }

    /// Replaces the whole wind; it applies from the next tick on.
    pub fn set_wind(&mut self, wind: &[f64]) -> Result<()> {
        self.cloth.set_wind(packing::unpack_wind(wind)).map_err(to_js_error)
    }
}
