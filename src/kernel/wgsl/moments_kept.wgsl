// Momentum j and density ρ - 1 of each covered cell before its collision, from which gather.wgsl works out
// what the solids receive; by records.
@group(0) @binding(BIND_Moments) var<storage, read_write> moments: array<vec4<f32>>;

fn keep_moments_of(x: u32, y: u32, z: u32, h: array<f32, 19>) {
    let slot = slot_of(x, y, z);
    if (slot > 0u) {
        moments[slot] = vec4<f32>(momentum(h), sum(h));
    }
}
