//! `breakwater unit`: properties and geometry files of an armour unit in the catalogue.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::CommandError;
use crate::{
    case::UnitKind,
    geometry::{armour_unit::gmsh, stl},
    output::write_atomically,
};

/// Show volume, nominal diameter, inertia and K_D of an armour unit. Optionally write its surface and its Gmsh
/// geometry.
#[derive(Args)]
pub struct UnitArguments {
    /// Shape of the unit.
    shape: CatalogueShape,
    /// Height H of the unit, or size C of a Core-Loc [m].
    #[arg(long, default_value_t = 1.0)]
    height_m: f64,
    /// Waist ratio of a Dolos: width of the stem divided by the height [-].
    #[arg(long, default_value_t = 0.34)]
    waist_ratio: f64,
    /// Density of the concrete [kg/m3].
    #[arg(long, default_value_t = 2350.0)]
    density_kg_m3: f64,
    /// Write the closed surface as binary STL to this file; default: not written.
    #[arg(long)]
    stl: Option<PathBuf>,
    /// Write the geometry for Gmsh to this file; default: not written.
    #[arg(long)]
    geo: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
#[value(rename_all = "snake_case")]
enum CatalogueShape {
    Tetrapod,
    Dolos,
    CoreLoc,
    GroovedCube,
    Cube,
}

/// Radius of the rounded edges divided by the height [-].
const ROUNDING: f64 = 0.03;
/// Number of elements along the height of the unit in the Gmsh geometry.
const ELEMENTS: f64 = 20.0;

impl UnitArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let height = self.height_m;
        if !(self.density_kg_m3 > 0.0 && self.density_kg_m3.is_finite()) {
            return Err(CommandError::refused(format!("--density-kg-m3 {}: must be positive", self.density_kg_m3)));
        }
        let kind = match self.shape {
            CatalogueShape::Tetrapod => UnitKind::Tetrapod { height },
            CatalogueShape::Dolos => UnitKind::Dolos { height, waist: self.waist_ratio },
            CatalogueShape::CoreLoc => UnitKind::CoreLoc { size: height },
            CatalogueShape::GroovedCube => UnitKind::GroovedCube { height },
            CatalogueShape::Cube => UnitKind::Cuboid { edges: [height; 3] },
        };
        let unit = kind.build(ROUNDING).map_err(CommandError::refused)?;
        let properties = unit.solid().volume_properties();
        let mass = self.density_kg_m3 * properties.volume;
        let inertia = unit.inertia(mass);
        println!("{} of {height} m", kind.name());
        println!(
            "  volume       {} m3 = {:.4} H^3",
            five_digits(properties.volume),
            properties.volume / height.powi(3)
        );
        println!("  D_n          {:.5} m", properties.volume.cbrt());
        println!("  mass         {} kg at {} kg/m3", five_digits(mass), self.density_kg_m3);
        let [xx, yy, zz] = [inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z].map(five_digits);
        println!("  inertia      {xx} {yy} {zz} kg m2");
        println!("  convex parts {}, {} triangles", unit.parts().len(), unit.solid().triangles().len());
        if let Some(k_d) = kind.stability_coefficient() {
            println!("  K_D          {k_d} (Hudson formula; two layers, random placement, trunk, breaking waves)");
        }
        if let Some(path) = &self.stl {
            stl::write(path, unit.solid().vertices(), unit.solid().triangles()).map_err(CommandError::failed)?;
            println!("  surface      {}", path.display());
        }
        if let Some(path) = &self.geo {
            // `geometry` returns `Some` for every unit in the catalogue.
            let text = gmsh::geometry(&unit, height / ELEMENTS).unwrap_or_default();
            write_atomically(path, text.as_bytes()).map_err(CommandError::failed)?;
            println!("  geometry     {}: gmsh -3 {0}", path.display());
        }
        Ok(())
    }
}

/// Formats a positive number with five significant digits; numbers below 0.01 in scientific notation.
fn five_digits(value: f64) -> String {
    if value < 0.01 {
        return format!("{value:.4e}");
    }
    let decimals = (4 - value.log10().floor() as i32).max(0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::five_digits;

    #[test]
    fn numbers_have_five_significant_digits() {
        let texts = [0.000_127_62, 0.010_234_1, 2.236_32, 5255.352, 1_234_567.0].map(five_digits);
        assert_eq!(texts, ["1.2762e-4", "0.010234", "2.2363", "5255.4", "1234567"]);
    }
}
