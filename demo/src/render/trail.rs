//! Trail of the blade: a thin line on the screen that glows and fades.
//!
//! Method: a triangle strip with mitred joints, blended additively.
//!
//! Reads [`TrailPoint`]s; writes the current colour target.
//!
//! Invariant: two paths are never connected.

use glam::Vec2;
use three_d::{Blend, Context, CoreError, DepthTest, RenderStates, VertexBuffer, WriteMask};

use super::glsl::glsl;
use super::lazy_program::LazyProgram;
use super::light::linear;
use super::pass::{RenderPass, to_gl_vector};

/// Half the width of the glow, as a fraction of the height of the picture.
const HALF_WIDTH: f32 = 0.016;

/// A point of the trail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailPoint {
    /// Normalised device coordinates (-1 to 1, y up).
    pub at: Vec2,
    /// Brightness, 1 (new) to 0 (dark).
    pub glow: f32,
    /// Whether a new path begins here.
    pub first: bool,
}

/// Shader program of the trail.
pub struct Trail {
    pub(super) program: LazyProgram,
    ribbon: VertexBuffer<[f32; 4]>,
}

impl Trail {
    /// Creates an empty ribbon.
    pub fn new(context: &Context) -> Self {
        Self {
            program: LazyProgram::new(context, glsl!("trail.vert"), glsl!("trail.frag")),
            ribbon: VertexBuffer::new(context),
        }
    }

    pub(super) fn draw(
        &mut self,
        pass: &RenderPass,
        trail_points: &[TrailPoint],
    ) -> Result<(), CoreError> {
        let ribbon = ribbon(trail_points, pass.aspect());
        if ribbon.is_empty() {
            return Ok(());
        }
        self.ribbon.fill(&ribbon);
        let p = self.program.get()?;
        p.use_uniform("glow", to_gl_vector(linear(0x7cc0ff)));
        p.use_vertex_attribute("place", &self.ribbon);
        let states = RenderStates {
            blend: Blend::ADD,
            depth_test: DepthTest::Always,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        p.draw_arrays(states, pass.viewport, self.ribbon.vertex_count());
        Ok(())
    }
}

/// Returns two triangles per piece: x and y on the screen, side (-1 to 1), brightness.
fn ribbon(trail_points: &[TrailPoint], aspect: f32) -> Vec<[f32; 4]> {
    let wide = Vec2::new(aspect, 1.0);
    let mut ribbon = Vec::new();
    // Neighbouring pieces share the mean direction at their joint, so that there is no gap.
    let direction = |i: usize| {
        let (before, after) = (trail_points[..=i].iter().rev(), trail_points[i + 1..].iter());
        let from = before.take(2).take_while(|s| !s.first || s.at == trail_points[i].at).last();
        let to = after.take(1).take_while(|s| !s.first).last();
        let (from, to) = (from.unwrap_or(&trail_points[i]), to.unwrap_or(&trail_points[i]));
        ((to.at - from.at) * wide).normalize_or(Vec2::X)
    };
    for i in 1..trail_points.len() {
        if trail_points[i].first {
            continue;
        }
        let ends = [i - 1, i].map(|i| {
            let spark = trail_points[i];
            let across = direction(i).perp() * HALF_WIDTH * 2.0 * (0.35 + 0.65 * spark.glow) / wide;
            [-1.0, 1.0].map(|side| {
                let at = spark.at + across * side;
                [at.x, at.y, side, spark.glow]
            })
        });
        let [[a, b], [c, d]] = ends;
        ribbon.extend([a, b, d, a, d, c]);
    }
    ribbon
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spark(x: f32, first: bool) -> TrailPoint {
        TrailPoint { at: Vec2::new(x, 0.2), glow: 1.0, first }
    }

    #[test]
    fn two_paths_are_not_joined() {
        let one = [spark(-0.5, true), spark(-0.4, false), spark(-0.3, false)];
        assert_eq!(ribbon(&one, 1.5).len(), 12);
        let two = [spark(-0.5, true), spark(-0.4, false), spark(0.3, true), spark(0.4, false)];
        assert_eq!(ribbon(&two, 1.5).len(), 12);
        assert!(ribbon(&two, 1.5).iter().all(|v| v[0] < -0.35 || v[0] > 0.25));
        assert_eq!(ribbon(&[spark(0.0, true)], 1.5).len(), 0);
    }

    #[test]
    fn a_straight_path_is_straight_and_has_the_set_width() {
        for vertex in ribbon(&[spark(-0.5, true), spark(0.5, false)], 2.0) {
            let [x, y, side, _] = vertex;
            assert!((x.abs() - 0.5).abs() < 1.0e-6);
            assert!((y - 0.2 - side * HALF_WIDTH * 2.0).abs() < 1.0e-6, "{y} at side {side}");
        }
    }
}
