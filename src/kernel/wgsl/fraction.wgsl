// Solid fraction of a sphere in a cell, in single precision, without functions of poor accuracy.
//
// The volume that a ball shares with a box is an integral along x of the area that a disc shares with a
// rectangle. That area is a strip, a trapezoid and a segment of the disc, each of the size of the cell: no
// large numbers are subtracted, so that the error stays near 1e-6 however large the ball. The integral is
// split where the disc passes a corner of the rectangle.

// The s > 0 with s (2 p + s) = e: how far it is from p to where the square has grown by e.
fn reach(p: f32, e: f32) -> f32 {
    if (e <= 0.0) {
        return 0.0;
    }
    return e / (p + sqrt(p * p + e));
}

// Area of a disc about the origin in the rectangle from (y, z) to (y, z) + size, none of them negative;
// power: squared radius less y² + z².
fn disc_in_rectangle(power: f32, y: f32, z: f32, size: vec2<f32>) -> f32 {
    // From y to `full` the disc reaches over the whole height, from there to `end` over a part of it.
    let full = min(reach(y, power - size.y * (2.0 * z + size.y)), size.x);
    let end = min(reach(y, power), size.x);
    let high = min(reach(z, power - full * (2.0 * y + full)), size.y);
    let low = min(reach(z, power - end * (2.0 * y + end)), size.y);
    let width = end - full;
    let fall = high - low;
    // Segment over the chord between: R² (θ - sin θ)/2, with q = sin(θ/2). It is twice that of θ/2 and a
    // triangle; asin q - q √(1 - q²) = Σ 2 (2n)!/(n! 2^n)² q^(2n+3)/(2n+3), and sin(θ/4) is at most 0.39.
    let squared_radius = y * y + z * z + max(power, 0.0);
    let q2 = clamp((width * width + fall * fall) / max(4.0 * squared_radius, 1e-30), 0.0, 1.0);
    let q = sqrt(q2);
    let c = sqrt(1.0 - q2);
    let half = q / sqrt(2.0 * (1.0 + c));
    let h2 = half * half;
    let series = 0.6666667 + h2 * (0.2 + h2 * (0.10714286 + h2 * (0.069444444
        + h2 * (0.049715909 + h2 * (0.037860577 + h2 * 0.030078125)))));
    let segment = squared_radius * (q * q2 / (1.0 + c) + 2.0 * series * half * h2);
    return full * size.y + 0.5 * width * (high + low) + segment;
}

// Volume that a ball of radius r about the origin shares with the box from `corner` to corner + size,
// none of them negative.
fn ball_in_box(corner: vec3<f32>, size: vec3<f32>, r: f32) -> f32 {
    let power = r * r - dot(corner, corner);
    let beside = size.y * (2.0 * corner.y + size.y);
    let above = size.z * (2.0 * corner.z + size.z);
    // Along x, where the disc shrinks below the far corner, the two beside it, the near one.
    var splits = min(vec4<f32>(
        reach(corner.x, power - beside - above),
        reach(corner.x, power - max(beside, above)),
        reach(corner.x, power - min(beside, above)),
        reach(corner.x, power),
    ), vec4<f32>(size.x));
    var volume = splits.x * size.y * size.z;
    // Empty slabs between the splits to the end, so that neighbours have their other ones at the same time.
    if (splits.x == splits.y) {
        splits = splits.yzww;
    }
    if (splits.x == splits.y) {
        splits = splits.yzww;
    }
    if (splits.y == splits.z) {
        splits = splits.xyww;
    }
    while (splits.x < splits.w) {
        let length = splits.y - splits.x;
        // Gauss's rule of six points for s in x = end - length s²: below a split the area may end like
        // (end - x)^(3/2), which is smooth in s. Its weights times 2 s.
        let end = splits.y;
        volume += length * (0.005784813 * area(end - length * 0.0011400916, power, corner, size)
            + 0.061111317 * area(end - length * 0.0286947700, power, corner, size)
            + 0.178130346 * area(end - length * 0.1449251860, power, corner, size)
            + 0.289783588 * area(end - length * 0.3835443720, power, corner, size)
            + 0.299650256 * area(end - length * 0.6899041564, power, corner, size)
            + 0.165539679 * area(end - length * 0.9336096058, power, corner, size));
        splits = splits.yzww;
    }
    return volume;
}

