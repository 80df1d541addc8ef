//! HDR render target: multisampled half-float colour and depth, with a resolved colour texture.
//!
//! Method: all passes draw into the multisampled part; it is resolved once, for the post-processing
//! pass.
//!
//! Reads the wanted size; creates GPU textures.
//!
//! Invariant: colours in it are linear.

use three_d::{Context, Interpolation, RenderTargetMultisample, Texture2D, Wrapping, f16};

/// Samples per pixel.
const SAMPLES: u32 = 4;

/// Multisampled target, and the texture that it is resolved to.
pub(super) struct HdrTarget {
    pub(super) samples: RenderTargetMultisample<[f16; 4], f32>,
    pub(super) resolved: Texture2D,
}

impl HdrTarget {
    /// Replaces the target if it does not have this size.
    pub(super) fn resize(target: &mut Option<Self>, context: &Context, width: u32, height: u32) {
        let fits = target
            .as_ref()
            .is_some_and(|t| t.resolved.width() == width && t.resolved.height() == height);
        if !fits {
            // The old target is dropped first, so that the GPU memory never holds two.
            *target = None;
            *target = Some(Self {
                samples: RenderTargetMultisample::new(context, width, height, SAMPLES),
                resolved: linear_texture(context, width, height),
            });
        }
    }
}

/// Creates a half-float colour texture.
fn linear_texture(context: &Context, width: u32, height: u32) -> Texture2D {
    Texture2D::new_empty::<[f16; 4]>(
        context,
        width,
        height,
        Interpolation::Linear,
        Interpolation::Linear,
        None,
        Wrapping::ClampToEdge,
        Wrapping::ClampToEdge,
    )
}
