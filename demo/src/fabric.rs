//! Fabrics of the demo: the material for the simulation and the appearance for the shaders.
//!
//! Method: materials are presets of Muslin with other limits for tearing; appearances are tuned by
//! eye.
//!
//! Reads a [`Fabric`]; returns a [`Material`] or an [`Appearance`].
//!
//! Invariant: colours are sRGB `0xrrggbb`; `render::cloth_material` converts them to linear values.

use muslin::{Material, Preset};
use serde::{Deserialize, Serialize};

/// A fabric of the sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fabric {
    /// Light and fluid, silvery blue.
    #[default]
    Silk,
    /// Unbleached shirting: matt and translucent.
    Cotton,
    /// Heavy indigo twill with a pale back and topstitching.
    Denim,
    /// Printed nylon, crisp and bright.
    Flag,
}

/// A pattern that the cloth shader prints on a fabric.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Print {
    /// The plain fabric.
    #[default]
    None = 0,
    /// Three waves and a ring.
    Flag = 1,
    /// Stripes across, in the colour of the seam.
    Stripes = 2,
    /// Two bands above the hem, in the colour of the seam.
    Border = 3,
}

/// Parameters of a fabric for the cloth shader. Colours are sRGB, `0xrrggbb`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Appearance {
    /// Colour of the front.
    pub front: u32,
    /// Colour of the back.
    pub back: u32,
    /// Saturation of the colours, 0 (grey) to 1; coloured lights add the rest.
    pub saturation: f32,
    /// Colours of loose warp and weft threads.
    pub threads: [u32; 2],
    /// Colour of the seam along the hem, and its opacity.
    pub seam: (u32, f32),
    /// Visible threads per metre.
    pub count: f32,
    /// Height of the thread relief, and unevenness of the yarn.
    pub relief: [f32; 2],
    /// Weave: 0 plain, 1 twill, 2 ripstop.
    pub weave: f32,
    /// Specular lobe: roughness across and along the thread, its strength, and the strength of
    /// reflections.
    pub gloss: [f32; 4],
    /// Strength of the sheen of loose fibres at grazing angles.
    pub fuzz: f32,
    /// Strength of the transmitted light.
    pub transmission: f32,
    /// What is printed on it.
    pub print: Print,
}

