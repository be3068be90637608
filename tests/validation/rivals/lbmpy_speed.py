"""Measures the speed of lbmpy, which generates lattice Boltzmann code, on the works of `cargo validate speed`.

Prints a CSV line per measurement, `threads,engine,bytes,work,updates`: million cell updates per second of a fully
periodic cube, D3Q19. Prints to stderr, before each round, how fast a generated loop changes numbers in place.

lbmpy 2.1 needs Python 3.12 or newer, a C++ compiler and Python's headers. With them:

    python3 -m venv /opt/lbmpy && /opt/lbmpy/bin/pip install lbmpy==2.1.1 py-cpuinfo
    /opt/lbmpy/bin/python tests/validation/rivals/lbmpy_speed.py --threads 2

Without py-cpuinfo, pystencils does not know the processor and nothing is vectorised. Where Python is older (Debian
bookworm), in a userland of Debian trixie, as root:

    apt-get install -y debootstrap
    debootstrap --variant=minbase --include=python3,python3-venv,python3-dev,g++,ca-certificates trixie /opt/trixie
    mount -t proc proc /opt/trixie/proc
    chroot /opt/trixie python3 -m venv /opt/lbmpy
    chroot /opt/trixie /opt/lbmpy/bin/pip install lbmpy==2.1.1 py-cpuinfo
    chroot /opt/trixie /opt/lbmpy/bin/python - --threads 2 < tests/validation/rivals/lbmpy_speed.py

The first run generates and compiles for some minutes; later runs take the kernels from ~/.cache.

What is computed, each choice in lbmpy's favour where there was one:
- Populations are updated in place (esoteric pull: as fast as AA and esoteric twist or faster), are stored less their
  weights, and vectors are as wide as the processor has them. pystencils 2.1 generates no non-temporal stores.
- "MRT" has the moments, equilibrium and rates of psmrt's (d'Humieres et al. 2002). "MRT; default moments" is the MRT
  that lbmpy makes when it is told the viscosity only: fewer operations, since all other rates are 1.
- "PS-MRT" is lbmpy's partially saturated method with the collision SC1 (bounce-back of the non-equilibrium), at most
  one solid in a cell. The solids' velocity, zero, is compiled in, not read. lbmpy 2.1 computes both collisions in
  every cell: its kernel that branches on the fraction is "not yet available". "forces" also writes the force of each
  cell; lbmpy does not add them up for each solid.
- Each work is measured twice: with the copying of the periodic faces, by lbmpy's own LBMPeriodicityHandling
  (NumPy, one thread), and, "kernel alone", without it. The second is no periodic flow: it is what the kernel can do.
"""

import argparse
import os
import sys
import time

TAU = 0.8
PITCH, SOLID_FRACTION = 16, 0.6  # of the bed: two spheres in each cube of PITCH cells
VELOCITY = (0.01, 0.0, 0.0)  # of the fluid at the start

parser = argparse.ArgumentParser(description="Measures the speed of lbmpy.")
parser.add_argument("--threads", type=int, default=os.cpu_count(), help="OMP_NUM_THREADS; default: all processors")
parser.add_argument("--rounds", type=int, default=1, help="measurements of each work, one after the other")
parser.add_argument("--side", type=int, default=128, help="cells along the cube, a multiple of 16")
parser.add_argument("--only", default="", help="only works whose name contains this")
arguments = parser.parse_args()
os.environ["OMP_NUM_THREADS"] = str(arguments.threads)  # before any kernel is loaded

import lbmpy
import numpy as np
import pystencils
import sympy
from lbmpy import LBMConfig, LBMOptimisation, LBStencil, Method, Stencil, create_lb_update_rule
from lbmpy.advanced_streaming import LBMPeriodicityHandling, Timestep
from lbmpy.moments import MOMENT_SYMBOLS
from lbmpy.partially_saturated_cells import PSMConfig

STENCIL = LBStencil(Stencil.D3Q19)
PATTERN = "esopull"


