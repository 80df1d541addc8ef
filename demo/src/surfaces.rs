//! The surfaces that a cloth scene draws: its cloths, or the skins of the clothes and the body that
//! wears them.
//!
//! Method: the surfaces borrow the lists of cloths and skins, and are uploaded to the renderer.
//!
//! Reads the scene and the links of its cloths; writes smooth surfaces and the buffers of the
//! renderer.
//!
//! Invariant: surfaces have the order of `scene::appearances`; the clothes of the figure come with
//! their coarse cloth, which has only lines, for the wireframe.

use glam::Vec2;
use muslin::{Cloth, LinkKind, Skin};
use muslin_scenes::SceneInstance;
use muslin_scenes::figure::dressed::DressedBody;
use muslin_scenes::figure::garments::{SHIRT_SPAN, SKIRT_SPAN};

use crate::render::{ClothSurface, Renderer};
use crate::scene;
use crate::scene_kind::SceneKind;
use crate::settings::Settings;
use crate::smooth_surface::{SmoothSurface, Weave};

/// End points of the links of one cloth, for the wireframe.
#[derive(Debug, Default)]
pub struct WireframeLines {
    ends: Vec<u32>,
    revision: Option<u64>,
}

impl WireframeLines {
    /// Rebuilds the list of lines if the topology of the cloth has changed. `generation` counts
    /// the rebuilds of the scene, since new cloths restart their topology revision.
    pub fn update(&mut self, cloth: &Cloth, generation: u32) {
        let revision = joined(generation, cloth.topology_revision());
        if self.revision != Some(revision) {
            self.revision = Some(revision);
            self.ends.clear();
            let woven = cloth.links().filter(|link| link.2 == LinkKind::Stretch);
            self.ends.extend(woven.flat_map(|(a, b, _)| [a, b]));
        }
    }
}

/// Returns a number that changes with each of its arguments; its lowest bit is zero.
fn joined(generation: u32, revision: u32) -> u64 {
    (u64::from(generation) << 33) | (u64::from(revision) << 1)
}

/// Uploads every surface of the scene; `refine` says whether cloths are made finer for it.
pub fn upload(
    renderer: &mut Renderer,
    instance: &mut SceneInstance,
    settings: &Settings,
    lines: &[WireframeLines],
    (smooth, refine): (&mut [SmoothSurface], bool),
    generation: u32,
) {
    let result = instance.update_drawn();
    debug_assert!(result.is_ok(), "the skins do not fit the clothes: {result:?}");
    let (cloths, figure) = instance.parts();
    let mut made: Vec<_> = cloths
        .iter_mut()
        .zip(lines.iter().zip(smooth))
        .map(|(cloth, (lines, smooth))| surface(cloth, lines, (smooth, refine), settings))
        .collect();
    let Some(body) = figure else {
        renderer.set_cloth_count(made.len());
        for (i, surface) in made.iter().enumerate() {
            renderer.upload_cloth(i, surface);
        }
        return;
    };
    let count = body.drawn().positions().len();
    let (uvs, frayed) = (vec![Vec2::splat(0.5); count], vec![false; count]);
    let [skirt, shirt] = body.skins();
    let mut surfaces = vec![
        skin_surface(skirt, SKIRT_SPAN, generation),
        skin_surface(shirt, SHIRT_SPAN, generation),
        body_surface(body, &uvs, &frayed, generation),
    ];
    if settings.wireframe {
        made.iter_mut().for_each(|cloth| (cloth.indices, cloth.coarse_indices) = (&[], &[]));
        surfaces.append(&mut made);
    }
    renderer.set_cloth_count(surfaces.len());
    for (i, surface) in surfaces.iter().enumerate() {
        renderer.upload_cloth(i, surface);
    }
}

fn surface<'a>(
    cloth: &'a mut Cloth,
    lines: &'a WireframeLines,
    (smooth, refine): (&'a mut SmoothSurface, bool),
    settings: &Settings,
) -> ClothSurface<'a> {
    // A finer mesh has other indices, also where the topology of the cloth is the same.
    let revision = lines.revision.unwrap_or_default() | u64::from(refine);
    let weave = Weave {
        spacing: scene::grid::spacing(settings),
        unit: scene::unit(settings.scene),
        is_grid: scene::grid::grid_size(settings).is_some(),
        refine,
    };
    smooth.update(&cloth.view(), weave, revision);
    ClothSurface {
        positions: smooth.positions(),
        unit: scene::unit(settings.scene),
        normals: smooth.normals(),
        uvs: smooth.uvs(),
        frayed: smooth.frayed(),
        hollows: smooth.hollows(),
        indices: smooth.indices(),
        coarse_indices: smooth.coarse_indices(),
        lines: &lines.ends,
        span: scene::span(settings),
        is_round: settings.scene == SceneKind::Discs,
        revision,
    }
}

fn skin_surface(skin: &Skin, span: Vec2, generation: u32) -> ClothSurface<'_> {
    ClothSurface {
        positions: skin.positions(),
        unit: 1.0,
        normals: skin.normals(),
        uvs: skin.uvs(),
        frayed: skin.frayed(),
        hollows: &[],
        indices: skin.indices(),
        coarse_indices: &[],
        lines: &[],
        span,
        is_round: false,
        revision: joined(generation, skin.topology_revision()),
    }
}

/// Returns the surface of the body. Its texture coordinates are those of the middle of a fabric,
/// away from hems.
fn body_surface<'a>(
    body: &'a DressedBody,
    uvs: &'a [Vec2],
    frayed: &'a [bool],
    generation: u32,
) -> ClothSurface<'a> {
    let drawn = body.drawn();
    ClothSurface {
        positions: drawn.positions(),
        unit: 1.0,
        normals: drawn.normals(),
        uvs,
        frayed,
        hollows: &[],
        indices: drawn.indices(),
        coarse_indices: &[],
        lines: &[],
        span: Vec2::ONE,
        is_round: false,
        revision: joined(generation, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cloth_that_is_drawn_with_other_triangles_has_another_revision() {
        let settings = Settings::default();
        let mut cloth = scene::build(&settings, false).unwrap().cloths.remove(0);
        let mut lines = WireframeLines::default();
        let mut smooth = SmoothSurface::default();
        let mut drawn = |cloth: &mut Cloth, generation: u32, refine: bool| {
            lines.update(cloth, generation);
            let surface = surface(cloth, &lines, (&mut smooth, refine), &settings);
            let count = surface.positions.len();
            assert!(surface.indices.iter().all(|i| (*i as usize) < count));
            (surface.indices.to_vec(), surface.revision)
        };
        let mut states = vec![drawn(&mut cloth, 0, true), drawn(&mut cloth, 0, false)];
        assert!(states[0].0.len() > states[1].0.len(), "the cloth is not made finer");
        assert_eq!(drawn(&mut cloth, 0, true), states[0]);
        cloth.tear_edge(820, 821).unwrap();
        states.extend([drawn(&mut cloth, 0, true), drawn(&mut cloth, 0, false)]);
        states.push(drawn(&mut cloth, 1, false));
        for (i, (_, revision)) in states.iter().enumerate() {
            assert!(states[..i].iter().all(|(_, other)| other != revision), "revision {revision}");
        }
    }
}
