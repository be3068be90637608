// Sums and extremes over the box: each invocation goes through every STRANDS-th cell and leaves its
// part; the parts are put together in double precision by the caller, always in the same order.

struct Part {
    // Σ (ρ - 1)
    density: f32,
    // Σ (j + j*)/2, the momentum before and after the next collision
    flux_x: f32,
    flux_y: f32,
    flux_z: f32,
    // Largest |j|²/ρ² and |j + G/2|²/ρ²
    bare_speed2: f32,
    speed2: f32,
    // First broken cell, or 0xffffffff
    broken: u32,
    spare: u32,
}

@group(0) @binding(BIND_Seen) var<storage, read_write> parts: array<Part>;

// Not NaN and not infinite, by the bits: compilers may take for granted that there is neither.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(64)
fn summary(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= STRANDS) {
        return;
    }
    var part = Part(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0xffffffffu, 0u);
    for (var cell = id.x; cell < task.count; cell += STRANDS) {
        let at = coordinates(cell);
        let h = observed(at);
        let drho = sum(h);
        let j = momentum(h);
        let rho = 1.0 + drho;
        let u = j / rho;
        let bare2 = dot(u, u);
        part.density += drho;
//#if FORCE
        let full = (j + 0.5 * drive.force) / rho;
        let speed2 = dot(full, full);
        var gain = drive.force;
//#else
        let speed2 = bare2;
        var gain = vec3<f32>(0.0);
//#end
//#if SOLIDS
        // j* = j + (1 - B) G + GAIN Σ B_s (ρ u_s - j)
        let solid = solid_part(at.x, at.y, at.z);
        gain = (1.0 - solid.weight) * gain - GAIN * solid.weight * j;
//#if MOVING
        gain += GAIN * rho * vec3<f32>(solid.velocity_x, solid.velocity_y, solid.velocity_z);
//#end
//#end
        let flux = j + 0.5 * gain;
        part.flux_x += flux.x;
        part.flux_y += flux.y;
        part.flux_z += flux.z;
        part.bare_speed2 = max(part.bare_speed2, bare2);
        part.speed2 = max(part.speed2, speed2);
        let is_sound = is_finite(drho) && is_finite(bare2) && rho > 0.0 && bare2 <= MAX_SPEED2;
        if (!is_sound && cell < part.broken) {
            part.broken = cell;
        }
    }
    parts[id.x] = part;
}
