//! The force of one contact, and how its springs are carried along as the contact turns.
//!
//! Seen from the first body: `n` is the unit normal from the first to the second, `δ` the overlap,
//! `u` the velocity of the first relative to the second at the point of contact, which lies on the
//! line of centres, half-way into the overlap (on a plane: on the plane).
//!
//! ```text
//!   normal       F_n = max(0, k δ + γ u·n)                         pushes the bodies apart
//!   tangential   dξ/dt = u_t,   F_t = -(k_t ξ + γ_t u_t),   |F_t| <= μ F_n
//!   rolling      dθ/dt = (ω₁ - ω₂)_t,   M = -R_r² (k_r θ + γ_r (ω₁ - ω₂)_t),   |M| <= μ_r R_r F_n
//!   on the first   F = -F_n n + F_t at the point of contact; on the second -F at the same point
//! ```
//!
//! Force and counter-force are equal and opposite and act at one point: momentum and, between grains,
//! angular momentum are conserved exactly, whatever the length of the sub-step. (Across a periodic
//! face the point of contact has two images; there angular momentum has no meaning.)

use crate::grains::law::{ContactLaw, Rolling};
use crate::lattice::Vec3;

/// What a contact remembers from one sub-step to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactMemory {
    /// Normal from the first to the second body when the springs were last moved.
    pub normal: Vec3,
    /// Tangential spring `ξ`, length.
    pub spring: Vec3,
    /// Rolling spring, radians.
    pub rolling: Vec3,
    /// Overlap then, length: under Hertz's law the springs depend on how it has changed.
    pub overlap: f64,
}

/// Where two bodies touch, or would.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Unit normal from the first to the second body.
    pub normal: Vec3,
    /// Overlap, length; negative: a gap.
    pub overlap: f64,
    /// Distances from the two centres to the point of contact, length.
    pub arms: [f64; 2],
    /// Radius on which rolling resistance acts, length.
    pub rolling_radius: f64,
}

impl Geometry {
    /// Two spheres, the second at `offset` from the first.
    pub fn of_spheres(offset: &Vec3, radii: [f64; 2]) -> Self {
        let [first, second] = radii;
        let distance = offset.norm();
        let overlap = first + second - distance;
        Geometry {
            normal: offset / distance,
            overlap,
            arms: [first - 0.5 * overlap, second - 0.5 * overlap],
            rolling_radius: first * second / (first + second),
        }
    }

    /// A sphere of `radius` at height `height` over a plane whose normal is `up`.
    pub fn on_plane(height: f64, up: &Vec3, radius: f64) -> Self {
        Geometry {
            normal: -up,
            overlap: radius - height,
            arms: [height, 0.0],
            rolling_radius: radius,
        }
    }
}

/// Velocity (length/time) and angular velocity (1/time) of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Velocity of its centre.
    pub velocity: Vec3,
    /// Angular velocity.
    pub angular_velocity: Vec3,
}

/// How two bodies move against each other where they touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relative {
    /// Velocity `u` of the first relative to the second at the point of contact, length/time.
    pub velocity: Vec3,
    /// Angular velocity of the first relative to the second, 1/time.
    pub angular_velocity: Vec3,
    /// Angular velocity about the normal, mean of the two bodies, 1/time.
    pub twist: f64,
}

impl Relative {
    /// The relative motion of two bodies.
    pub fn new(geometry: &Geometry, [first, second]: [&Motion; 2]) -> Self {
        // u = v₁ - v₂ + (a₁ ω₁ + a₂ ω₂) × n
        let n = &geometry.normal;
        let turning =
            geometry.arms[0] * first.angular_velocity + geometry.arms[1] * second.angular_velocity;
        Relative {
            velocity: first.velocity - second.velocity + turning.cross(n),
            angular_velocity: first.angular_velocity - second.angular_velocity,
            twist: 0.5 * (first.angular_velocity + second.angular_velocity).dot(n),
        }
    }
}

/// Force and torques of one contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairForce {
    /// Force on the first body; on the second acts its opposite.
    pub force: Vec3,
    /// Torques on the first and second body about their centres.
    pub torques: [Vec3; 2],
}

