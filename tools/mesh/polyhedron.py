"""Convex polyhedra from their corners, and their OpenCASCADE solids."""

from itertools import combinations

import gmsh
import numpy as np

# Distance below which a corner lies in a plane, relative to the extent of the body.
IN_PLANE = 1e-9


class Polyhedron:
    """Convex hull of points: `corners` [m]; `faces`, rings of corner indices, counter-clockwise seen from outside."""

    def __init__(self, points):
        points = np.unique(np.round(np.asarray(points, float), 12), axis=0)
        rings = _hull_faces(points)
        used = sorted({corner for ring in rings for corner in ring})
        number = {corner: index for index, corner in enumerate(used)}
        self.corners = points[used]
        self.faces = [[number[corner] for corner in ring] for ring in rings]

    def volume(self):
        """Volume [m3]: sum of the tetrahedra from the first corner to the triangles of the faces."""
        origin = self.corners[0]
        total = 0.0
        for ring in self.faces:
            a, *rest = self.corners[ring] - origin
            total += sum(a @ np.cross(b, c) for b, c in zip(rest, rest[1:]))
        return total / 6.0

    def solid(self):
        """Tag of a new volume with this shape."""
        occ = gmsh.model.occ
        points = [occ.addPoint(*corner) for corner in self.corners]
        lines = {}

        def line(a, b):
            if (b, a) in lines:
                return -lines[b, a]
            return lines.setdefault((a, b), occ.addLine(points[a], points[b]))

        loops = [occ.addCurveLoop([line(a, b) for a, b in zip(ring, ring[1:] + ring[:1])]) for ring in self.faces]
        faces = [occ.addPlaneSurface([loop]) for loop in loops]
        return occ.addVolume([occ.addSurfaceLoop(faces)])


def _hull_faces(points):
    """Rings of corner indices of the faces of the convex hull. The search tries the plane of every three points, because
    there are few points."""
    tolerance = IN_PLANE * np.ptp(points, axis=0).max()
    rings = {}
    for a, b, c in combinations(range(len(points)), 3):
        normal = np.cross(points[b] - points[a], points[c] - points[a])
        length = np.linalg.norm(normal)
        if length < tolerance**2:
            continue
        normal /= length
        height = (points - points[a]) @ normal
        if height.max() > tolerance:
            if height.min() < -tolerance:
                continue
            normal = -normal
        on_face = np.flatnonzero(abs(height) < tolerance)
        rings.setdefault(tuple(on_face), _ring(points, on_face, normal))
    return list(rings.values())


def _ring(points, on_face, normal):
    """Corners of a face, ordered around the outward normal, without points inside the face or on its sides."""
    middle = points[on_face].mean(axis=0)
    along = points[on_face[0]] - middle
    across = np.cross(normal, along)
    from_middle = points[on_face] - middle
    turn = np.argsort(np.arctan2(from_middle @ across, from_middle @ along))
    ring = [int(corner) for corner in on_face[turn]]
    reach = np.linalg.norm(from_middle, axis=1).max()

    def is_corner(before, corner, after):
        inward, onward = points[corner] - points[before], points[after] - points[corner]
        return np.cross(inward, onward) @ normal > 1e-9 * reach**2

    neighbours = zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1])
    return [corner for before, corner, after in neighbours if is_corner(before, corner, after)]