def dhumieres():
    """The moments of d'Humieres et al. (2002) in groups, and a rate for each moment."""
    x, y, z = MOMENT_SYMBOLS
    c2 = x**2 + y**2 + z**2
    xx, ww = 3 * x**2 - c2, y**2 - z**2
    groups = {
        "conserved": ([sympy.Integer(1), x, y, z], 0.0),
        "e": ([19 * c2 - 30], 1.19),
        "eps": ([(21 * c2**2 - 53 * c2 + 24) / 2], 1.4),
        "q": ([(5 * c2 - 9) * axis for axis in (x, y, z)], 1.2),
        "nu": ([xx, ww, x * y, y * z, x * z], 1 / TAU),
        "pi": ([(3 * c2 - 5) * xx, (3 * c2 - 5) * ww], 1.4),
        "m": ([(y**2 - z**2) * x, (z**2 - x**2) * y, (x**2 - y**2) * z], 1.98),
    }
    rates = [rate for moments, rate in groups.values() for _ in moments]
    return {"nested_moments": [moments for moments, _ in groups.values()], "relaxation_rates": rates}


class Still:
    """Stands for a field of the solids' velocity that is zero everywhere."""

    def center(self, _):
        return sympy.Integer(0)


def bed(side):
    """Noble and Torczynski's weight of the solid in each cell: a body-centred array of spheres, smeared over a cell."""
    radius = PITCH * (SOLID_FRACTION * 3 / (8 * np.pi)) ** (1 / 3)
    fraction = np.zeros((side,) * 3)
    for centre in (0.3, 0.3 + PITCH / 2):
        off = (np.arange(side) - centre + PITCH / 2) % PITCH - PITCH / 2  # from the nearest centre
        distance = np.sqrt(off[:, None, None] ** 2 + off[None, :, None] ** 2 + off[None, None, :] ** 2)
        fraction = np.maximum(fraction, np.clip(radius - distance + 0.5, 0, 1))
    return fraction * (TAU - 0.5) / (1 - fraction + TAU - 0.5)


