"""A single Tetrapod, and a Tetrapod that falls onto a base."""

import gmsh

from bars import box
from scene import IMPACT_GAP, Body, Scene, sides_of
from units import Tetrapod

# Height of the Tetrapod [m], equal to the height of the Dolos in the drop test.
HEIGHT = 1.0
# Assumed, in heights H of the unit: the base extends 0.2 H beyond the feet and is 0.3 H thick.
BASE_HALF_WIDTH = 0.85
BASE_THICKNESS = 0.3


def tetrapod(size, height=HEIGHT):
    """Tetrapod of the given height [m], centred, one leg up."""
    unit = _unit(size, height)
    gmsh.model.occ.synchronize()
    return Scene([unit])


def tetrapod_on_base(size, base_size, height=HEIGHT):
    """Tetrapod on three legs, 0.1 mm above a base with its top at z = 0: it falls, and all feet hit simultaneously."""
    unit = _unit(size, height)
    gmsh.model.occ.translate([(3, unit.solids[0])], 0, 0, Tetrapod(height).foot + IMPACT_GAP)
    half, thickness = BASE_HALF_WIDTH * height, BASE_THICKNESS * height
    base = box("base", (-half, -half, -thickness), (half, half, 0), base_size)
    gmsh.model.occ.synchronize()
    return Scene([unit, base], sides_of(base, "base"))


def _unit(size, height):
    shape = Tetrapod(height)
    return Body("unit", [shape.solid()], shape.volume, size)
