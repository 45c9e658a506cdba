//! The physical terms: one equation per file, written once for scalars and SIMD lanes.
//!
//! | file | equation |
//! | --- | --- |
//! | [`kernel`] | quintic Wendland kernel |
//! | [`momentum`] | 1: momentum |
//! | [`continuity`] | 2: continuity |
//! | [`viscosity`] | 3: artificial viscosity; laminar viscosity |
//! | [`turbulence`] | sub-particle-scale stress |
//! | [`density_diffusion`] | 4 and 5: density diffusion |
//! | [`equation_of_state`] | 6: Tait |
//! | [`acoustic_damping`] | damping of sound |
//! | [`wall_slip`] | velocity of boundary particles in the equations of the water |
//! | [`shifting`] | particle shifting |
//! | [`porous`] | flow through porous media |
//!
//! Symbols: a is the particle for which a term is computed, b one of its neighbours. r is the position, v the velocity,
//! m the mass, rho the density, V = m / rho the volume, p the pressure, c the speed of sound and g the gravitational
//! acceleration. Differences are r_ab = r_a - r_b, v_ab = v_a - v_b and rho_ba = rho_b - rho_a. W_ab is the kernel at
//! the distance |r_ab|, grad_a W_ab its gradient with respect to r_a, and h the smoothing length. rho0 is the reference
//! density, c0 the speed of sound at rho0 and gamma the exponent of the equation of state.

pub mod acoustic_damping;
pub mod continuity;
pub mod density_diffusion;
pub mod equation_of_state;
pub mod kernel;
pub mod momentum;
pub mod porous;
pub mod shifting;
pub mod turbulence;
pub mod viscosity;
pub mod wall_slip;
