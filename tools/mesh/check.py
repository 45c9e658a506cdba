#!/usr/bin/env python3
"""Checks meshes of the fracture cases, independently of Gmsh.

    tools/mesh/check.py cases/fracture/meshes/*.msh

Needs the packages meshio and numpy: `pip install meshio numpy`. Prints each body and every failed check; the exit code
is 1 if a check fails.
"""

import argparse
import math
import sys
from collections import Counter
from pathlib import Path

import meshio
import numpy as np

import quality

# Exact volumes [m3]. Dolos: the sum of its convex blocks; with the haunches 2.1 % more than the published
# 0.675 (a/H)^1.285 H^3 (Burcharth et al. 1992). Core-Loc: section 4.1 of Guo et al. Tetrapod: 0.2799 H^3.
DOLOS = {"unit": 0.18536}
DROP_BASE = {"base": 0.8 * (1.45 * 0.10 + 0.65 * 0.32)}
PENDULUM = {
    # The block is H/12 high and reaches from the side of the fluke to the end of the base.
    "base": DROP_BASE["base"] + 0.8 / 12 * (0.85 - (0.5 - 0.16 * (0.5 - 1 / 12))),
    "cylinder": 0.2 * 0.18536 * 2340 / 7850,
}
TETRAPOD = {"unit": 0.2799}
VOLUMES = {
    "bar": {"bar_1": 0.5 * 0.05**2, "bar_2": 0.5 * 0.05**2},
    "bar_single": {"bar": 0.5 * 0.05**2},
    "cantilever": {"cantilever": 0.1**2},
    "beam": {"beam": 0.320 * 0.040 * 0.020},
    "disc": {"disc": math.pi * 0.020**2 * 0.015},
    "compression": {"prism": 0.05**2 * 0.1},
    "block_on_slab": {"block": 0.1**3, "slab": 0.4 * 0.2 * 0.05},
    "dolos_drop": DOLOS | DROP_BASE,
    "dolos_drop_cracked": DOLOS | DROP_BASE,
    "dolos_pendulum": DOLOS | PENDULUM,
    "dolos_pendulum_cracked": DOLOS | PENDULUM,
    "core_loc_five": {f"unit_{n}": 8.0 for n in range(1, 6)} | {"base": 10.5 * (12 * 5 + 6.5 * 4.875 / 2)},
    "tetrapod": TETRAPOD,
    "tetrapod_on_base": TETRAPOD | {"base": 1.7**2 * 0.3},
}
# Named sets of the boundary.
HELD = {f"base_{side}" for side in ("bottom", "left", "right", "front", "back")}
CRACKS = {"crack_upper", "crack_lower"}
SETS = {
    "bar": {"bar_1_left", "bar_1_right", "bar_2_left", "bar_2_right"},
    "bar_single": {"left", "right"},
    "cantilever": {"clamped", "tip"},
    "beam": {"support_left", "support_right", "load"},
    "disc": {"top", "bottom"},
    "compression": {"top", "bottom"},
    "block_on_slab": {"slab_bottom", "block_top"},
    "dolos_drop": HELD,
    "dolos_drop_cracked": HELD | CRACKS,
    "dolos_pendulum": HELD,
    "dolos_pendulum_cracked": HELD | CRACKS,
    "core_loc_five": HELD,
    "tetrapod": set(),
    "tetrapod_on_base": HELD,
}
# Largest relative volume error, due to flat triangles on round surfaces.
VOLUME_TOLERANCE = 0.01
# Smallest allowed dihedral angle [degrees]. Flatter tetrahedra would make the time step too small.
LEAST_ANGLE = 8.0


def main():
    """Runs the command line."""
    parser = argparse.ArgumentParser(description="Checks meshes of the fracture cases.")
    parser.add_argument("files", nargs="+", type=Path)
    failed = False
    for file in parser.parse_args().files:
        print(f"{file} ({file.stat().st_size / 1000:.0f} kB)")
        for failure in check(file):
            failed = True
            print(f"  FAILED: {failure}")
    sys.exit(failed)


