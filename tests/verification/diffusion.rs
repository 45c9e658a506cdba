//! On which particles density diffusion acts, and how it changes a linear density field.

use breakwater::sph::particles::boundary::{Boundary, BoundaryParticle};
use breakwater::sph::{
    parameters::BoundaryCondition,
    terms::{
        density_diffusion::{DensityDiffusion, Diffusion},
        wall_slip::Mirroring,
    },
};
use glam::DVec3;

use super::blocks::{DP, JITTER, block, ideal, rates_beside, whole_axes};
use super::tanks::RHO0;

/// z of a wall [m]: one layer of particles, one particle spacing below the lowest layer of the block.
const WALL: f64 = -10.5 * DP;

/// Returns position and density rate of each particle in a block of varying density above the wall.
fn density_rates(boundary: BoundaryCondition, diffusion: DensityDiffusion) -> Vec<(DVec3, f32)> {
    let density = |p: DVec3| RHO0 + (p / DP).map(f64::sin).element_sum();
    let wall: Vec<BoundaryParticle> = (0..400)
        .map(|i| BoundaryParticle {
            position: DVec3::new(DP * (f64::from(i % 20) - 9.5), DP * (f64::from(i / 20) - 9.5), WALL),
            to_surface: DVec3::new(0.0, 0.0, 0.5 * DP),
            volume: DP.powi(3),
            mirroring: Mirroring::Normal,
        })
        .collect();
    let mut parameters = ideal(DP, None);
    parameters.boundary = boundary;
    parameters.diffusion = Diffusion::new(diffusion, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
    let (water, rates) = rates_beside(
        parameters,
        block(JITTER, density, |_| DVec3::ZERO),
        Boundary::new(&wall, &[], &[], RHO0),
        [DVec3::splat(-0.15), DVec3::splat(0.15)],
    );
    water.position.into_iter().zip(rates.iter().map(|rate| rate.density)).collect()
}

/// Returns the share of particles on which diffusion acts [-]: first within the kernel support of the wall particles,
/// then beyond.
fn diffused(boundary: BoundaryCondition) -> [f64; 2] {
    let with_diffusion = density_rates(boundary, DensityDiffusion::MolteniColagrossi);
    let without_diffusion = density_rates(boundary, DensityDiffusion::None);
    let support = ideal(DP, None).kernel.support();
    let share_where = |is_included: &dyn Fn(f64) -> bool| {
        let pairs = || with_diffusion.iter().zip(&without_diffusion).filter(|((p, _), _)| is_included(p.z - WALL));
        pairs().filter(|((_, a), (_, b))| a != b).count() as f64 / pairs().count() as f64
    };
    // Particles within half a particle spacing of the limit of the support are excluded, because there the jitter
    // decides if a wall particle is in their support.
    [share_where(&|height| height < support - 0.5 * DP), share_where(&|height| height > support + 0.5 * DP)]
}

#[test]
fn water_within_reach_of_dynamic_walls_does_not_diffuse() {
    assert_eq!(diffused(BoundaryCondition::Dynamic), [0.0, 1.0]);
}

#[test]
fn all_water_near_modified_dynamic_walls_diffuses() {
    assert_eq!(diffused(BoundaryCondition::ModifiedDynamic), [1.0, 1.0]);
}

/// Returns the largest density rate of a jittered block whose density has a slope and ripples [kg/(m3 s)]. Edges and
/// corners are excluded: gradients are not renormalised if less than a quarter of the neighbourhood is filled.
fn largest_rate(diffusion: DensityDiffusion, slope: f64, ripple: f64) -> f64 {
    let wave = DVec3::new(0.4, 0.3, 0.5) / DP;
    let density = |p: DVec3| RHO0 + slope * p.dot(DVec3::new(1.0, -2.0, 3.0)) + ripple * p.dot(wave).sin();
    let mut parameters = ideal(DP, None);
    parameters.diffusion = Diffusion::new(diffusion, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
    let (water, rates) = rates_beside(
        parameters,
        block(JITTER, density, |_| DVec3::ZERO),
        Boundary::new(&[], &[], &[], RHO0),
        [DVec3::splat(-0.15), DVec3::splat(0.15)],
    );
    let not_at_edges = water.position.iter().zip(&rates).filter(|(p, _)| whole_axes(**p) >= 2);
    not_at_edges.map(|(_, rate)| f64::from(rate.density.abs())).fold(0.0, f64::max)
}

/// Renormalised gradients are exact for a linear field, also at the free surface. The diffusion of Molteni &
/// Colagrossi, which acts on the whole density difference, transports mass from the denser side to the less dense side.
#[test]
fn diffusion_of_antuono_does_not_change_a_linear_density() {
    let [whole, rest] = [DensityDiffusion::MolteniColagrossi, DensityDiffusion::Antuono]
        .map(|diffusion| largest_rate(diffusion, 20.0, 0.0));
    println!("linear density: rate {whole:.2e} with Molteni & Colagrossi, {rest:.2e} with Antuono et al.");
    // Reached ratio: 1.5e-6, the rounding of single precision summed over some 280 neighbours.
    assert!(rest < 1e-5 * whole);
    let ripples = largest_rate(DensityDiffusion::Antuono, 0.0, 1.0);
    println!("ripples: rate {ripples:.2e} with Antuono et al.");
    // The diffusion does act on ripples: the gradients describe only part of the density differences in a wave that is
    // nine particle spacings long.
    assert!(ripples > 0.1 * largest_rate(DensityDiffusion::MolteniColagrossi, 0.0, 1.0));
}
