// Solid fractions of listed balls, given by the cell's low corner against their centre, and their radius.

@group(0) @binding(BIND_Balls) var<storage, read> balls: array<vec4<f32>>;
@group(0) @binding(BIND_Seen) var<storage, read_write> fractions_found: array<f32>;

@compute @workgroup_size(64)
fn fractions(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < COUNT) {
        fractions_found[id.x] = solid_fraction(balls[id.x].xyz, balls[id.x].w);
    }
}
