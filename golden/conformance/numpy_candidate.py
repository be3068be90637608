#!/usr/bin/env python3
"""A candidate in NumPy: PS-MRT written from the paper and its sources, not from psmrt's Rust.

    python3 numpy_candidate.py KIT OUT [--precision f64|f32|f16-storage] [--mistake NAME] [--stages 0-8]

Reads the problems of KIT and writes answers to OUT. It is a third opinion on the oracle, an example for
your own candidate, and, with --mistake, the patient on which the judge's diagnosis is tested: each name
of `psmrt conformance mistakes` plants that one mistake; for several names, with commas between them, it answers
once for each. Answers with a mistake go to OUT/NAME. Cells are the first axis of all arrays, directions
the last.
"""

import argparse
import json
import pathlib
from fractions import Fraction
from functools import reduce
from itertools import product
from math import gcd

import numpy as np

import numpy_coverage as coverage

# D3Q19, numbered in an order of its own: x slowest, z fastest, rest in the middle.
C = np.array([c for c in product((-1, 0, 1), repeat=3) if sum(map(abs, c)) <= 2])
Q = len(C)
AXES = {name: (axis, side) for axis, pair in enumerate(("-x +x", "-y +y", "-z +z"))
        for side, name in enumerate(pair.split())}


MISTAKES = """
    weights_swapped opposites_in_pairs opposites_mirrored moments_not_orthogonal moments_reordered
    equilibrium_linear equilibrium_three equilibrium_without_square optimised_constants
    constant_density eq2_without_tau eq4_without_tau s9_is_tau s_hat_without_blank s_hat_13th
    pi_rate_is_eps pi_rate_is_nu rates_q_and_m_swapped rates_e_and_eps_swapped viscosity_without_third
    viscosity_without_half velocity_without_half_force source_without_half_rate naive_force
    body_force_not_weighted eq5_sign full_bounce_back equilibrium_not_reversed b_is_epsilon b_with_tau fluid_part_not_weighted
    solid_with_half_force solid_at_rest rotation_missing spin_reversed superposition_tau
    other_operator eq5_for_full_bounce_back full_bounce_back_half_velocity
    graded_drag_with_tau graded_drag_without_two graded_drag_of_noble_torczynski graded_viscosity_of_fluid
    graded_odd_rate_of_fluid graded_odd_rate_without_open graded_full_cell_kept weights_not_shared force_sign force_without_weight torque_arm_not_wrapped
    arm_not_wrapped torque_about_origin torque_reversed coverage_staircase coverage_linear
    radius_is_diameter coverage_not_updated wall_on_node moving_wall_without_two moving_wall_sign
    moving_wall_density_one free_slip_is_no_slip pressure_sign pressure_without_velocity
    faces_ignored streaming_reversed stream_before_collision contact_pulls contact_damping_sign
    slip_without_spin coulomb_missing arms_are_radii second_torque_reversed drag_law_printed
    settling_reynolds_printed bed_is_a_cube
""".split()
NUMBERS = {tuple(c): a for a, c in enumerate(C.tolist())}


def number_of(c):
    return NUMBERS[tuple(int(component) for component in c)]


def raw_moments():
    """The nineteen monomials of d'Humieres et al. (2002), before they are orthogonalised."""
    rows = []
    for x, y, z in C.tolist():
        c2 = x * x + y * y + z * z
        rows.append([1, c2, c2 * c2, x, c2 * x, y, c2 * y, z, c2 * z, 3 * x * x - c2,
                     c2 * (3 * x * x - c2), y * y - z * z, c2 * (y * y - z * z), x * y, y * z, x * z,
                     x * (y * y - z * z), y * (z * z - x * x), z * (x * x - y * y)])
    return np.array(rows).T


