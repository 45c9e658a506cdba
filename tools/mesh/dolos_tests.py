"""Drop and pendulum tests of a Dolos: Guo, Latham & Xiang, sections 3.1 and 3.2, after Burcharth (1981b).

The paper's axes are x along the stem, y upwards, z across; here z is upwards and y across. The paper does not give all
dimensions of base, block and cylinder (its Figures 9 and 15). Dimensions marked "assumed" are not in its text.
"""

import math

import gmsh

from polyhedron import Polyhedron
from scene import IMPACT_GAP, RESTING_GAP, Body, Scene, extruded, profile_area, sides_of, solid_of
from units import Dolos

# Length of the Dolos [m] (section 3.1.1).
HEIGHT = 1.0
# Depth of the pre-existing cracks divided by the mesh size [-]: "approximately one element length" (section 3.1.3).
CRACK_DEPTH = 1.0

# The base is a slab with a step. The upright fluke hits the slab. Stem and horizontal fluke rest on the flat top of the
# step, which the stem touches (section 3.1.2, second stress concentration). The step is therefore as high as the distance
# from the lower end of the upright fluke to the underside of the stem. The other dimensions are assumed: with them the
# volumes of unit, base and block are proportional to the paper's numbers of elements (67,240, 103,042 and about 10,500).
STEP_END = 0.05  # [m] under the middle of the stem, clear of the fluke and its haunch
BASE_X = (-0.60, 0.85)  # [m]
BASE_Y = (-0.40, 0.40)  # [m]
SLAB = 0.10  # thickness [m]

# The block that stops the foot of the upright fluke in the pendulum test is H/12 high (section 3.2.1). Assumed: it is a
# part of the base, stands on the side of +x, towards which the foot moves, and extends to the end of the base.
BLOCK = HEIGHT / 12

# Mass of the cylinder divided by the mass of the Dolos [-] (section 3.2.1).
CYLINDER_MASS = 1 / 5
# Densities of concrete and steel [kg/m3] (Table 3).
CONCRETE, STEEL = 2340.0, 7850.0
# Distance from the impact point of the cylinder to the end of the fluke [m] (section 3.2.1).
STRUCK = HEIGHT / 12


def dolos_drop(size, base_size, cracked=False):
    """Dolos that has rotated about its horizontal fluke: the foot of the upright fluke is 0.1 mm above the slab."""
    dolos = Dolos(HEIGHT)
    pivot = pivot_of(dolos)
    # Rotation by this angle gives the gap at the foot.
    angle = IMPACT_GAP / (dolos.crossing - pivot[0])

    def pose(entities):
        gmsh.model.occ.rotate(entities, *pivot, 0, -1, 0, angle)
        gmsh.model.occ.translate(entities, 0, 0, RESTING_GAP)

    unit = _unit(dolos, size, cracked, pose)
    base = _base(_step_and_slab(dolos), base_size)
    gmsh.model.occ.synchronize()
    return Scene([unit, base], sides_of(base, "base"))


def dolos_pendulum(size, base_size, cracked=False):
    """Dolos at rest on the base with its foot at the block, and a steel cylinder 0.1 mm from its head."""
    dolos = Dolos(HEIGHT)
    unit = _unit(dolos, size, cracked, lambda entities: gmsh.model.occ.translate(entities, 0, 0, RESTING_GAP))
    base = _base(_step_and_slab_with_block(dolos), base_size)
    cylinder = _cylinder(dolos, size)
    gmsh.model.occ.synchronize()
    return Scene([unit, base, cylinder], sides_of(base, "base"))


def dolos_drop_cracked(size, base_size):
    """Drop test with cracks in the surface of the Dolos."""
    return dolos_drop(size, base_size, cracked=True)


def dolos_pendulum_cracked(size, base_size):
    """Pendulum test with cracks in the surface of the Dolos."""
    return dolos_pendulum(size, base_size, cracked=True)


def pivot_of(dolos):
    """Point of the rotation axis: the outer edge of the horizontal fluke's underside, in the axes of the Dolos [m]."""
    return (-dolos.crossing - dolos.half_fluke_flat, 0.0, -dolos.half_stem)


