//! `breakwater check`: validates cases and estimates the cost of their runs.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, counted, input::load, run, savings::savings};
use crate::{
    case::{
        BreakageSettings, Case, DryTestCase, DryTestKind, ImpactMeasure, InputFile, InputKind, Part, PartShape,
        Reference, Sides, UnitGroup, UnitKind, Units, Wave, Wavemaker,
    },
    output::{OutputSize, progress::readable},
    rigid::{RigidSetup, RigidWorld},
    simulation::{
        bodies::rigid_setup,
        dry_test::DryTest,
        flume::{setup::check_times, wave::incoming::particle_start},
    },
    sweep::{plan::Sweep, values::in_words},
};

/// Full evaluations per second and core [1/s], assumed in the estimate of the run time. A full evaluation computes all
/// terms of one particle; a time step has two per particle. `breakwater bench` measures 1.5 million with AVX-512. The
/// estimate uses a smaller value, because a run also computes gauges, outputs and contact.
const EVALUATIONS_PER_S_AND_CORE: f64 = 1.2e6;

/// Full evaluations per second and core in two dimensions [1/s]. The rate is higher than in three dimensions, because a
/// particle has only one sixth as many neighbours.
const EVALUATIONS_IN_TWO_DIMENSIONS: f64 = 2.4e6;

/// Validate input files; estimate the number of particles, memory, file sizes, time step and run time of a case, and say
/// which changes of the case would save run time.
#[derive(Args)]
pub struct CheckArguments {
    /// Files to check: case files, sweep files, placement files, and reference folders (or their `reference.json`).
    #[arg(required = true)]
    cases: Vec<PathBuf>,
}

impl CheckArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let mut refusals = Vec::new();
        for path in &self.cases {
            if let Err(CommandError::Refused(reason) | CommandError::Failed(reason)) = check(path) {
                refusals.push(reason);
            }
        }
        if refusals.is_empty() { Ok(()) } else { Err(CommandError::refused(refusals.join("\n"))) }
    }
}

const ALL_KINDS: [InputKind; 6] = [
    InputKind::Flume,
    InputKind::DryTest,
    InputKind::Fracture,
    InputKind::Sweep,
    InputKind::Placement,
    InputKind::Reference,
];

fn check(path: &Path) -> Result<(), CommandError> {
    let reference = path.join(Reference::FILE);
    let path = if reference.is_file() { &reference } else { path };
    match load(path, &ALL_KINDS)? {
        InputFile::Flume(case) => check_flume(&case, path),
        InputFile::DryTest(case) => {
            print_dry(&case);
            check_overlap(DryTest::setup(&case), &case.units, path)
        }
        InputFile::Fracture(case) => run::fracture::check(&case, path),
        InputFile::Sweep(file) => {
            print_sweep(path, &Sweep::new(file, path).map_err(CommandError::refused)?);
            Ok(())
        }
        InputFile::Reference(reference) => {
            println!("{}: {}: {}", path.display(), reference.title, reference.waves_in_words());
            Ok(())
        }
        InputFile::Placement(file) => {
            let of_groups = file.groups.iter().map(|group| group.poses.len()).sum::<usize>();
            let units = counted(file.poses.len() + of_groups, "unit");
            println!("{}: placement of {units} for the case: {}", path.display(), file.title);
            Ok(())
        }
    }
}

fn check_flume(case: &Case, path: &Path) -> Result<(), CommandError> {
    let times = check_times(case, particle_start(case, None))
        .map_err(|reason| CommandError::refused(format!("{}: {reason}", path.display())));
    print(case);
    print_savings(case, path);
    let Some(units) = &case.units else { return times };
    let setup = rigid_setup(units, &case.site(), &case.materials, case.contact.law, case.fluid.gravity);
    times.and(check_overlap(setup, units, path))
}

/// Largest number of values of a varied key that `check` prints.
const MOST_VALUES: usize = 12;

fn print_sweep(path: &Path, sweep: &Sweep) {
    println!("{}: {}", path.display(), sweep.title);
    println!("  runs        {} of {}", sweep.members.len(), sweep.case.display());
    for one in &sweep.varied {
        let shown: Vec<String> = one.values.iter().take(MOST_VALUES).map(in_words).collect();
        let rest = one.values.len() - shown.len();
        let rest = if rest == 0 { String::new() } else { format!(" and {rest} more") };
        println!("  varies      {}: {}{rest}", one.key, shown.join(", "));
    }
}

