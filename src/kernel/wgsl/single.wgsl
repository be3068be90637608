// The collision of one cell with a single relaxation time (Eq. 2 of the paper), in pairs of opposite
// directions. h are the populations less their weights.

// Both populations of a pair after the collision, cu = c·u and cg = c·G of the first:
// f* = f + (f_eq - f)/τ + (1 - 1/(2τ)) F
fn relaxed(plus: f32, minus: f32, w: f32, cu: f32, cg: f32, state: State) -> vec2<f32> {
    // f_eq = w ρ [1 + 3 c·u + 9/2 (c·u)² - 3/2 u²], its even part less w, and its odd part
    let even = w * (state.drho + state.rho * (4.5 * cu * cu) - state.speed);
    let odd = 3.0 * w * state.rho * cu;
    var change_plus = S_NU * (even + odd - plus);
    var change_minus = S_NU * (even - odd - minus);
//#if FORCE
    // F = w [3 (c - u) + 9 (c·u) c]·G
    let force_even = w * (9.0 * cu * cg - state.power);
    let force_odd = 3.0 * w * cg;
    change_plus += (1.0 - 0.5 * S_NU) * (force_even + force_odd);
    change_minus += (1.0 - 0.5 * S_NU) * (force_even - force_odd);
//#end
    return vec2<f32>(plus + change_plus, minus + change_minus);
}

struct State {
    // ρ - 1 and ρ
    drho: f32,
    rho: f32,
    // 3/2 ρ u²
    speed: f32,
    // 3 u·G
    power: f32,
}

fn collided(h: array<f32, 19>) -> array<f32, 19> {
    let drho = h[0] + ((h[1] + h[2]) + (h[3] + h[4]) + (h[5] + h[6]))
        + ((h[7] + h[10]) + (h[8] + h[9]) + (h[11] + h[14]))
        + ((h[12] + h[13]) + (h[15] + h[18]) + (h[16] + h[17]));
    let xy = vec2<f32>(h[7] - h[10], h[8] - h[9]);
    let xz = vec2<f32>(h[11] - h[14], h[12] - h[13]);
    let yz = vec2<f32>(h[15] - h[18], h[16] - h[17]);
    // j = Σ c h
    let j = vec3<f32>(
        (h[1] - h[2]) + (xy.x - xy.y) + (xz.x - xz.y),
        (h[3] - h[4]) + (xy.x + xy.y) + (yz.x - yz.y),
        (h[5] - h[6]) + (xz.x + xz.y) + (yz.x + yz.y),
    );
    let rho = 1.0 + drho;
    // u = (j + G/2)/ρ
//#if FORCE
    let u = (j + 0.5 * G) / rho;
    let g = G;
    let power = 3.0 * dot(u, G);
//#else
    let u = j / rho;
    let g = vec3<f32>(0.0);
    let power = 0.0;
//#end
    let state = State(drho, rho, 1.5 * rho * dot(u, u), power);
    let p1 = relaxed(h[1], h[2], 1.0 / 18.0, u.x, g.x, state);
    let p3 = relaxed(h[3], h[4], 1.0 / 18.0, u.y, g.y, state);
    let p5 = relaxed(h[5], h[6], 1.0 / 18.0, u.z, g.z, state);
    let p7 = relaxed(h[7], h[10], 1.0 / 36.0, u.x + u.y, g.x + g.y, state);
    let p8 = relaxed(h[8], h[9], 1.0 / 36.0, u.y - u.x, g.y - g.x, state);
    let p11 = relaxed(h[11], h[14], 1.0 / 36.0, u.x + u.z, g.x + g.z, state);
    let p12 = relaxed(h[12], h[13], 1.0 / 36.0, u.z - u.x, g.z - g.x, state);
    let p15 = relaxed(h[15], h[18], 1.0 / 36.0, u.y + u.z, g.y + g.z, state);
    let p16 = relaxed(h[16], h[17], 1.0 / 36.0, u.z - u.y, g.z - g.y, state);
    var post: array<f32, 19>;
    var change = S_NU * (1.0 / 3.0 * (drho - state.speed) - h[0]);
//#if FORCE
    change -= (1.0 - 0.5 * S_NU) * (1.0 / 3.0) * power;
//#end
    post[0] = h[0] + change;
    post[1] = p1.x;
    post[2] = p1.y;
    post[3] = p3.x;
    post[4] = p3.y;
    post[5] = p5.x;
    post[6] = p5.y;
    post[7] = p7.x;
    post[10] = p7.y;
    post[8] = p8.x;
    post[9] = p8.y;
    post[11] = p11.x;
    post[14] = p11.y;
    post[12] = p12.x;
    post[13] = p12.y;
    post[15] = p15.x;
    post[18] = p15.y;
    post[16] = p16.x;
    post[17] = p16.y;
    return post;
}