def check(file):
    """Yields the failed checks of a mesh."""
    name = file.stem.removesuffix("-coarse")
    points, groups = read(file)
    bodies = {group: cells for group, cells in groups.items() if cells.shape[1] == 4}
    sets = {group: cells for group, cells in groups.items() if cells.shape[1] < 4}
    if bodies.keys() != VOLUMES[name].keys():
        yield f"the bodies are {sorted(bodies)}, but should be {sorted(VOLUMES[name])}"
    if sets.keys() != SETS[name]:
        yield f"the sets are {sorted(sets)}, but should be {sorted(SETS[name])}"
    nodes = [set(cells.ravel()) for cells in bodies.values()]
    if len(set.union(*nodes)) != sum(map(len, nodes)):
        yield "bodies share nodes"
    for body, cells in bodies.items():
        yield from check_body(body, points[cells], cells, VOLUMES[name].get(body, math.nan))
    for group, cells in sets.items():
        yield from check_set(group, cells, [faces_of(tets) for tets in bodies.values()])


def read(file):
    """Returns the points and the cells of each physical group."""
    mesh = meshio.read(file)
    names = {(dimension, tag): name for name, (tag, dimension) in mesh.field_data.items()}
    groups = {}
    for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        for tag in np.unique(tags):
            groups.setdefault(names[block.dim, tag], []).append(block.data[tags == tag])
    return mesh.points, {name: np.concatenate(cells) for name, cells in groups.items()}


def check_body(name, tets, cells, volume):
    """Yields the failed checks of a body and prints its properties."""
    volumes, edges, angles = quality.volumes(tets), quality.edge_lengths(tets), quality.dihedral_angles(tets)
    centre = (volumes[:, None] * tets.mean(axis=1)).sum(axis=0) / volumes.sum()
    print(
        f"  {name:12}{len(tets):7} tetrahedra, {volumes.sum():.6g} m3 ({100 * (volumes.sum() / volume - 1):+.2f} %), "
        f"mean edge {1e3 * edges.mean():.4g} mm, shortest {1e3 * edges.min():.4g} mm, "
        f"smallest angle {angles.min():.1f} degrees, centre {np.round(centre, 4).tolist()}"
    )
    if volumes.min() <= 0:
        yield f"{name}: {np.sum(volumes <= 0)} tetrahedra have no positive volume"
    if not abs(volumes.sum() / volume - 1) < VOLUME_TOLERANCE:
        yield f"{name}: the volume is {volumes.sum():.6g} m3, but should be {volume:.6g} m3"
    if angles.min() < LEAST_ANGLE:
        yield f"{name}: the smallest angle is {angles.min():.1f} degrees; at least {LEAST_ANGLE} degrees is allowed"
    faces = faces_of(cells)
    if max(faces.values()) > 2:
        yield f"{name}: a face belongs to more than two tetrahedra"
    skin = [face for face, count in faces.items() if count == 1]
    sides = Counter(tuple(sorted(pair)) for a, b, c in skin for pair in ((a, b), (b, c), (a, c)))
    if set(sides.values()) != {2}:
        yield f"{name}: the surface is not closed"


def check_set(name, cells, faces_of_bodies):
    """Yields the failed checks of a set: faces must lie on the surface of one body, cracks inside one body."""
    if cells.shape[1] != 3:
        return
    wanted = 2 if name.startswith("crack") else 1
    for faces in faces_of_bodies:
        if all(faces.get(tuple(sorted(face)), 0) == wanted for face in cells):
            return
    yield f"{name}: a face of the set does not belong to {wanted} tetrahedra of one body"


def faces_of(tets):
    """For each face (a sorted triple of nodes), the number of tetrahedra to which the face belongs."""
    tets = np.sort(tets, axis=1)
    triples = np.concatenate([np.delete(tets, corner, axis=1) for corner in range(4)])
    return Counter(map(tuple, triples.tolist()))


if __name__ == "__main__":
    main()
