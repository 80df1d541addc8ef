//! Making cloths, and the numbers that descriptors start from.

use crate::RawCloth;
use crate::numbers::{self, Writer};
use crate::refusal::{Result, refusal};
use glam::Vec2;
use muslin::{Cloth, ColliderDesc, GridDesc, Material, MeshDesc, Preset, Settings};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// A cloth from a regular grid.
    pub fn grid(desc: &[f64], material: &[f64], settings: &[f64]) -> Result<RawCloth> {
        let desc = GridDesc {
            material: numbers::read_material(material),
            settings: numbers::read_settings(settings),
            ..numbers::read_grid(desc)
        };
        Cloth::grid(&desc).map(Self::new).map_err(refusal)
    }

    /// A cloth from a triangle mesh.
    pub fn mesh(
        positions: &[f32],
        indices: &[u32],
        uvs: &[f32],
        pinned: &[u32],
        desc: &[f64],
        material: &[f64],
        settings: &[f64],
    ) -> Result<RawCloth> {
        let desc = MeshDesc {
            positions: numbers::vectors(positions),
            indices: indices.to_vec(),
            uvs: uvs.as_chunks::<2>().0.iter().copied().map(Vec2::from_array).collect(),
            pinned: pinned.to_vec(),
            material: numbers::read_material(material),
            settings: numbers::read_settings(settings),
            ..numbers::read_mesh(desc)
        };
        Cloth::mesh(&desc).map(Self::new).map_err(refusal)
    }

    /// A cloth from what `save` gave.
    pub fn restore(buffer: &[u8]) -> Result<RawCloth> {
        Cloth::restore(buffer).map(Self::new).map_err(refusal)
    }

    /// The cloth as bytes.
    pub fn save(&self) -> Vec<u8> {
        self.cloth.save()
    }

    /// The state as one number of 64 bits: the lower 32, then the upper.
    pub fn state_hash(&self) -> Vec<u32> {
        let hash = self.cloth.state_hash();
        vec![hash as u32, (hash >> 32) as u32]
    }
}

/// A grid before anything is asked of it.
#[wasm_bindgen]
pub fn default_grid() -> Vec<f64> {
    numbers::write_grid(&GridDesc::default())
}

/// A mesh before anything is asked of it.
#[wasm_bindgen]
pub fn default_mesh() -> Vec<f64> {
    numbers::write_mesh(&MeshDesc::default())
}

/// Settings before anything is asked of them.
#[wasm_bindgen]
pub fn default_settings() -> Vec<f64> {
    numbers::write_settings(&Settings::default())
}

/// The material that a cloth has when nothing is said.
#[wasm_bindgen]
pub fn default_material() -> Vec<f64> {
    numbers::write_material(&Material::default())
}

/// The material of the preset with this number.
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
    numbers::write_material(&Material::preset(preset))
}

/// A collider before anything is asked of it.
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
    list.0
}
