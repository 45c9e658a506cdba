//! Column names of the tables in a run folder. The names include the units.
//!
//! In every table of a flume case, `time_s` is flume time. It is 0 at the start of the flume model or, without this
//! model, at the start of the particles. For waves from files, it is the time of these files.

/// `units.csv`: one row per unit and output time. `unit` counts from 1. `x_m` to `z_m` is the centre of mass, `qx` to
/// `qw` the orientation of the body axes (quaternion). `fluid_*` is the load from the water, `contact_*` the load from
/// bed, walls and other units: forces [N] and torques [N m] about the centre of mass, averaged over the time since the
/// unit's previous row.
pub const UNITS: [&str; 27] = [
    "time_s",
    "unit",
    "x_m",
    "y_m",
    "z_m",
    "qx",
    "qy",
    "qz",
    "qw",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "wx_rad_s",
    "wy_rad_s",
    "wz_rad_s",
    "fluid_fx_n",
    "fluid_fy_n",
    "fluid_fz_n",
    "fluid_tx_nm",
    "fluid_ty_nm",
    "fluid_tz_nm",
    "contact_fx_n",
    "contact_fy_n",
    "contact_fz_n",
    "contact_tx_nm",
    "contact_ty_nm",
    "contact_tz_nm",
];

/// `contacts.csv`: one row per contact event. `partner` is the number of the other unit, from 1, or 0 for bed and
/// walls. `bx_m`, `by_m`, `bz_m` is the contact position in the body axes of the unit, relative to its centre of mass.
/// `normal_velocity_m_s` and `tangential_velocity_m_s` are the approach velocities at the start of the event.
/// `rebound_m_s` is the normal velocity at the end of the event, positive if the bodies separate.
pub const CONTACTS: [&str; 15] = [
    "start_s",
    "end_s",
    "unit",
    "partner",
    "x_m",
    "y_m",
    "z_m",
    "normal_velocity_m_s",
    "tangential_velocity_m_s",
    "peak_force_n",
    "impulse_n_s",
    "bx_m",
    "by_m",
    "bz_m",
    "rebound_m_s",
];

/// `energy.csv` of a dry test: slope of the bed, energy of the units, elastic energy of the contacts, and energy
/// dissipated by friction and contact damping since the start.
pub const DRY_ENERGY: [&str; 7] =
    ["time_s", "slope_deg", "kinetic_j", "potential_j", "elastic_j", "friction_j", "damping_j"];

/// `energy.csv` of a flume run: energy of the water and of the units. `from_*` is the energy that the water received
/// since the start: from bed, walls, wavemaker and units (by pressure), from viscosity, from density diffusion and
/// particle shifting, from damping and relaxation zones, and from the drag of porous parts. Negative values are energy
/// that the water lost.
pub const ENERGY: [&str; 11] = [
    "time_s",
    "kinetic_j",
    "potential_j",
    "internal_j",
    "units_kinetic_j",
    "units_potential_j",
    "from_boundary_j",
    "from_viscosity_j",
    "from_diffusion_j",
    "from_zones_j",
    "from_pores_j",
];

/// `energy.csv` of a fracture run: stored energies; energies dissipated and supplied since the start; residual of the
/// energy balance; area of failed faces; number of pairs of tetrahedra in contact. `freed_j` is the energy that the
/// springs of tied joints had when the joints were released.
pub const FRACTURE_ENERGY: [&str; 14] = [
    "time_s",
    "kinetic_j",
    "strain_j",
    "joints_j",
    "contact_j",
    "gravity_j",
    "viscous_j",
    "fracture_j",
    "friction_j",
    "work_j",
    "freed_j",
    "residual_j",
    "crack_area_m2",
    "pairs_touching",
];

/// `bodies.csv` of a fracture run: one row per body and output time of `energy.csv`, with its stored energies, the
/// energy dissipated in its joints since the start, and its largest first principal stress at this time. `body` counts
/// from 0 in the order of the mesh.
pub const FRACTURE_BODIES: [&str; 8] =
    ["time_s", "body", "kinetic_j", "strain_j", "joints_j", "gravity_j", "fracture_j", "sigma_1_pa"];

