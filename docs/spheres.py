"""Grains drawn as spheres in parallel projection (NumPy only), for grains_in_water.py and settling_film.py."""

import re
import struct
import zlib

import numpy as np

PAPER, EDGE = np.array([1.0, 1.0, 1.0]), np.array([0.45, 0.5, 0.55])
FALL = np.array([[0.93, 0.83, 0.62], [0.95, 0.62, 0.28], [0.82, 0.30, 0.22], [0.45, 0.10, 0.28]])
MARGIN = 3.0  # cells around the domain


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


def edge_of_cell(run):
    """The edge of a cell of a run's scene, m."""
    text = (run / "scene.toml").read_text()
    return float(re.search(r"\bdx = (\S+)", text)[1].rstrip(","))


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


class View:
    """A domain of `size` cells, seen along `into`, with so many pixels a cell."""

    def __init__(self, size, into, pixels_per_cell):
        self.into = np.array(into) / np.linalg.norm(into)
        right = np.cross(self.into, [0, 0, 1])
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.right, self.into)
        corners = np.array(np.meshgrid(*[(0, n) for n in size], indexing="ij")).reshape(3, -1).T
        across, upwards = corners @ self.right, corners @ self.up
        self.columns = round(pixels_per_cell * (np.ptp(across) + 2 * MARGIN))
        self.rows = round(pixels_per_cell * (np.ptp(upwards) + 2 * MARGIN))
        self.x = across.min() - MARGIN + (np.arange(self.columns) + 0.5) / pixels_per_cell
        self.y = upwards.max() + MARGIN - (np.arange(self.rows) + 0.5) / pixels_per_cell
        # Rays start in the plane through the origin.
        self.start = self.x[None, :, None] * self.right + self.y[:, None, None] * self.up
        light = np.array([0.35, -0.55, 0.75])
        self.light = light / np.linalg.norm(light)

    def leaves(self, axis, far, size):
        """Where rays leave through a far face: distance, place, and whether that is on the face."""
        t = (far - self.start[..., axis]) / self.into[axis]
        hit = self.start + t[..., None] * self.into
        others = [a for a in range(3) if a != axis]
        inside = np.all([(hit[..., a] >= 0) & (hit[..., a] <= size[a]) for a in others], axis=0)
        edge = np.any([np.minimum(hit[..., a], size[a] - hit[..., a]) < 0.25 for a in others], axis=0)
        return t, hit, inside, edge

    def draw(self, image, depth, centres, radius, tints):
        """Draws spheres of one radius in their tints into an image, where nothing is nearer."""
        for centre, tint in zip(centres, tints):
            u, v = centre @ self.right, centre @ self.up
            i = np.flatnonzero(abs(self.x - u) < radius)
            j = np.flatnonzero(abs(self.y - v) < radius)
            du, dv = self.x[i][None, :] - u, self.y[j][:, None] - v
            rest = radius**2 - du**2 - dv**2
            high = np.sqrt(np.maximum(rest, 0))
            t = centre @ self.into - high
            window = np.ix_(j, i)
            seen = (rest > 0) & (t < depth[window])
            normal = (du[..., None] * self.right + dv[..., None] * self.up - high[..., None] * self.into) / radius
            lit = np.clip(normal @ self.light, 0, 1)
            shine = lit**40
            shade = 0.40 + 0.62 * lit
            rim = np.where(high < 0.3 * radius, 0.8, 1.0)
            colours = np.clip(tint * (shade * rim)[..., None] + 0.25 * shine[..., None], 0, 1)
            image[window] = np.where(seen[..., None], colours, image[window])
            depth[window] = np.where(seen, t, depth[window])


def averaged(image, samples):
    """Each pixel the mean of its samples, in bytes; 32 levels of each colour make files small and are not seen."""
    rows, columns, _ = image.shape
    small = image.reshape(rows // samples, samples, columns // samples, samples, 3).mean(axis=(1, 3))
    return (np.round(small * 31) * 255 / 31).astype(np.uint8)
