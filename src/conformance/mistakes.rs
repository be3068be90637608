//! The catalogue of single mistakes that the judge knows: those that people really make, and every
//! misprint of the paper.

/// What is known about a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The mistake.
    pub mistake: Mistake,
    /// Its name.
    pub name: &'static str,
    /// What is wrong.
    pub what: &'static str,
    /// The equation to look at, in its right form.
    pub look_at: &'static str,
}

impl Mistake {
    /// Its entry in the catalogue.
    pub fn entry(self) -> &'static Entry {
        // Both are made of one list, in its order.
        &CATALOGUE[self as usize]
    }
}

/// Makes the list of mistakes and the catalogue of one list: of each mistake its variant, its name, what is wrong, and
/// the equation to look at.
macro_rules! catalogue {
    ($($variant:ident, $name:literal, $what:literal, $look_at:literal;)*) => {
        /// A mistake.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Mistake {
            $(#[doc = $what] $variant,)*
        }

        /// All mistakes, in the order of the problems that show them first.
        pub const CATALOGUE: [Entry; [$($name),*].len()] = [$(Entry {
            mistake: Mistake::$variant,
            name: $name,
            what: $what,
            look_at: $look_at,
        }),*];
    };
}

catalogue! {
    WeightsSwapped, "weights_swapped",
        "the weights of faces and edges are swapped",
        "D3Q19: w = 1/3 at rest, 1/18 for |c| = 1, 1/36 for |c|^2 = 2";
    OppositesInPairs, "opposites_in_pairs",
        "the opposite of a direction is taken to be its neighbour in pairs 1-2, 3-4, ... of your numbering",
        "c_-a = -c_a, looked up for your own order";
    OppositesMirrored, "opposites_mirrored",
        "the opposite of an edge direction is mirrored along one axis only",
        "c_-a = -c_a: all components change sign";
    MomentsNotOrthogonal, "moments_not_orthogonal",
        "the rows of M are plain monomials, not orthogonalised, but relax with the same rates",
        "M of d'Humieres et al. (2002), the paper's reference 4";
    MomentsReordered, "moments_reordered",
        "the rows of M are grouped (j_x j_y j_z, q_x q_y q_z, stresses, pi), S-hat is in d'Humieres' order",
        "M and S-hat of Eq. 3 need one order of moments";
    EquilibriumLinear, "equilibrium_linear",
        "the equilibrium has no terms of second order in u",
        "f_eq = w rho (1 + 3 c.u + 9/2 (c.u)^2 - 3/2 u^2)";
    EquilibriumThree, "equilibrium_three",
        "3 (c.u)^2 stands for 9/2 (c.u)^2 in the equilibrium",
        "f_eq = w rho (1 + 3 c.u + 9/2 (c.u)^2 - 3/2 u^2)";
    EquilibriumWithoutSquare, "equilibrium_without_square",
        "-3/2 u^2 is missing in the equilibrium",
        "f_eq = w rho (1 + 3 c.u + 9/2 (c.u)^2 - 3/2 u^2)";
    OptimisedConstants, "optimised_constants",
        "the equilibrium moments have d'Humieres' optimised constants (0, -475/63, 0)",
        "m_eq = M f_eq: (w_eps, w_epsj, w_xx) = (3, -11/2, -1/2)";
    ConstantDensity, "constant_density",
        "j^2 is divided by a constant density in the equilibrium moments",
        "m_eq: j^2/rho with the density of the cell";
    Eq2WithoutTau, "eq2_without_tau",
        "the factor 1/tau of SRT is missing",
        "Eq. 2: Omega = -(f - f_eq)/tau";
    Eq4WithoutTau, "eq4_without_tau",
        "the factor 1/tau of PS-SRT is missing, as printed",
        "Eq. 4, misprinted: -(I - B)(f - f_eq)/tau";
    S9IsTau, "s9_is_tau",
        "the rate of the stress is tau, as printed",
        "section 2, misprinted: s9 = 1/tau";
    SHatWithoutBlank, "s_hat_without_blank",
        "the blank 4th entry of S-hat is left out, so later rates slip by one",
        "S-hat of section 2, misprinted: 19 entries, the 4th is 0";
    SHat13th, "s_hat_13th",
        "the 13th entry of S-hat is s9, as printed",
        "S-hat of section 2, misprinted: the 13th is that of the 11th";
    PiRateIsEps, "pi_rate_is_eps",
        "pi_xx and pi_ww relax with the rate of eps, as the paper's s2 for both says",
        "S-hat: the 11th and 13th entries have a rate of their own, s_pi";
    PiRateIsNu, "pi_rate_is_nu",
        "pi_xx and pi_ww relax with the rate of the stress",
        "S-hat: the 11th and 13th entries have a rate of their own, s_pi";
    RatesQAndMSwapped, "rates_q_and_m_swapped",
        "the rates of q and m are swapped",
        "S-hat of Eq. 3: s4 for q, s16 for m";
    RatesEAndEpsSwapped, "rates_e_and_eps_swapped",
        "the rates of e and eps are swapped",
        "S-hat of Eq. 3: s1 for e, s2 for eps";
    ViscosityWithoutThird, "viscosity_without_third",
        "tau = nu + 1/2: the factor 3 is missing",
        "section 2: nu = (tau - 1/2)/3";
    ViscosityWithoutHalf, "viscosity_without_half",
        "tau = 3 nu: the 1/2 is missing",
        "section 2: nu = (tau - 1/2)/3";
    VelocityWithoutHalfForce, "velocity_without_half_force",
        "the velocity is j/rho where a body force acts",
        "Guo et al. (2002): u = (j + G/2)/rho";
    SourceWithoutHalfRate, "source_without_half_rate",
        "the source is not scaled by 1 - 1/(2 tau) (MRT: I - S-hat/2)",
        "Guo et al. (2002); M^-1 (I - S-hat/2) M F";
    NaiveForce, "naive_force",
        "the body force is 3 w c.G, with u = j/rho",
        "Guo et al. (2002): u = (j + G/2)/rho and the full source";
    BodyForceNotWeighted, "body_force_not_weighted",
        "the body force acts in full in cells with solid",
        "f* = f + (1 - B)(Omega + source) + B Lambda";
    Eq5Sign, "eq5_sign",
        "+ f_eq_-a(rho, u), as printed",
        "Eq. 5, misprinted: Lambda = f_-a - f_eq_-a(rho, u) + f_eq_a(rho, u_p) - f_a";
    FullBounceBack, "full_bounce_back",
        "all of f is bounced back, not its non-equilibrium part",
        "Eq. 5 and the sentence after it: f_-a - f_eq_-a(rho, u) + f_eq_a(rho, u_p) - f_a";
    EquilibriumNotReversed, "equilibrium_not_reversed",
        "the fluid's equilibrium in Lambda is that of the direction itself, not of the opposite one",
        "Eq. 5, corrected: Lambda_a = f_-a - f_eq_-a(rho, u) + f_eq_a(rho, u_p) - f_a";
    BIsEpsilon, "b_is_epsilon",
        "the weight is the solid fraction itself, not weighted by tau",
        "B = epsilon (tau - 1/2)/[(1 - epsilon) + (tau - 1/2)]";
    BWithTau, "b_with_tau",
        "tau stands for tau - 1/2 in the weight",
        "B = epsilon (tau - 1/2)/[(1 - epsilon) + (tau - 1/2)]";
    FluidPartNotWeighted, "fluid_part_not_weighted",
        "the fluid's collision lacks its factor 1 - B",
        "Eqs. 4 and 6: (I - B) Omega";
    SolidWithHalfForce, "solid_with_half_force",
        "inside Lambda the velocity is (j + G/2)/rho",
        "Eq. 5: u = j/rho";
    SolidAtRest, "solid_at_rest",
        "Lambda has u_p = 0 whatever the solid does",
        "Eq. 5: f_eq(rho, u_p)";
    RotationMissing, "rotation_missing",
        "u_p has no part from rotation",
        "u_p = U + omega x r";
    SpinReversed, "spin_reversed",
        "u_p = U + r x omega",
        "u_p = U + omega x r";
    SuperpositionTau, "superposition_tau",
        "under MRT the superposition operator relaxes with 1 - 1/tau",
        "Lambda = f_eq(rho, u_p) - f_eq(rho, u) + Omega, Omega of Eq. 3";
    OtherOperator, "other_operator",
        "the two solid operators are taken for each other",
        "the parameter operator of the problem";
    Eq5ForFullBounceBack, "eq5_for_full_bounce_back",
        "under full bounce-back only the non-equilibrium part is bounced back, as in Eq. 5",
        "full bounce-back: Lambda_a = f_-a - f_eq_-a(rho, u_p) + f_eq_a(rho, u_p) - f_a";
    FullBounceBackHalfVelocity, "full_bounce_back_half_velocity",
        "under full bounce-back 3 w rho c.u_p stands for 6 w rho c.u_p",
        "full bounce-back: f_eq_a(rho, u_p) - f_eq_-a(rho, u_p) = 6 w rho c.u_p";
    GradedDragWithTau, "graded_drag_with_tau",
        "in the drag of graded viscosity tau stands for tau - 1/2",
        "graded viscosity: B/(1 - B) = k epsilon/(1 - epsilon), k = (tau - 1/2)^2/(4 (tau - 1/2) + 0.4)";
    GradedDragWithoutTwo, "graded_drag_without_two",
        "the drag of graded viscosity lacks its factor 2",
        "graded viscosity: F = (1 - B) G + sum_s 2 B_s (rho u_p - j), and -2 B_s (rho u_p - j) on the solid";
    GradedDragOfNobleTorczynski, "graded_drag_of_noble_torczynski",
        "the drag of graded viscosity has Noble and Torczynski's weight",
        "graded viscosity: B/(1 - B) = k epsilon/(1 - epsilon), k = (tau - 1/2)^2/(4 (tau - 1/2) + 0.4)";
    GradedViscosityOfFluid, "graded_viscosity_of_fluid",
        "even moments of a cut cell relax with 1/tau: its viscosity is not divided by 1 - epsilon",
        "graded viscosity, even moments: 1/s - 1/2 = (tau - 1/2)/(1 - epsilon)";
    GradedOddRateOfFluid, "graded_odd_rate_of_fluid",
        "odd moments of a cut cell relax with the rates of the fluid",
        "graded viscosity, odd moments: 1/s - 1/2 = 0.002 (1 - epsilon)/(tau - 1/2)";
    GradedOddRateWithoutOpen, "graded_odd_rate_without_open",
        "the odd rates of a cut cell lack 1 - epsilon: their product with the even ones is not 0.002",
        "graded viscosity, odd moments: 1/s - 1/2 = 0.002 (1 - epsilon)/(tau - 1/2)";
    GradedFullCellKept, "graded_full_cell_kept",
        "under graded viscosity the populations of a full cell stay as they are, and nothing acts on the solid",
        "graded viscosity: a full cell has the rates 0 and 2, which turns every population back";
    WeightsNotShared, "weights_not_shared",
        "two solids in a cell are weighed each by itself",
        "B_s = B(min(1, sum epsilon), tau) epsilon_s/sum epsilon";
    ForceSign, "force_sign",
        "the force on the solid has the wrong sign",
        "F = -sum B sum_a Lambda_a c_a";
    ForceWithoutWeight, "force_without_weight",
        "the force on the solid is not weighted by B",
        "F = -sum B sum_a Lambda_a c_a";
    TorqueArmNotWrapped, "torque_arm_not_wrapped",
        "the torque's arm is not that of the nearest image",
        "T = sum r x F, r from the nearest periodic image of the centre";
    ArmNotWrapped, "arm_not_wrapped",
        "the arm is not that of the nearest image, in the torque and in u_p",
        "r from the nearest periodic image of the centre";
    TorqueAboutOrigin, "torque_about_origin",
        "the torque is taken about the origin",
        "T = sum r x F, r from the solid's centre";
    TorqueReversed, "torque_reversed",
        "the torque is F x r",
        "T = sum r x F";
    CoverageStaircase, "coverage_staircase",
        "a cell is full if its centre is in the sphere, else empty",
        "epsilon = volume of the sphere in the cell";
    CoverageLinear, "coverage_linear",
        "the solid fraction is a - |r| + 1/2, cut to 0..1",
        "epsilon = volume of the sphere in the cell";
    RadiusIsDiameter, "radius_is_diameter",
        "the radius is taken for a diameter",
        "epsilon = volume of the sphere in the cell, a its radius";
    CoverageNotUpdated, "coverage_not_updated",
        "the cells that a moving solid covers stay those of the start",
        "a step ends by moving the solids and covering the cells anew";
    WallOnNode, "wall_on_node",
        "bounce-back acts at the outermost node: the wall is off by half a cell",
        "half-way bounce-back: f_a(x, t+1) = f*_-a(x, t)";
    MovingWallWithoutTwo, "moving_wall_without_two",
        "the term of the moving wall lacks its factor 2",
        "f_a = f*_-a + 2 w_a rho c_a.u_w/c_s^2";
    MovingWallSign, "moving_wall_sign",
        "the term of the moving wall has the wrong sign",
        "f_a = f*_-a + 2 w_a rho c_a.u_w/c_s^2, c_a pointing into the fluid";
    MovingWallDensityOne, "moving_wall_density_one",
        "the term of the moving wall has a constant density",
        "f_a = f*_-a + 2 w_a rho c_a.u_w/c_s^2, rho of the cell";
    FreeSlipIsNoSlip, "free_slip_is_no_slip",
        "free slip is done as a wall at rest",
        "specular reflection: only the component across the face turns round";
    PressureSign, "pressure_sign",
        "the pressure face bounces back instead of anti-bouncing back",
        "f_a = -f*_-a + 2 w_a rho_w (1 + 9/2 (c_a.u)^2 - 3/2 u^2)";
    PressureWithoutVelocity, "pressure_without_velocity",
        "the pressure face lacks the terms in u",
        "f_a = -f*_-a + 2 w_a rho_w (1 + 9/2 (c_a.u)^2 - 3/2 u^2)";
    FacesIgnored, "faces_ignored",
        "every face is periodic",
        "the table of faces in the kit's README";
    StreamingReversed, "streaming_reversed",
        "populations stream against their direction",
        "Eq. 1: f_a(x + c_a, t + 1) = f*_a(x, t)";
    StreamBeforeCollision, "stream_before_collision",
        "the step streams first and collides then",
        "a step: collide, stream, move the solids";
    ContactPulls, "contact_pulls",
        "the normal force may pull",
        "F_n = max(0, k delta + gamma u.n)";
    ContactDampingSign, "contact_damping_sign",
        "the normal dashpot has the wrong sign",
        "F_n = max(0, k delta + gamma u.n), u of the first relative to the second, n from the first to the second";
    SlipWithoutSpin, "slip_without_spin",
        "the velocity at the contact has no part from the spins",
        "u = v_1 - v_2 + (a_1 omega_1 + a_2 omega_2) x n";
    CoulombMissing, "coulomb_missing",
        "the tangential force has no limit",
        "|F_t| <= mu F_n";
    ArmsAreRadii, "arms_are_radii",
        "the arms are the radii, not the distances to the point of contact",
        "a = R - delta/2";
    SecondTorqueReversed, "second_torque_reversed",
        "the torque on the second body is minus that on the first",
        "T_2 = (-a_2 n) x (-F): the same sign as T_1";
    DragLawPrinted, "drag_law_printed",
        "the drag law has Re^-0.5, as printed",
        "section 5, misprinted: 6/(1 + Re^0.5)";
    SettlingReynoldsPrinted, "settling_reynolds_printed",
        "the Reynolds number of settling is 0.3, as printed",
        "section 7, misprinted: Re = d v/nu";
    BedIsACube, "bed_is_a_cube",
        "the bed has a third side of 128 cells, as the printed size suggests",
        "section 6, misprinted: N pi d^3/6 = (1 - n) x y L";
}
