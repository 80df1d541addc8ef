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
/// Value that ends multisampling in the low mode: for 1, drivers take the least that they have.
const NO_SAMPLES: u32 = 0;

/// Multisampled target, and the texture that it is resolved to.
pub(super) struct HdrTarget {
    count: u32,
    pub(super) samples: RenderTargetMultisample<[f16; 4], f32>,
    pub(super) resolved: Texture2D,
}

impl HdrTarget {
    /// Replaces the target if it does not have this size, or the samples of the mode.
    pub(super) fn resize(
        target: &mut Option<Self>,
        context: &Context,
        [width, height]: [u32; 2],
        is_low: bool,
    ) {
        let count = if is_low { NO_SAMPLES } else { SAMPLES };
        let fits = target.as_ref().is_some_and(|t| {
            let size = [t.resolved.width(), t.resolved.height()];
            size == [width, height] && t.count == count
        });
        if !fits {
            // The old target is dropped first, so that the GPU memory never holds two.
            *target = None;
            *target = Some(Self {
                count,
                samples: RenderTargetMultisample::new(context, width, height, count),
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use three_d::CoreError;
    use three_d::context::HasContext as _;

    use super::*;
    use crate::headless::Headless;

    #[test]
    fn the_low_mode_draws_one_sample_per_pixel_and_the_usual_one_four() {
        let headless = Headless::new().unwrap();
        let context = &headless.context;
        let mut target = None;
        for (is_low, wanted) in [(false, 4), (true, 1), (false, 4)] {
            HdrTarget::resize(&mut target, context, [16, 8], is_low);
            let made = target.as_ref().unwrap();
            let mut samples = 0;
            made.samples
                .write::<CoreError>(|| {
                    // SAFETY: the context is current.
                    samples = unsafe { context.get_parameter_i32(three_d::context::SAMPLES) };
                    Ok(())
                })
                .unwrap();
            // Drivers name a target without multisampling 0 or 1.
            assert_eq!(samples.max(1), wanted);
            assert_eq!([made.resolved.width(), made.resolved.height()], [16, 8]);
        }
    }
}
