//! Writes tables in the format of SWASH, with all digits.

use std::io::{self, Write};

use super::layer_middles;
use crate::waves::external::table::{Place, VelocityTable};

/// Header of a SWASH table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heading {
    /// `HEADER`: names and units of the columns.
    Names,
    /// `NOHEADER`: no header.
    None,
}

/// Writes the SWASH table `TSEC WATL`. If `table` has no surface levels, still water is written.
///
/// # Errors
/// If writing fails.
pub fn write_level(table: &VelocityTable, place: &Place, heading: Heading, mut out: impl Write) -> io::Result<()> {
    write_heading(heading, &["Tsec".to_owned(), "Watlev".to_owned()], &["sec", "m"], &mut out)?;
    for &t in &table.times_s {
        let watl = table.surface_at_m(t).map_or(0.0, |z| z - place.still_water_z_m);
        writeln!(out, " {t:e} {watl:e}")?;
    }
    Ok(())
}

/// Writes the SWASH table `TSEC VELK` for layers with the given shares of the depth [-], from the surface downwards.
/// Velocities along y are 0.
///
/// # Errors
/// If writing fails.
pub fn write_velocities(
    table: &VelocityTable,
    place: &Place,
    layer_shares: &[f64],
    heading: Heading,
    mut out: impl Write,
) -> io::Result<()> {
    let layers = 1..=layer_shares.len();
    let mut names = vec!["Tsec".to_owned()];
    names.extend(layers.clone().map(|layer| format!("X-vel_k{layer:02}")));
    names.extend(layers.map(|layer| format!("Y-vel_k{layer:02}")));
    let mut units = vec!["m/s"; names.len()];
    units[0] = "sec";
    write_heading(heading, &names, &units, &mut out)?;
    for &t in &table.times_s {
        let surface = table.surface_at_m(t).unwrap_or(place.still_water_z_m);
        write!(out, " {t:e}")?;
        for z in layer_middles(place.bed_z_m, surface, layer_shares).into_iter().rev() {
            write!(out, " {:e}", table.velocity_m_s(z, t))?;
        }
        writeln!(out, "{}", " 0e0".repeat(layer_shares.len()))?;
    }
    Ok(())
}

/// Writes seven comment lines: the fifth has the names, the sixth the units.
fn write_heading(heading: Heading, names: &[String], units: &[&str], out: &mut impl Write) -> io::Result<()> {
    if heading == Heading::None {
        return Ok(());
    }
    let names: String = names.iter().map(|name| format!(" {name:>12}")).collect();
    let units: String = units.iter().map(|unit| format!(" {:>12}", format!("[{unit}]"))).collect();
    writeln!(out, "%\n%\n% Run:      Table:BREAKWATER\n%\n%{names}\n%{units}\n%")
}
