// Stable counting sort of points into bins (grid.rs): count the points of each bin, compute where each bin starts
// (prefix sum), write the points to their bins, then sort the points of each bin by index.

struct Sort {
    points: u32,
    bins: u32,
    // Number of blocks into which the bins are divided; a block has SCANNED bins.
    blocks: u32,
}

// Number of bins for which a workgroup of 256 threads computes the prefix sum.
const SCANNED = 1024u;

@group(0) @binding(1) var<uniform> sort: Sort;
@group(0) @binding(2) var<storage, read> cells: array<vec4<i32>>;
@group(0) @binding(3) var<storage, read_write> counts: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> start: array<u32>;
@group(0) @binding(5) var<storage, read_write> block_sums: array<u32>;
@group(0) @binding(6) var<storage, read_write> bin_of: array<u32>;
@group(0) @binding(7) var<storage, read_write> scattered: array<u32>;
@group(0) @binding(8) var<storage, read_write> order: array<u32>;

var<workgroup> partial: array<u32, 256>;

@compute @workgroup_size(64)
fn count(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
         @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= sort.points {
        return;
    }
    let bin = bin_of_cell(cells[i].xyz);
    bin_of[i] = bin;
    atomicAdd(&counts[bin], 1u);
}

// Returns the sum of the values of all lower threads of the workgroup. Then partial[255] is the sum of all values.
fn scan_group(local: u32, value: u32) -> u32 {
    partial[local] = value;
    workgroupBarrier();
    for (var step = 1u; step < 256u; step *= 2u) {
        var before = 0u;
        if local >= step {
            before = partial[local - step];
        }
        workgroupBarrier();
        partial[local] += before;
        workgroupBarrier();
    }
    return partial[local] - value;
}

@compute @workgroup_size(256)
fn scan_blocks(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
               @builtin(local_invocation_index) local: u32) {
    let block = group.y * groups.x + group.x;
    let first = block * SCANNED + local * 4u;
    var values = array<u32, 4>();
    var sum = 0u;
    for (var k = 0u; k < 4u; k++) {
        if first + k < sort.bins {
            values[k] = atomicLoad(&counts[first + k]);
        }
        sum += values[k];
    }
    var before = scan_group(local, sum);
    for (var k = 0u; k < 4u; k++) {
        if first + k < sort.bins {
            start[first + k] = before;
        }
        before += values[k];
    }
    if local == 255u && block < sort.blocks {
        block_sums[block] = partial[255];
    }
}

@compute @workgroup_size(256)
fn scan_sums(@builtin(local_invocation_index) local: u32) {
    var carried = 0u;
    for (var first = 0u; first < sort.blocks; first += 256u) {
        let block = first + local;
        var value = 0u;
        if block < sort.blocks {
            value = block_sums[block];
        }
        let before = scan_group(local, value);
        if block < sort.blocks {
            block_sums[block] = carried + before;
        }
        carried += partial[255];
        workgroupBarrier();
    }
}

@compute @workgroup_size(64)
fn add_sums(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
            @builtin(local_invocation_index) local: u32) {
    let bin = thread_number(group, groups, local);
    if bin > sort.bins {
        return;
    }
    if bin == sort.bins {
        start[bin] = sort.points;
        return;
    }
    start[bin] += block_sums[bin / SCANNED];
    // From here on, `counts` has the number of points already scattered into each bin.
    atomicStore(&counts[bin], 0u);
}

@compute @workgroup_size(64)
fn scatter(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= sort.points {
        return;
    }
    let bin = bin_of[i];
    scattered[start[bin] + atomicAdd(&counts[bin], 1u)] = i;
}

@compute @workgroup_size(64)
fn rank(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
        @builtin(local_invocation_index) local: u32) {
    let place = thread_number(group, groups, local);
    if place >= sort.points {
        return;
    }
    let i = scattered[place];
    let bin = bin_of[i];
    var before = 0u;
    for (var other = start[bin]; other < start[bin + 1u]; other++) {
        before += select(0u, 1u, scattered[other] < i);
    }
    order[start[bin] + before] = i;
}
