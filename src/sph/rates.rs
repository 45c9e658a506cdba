//! Right-hand sides of equations 1 and 2: one pass over the neighbour lists gives the acceleration, the rate of the
//! density and the largest approach speed of each target.
//!
//! A second, small pass gives the units what a gap too narrow for water particles carries. Where a foot stands on the
//! bed, no particle fits below it; with the forces of the water alone its pressure would press on the foot from above
//! and never from below, and hold the unit down with several times its weight. Water does reach such gaps and its
//! pressure is continuous through them, so bed, walls and other units act on a unit with the pressure term of
//! equation 1, their densities being those of the water near by (see [`super::mdbc`]). Viscosity is left out: dry
//! friction is the contact's.

use rayon::prelude::*;

use super::{
    continuity::add_compression,
    density_diffusion::DensityDiffusion,
    gradients::Extra,
    lanes::{Lanes, MOST_LANES, WithLanes},
    momentum::pair_stress,
    neighbours::{CHUNK, Chunk, Cluster, NeighbourLists},
    parameters::Parameters,
    records::Record,
    viscosity::{Viscosity, approach_rate, laminar_factor, monaghan_gingold_stress, viscous_stress},
};

/// Sums of one target.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    /// Acceleration without gravity [m/s2].
    pub acceleration: [f32; 3],
    /// d rho / dt [kg/(m3 s)].
    pub density: f32,
    /// Largest |mu_ab| of equation 3 over the neighbours [m/s].
    pub approach: f32,
}

/// What the pair loop needs besides the records.
#[derive(Debug, Clone, Copy)]
pub struct PairLoop {
    /// Constants of the scheme.
    pub parameters: Parameters,
    bin_x: f32,
    width: f32,
}

impl PairLoop {
    /// Loop over pairs in bins of length `bin_x` [m].
    pub fn new(parameters: Parameters, bin_x: f64) -> Self {
        let width = parameters.periodic_width.unwrap_or(0.0) as f32;
        Self { parameters, bin_x: bin_x as f32, width }
    }

