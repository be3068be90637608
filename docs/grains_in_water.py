"""Draws docs/grains_in_water.png from the run of docs/grains_in_water.toml (NumPy only):

    psmrt run docs/grains_in_water.toml --out out/grains_in_water
    python3 docs/grains_in_water.py out/grains_in_water docs/grains_in_water.png

Parallel projection. Grains are coloured by how fast they fall; the two far faces and the floor of the domain show the
vertical velocity of the water, blue downwards and red upwards. The domain is periodic in x and y.
"""

import re
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

STEP = 1500
FASTEST = 0.04  # m/s, the ends of both colour scales
PIXELS_PER_CELL = 6
SAMPLES = 2  # per pixel and axis, against jagged edges

PAPER, EDGE = np.array([1.0, 1.0, 1.0]), np.array([0.45, 0.5, 0.55])
FALL = np.array([[0.93, 0.83, 0.62], [0.95, 0.62, 0.28], [0.82, 0.30, 0.22], [0.45, 0.10, 0.28]])
WATER = np.array([[0.16, 0.38, 0.68], [0.55, 0.75, 0.90], [0.95, 0.97, 0.98], [0.96, 0.72, 0.62], [0.78, 0.28, 0.28]])


def colour(scale, share):
    """The colour at `share`, 0 to 1, of a scale."""
    at = np.clip(share, 0, 1) * (len(scale) - 1)
    low = np.minimum(at.astype(int), len(scale) - 2)
    return scale[low] + (at - low)[..., None] * (scale[low + 1] - scale[low])


def arrays(path):
    """The arrays of a .vtp file as psmrt writes it: raw, appended, each behind its length in bytes."""
    data = path.read_bytes()
    head, raw = data.split(b'<AppendedData encoding="raw">', 1)
    raw = raw[raw.index(b"_") + 1 :]
    found = {}
    for name, parts, offset in re.findall(rb'Float64" Name="([^"]*)" NumberOfComponents="(\d)"[^>]*offset="(\d+)"', head):
        start, parts = int(offset), int(parts)
        (length,) = struct.unpack_from("<Q", raw, start)
        found[name.decode()] = np.frombuffer(raw, "<f8", length // 8, start + 8).reshape(-1, parts)
    return found


def png(path, image):
    """Writes an array of bytes, rows by columns by 3."""
    rows, columns, _ = image.shape
    lines = b"".join(b"\0" + row.tobytes() for row in image)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b"")
    )


def main(run, out):
    step = f"{STEP:012}"
    uz = np.load(run / "fields" / f"velocity_{step}.npy")[..., 2].transpose(2, 1, 0)
    size = np.array(uz.shape, float)
    grains = arrays(run / "grains" / f"grains_{step}.vtp")
    dx = float(re.search(r"\bdx = (\S+)", (run / "scene.toml").read_text())[1].rstrip(","))
    centres, radius = grains["Points"] / dx, grains["diameter (m)"][0, 0] / 2 / dx
    fall = colour(FALL, -grains["velocity (m/s)"][:, 2] / FASTEST)
    centres[:, :2] %= size[:2]

    # The eye looks along `into`; `right` and `up` span the picture.
    into = np.array([-0.62, 0.74, -0.26])
    into /= np.linalg.norm(into)
    right = np.cross(into, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, into)
    corners = np.array(np.meshgrid(*[(0, n) for n in size], indexing="ij")).reshape(3, -1).T
    across, upwards = corners @ right, corners @ up
    margin = 3.0
    scale = PIXELS_PER_CELL * SAMPLES
    columns = SAMPLES * round(PIXELS_PER_CELL * (np.ptp(across) + 2 * margin))
    rows = SAMPLES * round(PIXELS_PER_CELL * (np.ptp(upwards) + 2 * margin))
    x = across.min() - margin + (np.arange(columns) + 0.5) / scale
    y = upwards.max() + margin - (np.arange(rows) + 0.5) / scale
    start = x[None, :, None] * right + y[:, None, None] * up  # rays start in the plane through the origin
    image = np.broadcast_to(PAPER, start.shape).copy()
    depth = np.full(start.shape[:2], np.inf)

    # The far faces: where a ray leaves the domain.
    for axis, far in [(0, 0.0), (1, size[1]), (2, 0.0)]:
        t = (far - start[..., axis]) / into[axis]
        hit = start + t[..., None] * into
        others = [a for a in range(3) if a != axis]
        inside = np.all([(hit[..., a] >= 0) & (hit[..., a] <= size[a]) for a in others], axis=0)
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
        edge = np.any([np.minimum(hit[..., a], size[a] - hit[..., a]) < 0.25 for a in others], axis=0)
        shown[edge] = EDGE
        image[inside], depth[inside] = shown[inside], t[inside]

    light = np.array([0.35, -0.55, 0.75])
    light /= np.linalg.norm(light)
    for centre, tint in zip(centres, fall):
        u, v = centre @ right, centre @ up
        i = np.flatnonzero(abs(x - u) < radius)
        j = np.flatnonzero(abs(y - v) < radius)
        du, dv = x[i][None, :] - u, y[j][:, None] - v
        rest = radius**2 - du**2 - dv**2
        high = np.sqrt(np.maximum(rest, 0))
        t = centre @ into - high
        window = np.ix_(j, i)
        seen = (rest > 0) & (t < depth[window])
        normal = (du[..., None] * right + dv[..., None] * up - high[..., None] * into) / radius
        lit = np.clip(normal @ light, 0, 1)
        shine = lit**40
        shade = 0.40 + 0.62 * lit
        rim = np.where(high < 0.3 * radius, 0.8, 1.0)
        colours = np.clip(tint * (shade * rim)[..., None] + 0.25 * shine[..., None], 0, 1)
        image[window] = np.where(seen[..., None], colours, image[window])
        depth[window] = np.where(seen, t, depth[window])

    small = image.reshape(rows // SAMPLES, SAMPLES, columns // SAMPLES, SAMPLES, 3).mean(axis=(1, 3))
    # 32 levels of each colour: a third of the bytes, and no visible difference.
    png(out, (np.round(small * 31) * 255 / 31).astype(np.uint8))


main(Path(sys.argv[1]), Path(sys.argv[2]))
