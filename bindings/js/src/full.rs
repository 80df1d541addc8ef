//! What only the full module has, beside `skins`: cuts, saves, sewing, and colliders whose vertices
//! move.
//!
//! `light.rs` has the same methods for `muslin/light`; there they throw.

use crate::RawCloth;
use crate::create::reserve;
use crate::error::{Result, to_js_error};
use crate::packing::{self, Reader};
use muslin::{Cloth, Collider, SewDesc, SewKind};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Creates a cloth from the bytes that `save` returned.
    pub fn restore(buffer: &[u8]) -> Result<RawCloth> {
        // A cloth without tears is saved as 84 bytes per particle.
        reserve(buffer.len() / 84);
        Cloth::restore(buffer).map(Self::new).map_err(to_js_error)
    }

    /// Returns the whole state of the cloth as bytes.
    pub fn save(&self) -> Result<Vec<u8>> {
        Ok(self.cloth.save())
    }

    /// Creates a copy of the cloth, by a save: the code that clones each list of a cloth would make
    /// the module 3 % larger.
    pub fn duplicate(&self) -> Result<RawCloth> {
        let mut copy = Self::restore(&self.save()?)?;
        copy.set_timed(self.is_timed);
        Ok(copy)
    }

    /// Cuts the cloth with a swept segment, and returns how many edges opened. `blade` holds both
    /// ends of the segment and its sweep.
    pub fn cut(&mut self, blade: &[f64]) -> Result<u32> {
        let mut blade = Reader::new(blade);
        let (from, to, sweep) = (blade.vector(), blade.vector(), blade.vector());
        self.cloth.cut(from, to, sweep).map_err(to_js_error)
    }

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

    /// Gives a mesh collider new vertices, x y z x y z … [m].
    pub fn update_collider(&mut self, collider: u32, positions: &[f32]) -> Result<()> {
        let positions = packing::to_vectors(positions);
        self.cloth.update_collider(Collider::from_bits(collider), &positions).map_err(to_js_error)
    }

    /// Makes the surface of another cloth a collider, and returns its number; updates the collider
    /// with this number unless it is 0.
    pub fn collide_with(&mut self, other: &RawCloth, collider: u32) -> Result<u32> {
        let known = (collider != 0).then(|| Collider::from_bits(collider));
        self.cloth.collide_with(&other.cloth, known).map(Collider::to_bits).map_err(to_js_error)
    }
}
