// What drives the fluid in a step (driven.rs).

struct Drive {
    // Body force per volume.
    force: vec3<f32>,
    // Velocity and density less 1 of each face: -x, +x, -y, ...
    faces: array<vec4<f32>, 6>,
}

@group(0) @binding(BIND_Drive) var<uniform> drive: Drive;