// Area of the section of both at `x` from the corner.
fn area(x: f32, power: f32, corner: vec3<f32>, size: vec3<f32>) -> f32 {
    return disc_in_rectangle(power - x * (2.0 * corner.x + x), corner.y, corner.z, size.yz);
}

// Solid fraction, 0 to 1, of the cell from `low` to low + 1 in a ball of radius r about the origin.
fn solid_fraction(low: vec3<f32>, r: f32) -> f32 {
    let high = low + 1.0;
    let near = max(max(low, -high), vec3<f32>(0.0));
    let far = max(abs(low), abs(high));
    if (dot(near, near) >= r * r) {
        return 0.0;
    }
    if (dot(far, far) <= r * r) {
        return 1.0;
    }
    // Along x the surface should change least: the axes by their distance from the centre.
    var l = low;
    if (abs(l.x + 0.5) > abs(l.y + 0.5)) {
        l = l.yxz;
    }
    if (abs(l.y + 0.5) > abs(l.z + 0.5)) {
        l = l.xzy;
    }
    if (abs(l.x + 0.5) > abs(l.y + 0.5)) {
        l = l.yxz;
    }
    let h = l + 1.0;
    // Planes through the centre cut the cell into up to eight parts, each mirrored to the positive side.
    let positive_size = select(max(h, vec3<f32>(0.0)), vec3<f32>(1.0), l >= vec3<f32>(0.0));
    let negative_size = select(max(-l, vec3<f32>(0.0)), vec3<f32>(1.0), h <= vec3<f32>(0.0));
    // Most cells have one. Counted so, neighbours on different sides of the ball do theirs at the same time.
    let has_positive = select(vec3<u32>(0u), vec3<u32>(1u), positive_size > vec3<f32>(0.0));
    let has_negative = select(vec3<u32>(0u), vec3<u32>(1u), negative_size > vec3<f32>(0.0));
    let kinds = has_positive + has_negative;
    let parts = kinds.x * kinds.y * kinds.z;
    var volume = 0.0;
    for (var part = 0u; part < parts; part++) {
        let which = vec3<u32>(part, part / kinds.x, part / (kinds.x * kinds.y)) % kinds;
        let mirrored = which >= has_positive;
        let size = select(positive_size, negative_size, mirrored);
        let corner = max(select(l, -h, mirrored), vec3<f32>(0.0));
        volume += ball_in_box(corner, size, r);
    }
    return clamp(volume, 0.0, 1.0);
}

// The share of SAMPLES³ points of the cell, the midpoints of its parts, that lie in the ball.
fn sampled_fraction(low: vec3<f32>, r: f32) -> f32 {
    var inside = 0u;
    for (var k = 0u; k < SAMPLES; k++) {
        for (var j = 0u; j < SAMPLES; j++) {
            for (var i = 0u; i < SAMPLES; i++) {
                let at = low + (vec3<f32>(vec3<u32>(i, j, k)) + 0.5) / f32(SAMPLES);
                inside += select(0u, 1u, dot(at, at) <= r * r);
            }
        }
    }
    return f32(inside) / f32(SAMPLES * SAMPLES * SAMPLES);
}

// Linear in the distance between the centres of cell and ball: clamp(r - 1/(12 r) + 1/2 - d, 0, 1).
fn linear_fraction(low: vec3<f32>, r: f32) -> f32 {
    let d = length(low + 0.5);
    return clamp(r - 1.0 / (12.0 * r) + 0.5 - d, 0.0, 1.0);
}
