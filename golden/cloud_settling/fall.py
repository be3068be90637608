"""What a run of fall.toml shows, as the tables beside it (NumPy; Python 3.9 or later):

    psmrt run golden/cloud_settling/fall.toml --out RUN
    python3 golden/cloud_settling/fall.py RUN

fall.csv: moment by moment, how fast grains fall and where they are; the core are the grains that start at least eight
diameters from the side walls, the rim those that start within one. fall_walls.csv: the velocity by the distance to
the nearest side wall, in the middle half of the height, early on. fall_layers.csv: porosity, coordination number and
the grains' stress layer by layer, at the end.
"""

import csv
import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "docs"))
from spheres import arrays  # noqa: E402

STOKES = 1500 * 9.81 * 1.6e-4**2 / (18 * 1e-2)  # m/s
DIAMETER, SIDE, HEIGHT = 1.6e-4, 6.4e-3, 1e-2  # m
WEIGHT = 12000 * np.pi / 6 * DIAMETER**3 * 1500 * 9.81  # N, less buoyancy
# Seconds: the weight grows until 0.14 s, and what swings then has died out at 0.6 s.
EARLY = [0.6, 1.2]


def moments(run):
    """Time, centres and velocities of each record."""
    index = (run / "grains.pvd").read_text()
    for time, file in re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', index):
        found = arrays(run / file)
        yield float(time), found["Points"], found["velocity (m/s)"]


def to_wall(centres):
    """Distance to the nearest side wall, in diameters."""
    across = centres[:, :2]
    return np.minimum(across, SIDE - across).min(axis=1) / DIAMETER


def on_walls(run):
    """The share of the weight that the water's forces on the six walls carry, and that of the grains' contacts with them."""
    shares = {}
    with open(run / "walls.csv") as file:
        for row in csv.DictReader(file):
            water, grains = shares.get(row["step"], (0.0, 0.0))
            water -= float(row["fluid_force_z (N)"]) / WEIGHT
            grains -= float(row["grain_force_z (N)"]) / WEIGHT
            shares[row["step"]] = water, grains
    return list(shares.values())


def write(name, head, columns, rows):
    with open(HERE / name, "w", newline="") as file:
        file.write(head)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def main(run, origin):
    series, early, start = [], [], None
    carried = on_walls(run)
    for number, (time, centres, velocities) in enumerate(moments(run)):
        wall = to_wall(centres)
        if start is None:
            start = wall
        core, rim = start >= 8, start < 1
        fall, height = -velocities[:, 2], centres[:, 2]
        row = [f"{time:.4g}", f"{fall.mean():.4e}", f"{fall[core].mean():.4e}", f"{fall[rim].mean():.4e}"]
        row += [f"{height.mean():.5e}", f"{height[core].mean():.5e}", f"{height[rim].mean():.5e}"]
        # The upper front, and how much rests: slower than a twentieth of Stokes' velocity in the lowest sixth.
        front = np.quantile(height, 0.99)
        # (At the start all are slow.)
        rests = (time > 0.2) & (np.abs(velocities).max(axis=1) < 0.05 * STOKES) & (height < HEIGHT / 6)
        row += [f"{front:.5e}", f"{rests.mean():.4f}", f"{rests[core].mean():.4f}"]
        series.append(row + [f"{share:.5f}" for share in carried[number]])
        if EARLY[0] <= time <= EARLY[1]:
            middle = np.abs(height - HEIGHT / 2) < HEIGHT / 4
            early.append((wall[middle], fall[middle]))
    made = f"# Made from a run of fall.toml by golden/cloud_settling/fall.py. {origin}\n"
    write(
        "fall.csv",
        "# 12,000 grains fall in the paper's box. Velocities downwards, m/s, and heights, m: means of all, of the core (at least\n"
        "# eight diameters from the side walls at the start) and of the rim (within one); front: below it are 99 of 100 grains;\n"
        "# share of the grains' weight in water that the water's forces on the walls carry, and that of contacts with the walls.\n"
        + made,
        "time_s,velocity,velocity_core,velocity_rim,height,height_core,height_rim,front,share_at_rest,core_at_rest,by_water,by_contacts".split(","),
        series,
    )
    wall, fall = (np.concatenate(part) for part in zip(*early))
    rows = []
    for layer in range(20):
        inside = (wall >= layer) & (wall < layer + 1)
        count = inside.sum() / len(early)
        rows.append([layer, f"{count:.0f}", f"{fall[inside].mean():.4e}", f"{fall[inside].std():.1e}"])
    write(
        "fall_walls.csv",
        "# Velocity downwards, m/s, by the distance to the nearest side wall in diameters (from this to one more), between 0.6\n"
        "# and 1.2 s, in the middle half of the height; grains: in the mean of the moments; spread: standard deviation of the grains.\n" + made,
        "layer_from_diameters,grains,velocity_m_s,spread_m_s".split(","),
        rows,
    )
    with open(run / "layers.csv") as file:
        layers = list(csv.DictReader(file))
    last = layers[-1]["step"]
    wanted = ["low (m)", "high (m)", "porosity", "coordination_number", "effective_stress_z (Pa)"]
    write(
        "fall_layers.csv",
        f"# Layers of five cells at {float(layers[-1]['time (s)']):.4g} s, the last moment.\n" + made,
        "low_m,high_m,porosity,coordination_number,stress_z_Pa".split(","),
        [[f"{float(row[name]):.5g}" for name in wanted] for row in layers if row["step"] == last],
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), " ".join(sys.argv[2:]))
