"""A tour of the reader, in cells: python3 tutorial.py [RUN_DIRECTORY].

Jupyter, VS Code and Spyder run the cells (# %%) one by one. Make a run first:

    endoflow run boundary-integral cases/standard.toml --until 1 -o out/tutorial
"""

# %% Load a run
import sys

import numpy as np

import endoflow

directory = sys.argv[1] if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "out/tutorial"
run = endoflow.load(directory)
print(f"{run.engine}, patch radius {run.parameters['molecules']['patch_radius']:g} nm, {len(run.shapes)} shapes")

# %% Histories: one array for each column, nan where there is no value
time = run.history["time_us"]
neck = run.history["neck_radius_nm"]
print("columns:", ", ".join(f"{name} ({unit})" for name, unit in run.history_units.items()))
first_neck = time[np.isfinite(neck)][:1]
print("a neck first appears at", *(f"{t:.3f} µs" for t in first_neck))

# %% Events: budding is the neck radius falling below 5 nm
budding = run.event_time("budding")
print("budding:", "none" if budding is None else f"{budding:.5f} µs")

# %% Molecules are conserved
mass = run.history["molecule_mass_nm2"]
drift = np.abs(mass / mass[0] - 1).max()
print(f"largest relative drift of the molecules' mass: {drift:.1e}")

# %% The energy falls: the fluid dissipates it
energy = run.history["bending_energy_pN_nm"]
print(f"bending energy from {energy[0]:.0f} to {energy[-1]:.0f} pN nm; it rises in {(np.diff(energy) > 0).sum()} steps")

# %% A shape at any time, interpolated at fixed material points
shape = run.shape_at(0.5 * run.shape_times[-1])
print(f"at {shape.time:.3g} µs: {len(shape)} points, apex {shape.z[0] - shape.z[-1]:.2f} nm above the rim")

# %% Area by hand: the surface of revolution of the curve, against history.csv
area = np.sum(np.pi * (shape.r[1:] + shape.r[:-1]) * np.diff(shape.s))
recorded = run.history_at("membrane_area_nm2", shape.time)
print(f"area {area:.1f} nm², in history.csv {recorded:.1f} nm²")

# %% How fast does the neck close?
necked = np.isfinite(neck) & (neck > 0)
if necked.sum() > 2:
    rate = np.gradient(neck[necked], time[necked])
    fastest = np.argmin(rate)
    print(f"the neck closes fastest at {time[necked][fastest]:.3f} µs: {-rate[fastest]:.1f} nm/µs")

# %% Draw the membrane, coloured by c (needs matplotlib)
try:
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection
except ImportError:
    sys.exit("matplotlib is not installed: no picture")

figure, panels = plt.subplots(1, 4, figsize=(11, 3), sharey=True, layout="constrained")
for axes, t in zip(panels, np.linspace(0, run.shape_times[-1], 4)):
    s = run.shape_at(t)
    for side in (-1, 1):
        points = np.column_stack((side * s.r, s.z))
        pieces = np.stack((points[:-1], points[1:]), axis=1)
        axes.add_collection(LineCollection(pieces, array=0.5 * (s.c[1:] + s.c[:-1]), cmap="viridis", clim=(0, 1)))
    axes.set(xlim=(-80, 80), ylim=(70, run.shapes[-1].z.max() + 10), aspect="equal", xlabel="r (nm)", title=f"{t:.2g} µs")
panels[0].set_ylabel("z (nm)")
figure.savefig(run.directory / "tutorial.png", dpi=150)
print("picture:", run.directory / "tutorial.png")
