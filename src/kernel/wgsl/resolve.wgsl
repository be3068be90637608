// What each covered cell is made of, from the touches of its solids.

@group(0) @binding(BIND_Solids) var<storage, read> solids: array<Solid>;
@group(0) @binding(BIND_Counts) var<storage, read> counts: array<u32>;
@group(0) @binding(BIND_Slots) var<storage, read_write> slots: array<u32>;
@group(0) @binding(BIND_Touches) var<storage, read> touches: array<vec2<u32>>;
// The touch of the same cell that came before; from here on the record of the cell.
@group(0) @binding(BIND_Links) var<storage, read_write> links: array<u32>;
// B_s of each touch.
@group(0) @binding(BIND_Weights) var<storage, read_write> weights: array<f32>;
// Of cells in which solids meet: what Σ B_s u_s u_s is above that of one solid with the mean velocity.
@group(0) @binding(BIND_Excess) var<storage, read_write> excess: array<vec4<f32>>;
// How many cells one solid touches, and how many several do; and their lists.
@group(0) @binding(BIND_Found) var<storage, read_write> found: array<atomic<u32>, 2>;
@group(0) @binding(BIND_Alone) var<storage, read_write> single: array<u32>;
@group(0) @binding(BIND_Meetings) var<storage, read_write> shared_by_many: array<u32>;

// The weight B of a cell in which the solid fractions add up to `sum`.
fn weight_of(sum: f32) -> f32 {
    let epsilon = min(sum, 1.0);
//#if FRACTION
    return epsilon;
//#else
    // A quotient may be 2.5 units in the last place off (WGSL, accuracy of division), also that of equal numbers.
    // In a full cell nothing but bounce-back acts on the rest population: 1 - B = 1e-7 would let it relax all the same.
    if (epsilon == 1.0) {
        return 1.0;
    }
//#if GRADED
    // B = k ε / [(1 - ε) + k ε]
    let solid = epsilon * GRADED_DRAG;
    return solid / (1.0 - epsilon + solid);
//#else
    // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)]
    return epsilon * EXCESS / (1.0 - epsilon + EXCESS);
//#end
//#end
}

// Cells that were covered are covered no more.
@compute @workgroup_size(64)
fn uncover(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.x + group.z * 65535u;
    if (number >= SOLIDS) {
        return;
    }
    let first = solids[number].first;
    let count = counts[number];
    for (var i = lane + 64u * group.y; i < count; i += 64u * PARTS) {
        let place = shares_at(first + i).x;
        if (place > 0u) {
            slots[place - 1u] = 0u;
        }
    }
}

@compute @workgroup_size(64)
fn resolve(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.x + group.z * 65535u;
    if (number >= SOLIDS) {
        return;
    }
    let velocity = solids[number].velocity;
    let spin = solids[number].spin;
    let first = solids[number].first;
    let count = counts[number];
    for (var i = lane + 64u * group.y; i < count; i += 64u * PARTS) {
        let name = first + i;
        let share = shares_at(name);
        if (share.x == 0u) {
            weights[name] = 0.0;
            links[name] = 0u;
        } else if (slots[share.x - 1u] == name) {
            if (links[name] == 0u) {
                // A cell of one solid.
                let b = weight_of(bitcast<f32>(touches[name].x));
                let u = velocity + cross(spin, bitcast<vec3<f32>>(share.yzw));
                weights[name] = b;
                links[name] = name;
                keep_records(name, bitcast<vec4<u32>>(vec4<f32>(b, b * u)));
                // Only where the step of all cells has no solids in it is the list used.
//#if LISTED
                single[atomicAdd(&found[0], 1u)] = share.x - 1u;
//#end
            } else {
                meeting(name, share.x - 1u);
            }
        }
    }
}

// u_s = U + ω × r of a touch.
fn velocity_of(name: u32) -> vec3<f32> {
    let solid = touches[name].y;
    let arm = bitcast<vec3<f32>>(shares_at(name).yzw);
    return solids[solid].velocity + cross(solids[solid].spin, arm);
}

// A cell of several, of which touch `head` came last. They are added up in the order of their numbers.
fn meeting(head: u32, cell: u32) {
    var epsilon = 0.0;
    var velocity = vec3<f32>(0.0);
    var square = vec3<f32>(0.0);
    var mixed = vec3<f32>(0.0);
    var last = 0u;
    loop {
        // The lowest number above the last.
        var next = 0xffffffffu;
        for (var name = head; name > 0u; name = links[name]) {
            if (name > last && name < next) {
                next = name;
            }
        }
        if (next == 0xffffffffu) {
            break;
        }
        last = next;
        let part = bitcast<f32>(touches[last].x);
        let u = velocity_of(last);
        epsilon += part;
        velocity += part * u;
        square += part * u * u;
        mixed += part * u * u.yzx;
    }
    let b = weight_of(epsilon);
    let factor = b / epsilon;
    let mean = velocity / epsilon;
    keep_records(head, bitcast<vec4<u32>>(vec4<f32>(b, factor * velocity)));
    let row = atomicAdd(&found[1], 1u);
    shared_by_many[row] = cell;
    excess[2u * row] = vec4<f32>(factor * (square - velocity * mean), 0.0);
    excess[2u * row + 1u] = vec4<f32>(factor * (mixed - velocity * mean.yzx), 0.0);
    var name = head;
    loop {
        let before = links[name];
        weights[name] = factor * bitcast<f32>(touches[name].x);
        links[name] = head;
        if (before == 0u) {
            break;
        }
        name = before;
    }
}
