"""Draws docs/boiling.png from the run of docs/boiling.toml (NumPy and Pillow):

    psmrt run docs/boiling.toml --out out/boiling
    python3 docs/boiling.py out/boiling docs/boiling.png

Four moments, one below the other. Left: the network of contacts, seen along y, each contact as wide as its normal force is large.
Right: grains and water in the plane y = 0.25 mm; water in the pores coloured by its upward velocity, grains by theirs.
"""

import csv
import re
import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from spheres import FALL, arrays, colour, edge_of_cell

MOMENTS = [(0.03, "no flow"), (0.07, "0.90 of the critical head"), (0.10, "1.05"), (0.16, "1.40, thrown against the upper face")]  # s
SCALE = 6  # pixels a cell
FASTEST = 5e-3  # m/s, the end of both colour scales
WIDEST = 6  # pixels, of a contact that bears the weight of a column of grains
GAP, HEAD = 24, 34
WATER = np.array([[0.97, 0.98, 0.99], [0.62, 0.79, 0.92], [0.16, 0.38, 0.68]])
INK = (60, 66, 72)


def lines(path):
    """The two ends of each contact, m, and its normal force, N."""
    found = arrays(path)
    return found["Points"].reshape(-1, 2, 3), found["normal force (N)"][:, 0]


def network(draw, run, step, dx, size, corner, strongest):
    ends, force = lines(run / "contacts" / f"contacts_{step}.vtp")
    left, top = corner
    for (start, end), strength in zip(ends / dx, force):
        width = WIDEST * strength / strongest
        if width < 0.3:
            continue
        # Those that cross a periodic side go on beyond the frame.
        points = [(left + SCALE * x, top + SCALE * (size[2] - z)) for x, _, z in (start, end)]
        draw.line(points, fill=INK, width=max(1, round(width)))


def plane(image, draw, run, step, dx, size, corner):
    left, top = corner
    uz = np.load(run / "fields" / f"velocity_{step}.npy")[:, int(size[1]) // 2, :, 2]
    tint = (255 * colour(WATER, np.clip(uz[::-1] / FASTEST, 0, 1))).astype(np.uint8)
    picture = Image.fromarray(tint).resize((int(SCALE * size[0]), int(SCALE * size[2])), Image.BICUBIC)
    image.paste(picture, corner)
    grains = arrays(run / "grains" / f"grains_{step}.vtp")
    radius = grains["diameter (m)"][0, 0] / 2 / dx
    middle = size[1] / 2
    for centre, velocity in zip(grains["Points"] / dx, grains["velocity (m/s)"]):
        cut = radius**2 - (centre[1] % size[1] - middle) ** 2
        if cut <= 0:
            continue
        cut = np.sqrt(cut)
        fill = tuple(int(255 * part) for part in colour(FALL, np.array(velocity[2] / FASTEST)))
        for x in (centre[0] % size[0] + np.array([-size[0], 0, size[0]])):
            box = [left + SCALE * (x - cut), top + SCALE * (size[2] - centre[2] - cut)]
            draw.ellipse(box + [box[0] + 2 * SCALE * cut, box[1] + 2 * SCALE * cut], fill=fill, outline=INK)


def on_sieve(run):
    """Times and what the grains press on the sieve with, N."""
    with open(run / "walls.csv") as table:
        rows = [row for row in csv.DictReader(table) if row["face"] == "z_low"]
    return [float(row["time (s)"]) for row in rows], [-float(row["grain_force_z (N)"]) for row in rows]


def main(run, out):
    text = (run / "scene.toml").read_text()
    size = np.array([float(n) for n in re.search(r"cells = \[(\d+), (\d+), (\d+)\]", text).groups()])
    dx = edge_of_cell(run)
    times, force = on_sieve(run)
    steps = sorted(re.search(r"\d{12}", path.name)[0] for path in (run / "grains").glob("*.vtp"))
    every = times[-1] / (len(steps) - 1)
    width, height = (int(SCALE * n) for n in (size[0], size[2]))
    # Frames of their own keep what crosses a side out of the other half.
    image = Image.new("RGB", (2 * width + 3 * GAP, len(MOMENTS) * (height + HEAD) + GAP), "white")
    try:
        font = ImageFont.truetype("DejaVuSans.ttf", 20)
    except OSError:
        font = ImageFont.load_default()
    strongest = max(lines(run / "contacts" / f"contacts_{steps[round(MOMENTS[0][0] / every)]}.vtp")[1])
    for row, (time, words) in enumerate(MOMENTS):
        step, top = steps[round(time / every)], HEAD + row * (height + HEAD)
        half = Image.new("RGB", (width, height), "white")
        network(ImageDraw.Draw(half), run, step, dx, size, (0, 0), strongest)
        image.paste(half, (GAP, top))
        half = Image.new("RGB", (width, height), "white")
        plane(half, ImageDraw.Draw(half), run, step, dx, size, (0, 0))
        image.paste(half, (2 * GAP + width, top))
        draw = ImageDraw.Draw(image)
        for left in (GAP, 2 * GAP + width):
            draw.rectangle([left, top, left + width, top + height], outline=INK)
        share = np.interp(time, times, force) / force[round(MOMENTS[0][0] / times[-1] * (len(times) - 1))]
        draw.text((GAP, top - 28), f"{time:.2f} s, {words}: {abs(round(100 * share))} % of the weight rests on the sieve", INK, font)
    image.quantize(96, dither=Image.Dither.NONE).save(out, optimize=True)


main(Path(sys.argv[1]), Path(sys.argv[2]))
