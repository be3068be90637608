"""Draws the settling cloud of the paper's section 7 from the grains that a run has recorded (NumPy; ffmpeg for a film):

    python3 docs/settling_film.py RUN picture.png STEP ...
    python3 docs/settling_film.py RUN film.webm

Parallel projection into the closed box, the near walls left out; grains are coloured by how fast they fall. A film shows all
recorded moments at 25 a second, on a white ground; several steps stand in one picture, three in a row (a multiple of
three, if there are more).
"""

import os
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from spheres import EDGE, FALL, PAPER, View, arrays, averaged, colour, edge_of_cell, png

FASTEST = 4e-3  # m/s, twice Stokes' velocity: the end of the colour scale
INTO = [-0.62, 0.74, -0.26]
IN_A_ROW = 3
SAMPLES = 2  # per pixel and axis, against jagged edges


def frame(run, path, pixels_per_cell):
    """The picture of one moment."""
    cells = re.search(r"cells = \[(\d+), (\d+), (\d+)\]", (run / "scene.toml").read_text())
    size = np.array([float(n) for n in cells.groups()])
    dx = edge_of_cell(run)
    grains = arrays(path)
    centres, radius = grains["Points"] / dx, grains["diameter (m)"][0, 0] / 2 / dx
    view = View(size, INTO, pixels_per_cell * SAMPLES)
    image = np.broadcast_to(PAPER, view.start.shape).copy()
    depth = np.full(image.shape[:2], np.inf)
    for axis, far in [(0, 0.0), (1, size[1]), (2, 0.0)]:
        t, _, inside, edge = view.leaves(axis, far, size)
        shown = np.broadcast_to([0.95, 0.97, 0.98], image.shape).copy()
        shown[edge] = EDGE
        image[inside], depth[inside] = shown[inside], t[inside]
    # The nearest first: what they hide need not be shaded, only compared.
    order = np.argsort(centres @ view.into)
    fall = colour(FALL, -grains["velocity (m/s)"][:, 2] / FASTEST)
    view.draw(image, depth, centres[order], radius, fall[order])
    # Films want even numbers of pixels.
    even = 2 * SAMPLES
    rows, columns = (even * (n // even) for n in image.shape[:2])
    return averaged(image[:rows, :columns], SAMPLES)


def film(run, out, pixels_per_cell=3.0):
    paths = sorted((run / "grains").glob("grains_*.vtp"))
    if not paths:
        sys.exit(f"{run}/grains has no grains_*.vtp: the scene needs a record of kind grains with every_time")
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        frames = pool.map(frame, [run] * len(paths), paths, [pixels_per_cell] * len(paths))
        first = next(frames)
        rows, columns, _ = first.shape
        codec = "-c:v libvpx-vp9 -pix_fmt yuv420p -crf 44 -b:v 0 -row-mt 1".split()
        raw = f"-f rawvideo -pix_fmt rgb24 -s {columns}x{rows} -r 25 -i -".split()
        command = ["ffmpeg", "-y", "-loglevel", "error", *raw, *codec, str(out)]
        with subprocess.Popen(command, stdin=subprocess.PIPE) as ffmpeg:
            ffmpeg.stdin.write(first.tobytes())
            for picture in frames:
                ffmpeg.stdin.write(picture.tobytes())
            ffmpeg.stdin.close()
    if ffmpeg.returncode:
        sys.exit(f"ffmpeg failed with {ffmpeg.returncode}")


if __name__ == "__main__":
    run, out = Path(sys.argv[1]), Path(sys.argv[2])
    steps = [int(step) for step in sys.argv[3:]]
    if steps:
        pixels_per_cell = 4.0 if len(steps) == 1 else 1.4
        paths = [run / "grains" / f"grains_{step:012}.vtp" for step in steps]
        frames = [frame(run, path, pixels_per_cell) for path in paths]
        rows = [np.hstack(frames[i : i + IN_A_ROW]) for i in range(0, len(frames), IN_A_ROW)]
        png(out, np.vstack(rows))
    else:
        film(run, out)
