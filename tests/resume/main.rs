//! Runs continue from their last checkpoint.

mod finished;
mod interrupted;

use serde_json::{Value, json};

/// A dam break in a two-dimensional tank with a block that the water reaches.
fn tank() -> Value {
    json!({
        "title": "tank",
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.3, "material": "stone" },
        "domain": { "x_m": [0.0, 1.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": 0.025,
                    "water": { "kind": "block", "x_m": [0.0, 0.5], "top_z_m": 0.3 } },
        "numerics": { "hold_units_s": 0.02 },
        "units": { "shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3, "material": "stone",
                   "centres_m": [[0.8, 0.0, 0.05]] },
        "materials": [{ "name": "stone", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["stone", "stone"], "coefficient": 0.5 }],
        "gauges": [{ "kind": "elevation", "name": "wall", "x_m": 0.95 }],
        "output": { "units_interval_s": 0.02, "series_interval_s": 0.005, "checkpoint_interval_s": 0.04 },
        "stop": { "duration_s": 0.2 }
    })
}
