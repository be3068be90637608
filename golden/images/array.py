"""Images of one ball in a cube, a simple cubic array of solid fraction 0.343: ball_48.npy with 48 voxels along each edge, and
ball_8, ball_12, ball_16, ball_24 with as many. A voxel is solid (1) if its centre lies in the ball.

Run:  python array.py        (needs numpy; writes into the folder it is run in)
"""
import numpy as np

RADIUS = (3 * 0.343 / (4 * np.pi)) ** (1 / 3)  # edges of the cube

for voxels in (8, 12, 16, 24, 48):
    along = (np.arange(voxels) + 0.5) / voxels - 0.5
    x, y, z = np.meshgrid(along, along, along, indexing="ij")
    np.save(f"ball_{voxels}.npy", (x * x + y * y + z * z < RADIUS**2).astype(np.uint8))
