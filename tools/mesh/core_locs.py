"""Five Core-Locs above a slope: Guo, Latham & Xiang, section 4.

The units of section 4.1 are lifted by about 16 mm, are about 32 mm from their nearest neighbours, and fall. Figure 25
shows their positions without coordinates; the positions here are assumed. `breakwater place` lowered five Core-Locs
onto a level foot and a slope of 3:4. Then they were moved apart to about the distances of the paper. As in section 4.3,
unit 4 falls by 49 mm within 0.1 s without touching anything. Unit 5 is the first to hit the base, after 21 ms.
"""

import gmsh
import numpy as np

from scene import Body, Scene, extruded, profile_area, sides_of
from units import CoreLoc

# Size C [m] of a unit of 8 m3 (section 4.1).
SIZE = 3.31
# Centres [m] and rotations (x, y, z, w) of units 1 to 5. Gaps above the base: 16, 16, 16, 80 and 2.2 mm; gaps between
# neighbours: 1-2 and 1-3 32 mm, 3-4 79 mm, 3-5 53 mm, all others more than 0.3 m.
POSES = [
    ((-1.863, -1.155, 1.4738), (-0.583, -0.396, -0.183, 0.686)),
    ((-1.787, 2.230, 1.5742), (-0.186, -0.645, -0.681, 0.293)),
    ((0.792, -0.679, 2.4613), (0.286, -0.610, 0.734, -0.089)),
    ((3.005, -1.668, 5.0014), (-0.860, -0.430, -0.095, 0.258)),
    ((1.297, 1.844, 3.1191), (0.485, -0.714, -0.491, -0.120)),
]
# Side view of the base [m], (x, z): a level foot, then a slope of 3:4. The assumed thickness gives about as many elements
# of 1.5 m as in the paper, 2079.
BASE = [(-5.5, -5.0), (6.5, -5.0), (6.5, 4.875), (0.0, 0.0), (-5.5, 0.0)]
BASE_Y = (-5.0, 5.5)


def core_loc_five(size, base_size):
    """Five Core-Locs of 8 m3 close to each other, just above a level foot and a slope, before they fall."""
    shape = CoreLoc(SIZE)
    units = []
    for number, (centre, rotation) in enumerate(POSES, start=1):
        solid = shape.solid()
        gmsh.model.occ.affineTransform([(3, solid)], pose(centre, rotation))
        units.append(Body(f"unit_{number}", [solid], shape.volume, size))
    area = profile_area(BASE)
    base = Body("base", [extruded(BASE, BASE_Y)], area * (BASE_Y[1] - BASE_Y[0]), base_size)
    gmsh.model.occ.synchronize()
    return Scene([*units, base], sides_of(base, "base"))


def pose(centre, rotation):
    """4 x 4 matrix, by rows, of a rotation (x, y, z, w) about the origin and a translation to the centre [m]."""
    x, y, z, w = np.array(rotation) / np.linalg.norm(rotation)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += 2 * w * cross + 2 * cross @ cross
    matrix[:3, 3] = centre
    return matrix.ravel().tolist()