def _unit(dolos, size, cracked, pose):
    whole = dolos.solid()
    if not cracked:
        pose([(3, whole)])
        return Body("unit", [whole], dolos.volume, size)
    wedges = [_wedge(dolos, side, CRACK_DEPTH * size) for side in (1, -1)]
    pose([(3, solid) for solid in (whole, *wedges)])
    parts, origins = gmsh.model.occ.fragment([(3, whole)], [(3, wedge) for wedge in wedges])
    upper, lower = (_crack_of(solid_of(origin), side) for origin, side in zip(origins[1:], (1, -1)))
    return Body("unit", [tag for _, tag in parts], dolos.volume, size, {"crack_upper": upper, "crack_lower": lower})


def _wedge(dolos, side, depth):
    """Prism inside the stem at its upper (side 1) or lower (-1) corner with the upright fluke.

    The prism touches the surface only along the edge between stem and haunch. The side of the prism towards the fluke is
    the crack. A solid is needed because Gmsh optimises meshes only if faces inside a body separate two solids.

    The crack starts at "the inner side of the chamfer, which is attached to the stem" and leans "more towards the
    fluke" (section 3.3.2). Assumed: an inclination of 45 degrees, normal to the haunch, and the full flat width of the
    stem between its chamfers.
    """
    x, z = dolos.haunch_on_stem, side * dolos.half_stem
    # An equilateral triangle gives well-shaped tetrahedra on both sides. Angles are measured downwards from the x axis.
    ways = [math.radians(45), math.radians(105)]
    section = [(x, z), *((x + depth * math.cos(way), z - side * depth * math.sin(way)) for way in ways)]
    return Polyhedron([(x, y, z) for x, z in section for y in (-dolos.half_flat, dolos.half_flat)]).solid()


def _crack_of(wedge, side):
    """The side of the wedge nearest to the surface of the stem."""
    sides = gmsh.model.occ.getSurfaceLoops(wedge)[1][0]
    return [int(max(sides, key=lambda face: side * gmsh.model.occ.getCenterOfMass(2, face)[2]))]


def _base(profile, size):
    return Body("base", [extruded(profile, BASE_Y)], profile_area(profile) * (BASE_Y[1] - BASE_Y[0]), size)


def _step_and_slab(dolos):
    """Side view of the base: corners (x, z) [m]."""
    step, floor = -dolos.half_stem, -dolos.height / 2
    (left, right), bottom = BASE_X, floor - SLAB
    return [(left, bottom), (right, bottom), (right, floor), (STEP_END, floor), (STEP_END, step), (left, step)]


def _step_and_slab_with_block(dolos):
    """Side view of the base with the block; the upright fluke touches the block's upper edge."""
    *before, (right, floor), corner, step, left = _step_and_slab(dolos)
    top = floor + BLOCK
    face = dolos.crossing + dolos.half_fluke(top - RESTING_GAP) + RESTING_GAP
    return [*before, (right, top), (face, top), (face, floor), corner, step, left]


def cylinder_diameter(dolos):
    """Diameter and length [m] of the steel cylinder."""
    return (4 / math.pi * CYLINDER_MASS * CONCRETE / STEEL * dolos.volume) ** (1 / 3)


def _cylinder(dolos, size):
    """Steel cylinder at the head of the upright fluke.

    Assumed: the cylinder lies along y and hits with its curved side. If the cylinder hit with an end face, the lower rim
    of that face would hit the inclined side of the fluke first, half a diameter below the axis of the cylinder.
    """
    diameter = cylinder_diameter(dolos)
    struck = dolos.height / 2 - STRUCK
    x = dolos.crossing + dolos.half_fluke(struck)
    # Inclination of the fluke's side. The cylinder touches this side along the line through the impact point.
    lean = math.atan((dolos.half_stem - dolos.half_fluke(dolos.height / 2)) / (dolos.height / 2))
    # A prism of the same mass with about one side per element. One of its edges is the contact line.
    sides = max(12, round(math.pi * diameter / size))
    radius = diameter / 2 * math.sqrt(2 * math.pi / sides / math.sin(2 * math.pi / sides))
    away = radius + IMPACT_GAP
    centre = (x + away * math.cos(lean), struck + away * math.sin(lean))
    angles = [math.pi + lean + 2 * math.pi * side / sides for side in range(sides)]
    profile = [(centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)) for angle in angles]
    return Body("cylinder", [extruded(profile, (-diameter / 2, diameter / 2))], math.pi / 4 * diameter**3, size)