/// Force of a contact at the end of a sub-step of length `dt`, and its springs moved there.
///
/// `middle` is the relative motion in the middle of the sub-step, which moves the springs as it moves
/// the centres; `end` is that at its end, on which the dashpots act. Without overlap there is neither
/// force nor memory.
pub fn contact_force(
    law: &ContactLaw,
    geometry: &Geometry,
    [middle, end]: [&Relative; 2],
    dt: f64,
    memory: &mut Option<ContactMemory>,
) -> Option<PairForce> {
    let Geometry { normal: n, overlap, arms, rolling_radius } = *geometry;
    if overlap <= 0.0 {
        *memory = None;
        return None;
    }
    let (elapsed, dashpot) = since_touch(geometry, middle, dt, memory.is_none());
    let mut springs = match memory {
        Some(before) => carried_along(before, &n, middle.twist * dt),
        None => ContactMemory { normal: n, spring: Vec3::zeros(), rolling: Vec3::zeros(), overlap },
    };
    springs.overlap = overlap;

    // F_n = max(0, k δ + γ u·n)
    let normal_force =
        (law.stiffness * overlap + law.damping * dashpot * end.velocity.dot(&n)).max(0.0);
    let mut force = -normal_force * n;
    if let Some(friction) = law.friction {
        // dξ/dt = u_t,  F_t = -(k_t ξ + γ_t u_t),  |F_t| <= μ F_n
        springs.spring += in_plane(&middle.velocity, &n) * elapsed;
        let dashpot_force = friction.damping * dashpot * in_plane(&end.velocity, &n);
        let limit = friction.coefficient * normal_force;
        force -= limited(&mut springs.spring, friction.stiffness, &dashpot_force, limit);
    }
    // T = arm × F; both arms point to the point of contact: a₁ n × F and (-a₂ n) × (-F)
    let turning = n.cross(&force);
    let mut torques = [arms[0] * turning, arms[1] * turning];
    if let Some(Rolling { coefficient, stiffness, damping }) = law.rolling {
        // dθ/dt = ω_t,  M = -R_r² (k_r θ + γ_r ω_t),  |M| <= μ_r R_r F_n
        springs.rolling += in_plane(&middle.angular_velocity, &n) * elapsed;
        let square = rolling_radius * rolling_radius;
        let dashpot_couple = damping * square * dashpot * in_plane(&end.angular_velocity, &n);
        let limit = coefficient * rolling_radius * normal_force;
        let couple = limited(&mut springs.rolling, stiffness * square, &dashpot_couple, limit);
        torques[0] -= couple;
        torques[1] += couple;
    }
    *memory = Some(springs);
    Some(PairForce { force, torques })
}

/// The part of the sub-step that has passed since the bodies touched, and the weight of the dashpots.
///
/// The force at the end of a sub-step acts from its middle to the middle of the next. If the bodies
/// touched `s dt` before the end, the dashpots, whose force starts with a jump, should have acted for
/// `(s + 1/2) dt` instead. Without this the impulse would be wrong by up to `γ v dt/2`, an error of
/// first order. Bodies that touch from the start are known by their memory, or by `dt = 0`.
fn since_touch(geometry: &Geometry, middle: &Relative, dt: f64, new: bool) -> (f64, f64) {
    if !new || dt == 0.0 {
        return (dt, 1.0);
    }
    let approach = middle.velocity.dot(&geometry.normal) * dt;
    let share = if approach > geometry.overlap { geometry.overlap / approach } else { 1.0 };
    (share * dt, share + 0.5)
}

/// The springs after the contact has turned to the normal `n` and twisted about it by `twist` radians.
fn carried_along(before: &ContactMemory, n: &Vec3, twist: f64) -> ContactMemory {
    // The shortest turn from the old normal m to the new n, of a vector ξ perpendicular to m:
    //   ξ - (m + n) (ξ·n)/(1 + m·n)
    // then the turn about n: ξ cos α + (n × ξ) sin α; what round-off leaves along n is taken away.
    let m = &before.normal;
    let (sine, cosine) = twist.sin_cos();
    let turn = |spring: &Vec3| {
        let turned = spring - (m + n) * (spring.dot(n) / (1.0 + m.dot(n)));
        in_plane(&(turned * cosine + n.cross(&turned) * sine), n)
    };
    ContactMemory {
        normal: *n,
        spring: turn(&before.spring),
        rolling: turn(&before.rolling),
        overlap: before.overlap,
    }
}

/// Spring and dashpot together, at most `limit`; beyond it the spring slips until both are at it.
fn limited(spring: &mut Vec3, stiffness: f64, dashpot: &Vec3, limit: f64) -> Vec3 {
    let wanted = stiffness * *spring + dashpot;
    let size = wanted.norm();
    if size <= limit {
        return wanted;
    }
    let allowed = wanted * (limit / size);
    *spring = (allowed - dashpot) / stiffness;
    allowed
}

/// The part of `vector` perpendicular to the unit vector `n`.
pub(super) fn in_plane(vector: &Vec3, n: &Vec3) -> Vec3 {
    vector - n * vector.dot(n)
}
