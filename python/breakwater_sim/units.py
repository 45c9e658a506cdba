"""Catalogue of armour units."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np

from . import _native


@dataclass(frozen=True)
class UnitShape:
    """An armour unit of height 1 m (size C of a Core-Loc)."""

    name: str
    """Name of the shape, as `units.shape` in a case."""
    volume_m3: float
    k_d: float | None
    """Stability coefficient of the Hudson formula: two layers, random placement, trunk, breaking waves."""
    vertices_m: np.ndarray
    """Points of the surface relative to the centre of mass, shape (n, 3)."""
    triangles: np.ndarray
    """Indices of the corner points, shape (m, 3)."""
    inertia_m5: tuple[float, float, float]
    """Moments of inertia about the body axes for a density of 1 kg/m3."""

    def volume(self, height_m: float) -> float:
        """Returns the volume of a unit [m3]."""
        return self.volume_m3 * height_m**3

    def nominal_diameter(self, height_m: float) -> float:
        """Returns the nominal diameter of a unit [m]: the edge of a cube of the same volume."""
        return self.volume(height_m) ** (1.0 / 3.0)


def catalogue() -> dict[str, UnitShape]:
    """Returns the armour units of the catalogue by their names."""
    shapes = {}
    for unit in json.loads(_native.catalogue()):
        vertices = np.asarray(unit.pop("vertices_m"), dtype=float)
        triangles = np.asarray(unit.pop("triangles"), dtype=np.int64)
        inertia = tuple(unit.pop("inertia_m5"))
        shapes[unit["name"]] = UnitShape(**unit, vertices_m=vertices, triangles=triangles, inertia_m5=inertia)
    return shapes
