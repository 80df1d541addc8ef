//! HDR DOC

use three_d::{Context, Interpolation, RenderTargetMultisample, Texture2D, Wrapping, f16};

/// Samples per pixel.
const SAMPLES: u32 = 4;

/// The linear picture while it is made: drawn multisampled, then resolved for [`post`].
pub(super) struct HdrTarget {
    pub(super) samples: RenderTargetMultisample<[f16; 4], f32>,
    pub(super) resolved: Texture2D,
}

impl HdrTarget {
    /// Makes another target if the old one is of another size.
    pub(super) fn resize(target: &mut Option<Self>, context: &Context, width: u32, height: u32) {
        let fits = target
            .as_ref()
            .is_some_and(|t| t.resolved.width() == width && t.resolved.height() == height);
        if !fits {
            // The old one goes first, so that two never resolution_scale the card's memory.
            *target = None;
            *target = Some(Self {
                samples: RenderTargetMultisample::new(context, width, height, SAMPLES),
                resolved: linear_texture(context, width, height),
            });
        }
    }
}

/// A half-float texture for linear light.
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
