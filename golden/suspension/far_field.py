"""Settling of random suspensions in a periodic cube, in the far field alone: an independent computation.

The mobility of N equal spheres by the tensor of Rotne, Prager and Yamakawa, summed over all periodic
images (C. W. J. Beenakker, J. Chem. Phys. 85, 1581 (1986)): every pair of spheres is exact in the first two
orders of radius over distance; stresslets and lubrication are left out, which makes them settle a few per
cent too fast (nothing at small solid fractions, 8 % at 0.1, more beyond). The spheres are where
tests/common/suspension.rs puts them. Of an infinite random suspension of hard spheres the same tensor gives
(1 - phi)^3/(1 + 2 phi) (J. F. Brady & L. J. Durlofsky, Phys. Fluids 31, 717 (1988)): so the box's own
correction is known, configuration by configuration.

    python3 golden/suspension/far_field.py > golden/suspension/far_field.csv
"""

import math
import sys

import numpy as np

CELLS = 6.0  # per diameter
GAP = 0.1  # at least, cells
# (wanted solid fraction, grains, seeds)
BOXES = [(0.1, 20, 4), (0.02, 40, 2), (0.05, 40, 3), (0.1, 40, 3), (0.2, 40, 3), (0.3, 40, 3)]


class Random:
    """SplitMix64 (Steele, Lea & Flood, OOPSLA 2014)."""

    def __init__(self, seed):
        self.state = seed

    def between(self, low, high):
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        z ^= z >> 31
        return low + (high - low) * (z >> 11) / 2**53


def random_places(count, side, distance, seed):
    random, places = Random(seed), []
    while len(places) < count:
        place = np.array([random.between(0.0, side) for _ in range(3)])
        if places:
            apart = place - np.array(places)
            apart -= side * np.round(apart / side)
            if (np.linalg.norm(apart, axis=1) < distance).any():
                continue
        places.append(place)
    return np.array(places)


def settling_velocity(places, side, a):
    """Mean velocity along z of all spheres under the same force, over that of one alone."""
    xi, root = math.sqrt(math.pi) / side, math.sqrt(math.pi)
    erfc = np.vectorize(math.erfc)
    images = np.array([[i, j, k] for i in range(-3, 4) for j in range(-3, 4) for k in range(-3, 4)]) * side
    total = 0.0
    for place in places:
        r = (place - places)[:, None, :] + images
        d = np.linalg.norm(r, axis=2).ravel()
        z = r[:, :, 2].ravel()
        z, d = z[d > 1e-9], d[d > 1e-9]
        e, ec = np.exp(-((xi * d) ** 2)) / root, erfc(xi * d)
        along = (0.75 * a / d + 0.5 * a**3 / d**3) * ec + (
            4 * xi**7 * a**3 * d**4 + 3 * xi**3 * a * d**2 - 20 * xi**5 * a**3 * d**2
            - 4.5 * xi * a + 14 * xi**3 * a**3 + xi * a**3 / d**2
        ) * e
        radial = (0.75 * a / d - 1.5 * a**3 / d**3) * ec + (
            -4 * xi**7 * a**3 * d**4 - 3 * xi**3 * a * d**2 + 16 * xi**5 * a**3 * d**2
            + 1.5 * xi * a - 2 * xi**3 * a**3 - 3 * xi * a**3 / d**2
        ) * e
        total += (along + radial * (z / d) ** 2).sum()
    waves = range(-7, 8)
    k = np.array([[i, j, l] for i in waves for j in waves for l in waves if (i, j, l) != (0, 0, 0)])
    k = k * 2 * math.pi / side
    k2 = (k**2).sum(axis=1)
    weight = (a - a**3 * k2 / 3) * (1 + k2 / (4 * xi**2) + k2**2 / (8 * xi**4))
    weight *= 6 * math.pi / k2 * np.exp(-k2 / (4 * xi**2)) / side**3 * (1 - k[:, 2] ** 2 / k2)
    structure = abs(np.exp(1j * places @ k.T).sum(axis=0)) ** 2
    own = 1 - 6 / root * xi * a + 40 / (3 * root) * xi**3 * a**3
    return total / len(places) + (weight * structure).sum() / len(places) + own


def main():
    print("# Settling velocity of random suspensions in a periodic cube over that of one sphere alone, in the far field")
    print("# (Rotne-Prager-Yamakawa tensor, Ewald sum of Beenakker 1986), and of an infinite suspension in the")
    print("# same approximation: (1 - phi)^3/(1 + 2 phi). Independent of the solver; spheres of 6 cells.")
    print("# Made by: python3 golden/suspension/far_field.py; for one sphere it gives 0.4990 at phi = 0.027, exact 0.4981.")
    print("wanted_solid_fraction,grains,seed,side_cells,solid_fraction,periodic_box,infinite")
    volume = math.pi * CELLS**3 / 6
    for wanted, count, seeds in BOXES:
        side = float(round((count * volume / wanted) ** (1 / 3)))
        phi = count * volume / side**3
        for seed in range(1, seeds + 1):
            places = random_places(count, side, CELLS + GAP, seed)
            box = settling_velocity(places, side, 0.5 * CELLS)
            infinite = (1 - phi) ** 3 / (1 + 2 * phi)
            print(f"{wanted},{count},{seed},{side:.0f},{phi:.6f},{box:.5f},{infinite:.5f}")
            sys.stdout.flush()


main()