/// `cracks.csv` of a fracture run: one row per failed face, in chronological order, with centre and area of the
/// undeformed face. `mode` 1 is opening, 2 is sliding. `body` counts from 0 in the order of the mesh, as in the VTKHDF
/// files.
pub const CRACKS: [&str; 7] = ["time_s", "x_m", "y_m", "z_m", "area_m2", "mode", "body"];

/// `fragments.csv` of a fracture run: one row per piece at the end of the run, the heaviest first. `x_m` to `z_m` is
/// the centre of mass.
pub const FRAGMENTS: [&str; 10] =
    ["fragment", "body", "tets", "mass_kg", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s"];

/// `breakage.csv`: one row per unit with its displacement and the results of its impacts re-run at prototype scale.
/// The columns from `sigma_1_pa` to `broken` are empty if no impact of the unit was re-run.
pub const BREAKAGE: [&str; 10] = [
    "unit",
    "displacement_m",
    "damaged",
    "peak_force_n",
    "nominal_stress_pa",
    "sigma_1_pa",
    "crack_area_m2",
    "pieces",
    "heaviest_share",
    "broken",
];

/// `diagnostics.csv`: checks of the run. `volume_m3` is the volume of the water, the sum of mass / density of all water
/// particles; `volume_change_m3` is its change since the first row. `largest_mach` (water speed / speed of sound) and
/// the densities are extremes of all time steps since the previous row. `rms_divergence_1_s` is the root mean square of
/// the divergence of the velocity at all water particles. `steps` is the number of time steps since the start, `dt_s`
/// the length of the next time step. `lost_particles`, the number of water particles lost since the first row, must
/// stay 0.
pub const DIAGNOSTICS: [&str; 10] = [
    "time_s",
    "volume_m3",
    "volume_change_m3",
    "largest_mach",
    "lowest_density_kg_m3",
    "highest_density_kg_m3",
    "rms_divergence_1_s",
    "steps",
    "dt_s",
    "lost_particles",
];

/// `profile.csv`: corner points of the bed profile with the mound.
pub const PROFILE: [&str; 2] = ["x_m", "z_m"];

/// Returns the column name of the surface elevation [m] at the gauge `name` (`gauges.csv`, `flume_gauges.csv`).
pub fn elevation(name: &str) -> String {
    format!("{name}_eta_m")
}

/// Returns the column name of the length of a vertical wire at the gauge `name` that is under water [m] (`gauges.csv`).
pub fn wetted_length(name: &str) -> String {
    format!("{name}_wetted_m")
}

/// Returns the column names of the pressure [Pa] at the gauge `name`: at the time of the row, and as a mean over the
/// time since the last row.
pub fn pressure(name: &str) -> [String; 2] {
    ["p", "p_mean"].map(|kind| format!("{name}_{kind}_pa"))
}

/// Returns the column names of the three velocity components [m/s] at the gauge `name`.
pub fn velocity(name: &str) -> [String; 3] {
    ["u", "v", "w"].map(|c| format!("{name}_{c}_m_s"))
}

/// Returns the column names of the force [N] and the moment [N m] at the gauge `name`.
pub fn force(name: &str) -> [String; 6] {
    ["fx_n", "fy_n", "fz_n", "mx_n_m", "my_n_m", "mz_n_m"].map(|component| format!("{name}_{component}"))
}

/// Returns the row of `contacts.csv` for an event. `offset` [s] is added to the event's times to give flume times.
pub fn contact_row(event: &crate::rigid::ContactEvent, offset: f64) -> [f64; 15] {
    let ([x, y, z], [bx, by, bz]) = (event.point, event.point_in_body);
    [
        event.start + offset,
        event.end + offset,
        f64::from(event.body + 1),
        event.partner_unit().map_or(0.0, |unit| f64::from(unit + 1)),
        x,
        y,
        z,
        event.approach_normal,
        event.approach_tangential,
        event.peak_force,
        glam::DVec3::from_array(event.impulse).length(),
        bx,
        by,
        bz,
        event.rebound,
    ]
}
