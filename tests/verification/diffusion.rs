//! Which water density diffusion acts on.

use breakwater::sph::particles::boundary::{Boundary, BoundaryParticle};
use breakwater::sph::{
    parameters::BoundaryCondition,
    terms::density_diffusion::{DensityDiffusion, Diffusion},
};
use glam::DVec3;

use super::blocks::{DP, JITTER, block, ideal, rates_beside, whole_axes};
use super::tanks::RHO0;

/// Level of a wall of one layer of particles, a particle distance below the block [m].
const WALL: f64 = -10.5 * DP;

/// Rates of density of a block whose density varies, above the wall, with the place of each particle.
fn density_rates(boundary: BoundaryCondition, diffusion: DensityDiffusion) -> Vec<(DVec3, f32)> {
    let density = |p: DVec3| RHO0 + (p / DP).map(f64::sin).element_sum();
    let wall: Vec<BoundaryParticle> = (0..400)
        .map(|i| BoundaryParticle {
            position: DVec3::new(DP * (f64::from(i % 20) - 9.5), DP * (f64::from(i / 20) - 9.5), WALL),
            to_surface: DVec3::new(0.0, 0.0, 0.5 * DP),
            volume: DP.powi(3),
            allows_free_slip: false,
        })
        .collect();
    let mut parameters = ideal(DP, None);
    parameters.boundary = boundary;
    parameters.diffusion = Diffusion::new(diffusion, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
    let (water, rates) = rates_beside(
        parameters,
        block(JITTER, density, |_| DVec3::ZERO),
        Boundary::new(&wall, &[], &[], 0, RHO0),
        [DVec3::splat(-0.15), DVec3::splat(0.15)],
    );
    water.position.into_iter().zip(rates.iter().map(|rate| rate.density)).collect()
}

/// Shares of the particles in and out of the wall's reach on which diffusion acts.
fn diffused(boundary: BoundaryCondition) -> [f64; 2] {
    let with = density_rates(boundary, DensityDiffusion::MolteniColagrossi);
    let without = density_rates(boundary, DensityDiffusion::None);
    let support = ideal(DP, None).kernel.support();
    let share = |here: &dyn Fn(f64) -> bool| {
        let pairs = || with.iter().zip(&without).filter(|((p, _), _)| here(p.z - WALL));
        pairs().filter(|((_, a), (_, b))| a != b).count() as f64 / pairs().count() as f64
    };
    // Half a particle distance either side of the wall's reach is left out: there the jitter decides.
    [share(&|height| height < support - 0.5 * DP), share(&|height| height > support + 0.5 * DP)]
}

#[test]
fn walls_of_the_dynamic_condition_and_the_water_they_reach_are_left_out_of_diffusion() {
    assert_eq!(diffused(BoundaryCondition::Dynamic), [0.0, 1.0]);
}

#[test]
fn all_water_diffuses_beside_walls_of_the_modified_condition() {
    assert_eq!(diffused(BoundaryCondition::ModifiedDynamic), [1.0, 1.0]);
}

/// Largest rate of density of a jittered block without walls, whose density has a slope and ripples [kg/(m3 s)]. Edges
/// and corners are left out: neighbourhoods of less than a quarter are not renormalised.
fn largest_rate(diffusion: DensityDiffusion, slope: f64, ripple: f64) -> f64 {
    let wave = DVec3::new(0.4, 0.3, 0.5) / DP;
    let density = |p: DVec3| RHO0 + slope * p.dot(DVec3::new(1.0, -2.0, 3.0)) + ripple * p.dot(wave).sin();
    let mut parameters = ideal(DP, None);
    parameters.diffusion = Diffusion::new(diffusion, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
    let (water, rates) = rates_beside(
        parameters,
        block(JITTER, density, |_| DVec3::ZERO),
        Boundary::new(&[], &[], &[], 0, RHO0),
        [DVec3::splat(-0.15), DVec3::splat(0.15)],
    );
    let away = water.position.iter().zip(&rates).filter(|(p, _)| whole_axes(**p) >= 2);
    away.map(|(_, rate)| f64::from(rate.density.abs())).fold(0.0, f64::max)
}

/// Renormalised gradients explain a linear field everywhere, at the free surface too, where the diffusion of the whole
/// density carries water from the dense side to the other.
#[test]
fn the_diffusion_of_antuono_leaves_a_linear_density_alone() {
    let [whole, rest] = [DensityDiffusion::MolteniColagrossi, DensityDiffusion::Antuono]
        .map(|diffusion| largest_rate(diffusion, 20.0, 0.0));
    println!("slope alone: {whole:.2e} of the whole density, {rest:.2e} after Antuono et al.");
    // 1.5e-6 was reached: single precision, some 280 neighbours.
    assert!(rest < 1e-5 * whole);
    let ripples = largest_rate(DensityDiffusion::Antuono, 0.0, 1.0);
    println!("ripples: {ripples:.2e}");
    // Not because it does nothing: of waves of nine particle distances the gradients explain a part.
    assert!(ripples > 0.1 * largest_rate(DensityDiffusion::MolteniColagrossi, 0.0, 1.0));
}
