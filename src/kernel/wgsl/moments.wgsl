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
    let first = vec3<f32>(d7 - d8, d15 - d16, d11 + d12);
    let second = vec3<f32>(d11 - d12, d7 + d8, d15 + d16);
    let straight = vec3<f32>(d1, d3, d5);
    let bent = first + second;
    // j = Σ c h,  q = Σ (5c² - 9) c h,  m_x = Σ (c_y² - c_z²) c_x h and its cyclic images
    let j = straight + bent;
    let q = bent - 4.0 * straight;
    let m = first - second;
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
    // p_xy, p_yz, p_xz
    let shear = vec3<f32>(s7 - s8, s15 - s16, s11 - s12);

    // u = (j + G/2)/ρ
    let over_rho = 1.0 / rho;
//#if FORCE
    let mass_flux = j + 0.5 * G;
//#else
    let mass_flux = j;
//#end
    let u = mass_flux * over_rho;
    // ρ u_i u_i and ρ u_i u_j (xy, yz, xz)
    let n = mass_flux * u;
    let t = mass_flux.xyx * u.yzz;
    let kinetic = n.x + n.y + n.z;
    let n_xx = 2.0 * n.x - n.y - n.z;
    let n_ww = n.y - n.z;

    // m_eq - m:  e_eq = -11 ρ + 19 ρu²,  eps_eq = 3 ρ - 11/2 ρu²,  q_eq = -2/3 ρu,
    // 3p_xx_eq = ρ (2u_x² - u_y² - u_z²),  pi_eq = -1/2 p_eq
    let to_e = 19.0 * kinetic - 11.0 * drho - e;
    let to_eps = 3.0 * drho - 5.5 * kinetic - eps;
    let to_q = -TWO_THIRDS * mass_flux - q;
    let to_pxx = n_xx - pxx;
    let to_pixx = -0.5 * n_xx - pixx;
    let to_pww = n_ww - pww;
    let to_piww = -0.5 * n_ww - piww;
    let to_shear = t - shear;

    // Ŝ (m_eq - m)
    var g_e = S_E * to_e;
    var g_eps = S_EPS * to_eps;
    var g_q = S_Q * to_q;
    var g_m = -S_M * m;
    var g_pxx = S_NU * to_pxx;
    var g_pixx = S_PI * to_pixx;
    var g_pww = S_NU * to_pww;
    var g_piww = S_PI * to_piww;
    var g_shear = S_NU * to_shear;
//#if FORCE
    // + (I - Ŝ/2) F,  F the derivative of m_eq along ρu → G
    let ug = u * G;
    let power = ug.x + ug.y + ug.z;
    let f_xx = 2.0 * (2.0 * ug.x - ug.y - ug.z);
    let f_ww = 2.0 * (ug.y - ug.z);
    g_e += (1.0 - 0.5 * S_E) * 38.0 * power;
    g_eps -= (1.0 - 0.5 * S_EPS) * 11.0 * power;
    g_q -= (1.0 - 0.5 * S_Q) * TWO_THIRDS * G;
    g_pxx += (1.0 - 0.5 * S_NU) * f_xx;
    g_pixx -= (1.0 - 0.5 * S_PI) * 0.5 * f_xx;
    g_pww += (1.0 - 0.5 * S_NU) * f_ww;
    g_piww -= (1.0 - 0.5 * S_PI) * 0.5 * f_ww;
    g_shear += (1.0 - 0.5 * S_NU) * (u.xyx * G.yzz + u.yzz * G.xyx);
    var g_j = G;
//#end

//#if SOLIDS
    // B and 1 - B, and the fluid's equilibrium without the body force
    let b = solid.weight;
    let open = 1.0 - b;
//#if FORCE
    let bare_n = j * j * over_rho;
    let bare_t = j.xyx * j.yzz * over_rho;
    let bare_kinetic = bare_n.x + bare_n.y + bare_n.z;
    let bare_xx = 2.0 * bare_n.x - bare_n.y - bare_n.z;
    let bare_ww = bare_n.y - bare_n.z;
    g_j *= open;
//#else
    let bare_t = t;
    let bare_kinetic = kinetic;
    let bare_xx = n_xx;
    let bare_ww = n_ww;
    var g_j = vec3<f32>(0.0);
//#end
    // Even moments of both operators: B [m_eq(u_p) - m_eq(u)]
//#if MOVING
    let p_n = rho * solid.square;
    let p_t = rho * solid.mixed;
    let p_u = rho * solid.velocity;
    let gain_kinetic = p_n.x + p_n.y + p_n.z - b * bare_kinetic;
    let gain_xx = 2.0 * p_n.x - p_n.y - p_n.z - b * bare_xx;
    let gain_ww = p_n.y - p_n.z - b * bare_ww;
    let gain_t = p_t - b * bare_t;
    let push = p_u - b * j;
