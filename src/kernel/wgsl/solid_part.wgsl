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

//#if MOVING
fn part_of(b: f32, x: f32, y: f32, z: f32) -> SolidPart {
    // ū = Σ B_s u_s / B
    let over = 1.0 / max(b, f32(1e-30));
    let mean_y = y * over;
    let mean_z = z * over;
    return SolidPart(b, x, y, z, x * x * over, y * mean_y, z * mean_z, x * mean_y, y * mean_z, x * mean_z);
}

// Per cell the number of its record, or 0.
//#if TEXTURES
@group(0) @binding(40) var slots: texture_storage_3d<r32uint, read>;
//#else
@group(0) @binding(40) var<storage, read> slots: array<u32>;
//#end
// (B, Σ B_s u_s) of each record; number 0 is that of a cell without solids.
@group(0) @binding(41) var<storage, read> records: array<vec4<f32>>;
//#if MANY
// Of the first records, cells in which several solids meet: what Σ B_s u_s u_s is above that of one
// solid with the mean velocity (xx, yy, zz, 0), (xy, yz, xz, 0).
@group(0) @binding(42) var<storage, read> excess: array<vec4<f32>>;
//#end

fn solid_part(x: u32, y: u32, z: u32) -> SolidPart {
//#if TEXTURES
    let slot = textureLoad(slots, vec3<u32>(x, y, z)).x;
//#else
    let slot = slots[x + STEP_Y * y + STEP_Z * z];
//#end
    var record = vec4<f32>(0.0);
    if (slot > 0u) {
        record = records[slot];
    }
    var part = part_of(record.x, record.y, record.z, record.w);
//#if MANY
    if (slot > 0u && slot <= task.many) {
        let square = excess[2u * slot - 2u];
        let mixed = excess[2u * slot - 1u];
        part.square_x += square.x;
        part.square_y += square.y;
        part.square_z += square.z;
        part.mixed_xy += mixed.x;
        part.mixed_yz += mixed.y;
        part.mixed_xz += mixed.z;
    }
//#end
    return part;
}
//#else
// B of each cell.
//#if TEXTURES
@group(0) @binding(40) var weights: texture_storage_3d<r32float, read>;
//#else
@group(0) @binding(40) var<storage, read> weights: array<f32>;
//#end

fn solid_part(x: u32, y: u32, z: u32) -> SolidPart {
//#if TEXTURES
    return SolidPart(textureLoad(weights, vec3<u32>(x, y, z)).x);
//#else
    return SolidPart(weights[x + STEP_Y * y + STEP_Z * z]);
//#end
}
//#end