def orthogonal_moments():
    """Their Gram-Schmidt orthogonalisation, in exact fractions, each row in its smallest integers."""
    done = []
    for monomial in raw_moments().tolist():
        row = [Fraction(value) for value in monomial]
        for other in done:
            share = Fraction(sum(a * b for a, b in zip(monomial, other)), sum(b * b for b in other))
            row = [a - share * b for a, b in zip(row, other)]
        scale = reduce(lambda a, b: a * b // gcd(a, b), (value.denominator for value in row))
        whole = [int(value * scale) for value in row]
        done.append([value // reduce(gcd, whole) for value in whole])
    return np.array(done)


class Candidate:
    def __init__(self, precision="f64", mistake=None):
        self.mistake = mistake
        self.half = precision == "f16-storage"
        self.real = np.float64 if precision == "f64" else np.float32
        square = (C * C).sum(axis=1)
        face, edge = (1 / 36, 1 / 18) if self.has("weights_swapped") else (1 / 18, 1 / 36)
        self.w = np.array([1 / 3, face, edge])[square].astype(self.real)
        self.c = C.astype(self.real)
        self.opposite = np.array([self.opposite_of(a) for a in range(Q)])
        matrix = orthogonal_moments()
        if self.has("moments_not_orthogonal"):
            matrix = raw_moments()
        if self.has("moments_reordered"):
            matrix = matrix[[0, 1, 2, 3, 5, 7, 4, 6, 8, 9, 11, 13, 14, 15, 10, 12, 16, 17, 18]]
        self.m = matrix.astype(self.real)
        self.m_inverse = np.linalg.inv(matrix).astype(self.real)

    def has(self, *mistakes):
        return self.mistake in mistakes

    def numbers(self, values):
        return np.asarray(values, dtype=self.real)

    def stored(self, f):
        """Populations as they are kept between steps."""
        return f.astype(np.float16).astype(self.real) if self.half else f

    def opposite_of(self, a):
        c = C[a].copy()
        if self.has("opposites_in_pairs"):
            moving = [k for k in range(Q) if C[k].any()]
            return moving[moving.index(a) ^ 1] if c.any() else a
        if self.has("opposites_mirrored"):
            if c.any():
                c[np.flatnonzero(c)[-1]] *= -1
            return number_of(c)
        return number_of(-c)

    # --- one cell -------------------------------------------------------------------------------

    def conserved(self, f):
        return f.sum(axis=-1), f @ self.c

    def equilibrium(self, rho, u, factor=1.0):
        """f_eq = w rho [1 + 3 c.u + 9/2 (c.u)^2 - 3/2 u^2]"""
        cu = u @ self.c.T
        second = (3 if self.has("equilibrium_three") else 4.5) * cu * cu
        if not self.has("equilibrium_without_square"):
            second = second - 1.5 * (u * u).sum(axis=-1, keepdims=True)
        if self.has("equilibrium_linear"):
            second = 0 * second
        return self.w * rho[..., None] * (1 + 3 * cu + factor * second)

    def equilibrium_moments(self, rho, u):
        factor = rho[..., None] if self.has("constant_density") else 1.0
        m_eq = self.equilibrium(rho, u, factor) @ self.m.T
        if self.has("optimised_constants"):
            m_eq[..., 2] = -475 / 63 * rho * (u * u).sum(axis=-1)
            m_eq[..., [10, 12]] = 0
        return m_eq

    def s_hat(self, rates):
        """The diagonal of S-hat, with the paper's misprints put right; rates[..., k] by RATES."""
        e, eps, q, nu, pi, m = np.moveaxis(self.numbers(rates), -1, 0)
        if self.has("rates_q_and_m_swapped"):
            q, m = m, q
        if self.has("rates_e_and_eps_swapped"):
            e, eps = eps, e
        if self.has("s9_is_tau"):
            nu = 1 / nu
        if self.has("pi_rate_is_eps"):
            pi = eps
        if self.has("pi_rate_is_nu"):
            pi = nu
        return self.diagonal(e, eps, q, nu, pi, m)

    def diagonal(self, e, eps, q, nu, pi, m):
        zero = 0 * e
        thirteenth = nu if self.has("s_hat_13th") else pi
        diagonal = [zero, e, eps, zero, q, zero, q, zero, q, nu, pi, nu, thirteenth, nu, nu, nu, m, m, m]
        if self.has("s_hat_without_blank"):
            diagonal = diagonal[:3] + diagonal[4:] + [zero]
        return np.stack(diagonal, axis=-1)

    def relaxation_time(self, viscosity):
        if self.has("viscosity_without_third"):
            return viscosity + 0.5
        return 3 * viscosity + (0 if self.has("viscosity_without_half") else 0.5)

    def weight(self, epsilon, tau):
        if self.has("b_is_epsilon"):
            return epsilon
        excess = tau if self.has("b_with_tau") else tau - 0.5
        return epsilon * excess / ((1 - epsilon) + excess)

    def graded_weight(self, epsilon, tau):
        if self.has("graded_drag_of_noble_torczynski"):
            return self.weight(epsilon, tau)
        excess = tau if self.has("graded_drag_with_tau") else tau - self.real(0.5)
        k = excess**2 / (4 * excess + self.real(0.4))
        return k * epsilon / ((1 - epsilon) + k * epsilon)

    def share(self, epsilon, tau, weight=None):
        """Weights of the solids (first axis) of each cell, and that of the cell."""
        weight = weight or self.weight
        if self.has("weights_not_shared"):
            weights = weight(epsilon, tau)
            return weights, np.minimum(weights.sum(axis=0), 1)
        total = epsilon.sum(axis=0)
        whole = weight(np.minimum(total, 1), tau)
        return whole * (epsilon / np.where(total > 0, total, 1)), whole

    def omega(self, f, rho, u, rules):
        if rules["s_hat"] is None:
            paper = rules["solid"] and rules["operator"] != "graded_viscosity"
            printed = self.has("eq2_without_tau") or (self.has("eq4_without_tau") and paper)
            rate = 1 if printed else 1 / rules["tau"][..., None]
            return -rate * (f - self.equilibrium(rho, u))
        change = rules["s_hat"] * (f @ self.m.T - self.equilibrium_moments(rho, u))
        return -(change @ self.m_inverse.T)

    def unscaled_source(self, u, g):
        """Guo et al. (2002)"""
        cg = g @ self.c.T
        if self.has("naive_force"):
            return self.w * 3 * cg
        ug = (u * g).sum(axis=-1, keepdims=True)
        return self.w * (3 * (cg - ug) + 9 * (u @ self.c.T) * cg)

    def source(self, u, g, rules):
        """That, scaled by 1 - 1/(2 tau), for MRT by I - S-hat/2 in moment space."""
        source = self.unscaled_source(u, g)
        if self.has("naive_force", "source_without_half_rate"):
            return source
        if rules["s_hat"] is None:
            rate = 1 if self.has("eq2_without_tau") else 1 / rules["tau"][..., None]
            return (1 - rate / 2) * source
        return ((1 - rules["s_hat"] / 2) * (source @ self.m.T)) @ self.m_inverse.T

    def velocity(self, rho, j, g):
        if g is None or self.has("velocity_without_half_force", "naive_force"):
            return j / rho[..., None]
        return (j + g / 2) / rho[..., None]

    def lambda_(self, f, rho, u, u_p, rules):
        """Eq. 5, its sign put right, or one of the other two operators."""
        if self.has("solid_at_rest"):
            u_p = 0 * u_p
        f_eq, solid, back = self.equilibrium(rho, u), self.equilibrium(rho, u_p), self.opposite
        if (rules["operator"] == "superposition") != self.has("other_operator"):
            if self.has("superposition_tau") and rules["s_hat"] is not None:
                return solid - f + (1 - 1 / rules["tau"][..., None]) * (f - f_eq)
            return solid - f_eq + self.omega(f, rho, u, rules)
        whole = rules["operator"] == "full_bounce_back"
        if self.has("full_bounce_back") or (whole and not self.has("eq5_for_full_bounce_back")):
            share = 0.5 if whole and self.has("full_bounce_back_half_velocity") else 1
            return f[..., back] - f + share * (solid - solid[..., back])
        if self.has("eq5_sign"):
            return f[..., back] + f_eq[..., back] + solid - f
        if self.has("equilibrium_not_reversed"):
            return f[..., back] - f_eq + solid - f
        return f[..., back] - f_eq[..., back] + solid - f

    def collide(self, f, rules, epsilon=None, u_p=None):
        """Populations after the collision, and the force on each solid in each cell."""
        rho, j = self.conserved(f)
        g = rules["body_force"]
        u, bare = self.velocity(rho, j, g), j / rho[..., None]
        omega = self.omega(f, rho, u, rules)
        source = 0 * f if g is None else self.source(u, g, rules)
        if epsilon is None:
            return f + omega + source, None
        if rules["operator"] == "graded_viscosity":
            covered = epsilon.sum(axis=0) > 0
            post, forces = self.graded(f, rho, j, rules, epsilon, u_p)
            return np.where(covered[:, None], post, f + omega + source), forces
        weights, total = self.share(epsilon, rules["tau"])
        fluid = 1 - total[..., None]
        if self.has("fluid_part_not_weighted"):
            fluid = np.ones_like(fluid)
        post = f + fluid * omega + (source if self.has("body_force_not_weighted") else fluid * source)
        forces = []
        for fraction, weight, velocity in zip(epsilon, weights, u_p):
            lambda_ = self.lambda_(f, rho, u if self.has("solid_with_half_force") else bare, velocity, rules)
            post = post + weight[..., None] * lambda_
            if self.has("force_without_weight"):
                weight = (fraction > 0).astype(self.real)
            sign = 1 if self.has("force_sign") else -1
            forces.append(sign * weight[..., None] * (lambda_ @ self.c))
        return post, np.array(forces)

    def graded(self, f, rho, j, rules, epsilon, u_p):
        """Cells with solid in them as fluid of graded viscosity, pulled along by the solids."""
        tau, one = rules["tau"], self.real(1)
        weights, total = self.share(epsilon, tau, self.graded_weight)
        g = rules["body_force"] if rules["body_force"] is not None else 0 * j
        force = g if self.has("body_force_not_weighted") else (1 - total[:, None]) * g
        forces = []
        for fraction, weight, velocity in zip(epsilon, weights, u_p):
            pull = (1 if self.has("graded_drag_without_two") else 2) * (rho[:, None] * velocity - j)
            force = force + weight[:, None] * pull
            if self.has("force_without_weight"):
                weight = (fraction > 0).astype(self.real)
            forces.append((1 if self.has("force_sign") else -1) * weight[:, None] * pull)
        filled = np.minimum(epsilon.sum(axis=0), 1)
        excess, free = tau - self.real(0.5), one - filled
        even = free / (free / 2 + excess)  # 1/s - 1/2 = (tau - 1/2)/(1 - epsilon)
        if self.has("graded_viscosity_of_fluid"):
            even = 1 / tau
        left = one if self.has("graded_odd_rate_without_open") else free
        q = m = 1 / (self.real(0.5) + self.real(0.002) * left / excess) + 0 * free
        if self.has("graded_odd_rate_of_fluid"):
            q, m = (1 / tau, 1 / tau) if rules["rates"] is None else rules["rates"].T[[2, 5]]
        s = self.diagonal(even, even, q + 0 * even, even, even, m + 0 * even)
        u = self.velocity(rho, j, force)
        source = self.unscaled_source(u, force) @ self.m.T
        if not self.has("naive_force", "source_without_half_rate"):
            source = (1 - s / 2) * source
        change = s * (self.equilibrium_moments(rho, u) - f @ self.m.T) + source
        post, forces = f + change @ self.m_inverse.T, np.array(forces)
        if self.has("graded_full_cell_kept"):
            full = (filled == 1)[:, None]
            post, forces = np.where(full, f, post), np.where(full, 0, forces)
        return post, forces

    # --- boxes ----------------------------------------------------------------------------------

    def links(self, cells, faces):
        """Where each population comes from: what kind of link, from which cell and direction, and at
        walls and pressure faces with which number."""
        n = np.array(cells)
        places = [(x, y, z) for z in range(n[2]) for y in range(n[1]) for x in range(n[0])]
        index = {place: i for i, place in enumerate(places)}
        shape = (len(places), Q)
        links = {"kind": np.zeros(shape, int), "cell": np.zeros(shape, int), "from": np.zeros(shape, int),
                 "wall": np.zeros(shape), "density": np.zeros(shape)}
        directions = C.tolist()
        sign = 1 if self.has("streaming_reversed") else -1
        periodic = [faces["-" + axis]["kind"] == "periodic" for axis in "xyz"]
        for i, place in enumerate(places):
            for a in range(Q):
                x, y, z = directions[a]
                source = [place[0] + sign * x, place[1] + sign * y, place[2] + sign * z]
                near = index.get(tuple(source))
                if near is not None:  # crosses no face
                    links["cell"][i, a], links["from"][i, a] = near, a
                    continue
                turned, wall, density = [x, y, z], None, None
                for name, (axis, side) in AXES.items():
                    if not (source[axis] < 0 if side == 0 else source[axis] >= n[axis]):
                        continue
                    face = faces[name]
                    kind = face["kind"]
                    if self.has("faces_ignored"):
                        kind = "periodic"
                    if self.has("free_slip_is_no_slip") and kind == "free_slip":
                        kind, face = "wall", {"velocity": [0, 0, 0]}
                    if kind == "free_slip":
                        turned[axis] *= -1
                    if kind in ("wall", "velocity_inlet"):
                        wall = np.add([0, 0, 0] if wall is None else wall, face["velocity"])
                    if kind == "pressure":
                        density = face["density"]
                    if kind == "periodic":
                        source[axis] %= n[axis]
                    else:
                        source[axis] = min(max(source[axis], 0), n[axis] - 1)
                if wall is not None:
                    links["kind"][i, a], links["cell"][i, a] = 1, i
                    links["from"][i, a] = self.opposite[a]
                    links["wall"][i, a] = self.wall_factor() * self.w[a] * (C[a] @ wall)
                    if self.has("wall_on_node"):
                        node = np.add(place, C[a])
                        node = np.where(periodic, node % n, node)
                        links["cell"][i, a] = index.get(tuple(node.tolist()), i)
                elif density is not None:
                    links["kind"][i, a], links["density"][i, a] = 2, density
                else:
                    links["cell"][i, a] = index[tuple(int(s) for s in source)]
                    links["from"][i, a] = number_of(turned)
        return links

    def wall_factor(self):
        return {"moving_wall_without_two": 3, "moving_wall_sign": -6}.get(self.mistake, 6)

    def stream(self, post, links):
        """f_a(x, t + 1) = f*_a(x - c_a, t), and what the faces make of it."""
        f = post[links["cell"], links["from"]]
        rho, j = self.conserved(post)
        density = np.ones_like(rho) if self.has("moving_wall_density_one") else rho
        f = np.where(links["kind"] == 1, f + self.numbers(links["wall"]) * density[:, None], f)
        u = j / rho[:, None]
        cu = u @ self.c.T
        second = 4.5 * cu * cu - 1.5 * (u * u).sum(axis=1, keepdims=True)
        if self.has("pressure_without_velocity"):
            second = 0 * second
        back = post[:, self.opposite] * (1 if self.has("pressure_sign") else -1)
        pressure = back + 2 * self.w * self.numbers(links["density"]) * (1 + second)
        return np.where(links["kind"] == 2, pressure, f)

    def cover(self, parameters, solid):
        """Solid fraction of each cell, the arm from the nearest image, and the arm as it is."""
        nx, ny, nz = parameters["cells"]
        z, y, x = np.meshgrid(np.arange(nz), np.arange(ny), np.arange(nx), indexing="ij")
        centres = np.stack([x, y, z], axis=-1).reshape(-1, 3) + 0.5
        raw = centres - np.array(solid["centre"])
        arm = raw.copy()
        for axis, name in enumerate("xyz"):
            if parameters["faces"]["-" + name]["kind"] == "periodic":
                length = parameters["cells"][axis]
                arm[:, axis] -= length * np.round(arm[:, axis] / length)
        return self.fraction(-arm, solid["radius"]), arm, raw

    def fraction(self, offset, radius):
        distance = np.sqrt((offset * offset).sum(axis=-1))
        if self.has("coverage_staircase"):
            return (distance <= radius).astype(float)
        if self.has("coverage_linear"):
            return np.clip(radius - distance + 0.5, 0, 1)
        return coverage.fraction(offset, radius / 2 if self.has("radius_is_diameter") else radius)

    def run(self, parameters, f):
        """The end of a scene: populations, and force and torque on each solid in the last step."""
        tau = parameters.get("tau")
        if tau is None:
            tau = self.relaxation_time(parameters["viscosity"])
        rates = parameters.get("rates")
        if rates is not None:
            rates = [{"nu": 1 / tau, **rates}[name] for name in ("e", "eps", "q", "nu", "pi", "m")]
        g = parameters["body_force"]
        solids = [dict(solid) for solid in parameters["solids"]]
        rules = {
            "tau": np.full(len(f), tau, dtype=self.real),
            "s_hat": None if rates is None else self.s_hat(rates),
            "rates": None if rates is None else np.tile(self.numbers(rates), (len(f), 1)),
            "body_force": None if g is None else self.numbers(g),
            "operator": parameters.get("operator"),
            "solid": bool(solids),
        }
        links = self.links(parameters["cells"], parameters["faces"])
        covers = [self.cover(parameters, solid) for solid in solids]
        f, loads = self.stored(f), []
        for _ in range(parameters["steps"]):
            if self.has("stream_before_collision"):
                f = self.stream(f, links)
            f, loads = self.collide_box(f, rules, solids, covers)
            if not self.has("stream_before_collision"):
                f = self.stream(f, links)
            f = self.stored(f)
            if any(any(solid["velocity"]) for solid in solids):
                for solid in solids:
                    solid["centre"] = np.add(solid["centre"], solid["velocity"])
                if not self.has("coverage_not_updated"):
                    covers = [self.cover(parameters, solid) for solid in solids]
        return f, loads

    def collide_box(self, f, rules, solids, covers):
        if not solids:
            return self.collide(f, rules)[0], []
        velocities = [self.solid_velocity(s, raw if self.has("arm_not_wrapped") else arm)
                      for s, (_, arm, raw) in zip(solids, covers)]
        epsilon = self.numbers([fraction for fraction, _, _ in covers])
        f, forces = self.collide(f, rules, epsilon, velocities)
        loads = []
        for solid, (_, arm, raw), force in zip(solids, covers, forces):
            if self.has("arm_not_wrapped", "torque_arm_not_wrapped"):
                arm = raw
            if self.has("torque_about_origin"):
                arm = raw + np.array(solid["centre"])
            torque = np.cross(self.numbers(arm), force)
            if self.has("torque_reversed"):
                torque = -torque
            loads.append((force.sum(axis=0), torque.sum(axis=0)))
        return f, loads

    def solid_velocity(self, solid, arm):
        velocity, spin = self.numbers(solid["velocity"]), self.numbers(solid["spin"])
        turning = np.cross(spin, self.numbers(arm))
        turning = {"rotation_missing": 0 * turning, "spin_reversed": -turning}.get(self.mistake, turning)
        return velocity + turning

    # --- answers, by kind of problem ------------------------------------------------------------

    def constants(self, parameters, given):
        rates = [parameters["rates"][name] for name in ("e", "eps", "q", "nu", "pi", "m")]
        return {"directions": C, "weights": self.w, "opposites": self.opposite, "moment_matrix": self.m,
                "s_hat": self.s_hat(rates), "relaxation_time": self.relaxation_time(given["viscosity"])}

    def moments(self, parameters, given):
        rho, j = self.conserved(given["f"])
        return {"density": rho, "momentum": j, "moments": given["f"] @ self.m.T,
                "equilibrium": self.equilibrium(given["rho"], given["u"]),
                "equilibrium_moments": self.equilibrium_moments(given["rho"], given["u"])}

    def collisions(self, parameters, given):
        solid = "epsilon" in given
        rules = {"tau": given["tau"], "body_force": given.get("body_force"), "solid": solid,
                 "s_hat": self.s_hat(given["rates"]) if "rates" in given else None,
                 "rates": given.get("rates"),
                 "operator": parameters.get("operator")}
        f = self.stored(given["f"])
        if not solid:
            return {"post": self.stored(self.collide(f, rules)[0])}
        post, force = self.collide(f, rules, given["epsilon"][None], given["u_p"][None])
        return {"post": self.stored(post), "force": force[0]}

    def solid_fractions(self, parameters, given):
        spheres = zip(given["offset"].astype(float), given["radius"].astype(float))
        return {"solid_fraction": np.array([self.fraction(o[None], r)[0] for o, r in spheres])}

    def weights(self, parameters, given):
        return {"weight": self.weight(given["epsilon"], given["tau"])}

    def shared_weights(self, parameters, given):
        return {"weight": self.share(given["epsilon"].T, given["tau"])[0].T}

    def streaming(self, parameters, given):
        shape = given["post"].shape
        links = self.links(parameters["cells"], parameters["faces"])
        f = self.stored(self.stream(self.stored(given["post"].reshape(-1, Q)), links))
        return {"populations": f.reshape(shape)}

    def scene(self, parameters, given):
        shape = given["populations"].shape
        f, loads = self.run(parameters, given["populations"].reshape(-1, Q))
        g = parameters["body_force"]
        u = self.velocity(*self.conserved(f), None if g is None else self.numbers(g))[:, 0]
        (nx, ny, _), found = parameters["cells"], {"populations": f.reshape(shape)}
        found["velocity_profile"] = u[: nx * ny : nx]
        found["mean_velocity"] = u.mean()
        if loads:
            force, torque = zip(*loads)
            found.update(force=np.array(force), torque=np.array(torque), drag=np.array(force)[:, 0].sum())
        if "amplitude" in parameters:
            k = 2 * np.pi / ny
            sine = np.sin(k * (np.repeat(np.arange(ny), nx) + 0.5))
            now = 2 / len(u) * (u * self.numbers(sine)).sum()
            found["viscosity"] = -np.log(now / parameters["amplitude"]) / (k * k * parameters["steps"])
        return found

    def contacts(self, parameters, given):
        first, second = given["radii"].T[..., None]
        distance = np.sqrt((given["offset"] ** 2).sum(axis=1, keepdims=True))
        n = given["offset"] / distance
        overlap = first + second - distance
        if parameters["plane"]:
            arms = (first if self.has("arms_are_radii") else distance, 0 * first)
        else:
            half = 0 if self.has("arms_are_radii") else overlap / 2
            arms = (first - half, second - half)
        spins = given["spin_first"], given["spin_second"]
        u = given["velocity_first"] - given["velocity_second"]
        if not self.has("slip_without_spin"):
            u = u + np.cross(arms[0] * spins[0] + arms[1] * spins[1], n)
        along = (u * n).sum(axis=1, keepdims=True)
        sign = -1 if self.has("contact_damping_sign") else 1
        normal = given["stiffness"][:, None] * overlap + sign * given["damping"][:, None] * along
        pushing = np.maximum(normal, 0)
        force = -(normal if self.has("contact_pulls") else pushing) * n
        if parameters["friction"]:
            wanted = (given["tangential_stiffness"][:, None] * given["spring"]
                      + given["tangential_damping"][:, None] * (u - along * n))
            if not self.has("coulomb_missing"):
                wanted = limited(wanted, given["friction"][:, None] * pushing)
            force = force - wanted
        turn = np.cross(n, force)
        back = -1 if self.has("second_torque_reversed") else 1
        torques = [arms[0] * turn, back * arms[1] * turn]
        if parameters["rolling"]:
            radius = first * second / (first + second)
            spin = spins[0] - spins[1]
            spin = spin - (spin * n).sum(axis=1, keepdims=True) * n
            couple = radius**2 * (given["rolling_stiffness"][:, None] * given["rolling_spring"]
                                  + given["rolling_damping"][:, None] * spin)
            couple = limited(couple, given["rolling_friction"][:, None] * radius * pushing)
            torques = [torques[0] - couple, torques[1] + couple]
        return {"force": force, "torque": np.stack(torques, axis=1)}

    def formulas(self, parameters, given):
        re = given["reynolds"]
        root = re**-0.5 if self.has("drag_law_printed") else re**0.5
        settling, bed = parameters["settling"], parameters["bed"]
        number = settling["diameter_m"] * settling["velocity_m_per_s"] / settling["viscosity_m2_per_s"]
        volume = bed["spheres"] * np.pi * bed["diameter"] ** 3 / 6
        x, y = bed["sides"]
        length = volume / ((1 - bed["porosity"]) * x * y)
        return {"drag_coefficient": 24 / re + 6 / (1 + root) + 0.4,
                "settling_reynolds": 0.3 if self.has("settling_reynolds_printed") else number,
                "bed_length": x if self.has("bed_is_a_cube") else length}


def limited(wanted, limit):
    size = np.sqrt((wanted * wanted).sum(axis=1, keepdims=True))
    return np.where(size > limit, wanted * (limit / np.where(size > 0, size, 1)), wanted)


def answer(kit, manifest, out, precision, mistake, stages):
    candidate = Candidate(precision, mistake)
    kit_order = [tuple(c) for c in manifest["directions"]]
    columns = [kit_order.index(tuple(c)) for c in C.tolist()]  # the kit's directions in my order
    out.mkdir(parents=True)  # fails if it is there: nothing is overwritten
    own = {"name": "NumPy candidate", "precision": precision, "directions": C.tolist(),
           "kit_version": manifest["kit_version"]}
    (out / "manifest.json").write_text(json.dumps(own))
    for problem in manifest["problems"]:
        if problem["stage"] not in stages:
            continue
        given = {}
        for entry in problem["given"]:
            array = np.load(kit / entry["file"])
            if entry["axes"][-1] == "direction":
                array = array[..., columns]
            given[entry["name"]] = candidate.numbers(array)
        with np.errstate(all="ignore"):  # a planted mistake may blow up
            found = getattr(candidate, problem["kind"])(problem["parameters"], given)
        (out / problem["id"]).mkdir()
        for entry in problem["asked"]:
            np.save(out / problem["id"] / (entry["name"] + ".npy"), np.asarray(found[entry["name"]]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("kit", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--precision", default="f64", choices=["f64", "f32", "f16-storage"])
    parser.add_argument("--mistake", help="names with commas between them; see above")
    parser.add_argument("--stages", default="0-8")
    arguments = parser.parse_args()
    first, _, last = arguments.stages.partition("-")
    stages = range(int(first), int(last or first) + 1)
    manifest = json.loads((arguments.kit / "manifest.json").read_text())
    if arguments.mistake is None:
        answer(arguments.kit, manifest, arguments.out, arguments.precision, None, stages)
        return
    for mistake in arguments.mistake.split(","):
        if mistake not in MISTAKES:
            parser.error(f"there is no mistake {mistake}; there are {', '.join(MISTAKES)}")
        out = arguments.out / mistake
        answer(arguments.kit, manifest, out, arguments.precision, mistake, stages)


if __name__ == "__main__":
    main()
