// The collision of one cell with a single relaxation time (Eq. 2 of the paper), in pairs of opposite
// directions. h are the populations less their weights.

// Both populations of a pair after the collision, cu = c·u and cg = c·G of the first:
// f* = f + (f_eq - f)/τ + (1 - 1/(2τ)) F
fn relaxed(plus: f32, minus: f32, w: f32, cu: f32, cg: f32, state: State) -> Pair {
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
    return Pair(plus + change_plus, minus + change_minus);
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

struct Pair {
    plus: f32,
    minus: f32,
}

fn collided(h: array<f32, 19>) -> array<f32, 19> {
    let drho = h[0] + ((h[1] + h[2]) + (h[3] + h[4]) + (h[5] + h[6]))
        + ((h[7] + h[10]) + (h[8] + h[9]) + (h[11] + h[14]))
        + ((h[12] + h[13]) + (h[15] + h[18]) + (h[16] + h[17]));
    let d7 = h[7] - h[10];
    let d8 = h[8] - h[9];
    let d11 = h[11] - h[14];
    let d12 = h[12] - h[13];
    let d15 = h[15] - h[18];
    let d16 = h[16] - h[17];
    // j = Σ c h
    let j_x = (h[1] - h[2]) + (d7 - d8) + (d11 - d12);
    let j_y = (h[3] - h[4]) + (d7 + d8) + (d15 - d16);
    let j_z = (h[5] - h[6]) + (d11 + d12) + (d15 + d16);
    let rho = 1.0 + drho;
    let over_rho = 1.0 / rho;
    // u = (j + G/2)/ρ
    let u_x = (j_x + 0.5 * G_X) * over_rho;
    let u_y = (j_y + 0.5 * G_Y) * over_rho;
    let u_z = (j_z + 0.5 * G_Z) * over_rho;
    let power = 3.0 * (u_x * G_X + u_y * G_Y + u_z * G_Z);
    let speed = 1.5 * rho * (u_x * u_x + u_y * u_y + u_z * u_z);
    let state = State(drho, rho, speed, power);
    let p1 = relaxed(h[1], h[2], 1.0 / 18.0, u_x, G_X, state);
    let p3 = relaxed(h[3], h[4], 1.0 / 18.0, u_y, G_Y, state);
    let p5 = relaxed(h[5], h[6], 1.0 / 18.0, u_z, G_Z, state);
    let p7 = relaxed(h[7], h[10], 1.0 / 36.0, u_x + u_y, G_X + G_Y, state);
    let p8 = relaxed(h[8], h[9], 1.0 / 36.0, u_y - u_x, G_Y - G_X, state);
    let p11 = relaxed(h[11], h[14], 1.0 / 36.0, u_x + u_z, G_X + G_Z, state);
    let p12 = relaxed(h[12], h[13], 1.0 / 36.0, u_z - u_x, G_Z - G_X, state);
    let p15 = relaxed(h[15], h[18], 1.0 / 36.0, u_y + u_z, G_Y + G_Z, state);
    let p16 = relaxed(h[16], h[17], 1.0 / 36.0, u_z - u_y, G_Z - G_Y, state);
    var post: array<f32, 19>;
    var change = S_NU * (1.0 / 3.0 * (drho - state.speed) - h[0]);
//#if FORCE
    change -= (1.0 - 0.5 * S_NU) * (1.0 / 3.0) * power;
//#end
    post[0] = h[0] + change;
    post[1] = p1.plus;
    post[2] = p1.minus;
    post[3] = p3.plus;
    post[4] = p3.minus;
    post[5] = p5.plus;
    post[6] = p5.minus;
    post[7] = p7.plus;
    post[10] = p7.minus;
    post[8] = p8.plus;
    post[9] = p8.minus;
    post[11] = p11.plus;
    post[14] = p11.minus;
    post[12] = p12.plus;
    post[13] = p12.minus;
    post[15] = p15.plus;
    post[18] = p15.minus;
    post[16] = p16.plus;
    post[17] = p16.minus;
    return post;
}
