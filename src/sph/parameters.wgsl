// Constants of the scheme (parameters.rs), and code that all shaders use.

struct Parameters {
    // Number of bins along x, y, z.
    count: vec3<i32>,
    // Number of water particles; in `records` the boundary particles follow the water.
    water: u32,
    // Size of a bin [m].
    size: vec3<f32>,
    // Number of boundary particles.
    boundary: u32,
    // Width of a periodic domain [m].
    width: f32,
    // Smoothing length h [m].
    h: f32,
    // 1 / (2 h) [1/m].
    inv_2h: f32,
    // Constant factor alpha_D of the kernel W [1/m3].
    kernel_scale: f32,
    // Constant factor of G, where grad_a W_ab = G r_ab (kernel.rs): -5 alpha_D / h^2 [1/m5].
    gradient_scale: f32,
    // Reference density rho0 [kg/m3].
    rho0: f32,
    // Coefficient alpha of the artificial viscosity, equation 3 [-].
    alpha: f32,
    // Factor of the density diffusion, equation 4: -2 delta h c0 [m2/s].
    diffusion: f32,
    // Factor A of rho_ab^H = A z_ab (1 - B z_ab), equation 5: rho0 g / c0^2 [kg/m4]; zero to diffuse the total density.
    hydrostatic: f32,
    // Factor B of the same formula: (gamma - 1) g / (2 c0^2) [1/m].
    curvature: f32,
    // Gravitational acceleration g [m/s2].
    gravity: f32,
    // Vertical density gradient at hydrostatic pressure, -rho0 g / c0^2 [kg/m4]; mDBC extrapolates densities with it.
    density_slope: f32,
    // Coefficient beta of the quadratic part of the artificial viscosity [-].
    beta: f32,
    longest_way: f32,
    // Between these limits, the trust in a fitted gradient changes: limits of the distance from a ghost node to the
    // centroid of the water around it [h], and of the spread of this water [h2] (mdbc.rs).
    centroid_limits: vec2<f32>,
    spread_limits: vec2<f32>,
    // Smallest determinant, divided by (sum of W V)^4, for which mDBC fits a gradient [-].
    least_determinant: f32,
    // A ghost node is dry if its sum of W V is below this value [-].
    dry: f32,
    // Corners of the box in which all particles must stay, relative to the low corner of the grid [m].
    bounds_low: vec3<f32>,
    padding_low: f32,
    bounds_high: vec3<f32>,
    padding_high: f32,
    // Coefficients of two binomial series in (rho - rho0) / rho0: pressure, powers 1 to 8 [Pa]; speed of sound, powers
    // 0 to 7 [m/s].
    pressure: array<vec4<f32>, 2>,
    sound: array<vec4<f32>, 2>,
}

// Values that change every time step.
struct Step {
    // Time step [s].
    dt: f32,
    // Kernel support plus the distance that a particle can have moved since sorting [m].
    reach: f32,
}

// Data of a particle that its neighbours need (records.rs).
struct Record {
    // Index of the bin along x; then x from the low end of this bin, and y and z from the middle of the grid [m].
    place: vec4<f32>,
    // Velocity [m/s] and volume [m3].
    motion: vec4<f32>,
    // rho - rho0 [kg/m3], pressure [Pa], speed of sound [m/s], kind of particle: WATER, WALL, or UNIT + k for unit k.
    state: vec4<f32>,
}

// True if the flume is periodic across its width. This is a compile-time constant because, with branches on uniform
// values, Mesa's software driver compiles a shader again at every dispatch and never frees the compiled shader.
override PERIODIC: bool = false;

const WATER = 0.0;
const WALL = 1.0;
const UNIT = 2.0;

@group(0) @binding(0) var<uniform> parameters: Parameters;

// Returns the index of a thread in a one- or two-dimensional dispatch of workgroups of 64 threads.
fn thread_number(group: vec3<u32>, groups: vec3<u32>, local: u32) -> u32 {
    return (group.y * groups.x + group.x) * 64u + local;
}

// Returns the bin index of a cell; cells outside the grid belong to the nearest bin.
fn bin_of_cell(cell: vec3<i32>) -> u32 {
    let c = clamp(cell, vec3<i32>(0), parameters.count - 1);
    return u32((c.z * parameters.count.y + c.y) * parameters.count.x + c.x);
}

// Returns a position in the form of Record.place, from a bin index (`cell`) and the offset in this bin [m].
fn split(cell: vec3<i32>, offset: vec3<f32>) -> vec4<f32> {
    let across = (vec2<f32>(cell.yz) - 0.5 * vec2<f32>(parameters.count.yz)) * parameters.size.yz + offset.yz;
    return vec4<f32>(f32(cell.x), offset.x, across);
}
