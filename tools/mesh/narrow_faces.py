"""Faces with sharp corners, which would force short edges on the mesh: meshed as one with a neighbour."""

import math

import gmsh
import numpy as np

# Corners sharper than this are narrow [degrees]: the side opposite to such a corner is half as long as the others.
NARROW = 30.0
# Only faces that bend less than this at their common edge become one [degrees].
FLAT = 25.0


def join_narrow_faces(faces):
    """Lets Gmsh mesh every narrow triangle among `faces` together with the triangle at which it bends least."""
    triangles = {face: corners for face in faces if (corners := _corners(face)) is not None}
    joined = set()
    for face in sorted(triangles, key=lambda face: _least_angle(triangles[face])):
        if _least_angle(triangles[face]) > NARROW:
            break
        bends = {other: _bend(face, other) for other in sorted(_neighbours(face, triangles) - joined)}
        if face in joined or not bends:
            continue
        other = min(bends, key=bends.get)
        if bends[other] < FLAT:
            gmsh.model.mesh.setCompound(2, [face, other])
            joined |= {face, other}


def _corners(face):
    """The corners of a triangle with straight sides [m]; None for other faces."""
    curves = gmsh.model.getBoundary([(2, face)], oriented=False)
    if len(curves) != 3 or any(gmsh.model.getType(*curve) != "Line" for curve in curves):
        return None
    points = sorted({tag for _, tag in gmsh.model.getBoundary(curves, combined=False, oriented=False)})
    return np.array([gmsh.model.getValue(0, point, []) for point in points])


def _least_angle(corners):
    """Least angle of a triangle [degrees]: opposite to its shortest side."""
    a, b, c = sorted(np.linalg.norm(corners[k] - corners[k - 1]) for k in range(3))
    return math.degrees(math.acos((b * b + c * c - a * a) / (2 * b * c)))


def _neighbours(face, triangles):
    """Those of `triangles` that share a side with the face."""
    curves = [tag for _, tag in gmsh.model.getBoundary([(2, face)], oriented=False)]
    beside = {int(other) for curve in curves for other in gmsh.model.getAdjacencies(1, curve)[0]}
    return beside & triangles.keys() - {face}


def _bend(face, other):
    """Angle between two plane faces [degrees], 0 if they lie in one plane."""
    cosine = np.dot(*(gmsh.model.getNormal(tag, [0, 0]) for tag in (face, other)))
    # The normals of two faces may point to different sides of the body; no face here bends by more than 90 degrees.
    return math.degrees(math.acos(min(abs(cosine), 1.0)))
