//! Sums of equations 1 and 2 over the neighbours of a cluster, one member per lane.

use super::{gradients::NeighbourData, rate::Rate};
use crate::sph::lanes::{Lanes, MAX_LANES};
use crate::sph::neighbours::lists::{Cluster, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::Parameters;
use crate::sph::terms::continuity::add_compression;
use crate::sph::terms::density_diffusion::Diffusion;
use crate::sph::terms::kernel::Wendland;
use crate::sph::terms::momentum::pair_stress;
use crate::sph::terms::viscosity::{Viscosity, approach_rate, laminar_factor, monaghan_gingold_stress, viscous_stress};

/// Viscosity model. The pair loop is compiled once for each model.
pub(super) trait Resistance {
    /// True if the model includes a sub-particle-scale stress.
    const TURBULENT: bool = false;

    /// Returns rho_a rho_b Pi_ab [Pa], if the viscous force acts along the line between the particles; zero if not.
    #[inline(always)]
    fn stress<L: Lanes>(_: &Constants, _approach: L, _a: &Members<L>, _b: &Record, _rho_b: L) -> L {
        L::splat(0.0)
    }

    /// Returns the factor of v_ab [Pa s] (see [`laminar_factor`]), if the viscous force acts along the velocity
    /// difference v_ab; `None` if not.
    #[inline(always)]
    fn shear<L: Lanes>(_: &Constants, _rho_a: L, _rho_b: L) -> Option<L> {
        None
    }
}

/// Artificial viscosity, equation 3.
pub(super) struct Artificial;

impl Resistance for Artificial {
    #[inline(always)]
    fn stress<L: Lanes>(constants: &Constants, approach: L, a: &Members<L>, b: &Record, rho_b: L) -> L {
        let &Constants { artificial, h, .. } = constants;
        viscous_stress(artificial, h, approach, a.sound_speed, L::splat(b.sound_speed), a.density, rho_b)
    }
}

/// Laminar viscosity of Monaghan & Gingold (1983).
pub(super) struct MonaghanGingold;

impl Resistance for MonaghanGingold {
    #[inline(always)]
    fn stress<L: Lanes>(constants: &Constants, approach: L, a: &Members<L>, _: &Record, rho_b: L) -> L {
        monaghan_gingold_stress(constants.nu, approach, a.density, rho_b)
    }
}

/// Laminar viscosity of Lo & Shao (2002).
pub(super) struct Laminar;

impl Resistance for Laminar {
    #[inline(always)]
    fn shear<L: Lanes>(constants: &Constants, rho_a: L, rho_b: L) -> Option<L> {
        Some(laminar_factor(constants.nu, rho_a, rho_b))
    }
}

/// Laminar viscosity of Lo & Shao (2002) with sub-particle-scale turbulence.
pub(super) struct Turbulent;

impl Resistance for Turbulent {
    const TURBULENT: bool = true;

    #[inline(always)]
    fn shear<L: Lanes>(constants: &Constants, rho_a: L, rho_b: L) -> Option<L> {
        Laminar::shear(constants, rho_a, rho_b)
    }
}

/// No viscosity: for pairs of a water particle and a particle of an inviscid wall or of a unit.
pub(super) struct Inviscid;

impl Resistance for Inviscid {}

/// Constants of the sums, in single precision.
pub(super) struct Constants {
    kernel: Wendland,
    diffusion: Diffusion,
    h: f32,
    rho0: f32,
    /// Coefficients alpha and beta of the artificial viscosity [-].
    artificial: [f32; 2],
    /// Kinematic viscosity nu of the laminar viscosity; in Monaghan & Gingold's form K nu with K = 2 (D + 2) in D
    /// dimensions [m2/s].
    nu: f32,
}

/// State of the members of a cluster (the particles a of the equations), one member per lane.
pub(super) struct Members<L> {
    velocity: [L; 3],
    excess_density: L,
    density: L,
    pressure: L,
    sound_speed: L,
    /// 1 for members on which the density diffusion acts, 0 for other members.
    pub(super) diffuses: L,
    density_gradient: [L; 3],
    stress: [L; 6],
}

/// Position of a neighbour b relative to the members.
pub(super) struct Near<L> {
    /// r_ab [m].
    r: [L; 3],
    /// r_ab^2 [m2].
    r2: L,
    /// Closeness 1 - q/2 with q = |r_ab| / h [-].
    pub(super) closeness: L,
}

/// Sums over the neighbours of each member, without constant factors. [`Sums::rates`] applies these factors.
pub(super) struct Sums<L> {
    /// Pressure force, and viscous force along the lines between the particles.
    force: [L; 3],
    /// Laminar force along v_ab, and turbulent force. They are small compared with the pressure force and would lose
    /// precision in the same sum.
    shear: [L; 3],
    compression: L,
    diffusion: L,
    fastest: L,
}

impl Constants {
    pub(super) fn new(parameters: &Parameters) -> Self {
        let Parameters { kernel, diffusion, tait, viscosity, .. } = *parameters;
        let (artificial, nu) = match viscosity {
            Viscosity::Artificial { alpha, beta } => ([alpha, beta], 0.0),
            Viscosity::Laminar { nu, .. } => ([0.0; 2], nu),
            Viscosity::MonaghanGingold { nu } => ([0.0; 2], 2.0 * (f64::from(kernel.dimensions()) + 2.0) * nu),
        };
        let (h, rho0) = (kernel.h as f32, tait.rho0 as f32);
        Self { kernel, diffusion, h, rho0, artificial: artificial.map(|c| c as f32), nu: nu as f32 }
    }

    /// Returns the relative position of a neighbour from r_ab [m].
    #[inline(always)]
    pub(super) fn near<L: Lanes>(&self, r: [L; 3]) -> Near<L> {
        let r2 = r[0].mul_add(r[0], r[1].mul_add(r[1], r[2] * r[2]));
        Near { r, r2, closeness: self.kernel.closeness(r2.sqrt()) }
    }
}

impl<L: Lanes> Members<L> {
    /// Creates the members of `cluster` from the records `targets` and, if the scheme needs them, from the additional
    /// `data` of the targets.
    #[inline(always)]
    pub(super) fn new<R: Resistance, const ANTUONO: bool>(
        constants: &Constants,
        cluster: &Cluster,
        targets: &[Record],
        data: &[NeighbourData],
    ) -> Self {
        let a = |f: fn(&Record) -> f32| lanes_of::<L, Record>(cluster, targets, f);
        let excess_density = a(|r| r.excess_density);
        let nothing = L::splat(0.0);
        let mut members = Self {
            velocity: [a(|r| r.velocity[0]), a(|r| r.velocity[1]), a(|r| r.velocity[2])],
            excess_density,
            density: L::splat(constants.rho0) + excess_density,
            pressure: a(|r| r.pressure),
            sound_speed: a(|r| r.sound_speed),
            diffuses: L::splat(1.0),
            density_gradient: [nothing; 3],
            stress: [nothing; 6],
        };
        if ANTUONO {
            members.density_gradient =
                std::array::from_fn(|k| lanes_of(cluster, data, |e: &NeighbourData| e.density_gradient[k]));
        }
        if R::TURBULENT {
            members.stress = std::array::from_fn(|k| lanes_of(cluster, data, |e: &NeighbourData| e.stress[k]));
        }
        members
    }
}

impl<L: Lanes> Sums<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self { force: [zero; 3], shear: [zero; 3], compression: zero, diffusion: zero, fastest: zero }
    }

    /// Adds the contribution of a neighbour with the relative position `near`, the record `b` and the data `data_b`.
    #[inline(always)]
    pub(super) fn add<R: Resistance, const ANTUONO: bool>(
        &mut self,
        constants: &Constants,
        a: &Members<L>,
        near: &Near<L>,
        b: &Record,
        data_b: &NeighbourData,
    ) {
        let &Constants { kernel, diffusion, h, rho0, .. } = constants;
        let splat = L::splat;
        let [x, y, z] = near.r;
        let g = kernel.gradient_shape(near.closeness);
        let gv = g * splat(b.volume);
        let v = [
            a.velocity[0] - splat(b.velocity[0]),
            a.velocity[1] - splat(b.velocity[1]),
            a.velocity[2] - splat(b.velocity[2]),
        ];
        let v_dot_r = v[0].mul_add(x, v[1].mul_add(y, v[2] * z));
        let excess_b = splat(b.excess_density);
        let rho_b = splat(rho0) + excess_b;

        let approach = approach_rate(h, v_dot_r, near.r2);
        self.fastest = self.fastest.max(approach.abs().where_positive(near.closeness));
        let viscous = R::stress(constants, approach, a, b, rho_b);
        add_to(&mut self.force, pair_stress(a.pressure, splat(b.pressure), viscous) * gv, near.r);
        if let Some(shear) = R::shear(constants, a.density, rho_b) {
            add_to(&mut self.shear, -shear * gv, v);
        }
        if R::TURBULENT {
            let factor = a.density * rho_b * gv;
            let total = |k: usize| a.stress[k] + splat(data_b.stress[k]);
            let (xx, yy, zz, xy, xz, yz) = (total(0), total(1), total(2), total(3), total(4), total(5));
            let along = [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z];
            add_to(&mut self.shear, -factor, along);
        }
        self.compression = add_compression(self.compression, rho_b, v_dot_r, gv);
        let mut excess = diffusion.excess(a.excess_density, excess_b, z);
        if ANTUONO {
            excess += explained_by_gradients(a, near, data_b);
        }
        self.diffusion = (g * splat(b.diffusive_volume)).mul_add(excess, self.diffusion);
    }

    /// Adds the sums over other neighbours of the same members.
    #[inline(always)]
    pub(super) fn add_sums(&mut self, other: &Self) {
        for k in 0..3 {
            self.force[k] += other.force[k];
            self.shear[k] += other.shear[k];
        }
        self.compression += other.compression;
        self.diffusion += other.diffusion;
        self.fastest = self.fastest.max(other.fastest);
    }

    /// Returns the rates of the members.
    #[inline(always)]
    pub(super) fn rates(&self, constants: &Constants, a: &Members<L>) -> [Rate; MAX_LANES] {
        let scale = L::splat(constants.kernel.gradient_scale());
        let minus_per_mass = -scale / a.density;
        let acceleration = |k: usize| (self.force[k] + self.shear[k]) * minus_per_mass;
        let (ax, ay, az) = (acceleration(0).to_array(), acceleration(1).to_array(), acceleration(2).to_array());
        let diffusion_factor = L::splat(constants.diffusion.factor()) * a.diffuses;
        let density = (scale * self.diffusion.mul_add(diffusion_factor, self.compression)).to_array();
        let compression = (scale * self.compression).to_array();
        let approach = (L::splat(constants.h) * self.fastest).to_array();
        std::array::from_fn(|lane| Rate {
            acceleration: [ax[lane], ay[lane], az[lane]],
            density: density[lane],
            compression: compression[lane],
            approach: approach[lane],
        })
    }
}

/// Returns (grad rho_a + grad rho_b) . r_ab / 2 [kg/m3]. The sum of rho_b - rho_a and this value is the part of the
/// density difference that the gradients do not explain (Antuono et al. 2010).
#[inline(always)]
fn explained_by_gradients<L: Lanes>(a: &Members<L>, near: &Near<L>, b: &NeighbourData) -> L {
    let share = L::splat(0.5 * (1.0 + b.uses_target_gradient));
    let slope = |k: usize| share.mul_add(a.density_gradient[k], L::splat(0.5 * b.density_gradient[k]));
    let [x, y, z] = near.r;
    slope(0).mul_add(x, slope(1).mul_add(y, slope(2) * z))
}

/// Adds `factor` times a vector to `sum`.
#[inline(always)]
pub(super) fn add_to<L: Lanes>(sum: &mut [L; 3], factor: L, vector: [L; 3]) {
    *sum = [factor.mul_add(vector[0], sum[0]), factor.mul_add(vector[1], sum[1]), factor.mul_add(vector[2], sum[2])];
}
