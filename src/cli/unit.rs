//! `breakwater unit`: properties and geometry files of a unit of the catalogue.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::Trouble;
use crate::{
    case::UnitKind,
    geometry::{gmsh, stl},
    output::write_atomically,
};

/// Show volume, nominal diameter, inertia and K_D of an armour unit; write its surface and Gmsh geometry.
#[derive(Args)]
pub struct UnitArguments {
    /// Shape of the unit.
    shape: CatalogueShape,
    /// Height H [m]; for a Core-Loc, its size C.
    #[arg(long, default_value_t = 1.0)]
    height_m: f64,
    /// Waist ratio of a Dolos: width of the stem over the height [-].
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

/// Radius of the rounded edges over the height [-].
const ROUNDING: f64 = 0.03;
/// Elements along the height in the Gmsh geometry.
const ELEMENTS: f64 = 20.0;

impl UnitArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let height = self.height_m;
        if !(self.density_kg_m3 > 0.0 && self.density_kg_m3.is_finite()) {
            return Err(Trouble::refused(format!("--density-kg-m3 {}: must be positive", self.density_kg_m3)));
        }
        let kind = match self.shape {
            CatalogueShape::Tetrapod => UnitKind::Tetrapod { height },
            CatalogueShape::Dolos => UnitKind::Dolos { height, waist: self.waist_ratio },
            CatalogueShape::CoreLoc => UnitKind::CoreLoc { size: height },
            CatalogueShape::GroovedCube => UnitKind::GroovedCube { height },
            CatalogueShape::Cube => UnitKind::Cuboid { edges: [height; 3] },
        };
        let unit = kind.build(ROUNDING).map_err(Trouble::refused)?;
        let properties = unit.solid().volume_properties();
        let mass = self.density_kg_m3 * properties.volume;
        let inertia = unit.inertia(mass);
        println!("{} of {height} m", kind.name());
        println!("  volume       {:.5e} m3 = {:.4} H^3", properties.volume, properties.volume / height.powi(3));
        println!("  D_n          {:.5} m", properties.volume.cbrt());
        println!("  mass         {mass:.4e} kg at {} kg/m3", self.density_kg_m3);
        println!("  inertia      {:.4e} {:.4e} {:.4e} kg m2", inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
        println!("  convex parts {}, {} triangles", unit.parts().len(), unit.solid().triangles().len());
        if let Some(k_d) = kind.stability_coefficient() {
            println!("  K_D          {k_d} (Hudson; two layers, random placing, trunk, breaking waves)");
        }
        if let Some(path) = &self.stl {
            stl::write(path, unit.solid().vertices(), unit.solid().triangles()).map_err(Trouble::failed)?;
            println!("  surface      {}", path.display());
        }
        if let Some(path) = &self.geo {
            // Every unit of the catalogue has an exact geometry.
            let text = gmsh::geometry(&unit, height / ELEMENTS).unwrap_or_default();
            write_atomically(path, text.as_bytes()).map_err(Trouble::failed)?;
            println!("  geometry     {}: gmsh -3 {0}", path.display());
        }
        Ok(())
    }
}
