// What the solids are in one cell. B is the weight of all solids together, B_s that of one.

struct SolidPart {
    // B = Σ_s B_s
    weight: f32,
//#if MOVING
    // Σ_s B_s u_s, the solids' velocity at the cell
    velocity: vec3<f32>,
    // Σ_s B_s u_s,i u_s,i
    square: vec3<f32>,
    // Σ_s B_s u_s,i u_s,j (xy, yz, xz)
    mixed: vec3<f32>,
//#end
}

//#if MOVING
// Per cell the number of its record, 0 where there is no solid.
@group(0) @binding(40) var<storage, read> slots: array<u32>;
// (B, Σ B_s u_s) of each record.
@group(0) @binding(41) var<storage, read> records: array<vec4<f32>>;
//#if MANY
// Of the first records, cells in which several solids meet: what Σ B_s u_s u_s is above that of one
// solid with the mean velocity (xx, yy, zz, 0), (xy, yz, xz, 0).
@group(0) @binding(42) var<storage, read> excess: array<vec4<f32>>;
//#end

fn solid_part(cell: u32) -> SolidPart {
    let slot = slots[cell];
    let record = records[slot];
    // ū = Σ B_s u_s / B
    let mean = record.yzw / max(record.x, 1e-30);
    var part = SolidPart(record.x, record.yzw, record.yzw * mean, record.yzy * mean.yzz);
//#if MANY
    if (slot > 0u && slot <= task.many) {
        part.square += excess[2u * slot - 2u].xyz;
        part.mixed += excess[2u * slot - 1u].xyz;
    }
//#end
    return part;
}
//#else
// B of each cell.
@group(0) @binding(40) var<storage, read> weights: array<f32>;

fn solid_part(cell: u32) -> SolidPart {
    return SolidPart(weights[cell]);
}
//#end
