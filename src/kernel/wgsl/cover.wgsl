// What the solids cover: first how many cells in each row of the box about a ball, then each touch.

@group(0) @binding(BIND_Solids) var<storage, read> solids: array<Solid>;
// Cell and solid fraction (bits) of each touch of solids whose cells are given.
@group(0) @binding(BIND_Given) var<storage, read> given: array<vec2<u32>>;
// Of each row along x: the first cell of it that is touched, and the touches before it of that solid.
@group(0) @binding(BIND_Rows) var<storage, read_write> rows: array<vec2<u32>>;
// Touches of each solid.
@group(0) @binding(BIND_Counts) var<storage, read_write> counts: array<u32>;
// Of each cell a touch of it, 0 for none.
@group(0) @binding(BIND_Slots) var<storage, read_write> slots: array<atomic<u32>>;
// Solid fraction (bits) and solid of each touch.
@group(0) @binding(BIND_Touches) var<storage, read_write> touches: array<vec2<u32>>;
// The touch of the same cell that came before, 0 for none. In which order they come is left to chance;
// resolve.wgsl brings them into that of their numbers.
@group(0) @binding(BIND_Links) var<storage, read_write> links: array<u32>;

// Low corner of the lowest cell against the centre.
fn low_corner(solid: Solid) -> vec3<f32> {
    return solid.offset - 0.5;
}

// The rows of one solid.
@compute @workgroup_size(64)
fn measure(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= SOLIDS) {
        return;
    }
    let solid = solids[number];
    if (solid.radius == 0.0) {
        counts[number] = solid.side;
        return;
    }
    let low = low_corner(solid);
    var count = 0u;
    for (var row = 0u; row < solid.side * solid.side; row++) {
        let yz = low.yz + vec2<f32>(f32(row % solid.side), f32(row / solid.side));
        let near = max(max(yz, -(yz + 1.0)), vec2<f32>(0.0));
        let square = solid.radius * solid.radius - dot(near, near);
        var first = 0u;
        var cells = 0u;
        if (square > 0.0) {
            let half = sqrt(square);
            let last = u32(clamp(half - low.x, 0.0, f32(solid.side - 1u)));
            first = u32(clamp(-half - low.x, 0.0, f32(last)));
            cells = last + 1u - first;
        }
        rows[solid.rows + row] = vec2<u32>(first, count);
        count += cells;
    }
    counts[number] = count;
}

// The cell at unbounded coordinates, wrapped round periodic axes; none outside the box.
fn locate(at: vec3<i32>) -> vec2<u32> {
    let cells = vec3<i32>(i32(NX), i32(NY), i32(NZ));
    let wrapped = (at % cells + cells) % cells;
    let inside = select(at, wrapped, vec3<bool>(PERIODIC_X, PERIODIC_Y, PERIODIC_Z));
    if (any(inside < vec3<i32>(0)) || any(inside >= cells)) {
        return vec2<u32>(0u, 0u);
    }
    let c = vec3<u32>(inside);
    return vec2<u32>(c.x + NX * (c.y + NY * c.z), 1u);
}

// The touches of one solid: workgroup y of PARTS does its share of them.
@compute @workgroup_size(64)
fn touch(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.x + group.z * 65535u;
    if (number >= SOLIDS) {
        return;
    }
    let solid = solids[number];
    let count = counts[number];
    for (var i = lane + 64u * group.y; i < count; i += 64u * PARTS) {
        var cell = vec2<u32>(0u, 0u);
        var arm = vec3<f32>(0.0);
        var fraction = 0.0;
        if (solid.radius == 0.0) {
            let known = given[solid.rows + i];
            cell = vec2<u32>(known.x, 1u);
            fraction = bitcast<f32>(known.y);
            let at = vec3<i32>(coordinates(known.x));
            arm = solid.offset + vec3<f32>(at - solid.base);
        } else {
            // The last row that starts at touch i or before.
            var row = 0u;
            var end = solid.side * solid.side;
            while (end - row > 1u) {
                let middle = (row + end) / 2u;
                if (rows[solid.rows + middle].y <= i) {
                    row = middle;
                } else {
                    end = middle;
                }
            }
            let start = rows[solid.rows + row];
            let step = vec3<u32>(start.x + i - start.y, row % solid.side, row / solid.side);
            cell = locate(solid.base + vec3<i32>(step));
            arm = solid.offset + vec3<f32>(step);
            let low = low_corner(solid) + vec3<f32>(step);
//#if SAMPLED
            fraction = sampled_fraction(low, solid.radius);
//#end
//#if LINEAR
            fraction = linear_fraction(low, solid.radius);
//#end
//#if EXACT
            fraction = solid_fraction(low, solid.radius);
//#end
        }
        let name = solid.first + i;
        var before = 0u;
        var place = 0u;
        if (cell.y == 1u && fraction > 0.0) {
            before = atomicExchange(&slots[cell.x], name);
            place = cell.x + 1u;
        }
        touches[name] = vec2<u32>(bitcast<u32>(fraction), number);
        links[name] = before;
        keep_shares(name, vec4<u32>(place, bitcast<vec3<u32>>(arm)));
    }
}
