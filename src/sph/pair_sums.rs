//! The sums of equations 1 and 2 over the neighbours of a cluster, one member a lane.

use super::{
    continuity::add_compression,
    density_diffusion::Diffusion,
    gradients::Extra,
    kernel::Wendland,
    lanes::{Lanes, MOST_LANES},
    momentum::pair_stress,
    neighbours::Cluster,
    parameters::Parameters,
    rates::{Rate, lanes_of},
    records::Record,
    viscosity::{Viscosity, approach_rate, laminar_factor, viscous_stress},
};

/// Terms that a loop over pairs is compiled for.
pub(super) trait Terms {
    /// Density diffusion with renormalised gradients.
    const ANTUONO: bool;
    /// Laminar instead of artificial viscosity.
    const LAMINAR: bool;
    /// Sub-particle-scale stress besides.
    const TURBULENT: bool;
}

/// Constants of the sums in single precision.
pub(super) struct Constants {
    kernel: Wendland,
    diffusion: Diffusion,
    h: f32,
    rho0: f32,
    /// alpha of the artificial viscosity [-].
    alpha: f32,
    /// nu of the laminar viscosity [m2/s].
    nu: f32,
}

/// The members of a cluster, the targets "a" of the equations.
pub(super) struct Members<L> {
    velocity: [L; 3],
    excess_density: L,
    density: L,
    pressure: L,
    sound_speed: L,
    density_gradient: [L; 3],
    stress: [L; 6],
}

/// A neighbour "b" seen from the members.
pub(super) struct Near<L> {
    /// r_ab [m].
    r: [L; 3],
    /// r_ab^2 [m2].
    r2: L,
    /// 1 - q/2 [-].
    closeness: L,
}

/// Sums of the members, without the constant factors, which come at the end.
pub(super) struct Sums<L> {
    force: [L; 3],
    compression: L,
    diffusion: L,
    fastest: L,
}

impl Constants {
    pub(super) fn new(parameters: &Parameters) -> Self {
        let Parameters { kernel, diffusion, tait, viscosity, .. } = *parameters;
        let (alpha, nu) = match viscosity {
            Viscosity::Artificial { alpha } => (alpha, 0.0),
            Viscosity::Laminar { nu, .. } => (0.0, nu),
        };
        let (h, rho0) = (kernel.h as f32, tait.rho0 as f32);
        Self { kernel, diffusion, h, rho0, alpha: alpha as f32, nu: nu as f32 }
    }

    /// Where a neighbour at r_ab [m] is.
    #[inline(always)]
    pub(super) fn near<L: Lanes>(&self, r: [L; 3]) -> Near<L> {
        let r2 = r[0].mul_add(r[0], r[1].mul_add(r[1], r[2] * r[2]));
        Near { r, r2, closeness: self.kernel.closeness(r2.sqrt()) }
    }
}

impl<L: Lanes> Members<L> {
    /// The members of `cluster` among the `targets`; `extra` are theirs, for schemes that have them.
    #[inline(always)]
    pub(super) fn new<T: Terms>(constants: &Constants, cluster: &Cluster, targets: &[Record], extra: &[Extra]) -> Self {
        let a = |f: fn(&Record) -> f32| lanes_of::<L, Record>(cluster, targets, f);
        let excess_density = a(|r| r.excess_density);
        let nothing = L::splat(0.0);
        let mut members = Self {
            velocity: [a(|r| r.velocity[0]), a(|r| r.velocity[1]), a(|r| r.velocity[2])],
            excess_density,
            density: L::splat(constants.rho0) + excess_density,
            pressure: a(|r| r.pressure),
            sound_speed: a(|r| r.sound_speed),
            density_gradient: [nothing; 3],
            stress: [nothing; 6],
        };
        if T::ANTUONO {
            members.density_gradient =
                std::array::from_fn(|k| lanes_of(cluster, extra, |e: &Extra| e.density_gradient[k]));
        }
        if T::TURBULENT {
            members.stress = std::array::from_fn(|k| lanes_of(cluster, extra, |e: &Extra| e.stress[k]));
        }
        members
    }
}

