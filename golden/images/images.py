"""Make three small voxel images of porous media for the permeability comparison.

Run:  python images.py        (needs numpy, porespy 3.2; writes spheres.npy, fibres.npy and blobs.npy here)

Each array is (44, 32, 32), axes x, y, z, uint8, 1 = solid and 0 = pore: an image of 32 x 32 x 32
voxels with 6 clear voxels before and behind it along x. The flow goes along x.
"""
import numpy as np
import porespy as ps
from scipy import ndimage

N = 32      # voxels along each edge of the image
CLEAR = 6   # clear voxels at each x end


def keep_percolating(solid):
    """Fill the pores that are not joined to both x ends. The sides y and z are periodic."""
    labels, _ = ndimage.label(~solid)
    parent = list(range(labels.max() + 1))

    def root(a):
        while parent[a] != a:
            a = parent[a]
        return a

    for axis in (1, 2):
        for a, b in set(zip(labels.take(0, axis).ravel(), labels.take(-1, axis).ravel())):
            if a and b:
                parent[root(a)] = root(b)
    labels = np.array([root(a) for a in range(len(parent))])[labels]
    through = (set(labels[0].ravel()) & set(labels[-1].ravel())) - {0}
    assert through, "the pore space does not percolate along x"
    return ~np.isin(labels, list(through))


def halve(pore):
    """Join 2 x 2 x 2 voxels to one, which is pore if at least half of them are.

    (porespy takes whole radii only, so the fibres of radius 2.5 are drawn at twice the resolution.)
    """
    n = pore.shape[0] // 2
    return pore.reshape(n, 2, n, 2, n, 2).mean(axis=(1, 3, 5)) >= 0.5


def main():
    shape = [N, N, N]
    images = {
        "spheres": ps.generators.overlapping_spheres(shape, r=6, porosity=0.5, seed=3),
        "fibres": halve(ps.generators.cylinders([2 * N] * 3, r=5, porosity=0.72, seed=1)),
        "blobs": ps.generators.blobs(shape, porosity=0.55, blobiness=1, seed=7),
    }
    for name, pore in images.items():
        solid = keep_percolating(~np.asarray(pore, bool))
        filled = np.count_nonzero(pore) - np.count_nonzero(~solid)
        array = np.pad(solid, ((CLEAR, CLEAR), (0, 0), (0, 0))).astype(np.uint8)
        np.save(f"{name}.npy", array)
        print(f"{name}: shape {array.shape}, porosity {1 - solid.mean():.4f}, {filled} pore voxels filled")


if __name__ == "__main__":
    main()
