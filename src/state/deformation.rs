//! The deformation of a mesh collider: where its vertices are at both ends of a tick.
//!
//! ```text
//! last ─ ─ ─ next ─ ─ ─ target     the host sets the target; the ticks of an `advance` reach it evenly
//! ```
//! Vertices are in the frame of the collider, relative to its center. The descriptor keeps those of
//! the start, from which trees and features are built, so that a restored collider gives the same
//! contacts.
//!
//! Reads what the host gives; writes its vertices and the posed surface.
//! Invariant: between ticks `last` is where the surface is.

use crate::error::{Result, check, check_all_finite};
use crate::geometry::aabb::Aabb;
use crate::geometry::bends::SurfaceBend;
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::moving_surface::{MovingSurface, MovingVertices};
use crate::geometry::solid_mesh::ClosestPointQuery;
use crate::math::hasher::StateHasher;
use crate::math::max;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The vertices of a mesh collider that deforms.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Deformation {
    /// At the end of the last tick [m].
    last: Vec<Vec3>,
    /// At the end of the next tick [m].
    next: Vec<Vec3>,
    /// At the end of an `advance` [m]; empty between reading a save and `restore`.
    #[serde(skip)]
    target: Vec<Vec3>,
    /// `None` between reading a save and `restore`.
    #[serde(skip)]
    surface: Option<Box<MovingSurface>>,
    /// Whether the surface is prepared for the motion of the next tick.
    #[serde(skip)]
    is_prepared: bool,
    #[serde(skip)]
    is_moving: bool,
    /// The largest displacement of a vertex in the next tick [m].
    #[serde(skip)]
    longest: f32,
}

impl Deformation {
    /// Makes the deformation of a mesh at rest at `positions`. `None` without triangles.
    pub fn new(positions: &[Vec3], triangles: Vec<[u32; 3]>) -> Option<Self> {
        let surface = MovingSurface::new(positions, triangles)?;
        Some(Self {
            last: positions.to_vec(),
            next: positions.to_vec(),
            target: positions.to_vec(),
            surface: Some(Box::new(surface)),
            is_prepared: false,
            is_moving: false,
            longest: 0.0,
        })
    }

    /// Builds the surface of a deformation from a save, over the `positions` of the start.
    pub fn restore(&mut self, positions: &[Vec3], triangles: Vec<[u32; 3]>) -> Result<()> {
        let field = "collider.deformation";
        let is_whole = [&self.last, &self.next].iter().all(|list| list.len() == positions.len());
        check(is_whole, field, "have all vertices")?;
        check_all_finite(&self.last, field)?;
        check_all_finite(&self.next, field)?;
        self.target.clone_from(&self.next);
        self.is_moving = self.last != self.next;
        self.surface = MovingSurface::new(positions, triangles).map(Box::new);
        Ok(())
    }

    /// The surface as it is posed.
    pub fn shape(&self) -> Option<&CollisionShape> {
        self.surface.as_ref().map(|surface| surface.shape())
    }

    /// A vertex at the start of the next tick [m].
    pub fn vertex(&self, i: usize) -> Vec3 {
        self.last[i]
    }

