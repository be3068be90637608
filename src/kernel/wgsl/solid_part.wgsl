// What the solids are in a cell, or in four cells at once. B is the weight of all solids together, B_s
// that of one.

struct SolidPart {
    // B = Σ_s B_s
    weight: real,
//#if MOVING
    // Σ_s B_s u_s, the solids' velocity at the cell
    velocity_x: real,
    velocity_y: real,
    velocity_z: real,
    // Σ_s B_s u_s,i u_s,i
    square_x: real,
    square_y: real,
    square_z: real,
    // Σ_s B_s u_s,i u_s,j
    mixed_xy: real,
    mixed_yz: real,
    mixed_xz: real,
//#end
}

//#if MOVING
fn part_of(b: real, x: real, y: real, z: real) -> SolidPart {
    // ū = Σ B_s u_s / B
    let over = 1.0 / max(b, real(1e-30));
    let mean_y = y * over;
    let mean_z = z * over;
    return SolidPart(b, x, y, z, x * x * over, y * mean_y, z * mean_z, x * mean_y, y * mean_z, x * mean_z);
}

//#if WIDE
// Per cell the number of its record.
@group(0) @binding(40) var<storage, read> slots: array<quad>;
// (B, Σ B_s u_s) of each record; the first, number 0, is that of a cell without solids.
@group(0) @binding(41) var<storage, read> records: array<quad>;

fn solid_part(vector: u32) -> SolidPart {
    let slot = bitcast<vec4<u32>>(unpacked(slots[vector]));
    let a = unpacked(records[slot.x]);
    let b = unpacked(records[slot.y]);
    let c = unpacked(records[slot.z]);
    let d = unpacked(records[slot.w]);
    return part_of(
        vec4<f32>(a.x, b.x, c.x, d.x),
        vec4<f32>(a.y, b.y, c.y, d.y),
        vec4<f32>(a.z, b.z, c.z, d.z),
        vec4<f32>(a.w, b.w, c.w, d.w),
    );
}
//#else
// Per cell the number of its record.
@group(0) @binding(40) var<storage, read> slots: array<u32>;
// (B, Σ B_s u_s) of each record; the first, number 0, is that of a cell without solids.
@group(0) @binding(41) var<storage, read> records: array<vec4<f32>>;
//#if MANY
// Of the first records, cells in which several solids meet: what Σ B_s u_s u_s is above that of one
// solid with the mean velocity (xx, yy, zz, 0), (xy, yz, xz, 0).
@group(0) @binding(42) var<storage, read> excess: array<vec4<f32>>;
//#end

fn solid_part(place: u32) -> SolidPart {
    let slot = slots[place];
    let record = records[slot];
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
//#end
//#else
// B of each cell.
//#if WIDE
@group(0) @binding(40) var<storage, read> weights: array<quad>;

fn solid_part(vector: u32) -> SolidPart {
    return SolidPart(unpacked(weights[vector]));
}
//#else
@group(0) @binding(40) var<storage, read> weights: array<f32>;

fn solid_part(place: u32) -> SolidPart {
    return SolidPart(weights[place]);
}
//#end
//#end
