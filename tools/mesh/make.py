#!/usr/bin/env python3
"""Makes the tetrahedral meshes of the fracture cases with Gmsh.

    tools/mesh/make.py --list
    tools/mesh/make.py dolos_drop
    tools/mesh/make.py beam --size 0.005 --out beam-5mm.msh
    tools/mesh/make.py --all --coarse

Needs the packages gmsh (tested with 4.15.2) and numpy: `pip install gmsh numpy`. Without a desktop, Gmsh may need more
libraries; on Debian: `apt install libglu1-mesa libxcursor1 libxinerama1 libxft2`.
README.md in this folder describes the meshes.
"""

import argparse
from pathlib import Path

import gmsh
import numpy as np

import quality
from catalogue import MESHES
from narrow_faces import join_narrow_faces

REPOSITORY = Path(__file__).resolve().parents[2]
COARSE_FOLDER = REPOSITORY / "cases" / "fracture" / "meshes"
FOLDER = REPOSITORY / "runs" / "meshes"
# Meshes with more tetrahedra than this are written in binary, which is read faster; smaller files are shorter as text.
MOST_IN_ASCII = 50_000
# Mesh size given to Gmsh, divided by the resulting mean edge length, for bodies much larger than an element.
ASKED = 0.8
# Smallest number of sides of a circle: the mesh of a Tetrapod then has 99 % of its volume.
SIDES_OF_CIRCLE = 20
# Gmsh's optimiser improves tetrahedra whose ratio of inscribed to circumscribed radius, times 3, is below this value.
OPTIMIZE_BELOW = 0.5
# Number of rounds of optimisation, each by Gmsh's optimiser and then by Netgen's.
ROUNDS = 3


def main():
    """Runs the command line."""
    parser = argparse.ArgumentParser(description="Makes the tetrahedral meshes of the fracture cases with Gmsh.")
    parser.add_argument("name", nargs="?", choices=MESHES, metavar="NAME", help="name of the mesh; see --list")
    parser.add_argument("--size", type=float, metavar="METRES", help="mesh size [m]")
    parser.add_argument("--height", type=float, metavar="METRES", help="height of a Tetrapod [m]; default 1")
    parser.add_argument("--coarse", action="store_true", help="make the coarse mesh, as in cases/fracture/meshes")
    parser.add_argument("--out", type=Path, metavar="FILE", help="output file; default runs/meshes/NAME.msh")
    parser.add_argument("--all", action="store_true", help="make every mesh")
    parser.add_argument("--list", action="store_true", help="list the meshes")
    options = parser.parse_args()
    if options.list:
        for name, entry in MESHES.items():
            print(f"{name:24}{1e3 * entry.size:7.1f} mm, coarse {1e3 * entry.coarse:5.1f} mm  {summary(entry)}")
    elif options.all:
        if options.size or options.height or options.out:
            parser.error("--size, --height and --out need the NAME of one mesh; they do not work with --all")
        for name in MESHES:
            make(name, options.coarse)
    elif options.name:
        if options.height and not MESHES[options.name].has_height():
            parser.error(f"the height of {options.name} is fixed; omit --height")
        make(options.name, options.coarse, options.size, options.height, options.out)
    else:
        parser.error("give the NAME of a mesh, --all or --list")


def summary(entry):
    """First line of the docstring of the entry's function."""
    return entry.build.__doc__.splitlines()[0]


def make(name, coarse=False, size=None, height=None, out=None):
    """Builds, meshes and writes one mesh, and prints its properties."""
    out = out or (COARSE_FOLDER / f"{name}-coarse.msh" if coarse else FOLDER / f"{name}.msh")
    out.parent.mkdir(parents=True, exist_ok=True)
    gmsh.initialize(interruptible=False)
    try:
        set_options()
        gmsh.model.add(name)
        scene = MESHES[name].scene(coarse, size, height)
        name_groups(scene)
        set_sizes(scene)
        for body in scene.bodies:
            join_narrow_faces(body.faces())
        mesh()
        tets = {body.name: corners_of(body) for body in scene.bodies}
        gmsh.option.setNumber("Mesh.Binary", sum(map(len, tets.values())) > MOST_IN_ASCII)
        gmsh.write(str(out))
    finally:
        gmsh.finalize()
    print(f"{out}: {out.stat().st_size / 1000:.0f} kB")
    for body in scene.bodies:
        print(f"  {body.name:12}{describe(body, tets[body.name])}")


def set_options():
    """Sets the options of Gmsh; one thread and a fixed seed give the same mesh in every run."""
    options = {
        "General.Terminal": 0,
        "General.NumThreads": 1,
        "Mesh.RandomSeed": 1,
        "Mesh.MshFileVersion": 4.1,
        "Mesh.SaveAll": 0,
        # Do not split short edges.
        "Mesh.MinimumCurveNodes": 2,
        # Frontal Delaunay on surfaces, Delaunay in volumes.
        "Mesh.Algorithm": 6,
        "Mesh.Algorithm3D": 1,
        "Mesh.Optimize": 1,
        "Mesh.OptimizeThreshold": OPTIMIZE_BELOW,
        "Mesh.MeshSizeFromPoints": 1,
        "Mesh.MeshSizeExtendFromBoundary": 1,
        "Mesh.MeshSizeFromCurvature": SIDES_OF_CIRCLE,
    }
    for name, value in options.items():
        gmsh.option.setNumber(name, value)


def name_groups(scene):
    """Defines the physical groups; Gmsh writes only entities with a name."""
    for body in scene.bodies:
        gmsh.model.addPhysicalGroup(3, body.solids, name=body.name)
        for name, faces in body.cracks.items():
            gmsh.model.addPhysicalGroup(2, faces, name=name)
    for name, faces in scene.surfaces.items():
        gmsh.model.addPhysicalGroup(2, faces, name=name)
    for name, curves in scene.curves.items():
        gmsh.model.addPhysicalGroup(1, curves, name=name)


def set_sizes(scene):
    """Sets the mesh size of each body."""
    for body in scene.bodies:
        points = gmsh.model.getBoundary([(3, solid) for solid in body.solids], False, False, recursive=True)
        gmsh.model.mesh.setSize(points, ASKED * body.size)


def mesh():
    """Generates the tetrahedra and optimises them in rounds."""
    gmsh.model.mesh.generate(3)
    for _ in range(ROUNDS):
        gmsh.model.mesh.optimize("")
        gmsh.model.mesh.optimize("Netgen")


def corners_of(body):
    """Corners of the body's tetrahedra: array (n, 4, 3) [m]."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    where = np.empty(int(tags.max()) + 1, int)
    where[tags] = np.arange(len(tags))
    nodes = np.concatenate([gmsh.model.mesh.getElementsByType(4, solid)[1] for solid in body.solids])
    return coordinates.reshape(-1, 3)[where[nodes]].reshape(-1, 4, 3)


def describe(body, tets):
    """Number of tetrahedra, volume and its error, edge lengths and smallest angle in one line."""
    edges, volume = quality.edge_lengths(tets), quality.volumes(tets).sum()
    return (
        f"{len(tets):7} tetrahedra, {volume:.6g} m3 ({100 * (volume / body.volume - 1):+.2f} %), "
        f"mean edge {1e3 * edges.mean():.4g} mm, shortest {1e3 * edges.min():.4g} mm, "
        f"smallest angle {quality.dihedral_angles(tets).min():.1f} degrees"
    )


if __name__ == "__main__":
    main()