    /// The same loop with other constants.
    pub(super) fn with(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Rates of the targets, which are consecutive `records` from `first_target` on; `extra` is what the scheme needs
    /// besides, a value for each record, or nothing.
    pub fn rates(
        &self,
        lists: &NeighbourLists,
        records: &[Record],
        extra: &[Extra],
        first_target: usize,
        rates: &mut [Rate],
    ) {
        rates.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (rates, chunk))| {
            let begin = first_target + number * CHUNK;
            let targets = &records[begin..begin + rates.len()];
            lists.instructions().dispatch(ChunkRates { pairs: self, chunk, begin, targets, records, extra, rates });
        });
    }

    /// Add the pressure of bed, walls and other units, across gaps that hold no water particles, to the accelerations
    /// of the units; arguments as in [`Self::rates`].
    ///
    /// The unit's own particles are in the lists as well: their forces on each other cancel.
    pub fn add_gap_pressure(
        &self,
        lists: &NeighbourLists,
        records: &[Record],
        first_target: usize,
        rates: &mut [Rate],
    ) {
        rates.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (rates, chunk))| {
            let begin = first_target + number * CHUNK;
            let targets = &records[begin..begin + rates.len()];
            for (cluster, neighbours) in chunk.clusters() {
                for target in cluster.first as usize..(cluster.first + cluster.len) as usize {
                    let acceleration = self.pressure_acceleration(&targets[target], neighbours, records);
                    for (sum, part) in rates[target].acceleration.iter_mut().zip(acceleration) {
                        *sum += part as f32;
                    }
                }
            }
        });
    }

    /// Number of pairs of a target, the first of the `records`, and a neighbour within the kernel's support.
    pub fn count_within_support(&self, lists: &NeighbourLists, records: &[Record]) -> u64 {
        let count = |(number, chunk): (usize, &Chunk)| {
            let of_cluster = |(cluster, neighbours): (&Cluster, &[u32])| {
                let first = number * CHUNK + cluster.first as usize;
                let near =
                    |a: &Record, j: &u32| self.distance(a, &records[*j as usize]).1 < self.parameters.kernel.support();
                let of_target = |a| neighbours.iter().filter(|j| near(a, j)).count() as u64;
                records[first..first + cluster.len as usize].iter().map(of_target).sum::<u64>()
            };
            chunk.clusters().map(of_cluster).sum::<u64>()
        };
        lists.chunks().par_iter().enumerate().map(count).sum()
    }

    /// Split positions of the members of a cluster, as [`super::records::split_position`] gives them.
    #[inline(always)]
    pub(super) fn split_positions<L: Lanes>(&self, cluster: &Cluster, targets: &[Record]) -> [L; 4] {
        let of: [fn(&Record) -> f32; 4] = [|r| r.bin_x, |r| r.x, |r| r.y, |r| r.z];
        of.map(|f| lanes_of(cluster, targets, f))
    }

    /// r_ab [m] of the members of a cluster and a neighbour, its nearest image in a periodic flume.
    #[inline(always)]
    pub(super) fn difference<L: Lanes>(&self, a: [L; 4], b: &Record) -> [L; 3] {
        let splat = L::splat;
        let x = (a[0] - splat(b.bin_x)).mul_add(splat(self.bin_x), a[1] - splat(b.x));
        let mut y = a[2] - splat(b.y);
        if self.width > 0.0 {
            y = y - splat(self.width) * (y * splat(1.0 / self.width)).round();
        }
        [x, y, a[3] - splat(b.z)]
    }

    /// Vector from b to a, its nearest image in a periodic flume, and its length [m].
    fn distance(&self, a: &Record, b: &Record) -> ([f64; 3], f64) {
        let difference = |a: f32, b: f32| f64::from(a) - f64::from(b);
        let mut r = [
            difference(a.bin_x, b.bin_x) * f64::from(self.bin_x) + difference(a.x, b.x),
            difference(a.y, b.y),
            difference(a.z, b.z),
        ];
        if let Some(width) = self.parameters.periodic_width {
            r[1] -= width * (r[1] / width).round();
        }
        (r, r.iter().map(|r| r * r).sum::<f64>().sqrt())
    }

    /// The pressure term of equation 1 for one target, in double precision so that inner forces cancel [m/s2].
    fn pressure_acceleration(&self, a: &Record, neighbours: &[u32], records: &[Record]) -> [f64; 3] {
        let kernel = &self.parameters.kernel;
        let mut sum = [0.0; 3];
        for &j in neighbours {
            let b = &records[j as usize];
            let (r, distance) = self.distance(a, b);
            let g = kernel.gradient_factor(kernel.closeness(distance));
            let stress = pair_stress(f64::from(a.pressure), f64::from(b.pressure), 0.0) * f64::from(b.volume) * g;
            sum.iter_mut().zip(r).for_each(|(sum, r)| *sum += stress * r);
        }
        let rho_a = self.parameters.tait.rho0 + f64::from(a.excess_density);
        sum.map(|sum| -sum / rho_a)
    }
}

/// The rates of one chunk of targets.
struct ChunkRates<'a> {
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    /// Number of the first target among the records.
    begin: usize,
    targets: &'a [Record],
    records: &'a [Record],
    extra: &'a [Extra],
    rates: &'a mut [Rate],
}

/// Terms that a loop over pairs is compiled for.
trait Terms {
    /// Density diffusion with renormalised gradients.
    const ANTUONO: bool;
    /// Laminar instead of artificial viscosity.
    const LAMINAR: bool;
    /// Sub-particle-scale stress besides.
    const TURBULENT: bool;
    /// Monaghan & Gingold's viscosity instead of artificial viscosity.
    const MONAGHAN_GINGOLD: bool = false;
}

struct MonaghanGingold<const ANTUONO: bool>;

impl<const ANTUONO: bool> Terms for MonaghanGingold<ANTUONO> {
    const ANTUONO: bool = ANTUONO;
    const LAMINAR: bool = false;
    const TURBULENT: bool = false;
    const MONAGHAN_GINGOLD: bool = true;
}

struct Choice<const ANTUONO: bool, const LAMINAR: bool, const TURBULENT: bool>;

impl<const ANTUONO: bool, const LAMINAR: bool, const TURBULENT: bool> Terms for Choice<ANTUONO, LAMINAR, TURBULENT> {
    const ANTUONO: bool = ANTUONO;
    const LAMINAR: bool = LAMINAR;
    const TURBULENT: bool = TURBULENT;
}