    /// The vertices at both ends of the next tick.
    fn vertices(&self) -> MovingVertices<'_> {
        MovingVertices { last: &self.last, next: &self.next }
    }

    /// Whether the surface moves in the next tick.
    pub fn is_moving(&self) -> bool {
        self.is_moving
    }

    /// The largest displacement of a vertex in the next tick [m].
    pub fn longest(&self) -> f32 {
        self.longest
    }

    /// Sets the vertices that the next tick, or the ticks of the next `advance`, reach.
    pub fn set_target(&mut self, position: &dyn Fn(usize) -> Vec3) {
        self.target.clear();
        self.target.extend((0..self.last.len()).map(position));
        self.first_step(1);
    }

    /// Moves the vertices at the start of the next tick by `shift` [m], with their frame.
    pub fn translate(&mut self, shift: Vec3) {
        self.last.iter_mut().for_each(|x| *x += shift);
        self.first_step(1);
        self.is_prepared = false;
    }

    /// Places the vertices at once: where they start the next tick, and where they end it until a
    /// target is set.
    pub fn place(&mut self, position: &dyn Fn(usize) -> Vec3) {
        for (i, (last, next)) in self.last.iter_mut().zip(&mut self.next).enumerate() {
            *last = position(i);
            *next = *last;
        }
        self.target.copy_from_slice(&self.next);
        (self.is_moving, self.is_prepared) = (false, false);
    }

    /// Sets the vertices at the end of the next tick: after the first of `count` equal steps to the
    /// target.
    pub fn first_step(&mut self, count: u32) {
        if count == 1 {
            self.next.copy_from_slice(&self.target);
        } else {
            let share = 1.0 / count as f32;
            for ((next, last), target) in self.next.iter_mut().zip(&self.last).zip(&self.target) {
                *next = *last + (*target - *last) * share;
            }
        }
        let was_moving = self.is_moving;
        self.is_moving = self.last != self.next;
        self.is_prepared &= !self.is_moving && !was_moving;
    }

    /// Prepares the surface for the motion of the next tick.
    pub fn prepare(&mut self) {
        let Self { last, next, surface: Some(surface), .. } = self else { return };
        if self.is_prepared {
            return;
        }
        self.is_prepared = true;
        let ways = last.iter().zip(&*next).map(|(last, next)| last.distance_squared(*next));
        self.longest = ways.fold(0.0, max).sqrt();
        let vertices = MovingVertices { last, next };
        surface.refit(vertices);
        if !self.is_moving {
            surface.settle(vertices);
        }
    }

    /// Poses what is near `bounds`, see [`MovingSurface::pose_for_search`].
    pub fn pose_for_search(
        &mut self,
        bounds: Aabb,
        moment: f32,
        is_sharp: &dyn Fn(&SurfaceBend) -> bool,
    ) {
        if let Self { last, next, surface: Some(surface), .. } = self {
            surface.pose_for_search(MovingVertices { last, next }, bounds, moment, is_sharp);
        }
    }

    /// See [`MovingSurface::is_measured`].
    pub fn is_measured(&self, bounds: &Aabb) -> bool {
        self.surface.as_ref().is_some_and(|surface| surface.is_measured(bounds))
    }

    /// Poses what is near some boxes, see [`MovingSurface::pose_some_for_search`].
    pub fn pose_some_for_search(&mut self, boxes: impl Iterator<Item = Aabb>, moment: f32) {
        if let Self { last, next, surface: Some(surface), .. } = self {
            surface.pose_some_for_search(MovingVertices { last, next }, boxes, moment);
        }
    }

    /// See [`MovingSurface::sharp_features`].
    pub fn sharp_features(&self) -> Option<impl Iterator<Item = u32> + '_> {
        self.surface.as_ref().map(|surface| surface.sharp_features())
    }

    /// Lists what can touch the cloth, see [`MovingSurface::activate`].
    pub fn activate(
        &mut self,
        triangles: impl Iterator<Item = u32>,
        edges: impl Iterator<Item = u32>,
        vertices: impl Iterator<Item = u32>,
    ) {
        if let Some(surface) = &mut self.surface {
            surface.activate(triangles, edges, vertices);
        }
    }

    /// Poses the surface for a part of the tick, see [`MovingSurface::pose`].
    pub fn pose(&mut self, part: [f32; 2]) {
        if let Self { last, next, surface: Some(surface), .. } = self {
            surface.pose(MovingVertices { last, next }, part);
        }
    }

    /// Poses features in some boxes, see [`MovingSurface::pose_features`].
    pub fn pose_features(&mut self, boxes: impl Iterator<Item = Aabb>, part: [f32; 2]) {
        if let Self { last, next, surface: Some(surface), .. } = self {
            surface.pose_features(MovingVertices { last, next }, boxes, part);
        }
    }

    /// See [`MovingSurface::visit_near`].
    pub fn visit_near(&self, query: &mut ClosestPointQuery) {
        if let Some(surface) = &self.surface {
            surface.visit_near(self.vertices(), query);
        }
    }

    /// See [`MovingSurface::longest_relative_path`].
    pub fn longest_relative_path(&self, path: [Vec3; 2], margin: f32, least: f32) -> f32 {
        let surface = self.surface.as_ref();
        surface.map_or(least, |s| s.longest_relative_path(self.vertices(), path, margin, least))
    }

    /// See [`MovingSurface::motions_near`].
    pub fn motions_near(&self, bounds: Aabb) -> Option<Aabb> {
        self.surface.as_ref().and_then(|s| s.motions_near(self.vertices(), bounds))
    }

    /// Adds the vertices at both ends of the next tick to a hash.
    pub fn hash(&self, hasher: &mut StateHasher) {
        for list in [&self.last, &self.next] {
            list.iter().for_each(|x| hasher.write_f32s(&x.to_array()));
        }
    }

    /// Completes the motion of a tick. The surface stays posed where it ended.
    pub fn finish_tick(&mut self) {
        if self.is_moving {
            self.last.copy_from_slice(&self.next);
            (self.is_moving, self.is_prepared) = (false, false);
        }
    }
}
