"""Meshes faces with sharp corners together with a neighbour, because such faces would cause short edges."""

import math

import gmsh
import numpy as np

# A corner with a smaller angle is narrow [degrees]. At this angle, the opposite side is about half as long as the other
# two sides.
NARROW = 30.0
# Faces are joined only if the angle between them is smaller than this [degrees].
FLAT = 25.0


def join_narrow_faces(faces):
    """Makes Gmsh mesh every narrow triangle of `faces` together with the neighbour at the smallest angle."""
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
    """Corners of a triangle with straight sides [m]; None for other faces."""
    curves = gmsh.model.getBoundary([(2, face)], oriented=False)
    if len(curves) != 3 or any(gmsh.model.getType(*curve) != "Line" for curve in curves):
        return None
    points = sorted({tag for _, tag in gmsh.model.getBoundary(curves, combined=False, oriented=False)})
    return np.array([gmsh.model.getValue(0, point, []) for point in points])


def _least_angle(corners):
    """Smallest angle of a triangle [degrees], opposite to its shortest side."""
    a, b, c = sorted(np.linalg.norm(corners[k] - corners[k - 1]) for k in range(3))
    return math.degrees(math.acos((b * b + c * c - a * a) / (2 * b * c)))


def _neighbours(face, triangles):
    """Triangles among `triangles` that share a side with the face."""
    curves = [tag for _, tag in gmsh.model.getBoundary([(2, face)], oriented=False)]
    beside = {int(other) for curve in curves for other in gmsh.model.getAdjacencies(1, curve)[0]}
    return beside & triangles.keys() - {face}


def _bend(face, other):
    """Angle between two plane faces [degrees]; 0 if they are coplanar."""
    cosine = np.dot(*(gmsh.model.getNormal(tag, [0, 0]) for tag in (face, other)))
    # The normals may point to different sides of the body; the angle here never exceeds 90 degrees.
    return math.degrees(math.acos(min(abs(cosine), 1.0)))