fn print(case: &Case) {
    let estimate = case.estimate();
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as f64;
    let in_layer = case.domain.sides == Sides::TwoDimensional;
    let rate = if in_layer { EVALUATIONS_IN_TWO_DIMENSIONS } else { EVALUATIONS_PER_S_AND_CORE };
    let seconds = estimate.evaluations / (rate * cores);
    println!("{}: {}", case.name, case.title);
    match &case.wave {
        Wave::None => println!("  wave        none"),
        Wave::Solitary(wave) => {
            println!("  wave        solitary, H = {} m in {} m of water", wave.height_m, wave.depth_m);
        }
        Wave::SolitaryInflow(wave) => {
            println!("  wave        solitary, H = {} m, inflow, {} m of water", wave.height_m, wave.depth_m);
        }
        Wave::Regular { wave, ramp_periods } => {
            print!(
                "  wave        regular, H = {} m, T = {} s, wavelength {:.3} m in {} m of water",
                wave.height_m,
                wave.period_s,
                wave.wavelength_m(),
                wave.depth_m
            );
            if case.wavemaker.follows_flume_model() {
                println!("; inflow");
            } else {
                let motion = case.wavemaker.motion(wave, *ramp_periods, case.flume.section().z(case.domain.x[0]));
                println!("; stroke {:.4} m at the still water level", motion.stroke_m());
            }
        }
        Wave::External(wave) => {
            let [first, last] = wave.times();
            let count = wave.rows.times_s.len();
            println!("  wave        from files: velocities at {count} times from {first} to {last} s");
        }
        Wave::Irregular { sea, .. } => println!(
            "  wave        irregular, H_s = {} m, T_p = {} s, gamma = {}, seed {}, in {} m of water",
            sea.significant_height_m, sea.peak_period_s, sea.peak_enhancement, sea.seed, sea.depth_m
        ),
    }
    if let Wavemaker::OpenEnds { gauge } = case.wavemaker {
        println!("  ends        open: water flows as in the flume model; gauges {gauge} m from the ends");
    } else if let Some(distance) = case.wavemaker.absorption_gauge() {
        println!("  wavemaker   absorbs returning waves, gauge {distance} m in front of it");
    }
    let across = match case.domain.sides {
        Sides::TwoDimensional => "two-dimensional".to_owned(),
        Sides::Periodic | Sides::Walls => format!("{} m wide", case.domain.width),
    };
    println!(
        "  domain      x = {} to {} m, {across}, still water depth up to {:.3} m",
        case.domain.x[0], case.domain.x[1], case.domain.depth
    );
    if let Some(bathymetry) = &case.flume.bathymetry {
        println!("  terrain     the flume model uses its section along y = {} m", bathymetry.y);
    }
    if !case.flume.parts.is_empty() {
        let words = |part: &Part| {
            let place = match part.shape {
                PartShape::Bed(_) => " (part of the bed)",
                PartShape::Porous(..) => " (porous)",
                PartShape::Body(_) => " (body)",
                PartShape::Section(_) | PartShape::Box(_) => "",
            };
            format!("{}{place}", part.name)
        };
        println!("  structure   {}", case.flume.parts.iter().map(words).collect::<Vec<_>>().join(", "));
    }
    for region in case.domain.regions.iter().filter(|_| case.domain.regions.len() > 1) {
        let dp = f64::from(region.coarseness) * case.domain.dp;
        println!("  spacing     {dp} m from x = {:.3} to {:.3} m", region.x[0], region.x[1]);
    }
    if let Some(units) = &case.units {
        print_units(units);
    }
    case.breakage.iter().for_each(print_breakage);
    println!(
        "  particles   about {:.0} thousand: water {:.0}, bed and walls {:.0}, units {:.1}; dp = {} m",
        estimate.particles() / 1e3,
        estimate.fluid / 1e3,
        estimate.boundary / 1e3,
        estimate.units / 1e3,
        case.domain.dp
    );
    println!("  memory      about {:.2} GB", estimate.bytes / 1e9);
    let files = OutputSize::estimate(case);
    println!(
        "  files       about {}: fluid.vtkhdf {}, surface.vtkhdf {}, units.vtkhdf {}, tables {}, checkpoint {}",
        size(files.total()),
        size(files.fluid),
        size(files.surface),
        size(files.units),
        size(files.tables),
        size(files.checkpoint)
    );
    println!(
        "  time step   about {:.2e} s, speed of sound {:.1} m/s; {:.0} steps for {} s",
        estimate.dt, case.fluid.sound_speed, estimate.steps, case.stop.duration
    );
    println!("  run time    about {} on {cores} cores", readable(seconds));
}

fn print_savings(case: &Case, path: &Path) {
    for (number, saving) in savings(case, path).iter().enumerate() {
        let label = if number == 0 { "savings" } else { "" };
        println!("  {label:<12}{:.0} % of the run time with {}", 100.0 * saving.share, saving.keys);
    }
}

