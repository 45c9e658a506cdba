"""Contents of a mesh: bodies, and the named parts of their boundaries.

Lengths are in metres; x is along the unit or beam, y across, z upwards, as everywhere in breakwater.
"""

from dataclasses import dataclass, field

import gmsh

# Tolerance of the search for a face by its plane or centre [m]: bounding boxes of OpenCASCADE are 1e-7 m too large.
FOUND = 2e-6
# Gap between bodies before an impact [m]: far smaller than an element, larger than rounding errors of coordinates.
IMPACT_GAP = 1e-4
# Gap between bodies at rest on each other [m]: the fall through it is negligible.
RESTING_GAP = 1e-6


@dataclass
class Body:
    """A body that moves independently: a physical volume."""

    name: str
    # Tags of the solids: one, or several parts if a face inside the body is needed.
    solids: list
    # Exact volume [m3].
    volume: float
    # Mesh size [m].
    size: float
    # Pre-existing cracks by name: tags of faces between two of the solids.
    cracks: dict = field(default_factory=dict)

    def faces(self):
        """Tags of the boundary faces."""
        return [tag for _, tag in gmsh.model.getBoundary([(3, solid) for solid in self.solids], oriented=False)]

    def faces_at(self, axis, value):
        """Tags of the faces that lie in the plane where the coordinate `axis` (0, 1, 2) is `value` [m]."""

        def lies_in_plane(tag):
            box = gmsh.model.getBoundingBox(2, tag)
            return abs(box[axis] - value) < FOUND and abs(box[axis + 3] - value) < FOUND

        return _some(filter(lies_in_plane, self.faces()), f"{self.name}: face at {value} of axis {axis}")

    def face_about(self, centre):
        """Tag of the face with this centroid, in a list."""
        return _about(2, self.faces(), centre)

    def curve_about(self, centre):
        """Tag of the curve with this midpoint, in a list."""
        curves = {tag for _, tag in gmsh.model.getBoundary([(2, f) for f in self.faces()], False, False)}
        return _about(1, curves, centre)


@dataclass
class Scene:
    """Bodies and named sets of their boundaries: surfaces, or curves where only a line of nodes is fixed or moved."""

    bodies: list
    surfaces: dict = field(default_factory=dict)
    curves: dict = field(default_factory=dict)


def _about(dimension, tags, centre):
    def is_there(tag):
        middle = gmsh.model.occ.getCenterOfMass(dimension, tag)
        return max(abs(a - b) for a, b in zip(middle, centre)) < FOUND

    return _some(filter(is_there, tags), f"entity of dimension {dimension} about {centre}")


def _some(found, what):
    found = list(found)
    if not found:
        raise LookupError(f"{what}: not found")
    return found


def extruded(profile, y):
    """Tag of the solid extruded from a polygon (x, z), from y[0] to y[1]; every side of the polygon gives a face."""
    occ = gmsh.model.occ
    points = [occ.addPoint(x, y[0], z) for x, z in profile]
    sides = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    face = occ.addPlaneSurface([occ.addCurveLoop(sides)])
    return solid_of(occ.extrude([(2, face)], 0, y[1] - y[0], 0))


def solid_of(entities):
    """Tag of the only volume among (dimension, tag) pairs."""
    [solid] = [tag for dimension, tag in entities if dimension == 3]
    return solid


def profile_area(profile):
    """Area of a polygon (x, z) [m2]."""
    pairs = zip(profile, profile[1:] + profile[:1])
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)) / 2


def sides_of(body, name):
    """Sets of a base that is fixed at its sides: bottom, left and right (-x, +x), front and back (-y, +y)."""
    low, high = (gmsh.model.getBoundingBox(3, body.solids[0])[k : k + 3] for k in (0, 3))
    at = {"left": (0, low[0]), "right": (0, high[0]), "front": (1, low[1]), "back": (1, high[1]), "bottom": (2, low[2])}
    return {f"{name}_{side}": body.faces_at(axis, value) for side, (axis, value) in at.items()}
