//! Creation of cloths, save and restore, and the default values of descriptors.
//!
//! JavaScript asks for the defaults, writes the fields of the caller over them and passes the lists
//! back, so the defaults are stated in the core only.

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::{self, Writer};
use core::hint::black_box;
use glam::Vec2;
use muslin::{Cloth, ColliderDesc, GridDesc, Material, MeshDesc, Preset, Settings};
use wasm_bindgen::prelude::wasm_bindgen;

/// Memory that making a cloth takes per particle, with what it frees again [bytes].
const BYTES_PER_PARTICLE: usize = 3072;

/// The most particles that memory is reserved for: a descriptor may turn out to be invalid.
const MAX_PARTICLES: usize = 1 << 17;

/// Grows the module's memory in one step by what a cloth of `particles` particles takes, unless so
/// much of it is free.
///
/// The allocator alone grows it in steps of 64 KiB. With each, V8 counts the whole memory as new and
/// soon collects garbage, which takes several times as long as making the cloth.
#[inline(never)]
fn reserve(particles: usize) {
    let mut room = Vec::<u8>::new();
    // If it fails, the memory may still suffice.
    room.try_reserve_exact(particles.min(MAX_PARTICLES) * BYTES_PER_PARTICLE).ok();
    black_box(&room);
}

#[wasm_bindgen]
impl RawCloth {
    /// Creates a cloth from a regular grid.
    pub fn grid(desc: &[f64], material: &[f64], settings: &[f64]) -> Result<RawCloth> {
        let desc = GridDesc {
            material: packing::unpack_material(material),
            settings: packing::unpack_settings(settings),
            ..packing::unpack_grid(desc)
        };
        // Only the product of a grid that is refused can exceed 32 bits.
        reserve(desc.columns.wrapping_mul(desc.rows) as usize);
        Cloth::grid(&desc).map(Self::new).map_err(to_js_error)
    }

    /// Creates a cloth from a triangle mesh.
    pub fn mesh(
        positions: &[f32],
        indices: &[u32],
        uvs: &[f32],
        pinned: &[u32],
        desc: &[f64],
        material: &[f64],
        settings: &[f64],
    ) -> Result<RawCloth> {
        reserve(positions.len() / 3);
        let desc = MeshDesc {
            positions: packing::to_vectors(positions),
            indices: indices.to_vec(),
            uvs: uvs.as_chunks::<2>().0.iter().copied().map(Vec2::from_array).collect(),
            pinned: pinned.to_vec(),
            material: packing::unpack_material(material),
            settings: packing::unpack_settings(settings),
            ..packing::unpack_mesh(desc)
        };
        Cloth::mesh(&desc).map(Self::new).map_err(to_js_error)
    }

    /// Creates a cloth from the bytes that `save` returned.
    pub fn restore(buffer: &[u8]) -> Result<RawCloth> {
        // A cloth without tears is saved as 84 bytes per particle.
        reserve(buffer.len() / 84);
        Cloth::restore(buffer).map(Self::new).map_err(to_js_error)
    }

    /// Creates a copy of the cloth, by a save: the code that clones each list of a cloth would make
    /// the module 3 % larger.
    pub fn duplicate(&self) -> Result<RawCloth> {
        let mut copy = Self::restore(&self.save())?;
        copy.set_timed(self.is_timed);
        Ok(copy)
    }

    /// Returns the whole state of the cloth as bytes.
    pub fn save(&self) -> Vec<u8> {
        self.cloth.save()
    }

    /// Returns the 64-bit hash of the state: the lower 32 bits, then the upper 32.
    pub fn state_hash(&self) -> Vec<u32> {
        let hash = self.cloth.state_hash();
        vec![hash as u32, (hash >> 32) as u32]
    }
}

/// Returns the default grid descriptor.
#[wasm_bindgen]
pub fn default_grid() -> Vec<f64> {
    packing::pack_grid(&GridDesc::default())
}

/// Returns the default mesh descriptor.
#[wasm_bindgen]
pub fn default_mesh() -> Vec<f64> {
    packing::pack_mesh(&MeshDesc::default())
}

/// Returns the default settings.
#[wasm_bindgen]
pub fn default_settings() -> Vec<f64> {
    packing::pack_settings(&Settings::default())
}

/// Returns the default material.
#[wasm_bindgen]
pub fn default_material() -> Vec<f64> {
    packing::pack_material(&Material::default())
}

/// Returns the material of a preset; `preset` is its index in `PRESETS` of `package/fields.js`.
#[wasm_bindgen]
pub fn preset_material(preset: u32) -> Vec<f64> {
    let preset = match preset {
        0 => Preset::Silk,
        1 => Preset::Cotton,
        2 => Preset::Denim,
        3 => Preset::Leather,
        4 => Preset::Paper,
        _ => Preset::FlagNylon,
    };
    packing::pack_material(&Material::preset(preset))
}

/// Returns the default collider descriptor, in the order that `add_collider` reads.
#[wasm_bindgen]
pub fn default_collider() -> Vec<f64> {
    let desc = ColliderDesc::default();
    let mut list = Writer::default();
    list.count(desc.shape as u32);
    list.vector(desc.position);
    list.numbers(&desc.rotation.to_array());
    list.numbers(&[desc.friction, desc.restitution, desc.tangential_restitution, desc.thickness]);
    list.numbers(&[desc.radius, desc.top_radius, desc.half_height]);
    list.vector(desc.half_extents);
    list.number(desc.spacing);
    list.counts(&[desc.columns, desc.rows]);
    list.number(desc.solid);
    list.0
}
