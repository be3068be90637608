// The collision of one cell in the moments of d'Humieres et al. (Phil. Trans. R. Soc. A 360, 437,
// 2002), each moment a sum written out, and the solid part of the cell with it.
//
// h are the populations less their weights, h_a = f_a - w_a, so that f32 keeps the digits of what
// moves: ρ = 1 + Σ h_a, and all other moments of the weights but e (-11) and eps (3) are zero.
//
// Opposite directions go together: s their sum, d their difference.

// f* = f + M⁻¹ g,  g = (1 - B) [Ŝ (m_eq - m) + (I - Ŝ/2) F] + Σ_s B_s Λ_s
fn collided(
    h: array<f32, 19>,
//#if SOLIDS
    solid: SolidPart,
//#end
) -> array<f32, 19> {
    let s1 = h[1] + h[2];
    let d1 = h[1] - h[2];
    let s3 = h[3] + h[4];
    let d3 = h[3] - h[4];
    let s5 = h[5] + h[6];
    let d5 = h[5] - h[6];
    let s7 = h[7] + h[10];
    let d7 = h[7] - h[10];
    let s8 = h[8] + h[9];
    let d8 = h[8] - h[9];
    let s11 = h[11] + h[14];
    let d11 = h[11] - h[14];
    let s12 = h[12] + h[13];
    let d12 = h[12] - h[13];
    let s15 = h[15] + h[18];
    let d15 = h[15] - h[18];
    let s16 = h[16] + h[17];
    let d16 = h[16] - h[17];
    let faces = s1 + s3 + s5;
    let in_xy = s7 + s8;
    let in_xz = s11 + s12;
    let in_yz = s15 + s16;
    let edges = in_xy + in_xz + in_yz;

    // ρ - 1 = Σ h
    let drho = h[0] + faces + edges;
    let rho = 1.0 + drho;
    // What the edges carry along each axis, from the one plane and from the other.
    let first_x = d7 - d8;
    let first_y = d15 - d16;
    let first_z = d11 + d12;
    let second_x = d11 - d12;
    let second_y = d7 + d8;
    let second_z = d15 + d16;
    let bent_x = first_x + second_x;
    let bent_y = first_y + second_y;
    let bent_z = first_z + second_z;
    // j = Σ c h,  q = Σ (5c² - 9) c h,  m_x = Σ (c_y² - c_z²) c_x h and its cyclic images
    let j_x = d1 + bent_x;
    let j_y = d3 + bent_y;
    let j_z = d5 + bent_z;
    let q_x = bent_x - 4.0 * d1;
    let q_y = bent_y - 4.0 * d3;
    let q_z = bent_z - 4.0 * d5;
    let m_x = first_x - second_x;
    let m_y = first_y - second_y;
    let m_z = first_z - second_z;
    // e = Σ (19c² - 30) h,  eps = Σ (21c⁴ - 53c² + 24)/2 h
    let e = 8.0 * edges - 11.0 * faces - 30.0 * h[0];
    let eps = edges - 4.0 * faces + 12.0 * h[0];
    // 3p_xx = Σ (3c_x² - c²) h,  p_ww = Σ (c_y² - c_z²) h;  pi: the same times (3c² - 5)
    let face_xx = 2.0 * s1 - s3 - s5;
    let edge_xx = in_xy + in_xz - 2.0 * in_yz;
    let face_ww = s3 - s5;
    let edge_ww = in_xy - in_xz;
    let pxx = face_xx + edge_xx;
    let pixx = edge_xx - 2.0 * face_xx;
    let pww = face_ww + edge_ww;
    let piww = edge_ww - 2.0 * face_ww;
    let pxy = s7 - s8;
    let pyz = s15 - s16;
    let pxz = s11 - s12;

    let over_rho = 1.0 / rho;
//#if GRADED
    // A cut cell as fluid of graded viscosity (reference/src/graded_viscosity.rs): its force F = (1 - B) G + 2 B (ρ u_p - j)
    // and its rates, which hide the fluid's. With (1 - ε) = (1 - B)/[(1 - B) + B/k]:
    // even moments 1/s - 1/2 = (τ - 1/2)/(1 - ε), odd moments 1/s - 1/2 = Λ_c (1 - ε)/(τ - 1/2).
    let b = solid.weight;
    let open = 1.0 - b;
    let whole = open + b / GRADED_DRAG;
    let even = open / (0.5 * open + EXCESS * whole);
    let odd = 1.0 / (0.5 + ODD_IN_CUT_CELLS * open / whole);
    let is_cut = b > 0.0;
    let S_E = select(S_E, even, is_cut);
    let S_EPS = select(S_EPS, even, is_cut);
    let S_NU = select(S_NU, even, is_cut);
    let S_PI = select(S_PI, even, is_cut);
    let S_Q = select(S_Q, odd, is_cut);
    let S_M = select(S_M, odd, is_cut);
    var push = -2.0 * b * vec3<f32>(j_x, j_y, j_z);
//#if MOVING
    push += 2.0 * rho * vec3<f32>(solid.velocity_x, solid.velocity_y, solid.velocity_z);
//#end
//#if FORCE
    push += open * drive.force;
//#end
//#else
//#if FORCE
    let push = drive.force;
//#end
//#end

    // u = (j + G/2)/ρ
//#if PUSHED
    let k_x = j_x + 0.5 * push.x;
    let k_y = j_y + 0.5 * push.y;
    let k_z = j_z + 0.5 * push.z;
//#else
    let k_x = j_x;
    let k_y = j_y;
    let k_z = j_z;
//#end
    let u_x = k_x * over_rho;
    let u_y = k_y * over_rho;
    let u_z = k_z * over_rho;
    // ρ u_i u_i and ρ u_i u_j
    let n_x = k_x * u_x;
    let n_y = k_y * u_y;
    let n_z = k_z * u_z;
    let t_xy = k_x * u_y;
    let t_yz = k_y * u_z;
    let t_xz = k_x * u_z;
    let kinetic = n_x + n_y + n_z;
    let n_xx = 2.0 * n_x - n_y - n_z;
    let n_ww = n_y - n_z;

    // m_eq - m:  e_eq = -11 ρ + 19 ρu²,  eps_eq = 3 ρ - 11/2 ρu²,  q_eq = -2/3 ρu,
    // 3p_xx_eq = ρ (2u_x² - u_y² - u_z²),  pi_eq = -1/2 p_eq;  with Ŝ before it
    var g_e = S_E * (19.0 * kinetic - 11.0 * drho - e);
    var g_eps = S_EPS * (3.0 * drho - 5.5 * kinetic - eps);
    var gq_x = -S_Q * (TWO_THIRDS * k_x + q_x);
    var gq_y = -S_Q * (TWO_THIRDS * k_y + q_y);
    var gq_z = -S_Q * (TWO_THIRDS * k_z + q_z);
    var gm_x = -S_M * m_x;
    var gm_y = -S_M * m_y;
    var gm_z = -S_M * m_z;
    var g_pxx = S_NU * (n_xx - pxx);
    var g_pixx = -S_PI * (0.5 * n_xx + pixx);
    var g_pww = S_NU * (n_ww - pww);
    var g_piww = -S_PI * (0.5 * n_ww + piww);
    var g_xy = S_NU * (t_xy - pxy);
    var g_yz = S_NU * (t_yz - pyz);
    var g_xz = S_NU * (t_xz - pxz);
//#if PUSHED
    // + (I - Ŝ/2) F,  F the derivative of m_eq along ρu → G
    let w_x = u_x * push.x;
    let w_y = u_y * push.y;
    let w_z = u_z * push.z;
    let power = w_x + w_y + w_z;
    let f_xx = 2.0 * (2.0 * w_x - w_y - w_z);
    let f_ww = 2.0 * (w_y - w_z);
    g_e += (1.0 - 0.5 * S_E) * 38.0 * power;
    g_eps -= (1.0 - 0.5 * S_EPS) * 11.0 * power;
    gq_x -= (1.0 - 0.5 * S_Q) * TWO_THIRDS * push.x;
    gq_y -= (1.0 - 0.5 * S_Q) * TWO_THIRDS * push.y;
    gq_z -= (1.0 - 0.5 * S_Q) * TWO_THIRDS * push.z;
    g_pxx += (1.0 - 0.5 * S_NU) * f_xx;
    g_pixx -= (1.0 - 0.5 * S_PI) * 0.5 * f_xx;
    g_pww += (1.0 - 0.5 * S_NU) * f_ww;
    g_piww -= (1.0 - 0.5 * S_PI) * 0.5 * f_ww;
    g_xy += (1.0 - 0.5 * S_NU) * (u_x * push.y + u_y * push.x);
    g_yz += (1.0 - 0.5 * S_NU) * (u_y * push.z + u_z * push.y);
    g_xz += (1.0 - 0.5 * S_NU) * (u_x * push.z + u_z * push.x);
    var gj_x = push.x;
    var gj_y = push.y;
    var gj_z = push.z;
//#end

//#if SOLIDS
//#if GRADED
//#else
    // B and 1 - B, and the fluid's equilibrium without the body force
    let b = solid.weight;
    let open = 1.0 - b;
//#if FORCE
    let bare_x = j_x * j_x * over_rho;
    let bare_y = j_y * j_y * over_rho;
    let bare_z = j_z * j_z * over_rho;
    let bare_xy = j_x * j_y * over_rho;
    let bare_yz = j_y * j_z * over_rho;
    let bare_xz = j_x * j_z * over_rho;
    let bare_kinetic = bare_x + bare_y + bare_z;
    let bare_xx = 2.0 * bare_x - bare_y - bare_z;
    let bare_ww = bare_y - bare_z;
    gj_x *= open;
    gj_y *= open;
    gj_z *= open;
//#else
    let bare_xy = t_xy;
    let bare_yz = t_yz;
    let bare_xz = t_xz;
    let bare_kinetic = kinetic;
    let bare_xx = n_xx;
    let bare_ww = n_ww;
    var gj_x = f32(0.0);
    var gj_y = f32(0.0);
    var gj_z = f32(0.0);
//#end
//#if FULL
    // Bounce-back of whole populations leaves even moments as they are, and takes twice the momentum.
    let gain_kinetic = f32(0.0);
    let gain_xx = f32(0.0);
    let gain_ww = f32(0.0);
    let gain_xy = f32(0.0);
    let gain_yz = f32(0.0);
    let gain_xz = f32(0.0);
//#if MOVING
    let push_x = 2.0 * (rho * solid.velocity_x - b * j_x);
    let push_y = 2.0 * (rho * solid.velocity_y - b * j_y);
    let push_z = 2.0 * (rho * solid.velocity_z - b * j_z);
//#else
    let push_x = -2.0 * b * j_x;
    let push_y = -2.0 * b * j_y;
    let push_z = -2.0 * b * j_z;
//#end
//#else
    // Even moments of both operators: B [m_eq(u_p) - m_eq(u)]
//#if MOVING
    let p_x = rho * solid.square_x;
    let p_y = rho * solid.square_y;
    let p_z = rho * solid.square_z;
    let gain_kinetic = p_x + p_y + p_z - b * bare_kinetic;
    let gain_xx = 2.0 * p_x - p_y - p_z - b * bare_xx;
    let gain_ww = p_y - p_z - b * bare_ww;
    let gain_xy = rho * solid.mixed_xy - b * bare_xy;
    let gain_yz = rho * solid.mixed_yz - b * bare_yz;
    let gain_xz = rho * solid.mixed_xz - b * bare_xz;
    let push_x = rho * solid.velocity_x - b * j_x;
    let push_y = rho * solid.velocity_y - b * j_y;
    let push_z = rho * solid.velocity_z - b * j_z;
//#else
    let gain_kinetic = -b * bare_kinetic;
    let gain_xx = -b * bare_xx;
    let gain_ww = -b * bare_ww;
    let gain_xy = -b * bare_xy;
    let gain_yz = -b * bare_yz;
    let gain_xz = -b * bare_xz;
    let push_x = -b * j_x;
    let push_y = -b * j_y;
    let push_z = -b * j_z;
//#end
//#end
    g_e = open * g_e + 19.0 * gain_kinetic;
    g_eps = open * g_eps - 5.5 * gain_kinetic;
    g_pxx = open * g_pxx + gain_xx;
    g_pixx = open * g_pixx - 0.5 * gain_xx;
    g_pww = open * g_pww + gain_ww;
    g_piww = open * g_piww - 0.5 * gain_ww;
    g_xy = open * g_xy + gain_xy;
    g_yz = open * g_yz + gain_yz;
    g_xz = open * g_xz + gain_xz;
//#if SUPERPOSITION
    // Λ = m_eq(u_p) - m_eq(u) + Ŝ [m_eq(u) - m]
    g_e += b * S_E * (19.0 * bare_kinetic - 11.0 * drho - e);
    g_eps += b * S_EPS * (3.0 * drho - 5.5 * bare_kinetic - eps);
    g_pxx += b * S_NU * (bare_xx - pxx);
    g_pixx -= b * S_PI * (0.5 * bare_xx + pixx);
    g_pww += b * S_NU * (bare_ww - pww);
    g_piww -= b * S_PI * (0.5 * bare_ww + piww);
    g_xy += b * S_NU * (bare_xy - pxy);
    g_yz += b * S_NU * (bare_yz - pyz);
    g_xz += b * S_NU * (bare_xz - pxz);
    gq_x = open * gq_x - TWO_THIRDS * push_x - b * S_Q * (q_x + TWO_THIRDS * j_x);
    gq_y = open * gq_y - TWO_THIRDS * push_y - b * S_Q * (q_y + TWO_THIRDS * j_y);
    gq_z = open * gq_z - TWO_THIRDS * push_z - b * S_Q * (q_z + TWO_THIRDS * j_z);
    gm_x = open * gm_x - b * S_M * m_x;
    gm_y = open * gm_y - b * S_M * m_y;
    gm_z = open * gm_z - b * S_M * m_z;
//#else
    // Odd moments: B [m_eq(u) + m_eq(u_p) - 2 m], or B [2 m_eq(u_p) - 2 m]; bounce-back turns their signs
    gq_x = open * gq_x - TWO_THIRDS * (push_x + 2.0 * b * j_x) - 2.0 * b * q_x;
    gq_y = open * gq_y - TWO_THIRDS * (push_y + 2.0 * b * j_y) - 2.0 * b * q_y;
    gq_z = open * gq_z - TWO_THIRDS * (push_z + 2.0 * b * j_z) - 2.0 * b * q_z;
    gm_x = open * gm_x - 2.0 * b * m_x;
    gm_y = open * gm_y - 2.0 * b * m_y;
    gm_z = open * gm_z - 2.0 * b * m_z;
//#end
    // Momentum, of both operators: B (ρ u_p - j), what the solid loses
    gj_x += push_x;
    gj_y += push_y;
    gj_z += push_z;
//#end
//#end

    // h* = h + M⁻¹ g, each row of M over its squared length
    let at_rest = g_eps * (12.0 / 252.0) - g_e * (30.0 / 2394.0);
    let at_face = -g_e * (11.0 / 2394.0) - g_eps * (4.0 / 252.0);
    let at_edge = g_e * (8.0 / 2394.0) + g_eps * (1.0 / 252.0);
    let a_xx = (g_pxx - g_pixx) * (1.0 / 36.0);
    let a_ww = (g_pww - g_piww) * (1.0 / 12.0);
    let b_xx = g_pxx * (1.0 / 36.0) + g_pixx * (1.0 / 72.0);
    let b_ww = g_pww * (1.0 / 12.0) + g_piww * (1.0 / 24.0);
//#if MOMENTUM
    let f_x = 0.1 * (gj_x - gq_x);
    let f_y = 0.1 * (gj_y - gq_y);
    let f_z = 0.1 * (gj_z - gq_z);
    let o_x = 0.1 * gj_x + 0.025 * gq_x;
    let o_y = 0.1 * gj_y + 0.025 * gq_y;
    let o_z = 0.1 * gj_z + 0.025 * gq_z;
//#else
    let f_x = -0.1 * gq_x;
    let f_y = -0.1 * gq_y;
    let f_z = -0.1 * gq_z;
    let o_x = 0.025 * gq_x;
    let o_y = 0.025 * gq_y;
    let o_z = 0.025 * gq_z;
//#end
    let of_x = o_x + 0.125 * gm_x;
    let os_x = o_x - 0.125 * gm_x;
    let of_y = o_y + 0.125 * gm_y;
    let os_y = o_y - 0.125 * gm_y;
    let of_z = o_z + 0.125 * gm_z;
    let os_z = o_z - 0.125 * gm_z;
    let e_x = at_face + 2.0 * a_xx;
    let e_y = at_face - a_xx + a_ww;
    let e_z = at_face - a_xx - a_ww;
    let e_xy = at_edge + b_xx + b_ww;
    let e_xz = at_edge + b_xx - b_ww;
    let e_yz = at_edge - 2.0 * b_xx;
    let sh_xy = 0.25 * g_xy;
    let sh_yz = 0.25 * g_yz;
    let sh_xz = 0.25 * g_xz;
    // Along (1, 1), (-1, 1) in each plane; x comes first in xy, second in xz, y first in yz.
    let o7 = of_x + os_y;
    let o8 = os_y - of_x;
    let o11 = os_x + of_z;
    let o12 = of_z - os_x;
    let o15 = of_y + os_z;
    let o16 = os_z - of_y;
    var post: array<f32, 19>;
    post[0] = h[0] + at_rest;
    post[1] = h[1] + (e_x + f_x);
    post[2] = h[2] + (e_x - f_x);
    post[3] = h[3] + (e_y + f_y);
    post[4] = h[4] + (e_y - f_y);
    post[5] = h[5] + (e_z + f_z);
    post[6] = h[6] + (e_z - f_z);
    post[7] = h[7] + (e_xy + sh_xy + o7);
    post[10] = h[10] + (e_xy + sh_xy - o7);
    post[8] = h[8] + (e_xy - sh_xy + o8);
    post[9] = h[9] + (e_xy - sh_xy - o8);
    post[11] = h[11] + (e_xz + sh_xz + o11);
    post[14] = h[14] + (e_xz + sh_xz - o11);
    post[12] = h[12] + (e_xz - sh_xz + o12);
    post[13] = h[13] + (e_xz - sh_xz - o12);
    post[15] = h[15] + (e_yz + sh_yz + o15);
    post[18] = h[18] + (e_yz + sh_yz - o15);
    post[16] = h[16] + (e_yz - sh_yz + o16);
    post[17] = h[17] + (e_yz - sh_yz - o16);
    return post;
}
