"""A free sphere that starts to move or to spin in a fluid at rest, unbounded, in Stokes flow: exact curves.

Sphere of radius a, r times as dense as the fluid; T = nu t/a^2, p its Laplace variable, q = sqrt(p). At T = 0 the
fluid is at rest everywhere outside the sphere, which has the velocity v0 or the angular velocity w0.

Spin. The torque on a sphere whose angular velocity has the transform w is, with the fluid at rest before
(G. G. Stokes 1851 for oscillations; L. D. Landau & E. M. Lifshitz, Fluid Mechanics, section 24, problem 6),
    -8 pi mu a^3 w (3 + 3 q + q^2)/(3 (1 + q)),
so that with the moment of inertia 8/15 pi rho_s a^5
    w/w0 = r (1 + q)/(r q^3 + (r + 5) q^2 + 15 q + 15).

Translation. Stokes, Basset and added mass together (R. Clift, J. R. Grace & M. E. Weber, Bubbles, Drops and
Particles (1978), ch. 11): the force is -6 pi mu a v (1 + q + q^2/9), the impulse of the sudden start
contained, so that
    v/v0 = r/((r + 1/2) q^2 + 9/2 (q + 1)):
the fluid that must give way takes its share at once, v(0+) = r v0/(r + 1/2).

Both are sums of c_i/(q - q_i) over the roots of the denominator, sum c_i = 0, whose originals are
c_i q_i exp(q_i^2 T) erfc(-q_i sqrt(T)). The table is made from these, with 30 digits, and checked against a
numerical inversion (Talbot) of the transforms as they stand.

    python3 golden/free_start/exact.py > golden/free_start/exact.csv
"""

from mpmath import erfc, exp, invertlaplace, mp, mpf, nstr, polyroots, polyval, sqrt

mp.dps = 30
RATIOS = ["1", "2.65"]
TIMES = ["0.02", "0.05", "0.1", "0.2", "0.3"]


def original(numerator, denominator, time):
    """The original of numerator(q)/denominator(q) at `time`; coefficients with the highest power first."""
    slope = [c * (len(denominator) - 1 - i) for i, c in enumerate(denominator[:-1])]
    total = mpf(0)
    for root in polyroots(denominator, maxsteps=200, extraprec=100):
        part = polyval(numerator, root) / polyval(slope, root)
        total += part * root * exp(root**2 * time) * erfc(-root * sqrt(time))
    return total.real


def main():
    print("# A free sphere that starts to move or to spin in an unbounded fluid at rest; T = nu t/a^2.")
    print("# Exact: see exact.py. Made by: python3 golden/free_start/exact.py > golden/free_start/exact.csv")
    print("density_ratio,T,spin_over_initial,velocity_over_initial")
    for ratio in RATIOS:
        r = mpf(ratio)
        forms = [
            ([r, r], [r, r + 5, mpf(15), mpf(15)]),
            ([r], [r + mpf(1) / 2, mpf(9) / 2, mpf(9) / 2]),
        ]
        for name in TIMES:
            time = mpf(name)
            row = [ratio, name]
            for numerator, denominator in forms:
                value = original(numerator, denominator, time)
                transform = lambda p: polyval(numerator, sqrt(p)) / polyval(denominator, sqrt(p))
                assert abs(value - invertlaplace(transform, time, method="talbot")) < mpf("1e-12")
                row.append(nstr(value, 8))
            print(",".join(row))


if __name__ == "__main__":
    main()
