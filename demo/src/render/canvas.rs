//! Off-screen canvas: a colour and a depth texture that a picture is drawn into and read back from.
//!
//! Method: two textures of the same size, used as one render target.
//!
//! Reads nothing; the renderer writes the textures, and [`OffscreenCanvas::pixels`] copies them to
//! memory.
//!
//! Invariant: the size never changes.

use three_d::{ColorTarget, Context, RenderTarget};

/// Render target for `--shot`, in place of a screen.
pub struct OffscreenCanvas {
    colour: three_d::Texture2D,
    depth: three_d::DepthTexture2D,
}

impl OffscreenCanvas {
    /// Creates a canvas of `width` × `height` pixels.
    pub fn new(context: &Context, width: u32, height: u32) -> Self {
        use three_d::{DepthTexture2D, Interpolation::Nearest, Texture2D, Wrapping::ClampToEdge};
        Self {
            colour: Texture2D::new_empty::<[u8; 4]>(
                context,
                width,
                height,
                Nearest,
                Nearest,
                None,
                ClampToEdge,
                ClampToEdge,
            ),
            depth: DepthTexture2D::new::<f32>(context, width, height, ClampToEdge, ClampToEdge),
        }
    }

    /// Returns the render target.
    pub fn target(&self) -> RenderTarget<'_> {
        RenderTarget::new(self.colour.as_color_target(None), self.depth.as_depth_target())
    }

    /// Returns the pixels, top row first.
    pub fn pixels(&self) -> Vec<[u8; 4]> {
        let target: ColorTarget<'_> = self.colour.as_color_target(None);
        target.read()
    }
}
