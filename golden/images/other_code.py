"""Permeability of voxel images with the lattice Boltzmann solver of poromics 0.0.8.

Run:  python other_code.py spheres.npy 1       (each voxel is 1 cell; with 2, each is 2 x 2 x 2 cells)
      python other_code.py spheres.npy 1 0.05  (with another viscosity; without it, 1/6)

Rows for independent.csv go to the standard output, remarks to the standard error.

Needs numpy, taichi, loguru and poromics (pip install --no-deps poromics==0.0.8). Its Julia part is
not needed: only the file with the D3Q19 solver is loaded (multiple relaxation times, plain
bounce-back, single precision). It runs in one thread.

The densities 1.0 and 0.99 are given at the centres of the first and the last plane of cells. The
solver sets these cells to the equilibrium AT REST: their velocity stays 0, although the fluid beside
them moves. So the density jumps by 3 J beside each plane (J is the mass flux for each cell of the
cross-section), a resistance that does not belong to the image. Two permeabilities are printed:
  poromics_0.0.8                from the density difference of the two planes (with the jumps);
  poromics_0.0.8_inner_density  from the mean densities 2 voxels from each end, in the clear part.
The resting ends also make the flow through the clear part too even, so the second value is still too
low where the pores are wide (see `rest` in stokes.py, which imitates such ends).
"""
import contextlib
import importlib
import os
import sys
import time
import types
from importlib.util import find_spec
from pathlib import Path

import numpy as np
os.environ["ENABLE_TAICHI_HEADER_PRINT"] = "0"
import taichi as ti

IMAGE = 32   # voxels, the length of the image without its clear ends
CLEAR = 6    # clear voxels at each end


def load_solver():
    """The solver class, without running the package's top-level import, which wants Julia."""
    package = types.ModuleType("poromics")
    package.__path__ = [str(Path(find_spec("poromics").origin).parent)]
    sys.modules["poromics"] = package
    return importlib.import_module("poromics._lbm._flow_solver")._D3Q19Solver


def permeability(image, cells, nu=1 / 6, every=500, tolerance=1e-4, most=20000):
    """The two values of k in voxels^2, and a remark."""
    solid = image
    for axis in range(3):
        solid = np.repeat(solid, cells, axis)
    solver = load_solver()(ti, solid, nu=nu)
    solver.set_bc_rho("x0", 1.0)
    solver.set_bc_rho("x1", 0.99)
    solver.init_fields()
    start, last = time.time(), 0.0
    for step in range(1, most + 1):
        solver.step()
        if step % every == 0:
            # Mass flux through the planes x. In the end planes the velocity is 0: leave them out.
            density = solver.get_density().astype(float)
            flux = (density * solver.get_velocity()[..., 0]).mean(axis=(1, 2))[2:-2]
            change = abs(flux.mean() - last) / flux.mean()
            last = flux.mean()
            if change < tolerance:
                break
    # In creeping flow this solver obeys  viscosity * laplace(density * u) = grad(density) / 3.
    mean = density.mean(axis=(1, 2))
    inner = mean[2 * cells] - mean[-1 - 2 * cells]
    k_planes, k_inner = (nu * flux.mean() * IMAGE * cells / (d / 3) / cells**2 for d in (0.01, inner))
    remark = (f"{step} steps, {time.time() - start:.0f} s, change {change:.1e}, spread of the flux "
              f"{np.ptp(flux) / flux.mean():.1e}, jumps {1 - mean[2 * cells]:.4e} and "
              f"{mean[-1 - 2 * cells] - 0.99:.4e}, 3 J {3 * flux.mean():.4e}")
    return k_planes, k_inner, remark


def main(path, cells, nu=1 / 6):
    with contextlib.redirect_stdout(sys.stderr):
        ti.init(arch=ti.cpu, cpu_max_num_threads=1)
    image = np.load(path)
    name, porosity = Path(path).stem, 1 - image[CLEAR:-CLEAR].mean()
    t = time.time()
    k_planes, k_inner, remark = permeability(image, cells, nu)
    print(f"{name}, {cells} cells, viscosity {nu:.4f}: {remark}, {time.time() - t:.0f} s in all", file=sys.stderr)
    print(f"{name},poromics_0.0.8,{cells},{k_planes:.6f},{porosity:.4f}")
    print(f"{name},poromics_0.0.8_inner_density,{cells},{k_inner:.6f},{porosity:.4f}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), *map(float, sys.argv[3:]))