//#else
    let gain_kinetic = -b * bare_kinetic;
    let gain_xx = -b * bare_xx;
    let gain_ww = -b * bare_ww;
    let gain_t = -b * bare_t;
    let push = -b * j;
//#end
//#if SUPERPOSITION
    // Λ = m_eq(u_p) - m_eq(u) + Ŝ [m_eq(u) - m]
    let keep_e = b * S_E * (19.0 * bare_kinetic - 11.0 * drho - e);
    let keep_eps = b * S_EPS * (3.0 * drho - 5.5 * bare_kinetic - eps);
    let keep_pxx = b * S_NU * (bare_xx - pxx);
    let keep_pixx = b * S_PI * (-0.5 * bare_xx - pixx);
    let keep_pww = b * S_NU * (bare_ww - pww);
    let keep_piww = b * S_PI * (-0.5 * bare_ww - piww);
    let keep_shear = b * S_NU * (bare_t - shear);
    let odd_q = -TWO_THIRDS * push - b * S_Q * (q + TWO_THIRDS * j);
    let odd_m = -b * S_M * m;
//#else
    // Odd moments: B [m_eq(u) + m_eq(u_p) - 2 m]; bounce-back turns their signs
    let odd_q = -TWO_THIRDS * (push + 2.0 * b * j) - 2.0 * b * q;
    let odd_m = -2.0 * b * m;
//#end
    g_e = open * g_e + 19.0 * gain_kinetic;
    g_eps = open * g_eps - 5.5 * gain_kinetic;
    g_pxx = open * g_pxx + gain_xx;
    g_pixx = open * g_pixx - 0.5 * gain_xx;
    g_pww = open * g_pww + gain_ww;
    g_piww = open * g_piww - 0.5 * gain_ww;
    g_shear = open * g_shear + gain_t;
    g_q = open * g_q + odd_q;
    g_m = open * g_m + odd_m;
    // Momentum, of both operators: B (ρ u_p - j), less what the solid receives
    g_j += push;
//#if SUPERPOSITION
    g_e += keep_e;
    g_eps += keep_eps;
    g_pxx += keep_pxx;
    g_pixx += keep_pixx;
    g_pww += keep_pww;
    g_piww += keep_piww;
    g_shear += keep_shear;
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
    let o_face = 0.1 * (g_j - g_q);
    let o_edge = 0.1 * g_j + 0.025 * g_q;
//#else
    let o_face = -0.1 * g_q;
    let o_edge = 0.025 * g_q;
//#end
    let o_first = o_edge + 0.125 * g_m;
    let o_second = o_edge - 0.125 * g_m;
    let e_x = at_face + 2.0 * a_xx;
    let e_y = at_face - a_xx + a_ww;
    let e_z = at_face - a_xx - a_ww;
    let e_xy = at_edge + b_xx + b_ww;
    let e_xz = at_edge + b_xx - b_ww;
    let e_yz = at_edge - 2.0 * b_xx;
    let sh = 0.25 * g_shear;
    // Along (1, 1), (-1, 1) in each plane; x comes first in xy, second in xz, y first in yz.
    let o7 = o_first.x + o_second.y;
    let o8 = o_second.y - o_first.x;
    let o11 = o_second.x + o_first.z;
    let o12 = o_first.z - o_second.x;
    let o15 = o_first.y + o_second.z;
    let o16 = o_second.z - o_first.y;
    var post: array<f32, 19>;
    post[0] = h[0] + at_rest;
    post[1] = h[1] + (e_x + o_face.x);
    post[2] = h[2] + (e_x - o_face.x);
    post[3] = h[3] + (e_y + o_face.y);
    post[4] = h[4] + (e_y - o_face.y);
    post[5] = h[5] + (e_z + o_face.z);
    post[6] = h[6] + (e_z - o_face.z);
    post[7] = h[7] + (e_xy + sh.x + o7);
    post[10] = h[10] + (e_xy + sh.x - o7);
    post[8] = h[8] + (e_xy - sh.x + o8);
    post[9] = h[9] + (e_xy - sh.x - o8);
    post[11] = h[11] + (e_xz + sh.z + o11);
    post[14] = h[14] + (e_xz + sh.z - o11);
    post[12] = h[12] + (e_xz - sh.z + o12);
    post[13] = h[13] + (e_xz - sh.z - o12);
    post[15] = h[15] + (e_yz + sh.y + o15);
    post[18] = h[18] + (e_yz + sh.y - o15);
    post[16] = h[16] + (e_yz - sh.y + o16);
    post[17] = h[17] + (e_yz - sh.y - o16);
    return post;
}