class Cube:
    """The fields of one precision. The works share them."""

    def __init__(self, side, number):
        self.side, self.number = side, number
        # Structure of arrays, rows aligned: each population by itself, x fastest.
        self.data = pystencils.create_data_handling((side,) * 3, periodicity=True, default_layout="fzyx")
        field = {"dtype": number, "alignment": True, "ghost_layers": 1}
        self.populations = self.data.add_array("populations", values_per_cell=19, **field)
        self.solid = self.data.add_array("solid", **field)
        self.force = self.data.add_array("force", values_per_cell=3, **field)
        self.data.cpu_arrays["force"][...] = 0
        self.data.cpu_arrays["solid"][...] = 0
        self.data.cpu_arrays["solid"][1:-1, 1:-1, 1:-1] = bed(side)
        self.copy_faces = LBMPeriodicityHandling(STENCIL, self.data, "populations", streaming_pattern=PATTERN)

    def settings(self):
        """How all kernels are generated."""
        settings = pystencils.CreateKernelConfig(target=pystencils.Target.CurrentCPU, default_dtype=self.number)
        settings.ghost_layers = 1
        settings.cpu.openmp.enable = True
        settings.cpu.vectorize.enable = True
        settings.cpu.vectorize.assume_inner_stride_one = True
        return settings

    def kernels(self, default_moments=False, solids=False, forces=False):
        """The kernels of even and odd steps."""
        method = {"relaxation_rate": 1 / TAU, "weighted": True} if default_moments else dhumieres()
        if solids:
            force = self.force if forces else None
            method["psm_config"] = PSMConfig(self.solid, Still(), solid_collision=1, object_force_field=force)
        # Common subexpressions are worth finding in this combination only.
        simpler = LBMOptimisation(symbolic_field=self.populations, cse_global=default_moments and not solids)
        both = []
        for step in (Timestep.EVEN, Timestep.ODD):
            config = LBMConfig(
                stencil=STENCIL, method=Method.MRT, compressible=True, continuous_equilibrium=False, zero_centered=True,
                streaming_pattern=PATTERN, timestep=step, **method,
            )  # fmt: skip
            rule = create_lb_update_rule(lbm_config=config, lbm_optimisation=simpler, config=self.settings())
            both.append(pystencils.create_kernel(rule, self.settings()).compile())
        return both

    def start(self):
        """Sets the fluid into uniform motion."""
        u = np.array(VELOCITY)
        for i, (c, w) in enumerate(zip(STENCIL, STENCIL.weights)):
            cu = np.dot(c, u)
            self.data.cpu_arrays["populations"][..., i] = float(w) * (3 * cu + 4.5 * cu**2 - 1.5 * u @ u)

    def two_steps(self, kernels, faces):
        for step, kernel in zip((Timestep.EVEN, Timestep.ODD), kernels):
            if faces:
                self.copy_faces(step.next())  # those of the step before
            self.data.run_kernel(kernel)

    def speed(self, kernels, faces):
        """Million cell updates per second, over half a second at least."""
        self.start()
        self.two_steps(kernels, faces)  # warms up
        return repeated(lambda: self.two_steps(kernels, faces)) * 2 * self.side**3 / 1e6

    def moves_as_at_the_start(self):
        """That plain fluid does."""
        self.copy_faces(Timestep.ODD)
        now = self.data.cpu_arrays["populations"][1:-1, 1:-1, 1:-1].copy()
        self.start()
        return np.allclose(now, self.data.cpu_arrays["populations"][1:-1, 1:-1, 1:-1], rtol=0, atol=1e-5)

    def bandwidth(self):
        """GB/s that a loop in place reads and writes."""
        field = self.populations
        again = [pystencils.Assignment(field(i), 0.999 * field(i) + 0.001) for i in range(19)]
        loop = pystencils.create_kernel(again, self.settings()).compile()
        self.start()
        self.data.run_kernel(loop)
        numbers = 19 * self.side**3 * 2 * np.dtype(self.number).itemsize
        return repeated(lambda: self.data.run_kernel(loop)) * numbers / 1e9


def repeated(action):
    """How often a second an action can be done, over half a second at least."""
    times, start = 0, time.perf_counter()
    while True:
        action()
        times += 1
        elapsed = time.perf_counter() - start
        if elapsed >= 0.5:
            return times / elapsed


WORKS = {
    "MRT": {},
    "MRT; default moments": {"default_moments": True},
    "PS-MRT; fixed bed of 0.6": {"solids": True},
    "PS-MRT; fixed bed of 0.6; default moments": {"solids": True, "default_moments": True},
    "PS-MRT; fixed bed of 0.6; forces": {"solids": True, "forces": True},
}

cubes = [Cube(arguments.side, number) for number in (np.float32, np.float64)]
ready = []
for work, options in WORKS.items():
    faces = {work: True, f"{work}; kernel alone": False}
    wanted = {name: with_faces for name, with_faces in faces.items() if arguments.only in name}
    for cube in cubes if wanted else []:
        kernels = cube.kernels(**options)
        ready += [(name, cube, kernels, with_faces, options) for name, with_faces in wanted.items()]

print(f"# {pystencils.Target.auto_cpu()}, pystencils {pystencils.__version__}, Python {sys.version}", file=sys.stderr)
print("threads,engine,bytes,work,updates")
for _ in range(arguments.rounds):
    print(f"# loop in place: {cubes[0].bandwidth():.1f} GB/s", file=sys.stderr)
    for name, cube, kernels, with_faces, options in ready:
        updates = cube.speed(kernels, with_faces)
        if with_faces and "solids" not in options and not cube.moves_as_at_the_start():
            sys.exit(f"{name}: the fluid no longer moves as at the start")
        size = np.dtype(cube.number).itemsize
        print(f"{arguments.threads},lbmpy {lbmpy.__version__},{size},{name},{updates:.1f}", flush=True)
