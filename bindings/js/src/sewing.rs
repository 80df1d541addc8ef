//! Sewn pairs.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use muslin::{SewDesc, SewKind};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Sews pairs of particles together; `pairs` has two particles per pair.
    pub fn sew(
        &mut self,
        pairs: &[u32],
        speed: f32,
        is_stitch: bool,
        tear_force: f32,
    ) -> Result<()> {
        let kind = if is_stitch { SewKind::Stitch } else { SewKind::Weld };
        let desc = SewDesc { speed, kind, tear_force };
        self.cloth.sew(pairs.as_chunks().0, &desc).map_err(to_js_error)
    }
}
