"""Draws docs/grains_in_water.png from the run of docs/grains_in_water.toml (NumPy only):

    psmrt run docs/grains_in_water.toml --out out/grains_in_water
    python3 docs/grains_in_water.py out/grains_in_water docs/grains_in_water.png

Parallel projection. Grains are coloured by how fast they fall; the two far faces and the floor of the domain show the
vertical velocity of the water, blue downwards and red upwards. The domain is periodic in x and y.
"""

import sys
from pathlib import Path

import numpy as np

from spheres import EDGE, FALL, PAPER, View, arrays, averaged, colour, edge_of_cell, png

STEP = 1500
FASTEST = 0.04  # m/s, the ends of both colour scales
PIXELS_PER_CELL = 6
SAMPLES = 2  # per pixel and axis, against jagged edges

WATER = np.array([[0.16, 0.38, 0.68], [0.55, 0.75, 0.90], [0.95, 0.97, 0.98], [0.96, 0.72, 0.62], [0.78, 0.28, 0.28]])


def main(run, out):
    step = f"{STEP:012}"
    uz = np.load(run / "fields" / f"velocity_{step}.npy")[..., 2].transpose(2, 1, 0)
    size = np.array(uz.shape, float)
    grains = arrays(run / "grains" / f"grains_{step}.vtp")
    dx = edge_of_cell(run)
    centres, radius = grains["Points"] / dx, grains["diameter (m)"][0, 0] / 2 / dx
    fall = colour(FALL, -grains["velocity (m/s)"][:, 2] / FASTEST)
    centres[:, :2] %= size[:2]

    view = View(size, [-0.62, 0.74, -0.26], PIXELS_PER_CELL * SAMPLES)
    shape = view.start.shape[:2]
    image = np.broadcast_to(PAPER, view.start.shape).copy()
    depth = np.full(shape, np.inf)
    # The far faces: where a ray leaves the domain.
    for axis, far in [(0, 0.0), (1, size[1]), (2, 0.0)]:
        t, hit, inside, edge = view.leaves(axis, far, size)
        cell = np.clip(hit, 0, size - 1e-9)
        # Linear between the nodes, which lie half a cell inside.
        node = np.clip(cell - 0.5, 0, size - 1)
        low = np.minimum(node.astype(int), (size - 2).astype(int))
        part = node - low
        value = np.zeros(t.shape)
        for corner in np.ndindex(2, 2, 2):
            share = np.prod(np.where(corner, part, 1 - part), axis=-1)
            value += share * uz[tuple((low + corner)[..., a] for a in range(3))]
        shown = colour(WATER, 0.5 + 0.5 * value / FASTEST)
        shown[edge] = EDGE
        image[inside], depth[inside] = shown[inside], t[inside]
    view.draw(image, depth, centres, radius, fall)
    rows, columns = (SAMPLES * (n // SAMPLES) for n in shape)
    png(out, averaged(image[:rows, :columns], SAMPLES))


main(Path(sys.argv[1]), Path(sys.argv[2]))