impl WithLanes for ChunkRates<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let antuono = self.pairs.parameters.diffusion.kind == DensityDiffusion::Antuono;
        match (antuono, self.pairs.parameters.viscosity) {
            (false, Viscosity::Artificial { .. }) => self.run_terms::<L, Choice<false, false, false>>(),
            (true, Viscosity::Artificial { .. }) => self.run_terms::<L, Choice<true, false, false>>(),
            (false, Viscosity::Laminar { turbulence: None, .. }) => self.run_terms::<L, Choice<false, true, false>>(),
            (true, Viscosity::Laminar { turbulence: None, .. }) => self.run_terms::<L, Choice<true, true, false>>(),
            (false, Viscosity::Laminar { .. }) => self.run_terms::<L, Choice<false, true, true>>(),
            (true, Viscosity::Laminar { .. }) => self.run_terms::<L, Choice<true, true, true>>(),
            (false, Viscosity::MonaghanGingold { .. }) => self.run_terms::<L, MonaghanGingold<false>>(),
            (true, Viscosity::MonaghanGingold { .. }) => self.run_terms::<L, MonaghanGingold<true>>(),
        }
    }
}

impl ChunkRates<'_> {
    #[inline(always)]
    fn run_terms<L: Lanes, T: Terms>(self) {
        for (cluster, neighbours) in self.chunk.clusters() {
            let members = cluster.first as usize..(cluster.first + cluster.len) as usize;
            let sums = if cluster.crosses_sides {
                self.cluster_rates::<L, T, true>(cluster, neighbours)
            } else {
                self.cluster_rates::<L, T, false>(cluster, neighbours)
            };
            self.rates[members].copy_from_slice(&sums[..cluster.len as usize]);
        }
    }

    #[inline(always)]
    fn cluster_rates<L: Lanes, T: Terms, const PERIODIC: bool>(
        &self,
        cluster: &Cluster,
        neighbours: &[u32],
    ) -> [Rate; MOST_LANES] {
        let Self { pairs, targets, records, .. } = self;
        let Parameters { kernel, tait, viscosity, diffusion, .. } = &pairs.parameters;
        let (h, rho0) = (kernel.h as f32, tait.rho0 as f32);
        let (alpha, nu) = match viscosity {
            Viscosity::Artificial { alpha } => (*alpha as f32, 0.0),
            Viscosity::Laminar { nu, .. } | Viscosity::MonaghanGingold { nu } => (0.0, *nu as f32),
        };
        let extra = |k: usize| &self.extra[self.begin + k];
        let extra_a = |f: fn(&Extra) -> f32| {
            L::from_fn(|lane| f(extra(cluster.first as usize + lane.min(cluster.len as usize - 1))))
        };
        let density_gradient_a: [L; 3] = if T::ANTUONO {
            [extra_a(|e| e.density_gradient[0]), extra_a(|e| e.density_gradient[1]), extra_a(|e| e.density_gradient[2])]
        } else {
            [L::splat(0.0); 3]
        };
        let stress_a: [L; 6] = if T::TURBULENT {
            [
                extra_a(|e| e.stress[0]),
                extra_a(|e| e.stress[1]),
                extra_a(|e| e.stress[2]),
                extra_a(|e| e.stress[3]),
                extra_a(|e| e.stress[4]),
                extra_a(|e| e.stress[5]),
            ]
        } else {
            [L::splat(0.0); 6]
        };
        let a = |f: fn(&Record) -> f32| lanes_of::<L, Record>(cluster, targets, f);
        let splat = L::splat;

        let (bin_a, x_a, y_a, z_a) = (a(|r| r.bin_x), a(|r| r.x), a(|r| r.y), a(|r| r.z));
        let (vx_a, vy_a, vz_a) = (a(|r| r.velocity[0]), a(|r| r.velocity[1]), a(|r| r.velocity[2]));
        let (excess_a, p_a, c_a) = (a(|r| r.excess_density), a(|r| r.pressure), a(|r| r.sound_speed));
        let rho_a = splat(rho0) + excess_a;

        let zero = splat(0.0);
        let (mut force_x, mut force_y, mut force_z) = (zero, zero, zero);
        let (mut compressions, mut diffusions, mut fastest) = (zero, zero, zero);
        for &j in neighbours {
            let b = &records[j as usize];
            let x_ab = (bin_a - splat(b.bin_x)).mul_add(splat(pairs.bin_x), x_a - splat(b.x));
            let mut y_ab = y_a - splat(b.y);
            if PERIODIC {
                y_ab = y_ab - splat(pairs.width) * (y_ab * splat(1.0 / pairs.width)).round();
            }
            let z_ab = z_a - splat(b.z);
            let r2 = x_ab.mul_add(x_ab, y_ab.mul_add(y_ab, z_ab * z_ab));
            let closeness = kernel.closeness(r2.sqrt());
            // Constant factors of the sums come at the end.
            let g = kernel.gradient_shape(closeness);
            let gv = g * splat(b.volume);

            let (vx_ab, vy_ab) = (vx_a - splat(b.velocity[0]), vy_a - splat(b.velocity[1]));
            let vz_ab = vz_a - splat(b.velocity[2]);
            let v_dot_r = vx_ab.mul_add(x_ab, vy_ab.mul_add(y_ab, vz_ab * z_ab));
            let excess_b = splat(b.excess_density);
            let rho_b = splat(rho0) + excess_b;

            let approach = approach_rate(h, v_dot_r, r2);
            fastest = fastest.max(approach.abs().where_positive(closeness));
            let viscous = if T::LAMINAR {
                splat(0.0)
            } else if T::MONAGHAN_GINGOLD {
                monaghan_gingold_stress(nu, approach, rho_a, rho_b)
            } else {
                viscous_stress(alpha, h, approach, c_a, splat(b.sound_speed), rho_a, rho_b)
            };
            let stress = pair_stress(p_a, splat(b.pressure), viscous) * gv;
            force_x = stress.mul_add(x_ab, force_x);
            force_y = stress.mul_add(y_ab, force_y);
            force_z = stress.mul_add(z_ab, force_z);
            if T::LAMINAR {
                let shear = laminar_factor(nu, rho_a, rho_b) * gv;
                force_x = force_x - shear * vx_ab;
                force_y = force_y - shear * vy_ab;
                force_z = force_z - shear * vz_ab;
            }
            if T::TURBULENT {
                let stress_b = &self.extra[j as usize].stress;
                let [xx, yy, zz, xy, xz, yz]: [L; 6] = std::array::from_fn(|k| stress_a[k] + splat(stress_b[k]));
                let factor = rho_a * rho_b * gv;
                force_x = force_x - factor * (xx * x_ab + xy * y_ab + xz * z_ab);
                force_y = force_y - factor * (xy * x_ab + yy * y_ab + yz * z_ab);
                force_z = force_z - factor * (xz * x_ab + yz * y_ab + zz * z_ab);
            }
            compressions = add_compression(compressions, rho_b, v_dot_r, gv);
            let diffusive_gv = g * splat(b.diffusive_volume);
            let mut excess = diffusion.excess(excess_a, excess_b, z_ab);
            if T::ANTUONO {
                let extra_b = &self.extra[j as usize];
                let share = splat(0.5 * (1.0 + extra_b.borrowed));
                let slope = |k: usize| share.mul_add(density_gradient_a[k], splat(0.5 * extra_b.density_gradient[k]));
                excess += slope(0).mul_add(x_ab, slope(1).mul_add(y_ab, slope(2) * z_ab));
            }
            diffusions = diffusive_gv.mul_add(excess, diffusions);
        }

        let scale = splat(kernel.gradient_scale());
        let minus_per_mass = -scale / rho_a;
        let [ax, ay, az] = [force_x, force_y, force_z].map(|force| (force * minus_per_mass).to_array());
        let density = (scale * diffusions.mul_add(splat(diffusion.factor()), compressions)).to_array();
        let approach = (splat(h) * fastest).to_array();
        std::array::from_fn(|lane| Rate {
            acceleration: [ax[lane], ay[lane], az[lane]],
            density: density[lane],
            approach: approach[lane],
        })
    }
}

/// The members of a cluster, one a lane; missing ones repeat the last.
#[inline(always)]
pub(super) fn lanes_of<L: Lanes, T>(cluster: &Cluster, targets: &[T], f: impl Fn(&T) -> f32) -> L {
    let members = &targets[cluster.first as usize..][..cluster.len as usize];
    let mut values = [0.0; MOST_LANES];
    values.iter_mut().zip(members).for_each(|(value, member)| *value = f(member));
    let last = values[members.len() - 1];
    values[members.len()..].fill(last);
    L::load(&values)
}
