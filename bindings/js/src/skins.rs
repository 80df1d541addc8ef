//! Skins: render meshes that follow a cloth. `package/skin.js` keeps the cloth of each skin and
//! passes it to every call.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing;
use glam::Vec2;
use muslin::{Skin, SkinDesc};
use wasm_bindgen::prelude::wasm_bindgen;

/// A skin whose methods take and return numbers and flat lists.
#[wasm_bindgen]
pub struct RawSkin {
    skin: Skin,
}

#[wasm_bindgen]
impl RawCloth {
    /// Makes a skin of this cloth.
    pub fn skin(
        &self,
        positions: &[f32],
        indices: &[u32],
        uvs: &[f32],
        smoothness: f32,
    ) -> Result<RawSkin> {
        let desc = SkinDesc {
            positions: packing::to_vectors(positions),
            indices: indices.to_vec(),
            uvs: uvs.as_chunks::<2>().0.iter().copied().map(Vec2::from_array).collect(),
            smoothness,
        };
        Ok(RawSkin { skin: Skin::new(&self.cloth, &desc).map_err(to_js_error)? })
    }
}

#[wasm_bindgen]
impl RawSkin {
    /// Updates all lists if the cloth changed.
    pub fn refresh(&mut self, cloth: &RawCloth) -> Result<()> {
        self.skin.refresh(&cloth.cloth).map_err(to_js_error)
    }

    /// Returns the number of vertices.
    pub fn vertex_count(&self) -> u32 {
        self.skin.positions().len() as u32
    }

    /// Returns the largest number of vertices that the skin can ever have.
    pub fn vertex_capacity(&self) -> u32 {
        self.skin.vertex_capacity()
    }

    /// Returns the number of indices, which never changes.
    pub fn index_count(&self) -> u32 {
        self.skin.indices().len() as u32
    }

    /// Returns the address of the positions: 3 f32 per vertex.
    pub fn positions_ptr(&self) -> *const f32 {
        self.skin.positions().as_ptr().cast()
    }

    /// Returns the address of the normals: 3 f32 per vertex.
    pub fn normals_ptr(&self) -> *const f32 {
        self.skin.normals().as_ptr().cast()
    }

    /// Returns the address of the texture coordinates: 2 f32 per vertex.
    pub fn uvs_ptr(&self) -> *const f32 {
        self.skin.uvs().as_ptr().cast()
    }

    /// Returns the address of the indices: 3 u32 per triangle.
    pub fn indices_ptr(&self) -> *const u32 {
        self.skin.indices().as_ptr()
    }

    /// Returns the address of the source vertices: 1 u32 per vertex.
    pub fn source_vertices_ptr(&self) -> *const u32 {
        self.skin.source_vertices().as_ptr()
    }

    /// Returns the address of the frayed flags: 1 byte per vertex, 0 or 1.
    pub fn frayed_ptr(&self) -> *const u8 {
        self.skin.frayed().as_ptr().cast()
    }

    /// Returns the topology revision, which changes when vertices or indices change.
    pub fn topology_revision(&self) -> u32 {
        self.skin.topology_revision()
    }

    /// Writes vertices into the staging memory of the cloth, see `RawCloth::write_vertices`.
    pub fn write_vertices(
        &mut self,
        cloth: &mut RawCloth,
        streams: &[f64],
        desc: &[f64],
    ) -> Result<()> {
        let skin = &mut self.skin;
        cloth.write_staged(streams, desc, &mut |cloth, streams, desc| {
            skin.write_vertices(cloth, streams, desc)
        })
    }
}

/// Returns the default smoothness of a skin.
#[wasm_bindgen]
pub fn default_smoothness() -> f32 {
    SkinDesc::default().smoothness
}
