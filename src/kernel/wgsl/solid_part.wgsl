// What the solids are in a cell. B is the weight of all solids together, B_s
// that of one.

struct SolidPart {
    // B = Σ_s B_s
    weight: f32,
//#if MOVING
    // Σ_s B_s u_s, the solids' velocity at the cell
    velocity_x: f32,
    velocity_y: f32,
    velocity_z: f32,
    // Σ_s B_s u_s,i u_s,i
    square_x: f32,
    square_y: f32,
    square_z: f32,
    // Σ_s B_s u_s,i u_s,j
    mixed_xy: f32,
    mixed_yz: f32,
    mixed_xz: f32,
//#end
}

//#if SLOTS
// Per cell the number of its record, or 0.
//#if MOVING
@group(0) @binding(BIND_Slots) var<storage, read> slots: array<u32>;

fn slot_of(x: u32, y: u32, z: u32) -> u32 {
    return slots[x + NX * (y + NY * z)];
}
//#else
//#if TEXTURES
@group(0) @binding(BIND_Slots) var slots: texture_storage_3d<r32uint, read>;

fn slot_of(x: u32, y: u32, z: u32) -> u32 {
    return textureLoad(slots, vec3<u32>(x, y, z)).x;
}
//#else
@group(0) @binding(BIND_Slots) var<storage, read> slots: array<u32>;

fn slot_of(x: u32, y: u32, z: u32) -> u32 {
    return slots[x + STEP_Y * y + STEP_Z * z];
}
//#end
//#end
//#end

//#if MOVING
//#if MANY
// Of the first listed cells, in which several solids meet: what Σ B_s u_s u_s is above that of one solid
// with the mean velocity (xx, yy, zz, 0), (xy, yz, xz, 0).
@group(0) @binding(BIND_Excess) var<storage, read> excess: array<vec4<f32>>;
//#end

fn solid_part(x: u32, y: u32, z: u32) -> SolidPart {
    // (B, Σ B_s u_s); record number 0 is that of a cell without solids.
    let record = bitcast<vec4<f32>>(records_at(slot_of(x, y, z)));
    let b = record.x;
    let u = record.yzw;
    // ū = Σ B_s u_s / B
    let mean = u / max(b, 1e-30);
    return SolidPart(
        b, u.x, u.y, u.z,
        u.x * mean.x, u.y * mean.y, u.z * mean.z,
        u.x * mean.y, u.y * mean.z, u.x * mean.z,
    );
}

//#if MANY
// The same of the listed cell of that number.
fn solid_part_of_listed(number: u32, x: u32, y: u32, z: u32) -> SolidPart {
    var part = solid_part(x, y, z);
    if (task.is_listed == 1u && number < task.many) {
        let square = excess[2u * number];
        let mixed = excess[2u * number + 1u];
        part.square_x += square.x;
        part.square_y += square.y;
        part.square_z += square.z;
        part.mixed_xy += mixed.x;
        part.mixed_yz += mixed.y;
        part.mixed_xz += mixed.z;
    }
    return part;
}
//#end
//#else
// B of each cell.
//#if TEXTURES
@group(0) @binding(BIND_CellWeights) var weights: texture_storage_3d<r32float, read>;

fn solid_part(x: u32, y: u32, z: u32) -> SolidPart {
    return SolidPart(textureLoad(weights, vec3<u32>(x, y, z)).x);
}
//#else
@group(0) @binding(BIND_CellWeights) var<storage, read> weights: array<f32>;

fn solid_part(x: u32, y: u32, z: u32) -> SolidPart {
    return SolidPart(weights[x + STEP_Y * y + STEP_Z * z]);
}
//#end
//#end
