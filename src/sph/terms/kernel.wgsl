// Quintic Wendland kernel (kernel.rs).

// Returns 1 - q/2 [-]; zero outside the support.
fn closeness_of(r: f32) -> f32 {
    return max(1.0 - r * parameters.inv_2h, 0.0);
}

// Returns W without its constant factor alpha_D.
fn kernel_shape(closeness: f32) -> f32 {
    let square = closeness * closeness;
    return square * square * (5.0 - 4.0 * closeness);
}

// Returns G without its constant factor -5 alpha_D / h^2.
fn gradient_shape(closeness: f32) -> f32 {
    return closeness * closeness * closeness;
}
