"""Volume that a sphere and a unit cell have in common: slices in closed form, summed by quadrature."""

import numpy as np

# Volumes that were asked for before.
KNOWN = {}
# Gauss and Legendre's points on both halves of -1..1 (more points at once have less exact weights).
HALF, HALF_WEIGHTS = np.polynomial.legendre.leggauss(32)
POINTS = np.concatenate([(HALF - 1) / 2, (HALF + 1) / 2])
WEIGHTS = np.concatenate([HALF_WEIGHTS, HALF_WEIGHTS]) / 2


def fraction(offset, radius):
    """Solid fraction of unit cells; offset (n, 3) is from the centre of each cell to the sphere's."""
    offset = np.abs(np.asarray(offset, dtype=float))
    nearest = np.sqrt((np.maximum(offset - 0.5, 0) ** 2).sum(axis=1))
    farthest = np.sqrt(((offset + 0.5) ** 2).sum(axis=1))
    cut = (nearest < radius) & (farthest > radius)
    fractions = (farthest <= radius).astype(float)
    fractions[cut] = volume(offset[cut], radius)
    return np.clip(fractions, 0, 1)


def volume(offset, radius):
    """As slices(), computed once for each place: planted mistakes ask for the same ones."""
    key = (offset.tobytes(), radius)
    if key not in KNOWN:
        KNOWN[key] = slices(offset, radius)
    return KNOWN[key]


def slices(offset, radius):
    """The cell spans low..high as seen from the sphere's centre; discs across z are summed."""
    low, high = -offset - 0.5, 0.5 - offset
    # The area of a slice has kinks where the disc's edge passes a side or a corner of the cell.
    x2 = np.stack([low[:, 0], high[:, 0]], axis=1) ** 2
    y2 = np.stack([low[:, 1], high[:, 1]], axis=1) ** 2
    corners = (x2[:, :, None] + y2[:, None, :]).reshape(-1, 4)
    squares = radius**2 - np.concatenate([0 * x2[:, :1], x2, y2, corners], axis=1)
    roots = np.sqrt(np.maximum(squares, 0))
    ends = np.concatenate([-roots, roots, low[:, 2:], high[:, 2:]], axis=1)
    ends = np.sort(np.clip(ends, low[:, 2:], high[:, 2:]), axis=1)
    middle, half = (ends[:, 1:] + ends[:, :-1]) / 2, (ends[:, 1:] - ends[:, :-1]) / 2
    # z = middle - half cos(theta) makes the square roots at both ends of a piece smooth.
    theta = np.pi / 2 * (POINTS + 1)
    z = middle[..., None] - half[..., None] * np.cos(theta)
    disc = np.sqrt(np.maximum(radius**2 - z**2, 0))
    box = [side[:, None, None] for side in (low[:, 0], high[:, 0], low[:, 1], high[:, 1])]
    areas = area(disc, *box) * np.sin(theta) * half[..., None]
    return np.pi / 2 * (areas @ WEIGHTS).sum(axis=1)


def area(disc, x0, x1, y0, y1):
    """Area that a disc about the origin and a rectangle have in common: a sum over its four sides."""
    return side(disc, x1, y0, y1) + side(disc, -x0, y0, y1) + side(disc, y1, x0, x1) + side(disc, -y0, x0, x1)


def side(disc, distance, start, end):
    """Triangle over the part of a side that is in the disc, sectors over the rest."""
    d = np.abs(distance)
    h = np.sqrt(np.maximum(disc**2 - d**2, 0))
    enter, leave = np.clip(-h, start, end), np.clip(h, start, end)
    angle = np.arctan2(enter, d) - np.arctan2(start, d) + np.arctan2(end, d) - np.arctan2(leave, d)
    return np.sign(distance) * (d * (leave - enter) + disc**2 * angle) / 2
