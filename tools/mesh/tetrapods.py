"""A Tetrapod alone, and one that falls onto a base."""

import gmsh

from bars import box
from scene import IMPACT_GAP, Body, Scene, sides_of
from units import Tetrapod

# Height of the Tetrapod [m], as long as the Dolos of the drop test.
HEIGHT = 1.0
# Assumed: the base reaches 0.2 H beyond the feet and is 0.3 H thick.
BASE_HALF_WIDTH = 0.85
BASE_THICKNESS = 0.3


def tetrapod(size, height=HEIGHT):
    """Tetrapod of a height [m] about its centre, one leg up."""
    unit = _unit(size, height)
    gmsh.model.occ.synchronize()
    return Scene([unit])


def tetrapod_on_base(size, base_size, height=HEIGHT):
    """Tetrapod on three legs, 0.1 mm over a base whose top is at z = 0: it falls, and all three feet hit flat."""
    unit = _unit(size, height)
    gmsh.model.occ.translate([(3, unit.solids[0])], 0, 0, Tetrapod(height).foot + IMPACT_GAP)
    half, thickness = BASE_HALF_WIDTH * height, BASE_THICKNESS * height
    base = box("base", (-half, -half, -thickness), (half, half, 0), base_size)
    gmsh.model.occ.synchronize()
    return Scene([unit, base], sides_of(base, "base"))


def _unit(size, height):
    shape = Tetrapod(height)
    return Body("unit", [shape.solid()], shape.volume, size)