impl Fabric {
    /// All fabrics, in the order of the panel.
    pub const ALL: [Self; 4] = [Self::Silk, Self::Cotton, Self::Denim, Self::Flag];
    /// Names on the panel.
    pub const NAMES: [&'static str; 4] = ["Silk", "Cotton", "Denim", "Nylon"];

    /// Returns the material. Stretch compliance is zero, so that the number of iterations (the
    /// stiffness control) alone decides how much the cloth stretches.
    pub fn material(self) -> Material {
        // A limit of four times the rest length behaves like rubber; with these limits it tears
        // like cloth.
        let tear_stretch = match self {
            Self::Silk | Self::Flag => 1.75,
            Self::Cotton => 1.65,
            Self::Denim => 1.9,
        };
        Material {
            stretch_stiffness_warp: 0.0,
            stretch_stiffness_weft: 0.0,
            tear_stretch,
            ..Material::preset(self.preset())
        }
    }

    /// Returns the preset of Muslin for this fabric.
    pub fn preset(self) -> Preset {
        match self {
            Self::Silk => Preset::Silk,
            Self::Cotton => Preset::Cotton,
            Self::Denim => Preset::Denim,
            Self::Flag => Preset::FlagNylon,
        }
    }

    /// Returns the parameters for the cloth shader.
    pub fn appearance(self) -> Appearance {
        match self {
            Self::Silk => Appearance {
                front: 0x839bf0,
                back: 0x8aa2f4,
                saturation: 0.90,
                threads: [0xb4c2ff, 0xd6dcff],
                seam: (0x6f7fbf, 0.30),
                count: 220.0,
                relief: [0.15, 0.03],
                weave: 0.0,
                gloss: [0.13, 0.42, 0.18, 1.3],
                fuzz: 0.16,
                transmission: 0.55,
                print: Print::None,
            },
            Self::Cotton => Appearance {
                front: 0xe9dfcf,
                back: 0xdcd3c6,
                saturation: 0.85,
                threads: [0xf2eadc, 0xe6dccb],
                seam: (0xb9ab95, 0.55),
                count: 130.0,
                relief: [0.30, 0.10],
                weave: 0.0,
                gloss: [0.62, 0.70, 0.035, 0.10],
                fuzz: 0.34,
                transmission: 1.35,
                print: Print::None,
            },
            Self::Denim => Appearance {
                front: 0x43598c,
                back: 0xb4bfd2,
                saturation: 1.0,
                threads: [0x3d5fa8, 0xd9dde6],
                seam: (0xffa640, 1.0),
                count: 150.0,
                relief: [0.34, 0.12],
                weave: 1.0,
                gloss: [0.55, 0.65, 0.035, 0.08],
                fuzz: 0.16,
                transmission: 0.10,
                print: Print::None,
            },
            Self::Flag => Appearance {
                front: 0xf2ead8,
                back: 0xf2ead8,
                saturation: 1.0,
                threads: [0xf2ead8, 0xff8a5c],
                seam: (0xf7f2e6, 0.8),
                count: 260.0,
                relief: [0.08, 0.02],
                weave: 2.0,
                gloss: [0.26, 0.30, 0.11, 0.75],
                fuzz: 0.05,
                transmission: 1.5,
                print: Print::Flag,
            },
        }
    }
}

/// Returns the appearance of the figure's skirt in this fabric: dyed, with two bands above the hem.
pub fn skirt(fabric: Fabric) -> Appearance {
    let (dye, band) = match fabric {
        Fabric::Silk => (0x8a2f4e, 0xf0d9b8),
        Fabric::Cotton => (0x9e3b33, 0xf0dfc4),
        Fabric::Denim => (0x3d5283, 0xf0d9b8),
        Fabric::Flag => (0x1f7f86, 0xf2ead8),
    };
    let woven = fabric.appearance();
    Appearance {
        front: dye,
        back: dye,
        saturation: 1.0,
        threads: [dye, dye],
        seam: (band, 1.0),
        // Finer than the fabrics of the large sheets.
        count: 420.0,
        relief: [0.10, 0.04],
        weave: 0.0,
        transmission: 0.25 * woven.transmission,
        print: Print::Border,
        ..woven
    }
}

/// Returns the appearance of the figure's shirt: unbleached cotton with dark blue stripes.
pub fn shirt() -> Appearance {
    Appearance {
        seam: (0x27375e, 1.0),
        transmission: 0.3,
        count: 420.0,
        relief: [0.10, 0.04],
        print: Print::Stripes,
        ..Fabric::Cotton.appearance()
    }
}

/// Returns the appearance of the figure's body: the matt linen of a tailor's mannequin.
pub fn mannequin() -> Appearance {
    Appearance {
        front: 0xd8c9b4,
        back: 0xd8c9b4,
        saturation: 1.0,
        threads: [0xd8c9b4; 2],
        seam: (0xd8c9b4, 0.0),
        count: 1.0,
        relief: [0.0, 0.0],
        weave: 0.0,
        gloss: [0.55, 0.55, 0.03, 0.16],
        fuzz: 0.10,
        transmission: 0.0,
        print: Print::None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fabrics_differ_in_density_and_colour() {
        for (i, a) in Fabric::ALL.iter().enumerate() {
            for b in &Fabric::ALL[i + 1..] {
                let (light, heavy) = (a.material().density, b.material().density);
                assert!((light - heavy).abs() > 0.004, "{a:?} and {b:?} weigh {light} and {heavy}");
                assert_ne!(a.appearance().front, b.appearance().front);
            }
        }
    }
}
