//! Still water over a mound with units: prints the computed and the hydrostatic pressure at each gauge.
//!
//!     cargo run --release --example still_water

use std::{error::Error, sync::Arc};

use breakwater::{Case, Simulation, case::Quantity};

fn main() -> Result<(), Box<dyn Error>> {
    let case = Arc::new(Case::load("cases/verification/still-water.json")?);
    let mut simulation = Simulation::new(case.clone())?;
    println!("{}: {} water particles", case.title, simulation.water.len());

    while simulation.time < 0.1 {
        simulation.step()?;
    }

    let mut now = simulation.begin_step()?;
    for gauge in case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Pressure) {
        let point = now.gauge_position(gauge);
        if let Some(sample) = now.sampler()?.sample(point) {
            let depth = case.flume.still_water_level - point.z;
            let hydrostatic = case.fluid.rho0 * case.fluid.gravity * depth;
            println!("{}: {:.0} Pa, hydrostatic {hydrostatic:.0} Pa", gauge.name, sample.pressure);
        }
    }
    Ok(())
}