impl<L: Lanes> Sums<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self { force: [zero; 3], compression: zero, diffusion: zero, fastest: zero }
    }

    /// Add a neighbour `near`, whose record is `b`.
    #[inline(always)]
    pub(super) fn add<T: Terms>(
        &mut self,
        constants: &Constants,
        a: &Members<L>,
        near: &Near<L>,
        b: &Record,
        extra_b: &Extra,
    ) {
        let &Constants { kernel, diffusion, h, rho0, alpha, nu } = constants;
        let splat = L::splat;
        let [x, y, z] = near.r;
        let g = kernel.gradient_shape(near.closeness);
        let gv = g * splat(b.volume);
        let v: [L; 3] = std::array::from_fn(|k| a.velocity[k] - splat(b.velocity[k]));
        let v_dot_r = v[0].mul_add(x, v[1].mul_add(y, v[2] * z));
        let excess_b = splat(b.excess_density);
        let rho_b = splat(rho0) + excess_b;

        let approach = approach_rate(h, v_dot_r, near.r2);
        self.fastest = self.fastest.max(approach.abs().where_positive(near.closeness));
        let viscous = if T::LAMINAR {
            splat(0.0)
        } else {
            viscous_stress(alpha, h, approach, a.sound_speed, splat(b.sound_speed), a.density, rho_b)
        };
        let stress = pair_stress(a.pressure, splat(b.pressure), viscous) * gv;
        self.add_force(stress, near.r);
        if T::LAMINAR {
            let shear = laminar_factor(nu, a.density, rho_b) * gv;
            self.add_force(-shear, v);
        }
        if T::TURBULENT {
            let factor = a.density * rho_b * gv;
            let [xx, yy, zz, xy, xz, yz]: [L; 6] = std::array::from_fn(|k| a.stress[k] + splat(extra_b.stress[k]));
            let along = [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z];
            self.add_force(-factor, along);
        }
        self.compression = add_compression(self.compression, rho_b, v_dot_r, gv);
        let mut excess = diffusion.excess(a.excess_density, excess_b, z);
        if T::ANTUONO {
            excess += explained_by_gradients(a, near, extra_b);
        }
        self.diffusion = (g * splat(b.diffusive_volume)).mul_add(excess, self.diffusion);
    }

    /// Add `factor` times a vector to -rho_a dv_a/dt.
    #[inline(always)]
    fn add_force(&mut self, factor: L, vector: [L; 3]) {
        for (sum, component) in self.force.iter_mut().zip(vector) {
            *sum = factor.mul_add(component, *sum);
        }
    }

    /// The rates of the members.
    #[inline(always)]
    pub(super) fn rates(&self, constants: &Constants, a: &Members<L>) -> [Rate; MOST_LANES] {
        let scale = L::splat(constants.kernel.gradient_scale());
        let minus_per_mass = -scale / a.density;
        let [ax, ay, az] = self.force.map(|force| (force * minus_per_mass).to_array());
        let diffusion_factor = L::splat(constants.diffusion.factor());
        let density = (scale * self.diffusion.mul_add(diffusion_factor, self.compression)).to_array();
        let approach = (L::splat(constants.h) * self.fastest).to_array();
        std::array::from_fn(|lane| Rate {
            acceleration: [ax[lane], ay[lane], az[lane]],
            density: density[lane],
            approach: approach[lane],
        })
    }
}

/// (grad rho_a + grad rho_b) . r_ab / 2, which the diffusion of Antuono et al. (2010) leaves alone [kg/m3].
#[inline(always)]
fn explained_by_gradients<L: Lanes>(a: &Members<L>, near: &Near<L>, b: &Extra) -> L {
    let share = L::splat(0.5 * (1.0 + b.borrowed));
    let slope = |k: usize| share.mul_add(a.density_gradient[k], L::splat(0.5 * b.density_gradient[k]));
    let [x, y, z] = near.r;
    slope(0).mul_add(x, slope(1).mul_add(y, slope(2) * z))
}
