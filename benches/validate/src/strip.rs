//! Strips of three rows of particles: how they are made, clamped and measured.
//!
//! ```text
//! column 0   1   2  …  n−1
//!        ●───●───●── … ──●      row 0         `along` ─▶
//!        ●───●───●── … ──●      row 1         `across` points at the reader
//!        ●───●───●── … ──●      row 2
//! ```

use crate::player::Player;
use muslin::glam::{DVec3, Vec3};
use muslin::{Cloth, GridDesc, Material, PinMode, Settings};

/// Rows of particles across a strip.
pub const ROWS: u32 = 3;

/// A strip, or a sheet with more rows, that starts flat.
#[derive(Clone, Debug)]
pub struct Strip {
    /// Particles along the strip.
    pub columns: u32,
    pub rows: u32,
    /// Distance between neighbours [m].
    pub spacing: f64,
    /// Direction of the strip.
    pub along: DVec3,
    /// Direction across it, perpendicular to `along`.
    pub across: DVec3,
    pub material: Material,
    pub settings: Settings,
}

/// A horizontal direction, at `turn` degrees to x, and the one across it.
pub fn horizontal(turn: f64) -> [DVec3; 2] {
    let (sine, cosine) = turn.to_radians().sin_cos();
    [DVec3::new(cosine, 0.0, sine), DVec3::new(-sine, 0.0, cosine)]
}

/// Material with this density [kg/m²], rigid links, and neither bend stiffness nor drag.
pub fn limp(density: f64) -> Material {
    let density = density as f32;
    Material { density, bend_stiffness: 0.0, drag: 0.0, lift: 0.0, ..Material::default() }
}

/// Material with this density [kg/m²] and bend stiffness [N m], rigid links and no drag.
pub fn bending(density: f64, bend_stiffness: f64) -> Material {
    Material { bend_stiffness: bend_stiffness as f32, ..limp(density) }
}

/// Limp material with this density [kg/m²] and stretch stiffness [N/m], and no drag.
pub fn elastic(density: f64, stiffness: f64) -> Material {
    let stiffness = stiffness as f32;
    Material {
        stretch_stiffness_warp: stiffness,
        stretch_stiffness_weft: stiffness,
        ..limp(density)
    }
}

impl Strip {
    pub fn cloth(&self) -> muslin::Result<Cloth> {
        Cloth::grid(&GridDesc {
            columns: self.columns,
            rows: self.rows,
            spacing: self.spacing as f32,
            right: self.along.as_vec3(),
            down: self.across.as_vec3(),
            pin_mode: PinMode::None,
            extra_particles: 0,
            material: self.material.clone(),
            settings: self.settings.clone(),
            ..GridDesc::default()
        })
    }

    /// The cloth with the particles of some columns pinned where they are.
    pub fn pinned(&self, columns: &[u32]) -> muslin::Result<Player> {
        let mut cloth = self.cloth()?;
        for column in columns {
            self.column(*column).try_for_each(|particle| cloth.pin(particle, None))?;
        }
        Ok(Player::new(cloth))
    }

    /// The particles of a column.
    pub fn column(&self, column: u32) -> impl Iterator<Item = u32> + Clone + use<> {
        let columns = self.columns;
        (0..self.rows).map(move |row| row * columns + column)
    }

    /// Mean position of a column [m].
    pub fn at(&self, player: &Player, column: u32) -> DVec3 {
        player.mean(self.column(column))
    }

    /// Mean position of the middle column, or of both [m].
    pub fn middle(&self, player: &Player) -> DVec3 {
        0.5 * (self.at(player, (self.columns - 1) / 2) + self.at(player, self.columns / 2))
    }

    /// Moves every particle so that the column `i` has the offset `points[i]` in the plane of
    /// `along` and up, and sets the pins there too.
    pub fn place(&self, player: &mut Player, points: &[[f64; 2]]) -> muslin::Result<()> {
        let positions: Vec<Vec3> = (0..self.rows)
            .flat_map(|row| {
                points.iter().map(move |[x, y]| {
                    let across = self.across * (self.spacing * f64::from(row));
                    (self.along * *x + DVec3::Y * *y + across).as_vec3()
                })
            })
            .collect();
        player.cloth.set_positions(0, &positions)?;
        player.cloth.set_velocities(0, &vec![Vec3::ZERO; positions.len()])
    }

    /// Moves the last `count` columns along the strip by `distance` [m] in `seconds` [s].
    pub fn push_end(
        &self,
        player: &mut Player,
        count: u32,
        distance: f64,
        seconds: f64,
    ) -> muslin::Result<()> {
        let columns = self.columns - count..self.columns;
        let ends: Vec<u32> = columns.flat_map(|column| self.column(column)).collect();
        let start: Vec<Vec3> =
            ends.iter().map(|particle| player.cloth.positions()[*particle as usize]).collect();
        let ticks = player.ticks_in(seconds);
        for tick in 1..=ticks {
            let moved = self.along * (distance * f64::from(tick) / f64::from(ticks));
            let targets: Vec<Vec3> = start.iter().map(|x| *x + moved.as_vec3()).collect();
            player.cloth.set_pin_targets(&ends, &targets)?;
            player.step(1);
        }
        Ok(())
    }
}
