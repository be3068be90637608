// Sums over the touches of solids (the parts of cells that they cover): what each adds, `terms` says.
//
// PARTS workgroups take the touches of a solid in turn, each invocation one after another, and then a tree. The order
// of the sums depends on nothing but where the solid is, so that two runs give the same bits.

// B_s of each touch
@group(0) @binding(BIND_Weights) var<storage, read> weights: array<f32>;
@group(0) @binding(BIND_Solids) var<storage, read> solids: array<Solid>;
// Touches of each solid
@group(0) @binding(BIND_Counts) var<storage, read> counts: array<u32>;
// Of each solid that is asked for, part by part
@group(0) @binding(SUMS) var<storage, read_write> sums: array<array<vec4<f32>, COLUMNS>>;

var<workgroup> lanes: array<array<vec4<f32>, COLUMNS>, LANES>;

@compute @workgroup_size(LANES)
fn gather(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let row = group.x + group.z * 65535u;
    let is_asked = row < asked();
    var mine = array<vec4<f32>, COLUMNS>();
    if (is_asked) {
        let solid = solid_of(row);
        let motion = solids[solid];
        for (var i = lane + LANES * group.y; i < counts[solid]; i += LANES * PARTS) {
            var more = terms(motion, motion.first + i);
            for (var c = 0u; c < COLUMNS; c++) {
                mine[c] += more[c];
            }
        }
    }
    lanes[lane] = mine;
    workgroupBarrier();
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        if (lane < half) {
            for (var c = 0u; c < COLUMNS; c++) {
                lanes[lane][c] += lanes[lane + half][c];
            }
        }
        workgroupBarrier();
    }
    if (is_asked && lane == 0u) {
        sums[PARTS * row + group.y] = lanes[0];
    }
}
