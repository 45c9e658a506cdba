// Quintic Wendland kernel (kernel.rs).

// Returns the closeness 1 - q/2 [-] with q = r/h, for the distance r [m]; zero outside the support.
fn closeness_of(r: f32) -> f32 {
    return max(1.0 - r * parameters.inv_2h, 0.0);
}

// Returns the kernel W without its constant factor alpha_D.
fn kernel_shape(closeness: f32) -> f32 {
    let square = closeness * closeness;
    return square * square * (5.0 - 4.0 * closeness);
}

// Returns G without its constant factor -5 alpha_D / h^2; grad_a W_ab = G r_ab with r_ab = r_a - r_b.
fn gradient_shape(closeness: f32) -> f32 {
    return closeness * closeness * closeness;
}
