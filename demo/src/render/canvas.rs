//! CANVAS DOC

use three_d::{ColorTarget, Context, RenderTarget};

/// A texture that a picture can be drawn into and read from: what `--shot` uses for a screen.
pub struct OffscreenCanvas {
    colour: three_d::Texture2D,
    depth: three_d::DepthTexture2D,
}

impl OffscreenCanvas {
    /// A canvas of `width` × `height` pixels.
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

    /// Where to draw.
    pub fn target(&self) -> RenderTarget<'_> {
        RenderTarget::new(self.colour.as_color_target(None), self.depth.as_depth_target())
    }

    /// The pixels, top row first.
    pub fn pixels(&self) -> Vec<[u8; 4]> {
        let target: ColorTarget<'_> = self.colour.as_color_target(None);
        target.read()
    }
}
