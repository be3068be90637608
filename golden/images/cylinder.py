"""Makes cylinder.stl: a cylinder of diameter 1 and length 2 along z, of 256 flat sides and the circle's area."""

import math
import struct

SIDES = 256
ANGLE = 2 * math.pi / SIDES
# n/2 r² sin(2π/n) = π/4
RADIUS = 0.5 * math.sqrt(ANGLE / math.sin(ANGLE))


def ring(z):
    return [(RADIUS * math.cos(i * ANGLE), RADIUS * math.sin(i * ANGLE), z) for i in range(SIDES)]


low, high = ring(-1.0), ring(1.0)
triangles = []
for i in range(SIDES):
    j = (i + 1) % SIDES
    triangles += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
    triangles += [((0.0, 0.0, -1.0), low[j], low[i]), ((0.0, 0.0, 1.0), high[i], high[j])]

with open("golden/images/cylinder.stl", "wb") as out:
    out.write(b"a cylinder of diameter 1 and length 2 along z".ljust(80))
    out.write(struct.pack("<I", len(triangles)))
    for triangle in triangles:
        out.write(struct.pack("<3f", 0, 0, 0))
        for corner in triangle:
            out.write(struct.pack("<3f", *corner))
        out.write(struct.pack("<H", 0))
