// Test programs with which card.rs measures the peak arithmetic speed and the memory bandwidth of a graphics card.

@group(0) @binding(0) var<storage, read_write> a: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> b: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> c: array<vec4<f32>>;

const ROUNDS = 1024u;

// Computes four independent chains of multiply-adds on vectors of four numbers; each thread does 2 x 16 x ROUNDS
// operations.
@compute @workgroup_size(64)
fn multiply_and_add(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
                    @builtin(local_invocation_index) local: u32) {
    let i = (group.y * groups.x + group.x) * 64u + local;
    let factor = b[i];
    let summand = c[i];
    var chains = array<vec4<f32>, 4>(factor, summand, factor + summand, factor - summand);
    for (var round = 0u; round < ROUNDS; round++) {
        chains[0] = fma(chains[0], factor, summand);
        chains[1] = fma(chains[1], factor, summand);
        chains[2] = fma(chains[2], factor, summand);
        chains[3] = fma(chains[3], factor, summand);
    }
    a[i] = chains[0] + chains[1] + chains[2] + chains[3];
}

// Computes a = b + c / 2: reads two arrays and writes one array.
@compute @workgroup_size(64)
fn triad(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
         @builtin(local_invocation_index) local: u32) {
    let i = (group.y * groups.x + group.x) * 64u + local;
    a[i] = b[i] + 0.5 * c[i];
}
