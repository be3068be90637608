"""Force on a sphere that oscillates within a concentric spherical shell at rest, over that in unbounded fluid.

Unsteady Stokes flow, density 1, radius 1. With u_r = f(r) cos(theta) e^(i omega t) and k = sqrt(i omega/nu),
f = c1 + c2/r^3 + c3 e^(-kr)(1 + kr)/r^3 + c4 (kr cosh kr - sinh kr)/r^3; no slip: f = 1, f' = 0 on the sphere, f = f' = 0 on the
shell. Pressure -i omega (c1 r - c2/(2 r^2)) cos(theta), so that the force is -4 pi/3 (-i omega)(c1 - c2/2) + 4 pi nu f''(1)/3.
Without the shell it is that of Landau & Lifshitz, Fluid Mechanics, section 24, problem 5. Needs mpmath.
"""

from mpmath import cosh, diff, exp, lu_solve, matrix, mp, pi, sinh, sqrt

mp.dps = 30


def parts(layer, shell):
    nu, omega = mp.mpf(layer) ** 2 / 2, 1
    k = sqrt(1j * omega / nu)
    terms = [
        lambda r: mp.mpf(1),
        lambda r: 1 / r**3,
        lambda r: exp(-k * (r - 1)) * (1 + k * r) / r**3,
        lambda r: (k * r * cosh(k * r) - sinh(k * r)) / cosh(k * shell) / r**3,
    ]
    rows = [[diff(term, r, n) for term in terms] for r, n in [(1, 0), (1, 1), (shell, 0), (shell, 1)]]
    c = lu_solve(matrix(rows), matrix([1, 0, 0, 0]))
    bend = sum(c[i] * diff(terms[i], 1, 2) for i in range(4))
    force = -4 * pi / 3 * (-1j * omega) * (c[0] - c[1] / 2) + 4 * pi * nu / 3 * bend
    with_velocity = 6 * pi * nu * (1 + 1 / mp.mpf(layer))
    with_acceleration = 3 * pi * layer * (1 + 2 / (9 * mp.mpf(layer)))
    return -force.real / with_velocity, -force.imag / with_acceleration


print("layer_radii,box_radii,shell,shell_radii,velocity_part,acceleration_part")
for layer in (0.5, 1):
    for box in (8, 12, 16):
        half = mp.mpf(box) / 2
        for name, radius in [("inscribed", half), ("equal_volume", 2 * half * (3 / (4 * pi)) ** (mp.mpf(1) / 3)), ("circumscribed", half * sqrt(3))]:
            print(layer, box, name, mp.nstr(radius, 6), *(mp.nstr(part, 7) for part in parts(layer, radius)), sep=",")
