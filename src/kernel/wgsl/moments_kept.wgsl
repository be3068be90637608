// Momentum j and density ρ - 1 of each covered cell before its collision, from which gather.wgsl works out
// what the solids receive.

fn keep_moments_of(x: u32, y: u32, z: u32, h: array<f32, 19>) {
    let slot = slot_of(x, y, z);
    if (slot > 0u) {
        keep_moments(slot, bitcast<vec4<u32>>(vec4<f32>(momentum(h), sum(h))));
    }
}