fn print_units(units: &Units) {
    units.groups.iter().for_each(print_group);
}

fn print_group(group: &UnitGroup) {
    let shape = group.shape();
    if group.models.len() > 1 {
        let (count, size) = (group.members.len(), group.nominal_diameter);
        println!("  units       {count} (rock) of D_n50 = {size} m and M50 = {} kg", group.mass);
        let density = group.mass / size.powi(3);
        println!("  rocks       {} random shapes, {density:.0} kg/m3", group.models.len());
        return;
    }
    println!(
        "  units       {} ({}) of {} m and {} kg",
        group.members.len(),
        shape.kind.name(),
        shape.height(),
        group.mass
    );
    let density = group.mass / shape.volume();
    print!("  a unit      {:.4e} m3, {density:.0} kg/m3, D_n = {:.4} m", shape.volume(), shape.nominal_diameter());
    match shape.kind.stability_coefficient() {
        Some(k_d) => println!(", K_D = {k_d}"),
        None => println!(),
    }
    if let UnitKind::Stl(stl) = &shape.kind {
        let corners: usize = stl.parts().iter().map(|part| part.corners().len()).sum();
        println!(
            "  parts       {} with {corners} corners, volume error {:.1} %",
            counted(stl.parts().len(), "convex part"),
            100.0 * stl.volume_error
        );
    }
}

/// `check` warns if the overlap of a unit with another body at the start, divided by the height of the unit [-],
/// exceeds this value. For units at rest this ratio is 0.0001, for units wedged in an armour layer up to 0.005.
const WARNING_OVERLAP: f64 = 0.01;

/// Warns if units overlap each other, the bed or a wall at the start.
fn check_overlap(setup: RigidSetup, units: &Units, path: &Path) -> Result<(), CommandError> {
    let world =
        RigidWorld::new(setup).map_err(|error| CommandError::refused(format!("{}: units: {error}", path.display())))?;
    let overlap = world.deepest_overlap() / units.tallest();
    if overlap > WARNING_OVERLAP {
        eprintln!(
            "warning: units overlap each other, the bed or a wall by up to {:.2} % of their height at the start; \
             contact forces will separate them",
            100.0 * overlap
        );
    }
    Ok(())
}

fn print_dry(case: &DryTestCase) {
    println!("{}: {}", case.name, case.title);
    let test = match case.test {
        DryTestKind::Settle => "units settle from their start positions".to_owned(),
        DryTestKind::Drop => "units are dropped".to_owned(),
        DryTestKind::Tilt { rate, to, .. } => {
            format!("the bed is tilted at {:.3} degrees/s up to {:.1} degrees", rate.to_degrees(), to.to_degrees())
        }
    };
    println!("  dry test    {test}");
    println!("  bed         x = {} to {} m, {} m wide", case.site.x[0], case.site.x[1], case.site.width);
    if let Some(terrain) = &case.site.terrain {
        let [low, high] = terrain.surface.bounds();
        println!(
            "  terrain     x = {:.3} to {:.3} m, y = {:.3} to {:.3} m, z = {:.3} to {:.3} m; {}",
            low.x,
            high.x,
            low.y,
            high.y,
            low.z,
            high.z,
            counted(terrain.surface.triangles().len(), "triangle")
        );
    }
    print_units(&case.units);
    case.breakage.iter().for_each(print_breakage);
    println!("  duration    at most {} s", case.stop.duration);
}

/// Prints the settings of the breakage analysis.
fn print_breakage(settings: &BreakageSettings) {
    let by = match settings.select.by {
        ImpactMeasure::PeakForce => "force",
        ImpactMeasure::ApproachVelocity => "approach velocity",
        ImpactMeasure::KineticEnergy => "kinetic energy",
    };
    let which = match settings.select.worst {
        Some(1) => format!("the hardest impact by {by}"),
        Some(worst) => format!("the {worst} hardest impacts by {by}"),
        None => format!("all recorded impacts, the hardest by {by} first"),
    };
    println!(
        "  breakage    {which}, re-run at length scale {}; {} tetrahedra per unit, edges of {:.3} m",
        settings.scale,
        settings.mesh.tets(),
        settings.mesh.edge() * settings.scale
    );
}

/// Formats a file size [bytes] in megabytes or gigabytes.
fn size(bytes: f64) -> String {
    match bytes {
        b if b <= 0.0 => "none".to_owned(),
        b if b < 0.995e6 => format!("{:.2} MB", b / 1e6),
        b if b < 0.995e9 => format!("{:.0} MB", b / 1e6),
        b => format!("{:.1} GB", b / 1e9),
    }
}
