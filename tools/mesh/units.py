"""Solids of the armour units in body axes: Dolos, Core-Loc, Tetrapod."""

import math

import gmsh
import numpy as np

from polyhedron import Polyhedron
from scene import solid_of


def octagon(width, chamfer):
    """Corners of a square section of the given width with chamfers of leg `chamfer`."""
    w, s = width / 2, width / 2 - chamfer
    return [(w, -s), (w, s), (s, w), (-s, w), (-w, s), (-w, -s), (-s, -w), (s, -w)]


def united(solids):
    """Tag of the union of solids, without seams between coplanar faces."""
    first, *others = [(3, solid) for solid in solids]
    entities, _ = gmsh.model.occ.fuse([first], others)
    return solid_of(entities)


class Dolos:
    """Dolos of height H: the stem along x, the fluke at -x along y, the fluke at +x upright.

    Ratios of Burcharth (1981b), also used by Guo et al. (section 3, Figure 8): width of the stem a/H = 0.36, width of
    the flukes at their ends b/H = 0.20, chamfer c/H = 0.056. c applies to all chamfers: along the stem, at the fluke
    ends, and as the leg of the haunch between stem and fluke, the "chamfer connection" of sections 3.1.3 and 3.3.2. As
    in breakwater's own Dolos, the flukes have the width `a` in the middle and taper linearly to both ends. Their
    chamfers are proportional to the width.

    With the haunches, each crossing is a hub: the convex hull of the stem's section where the haunch begins and the
    fluke's sections where it ends. The volume is 0.1854 H^3, 2.1 % more than the 0.675 (a/H)^1.285 H^3 of a Dolos
    without haunches. With Burcharth's H = 2.32 m and 2340 kg/m3, the mass is 5.42 t; his units had 5.4 t.
    """

    STEM, END, CHAMFER = 0.36, 0.20, 0.056

    def __init__(self, height):
        self.height = height
        self.half_stem = self.STEM / 2 * height
        # Distance of a fluke's axis from the middle of the unit.
        self.crossing = height / 2 - self.half_stem
        # The haunch starts on the stem and ends on the fluke. Distances of both points from the middle of stem and fluke.
        self.haunch_on_stem = self.crossing - self.half_fluke(self.half_stem) - self.CHAMFER * height
        self.haunch_on_fluke = self.half_stem + self.CHAMFER * height
        # Half of the flat width between the chamfers of the stem.
        self.half_flat = self.half_stem - self.CHAMFER * height
        # Half of the flat width between the chamfers in the middle of a fluke.
        self.half_fluke_flat = self.half_stem * (1 - 2 * self.CHAMFER / self.END)
        self.blocks = self._blocks()
        self.volume = sum(block.volume() for block in self.blocks)

    def half_fluke(self, along):
        """Half of a fluke's width [m] at the distance `along` [m] from the middle of the fluke."""
        return self.half_stem + (self.END / 2 * self.height - self.half_stem) * abs(along) / (self.height / 2)

    def solid(self):
        """Tag of a new volume."""
        return united(block.solid() for block in self.blocks)

    def _blocks(self):
        """Convex blocks with common faces: stem, two hubs, four arms of the flukes."""
        h = self.haunch_on_fluke
        stem = [(self.haunch_on_stem, *p) for p in octagon(2 * self.half_stem, self.CHAMFER * self.height)]
        section = self._fluke_section
        hub = stem + [p for along in (-h, 0.0, h) for p in section(along)]
        arms = [section(side * h) + section(side * self.height / 2) for side in (-1, 1)]
        # The other end of the Dolos is this end, rotated by 180 degrees about z and by 90 degrees about x.
        other = np.array([[-1, 0, 0], [0, 0, 1], [0, 1, 0]])
        ends = [np.array(part) for part in (hub, *arms)]
        return [
            Polyhedron(np.concatenate([stem, np.array(stem) @ other.T])),
            *(Polyhedron(part) for part in ends),
            *(Polyhedron(part @ other.T) for part in ends),
        ]

    def _fluke_section(self, along):
        width = 2 * self.half_fluke(along)
        return [(self.crossing + u, v, along) for u, v in octagon(width, self.CHAMFER / self.END * width)]


class CoreLoc:
    """Core-Loc of size C: members 0.354 C wide in the middle, 0.189 C at the ends, chamfers of 0.1146 of the width.

    Two members stand upright, one on each side in y; the third lies along x between them. The dimensions are assumed:
    with them, a unit of 3.31 m has the 8 m3 of section 4.1 of Guo, Latham & Xiang. breakwater's own Core-Loc, with
    0.362 C and 0.181 C, has the same volume but edges of 0.014 C where its chamfers meet. Here the shortest edges, of
    the chamfers at the ends, are 0.030 C.
    """

    MIDDLE, END, CHAMFER = 0.354, 0.189, 0.1146

    def __init__(self, size):
        self.size = size
        # The dimensions were chosen for the volume 0.2206 C^3.
        self.volume = 0.2206 * size**3

    def solid(self):
        """Tag of a new volume."""
        aside = (1 - self.MIDDLE) / 2 * self.size
        members = [(0.0, 0), (aside, 2), (-aside, 2)]
        return united(half.solid() for y, axis in members for half in self._halves(y, axis))

    def _halves(self, y, axis):
        """Both halves of the member at y along the coordinate `axis`."""
        for side in (-1, 1):
            points = []
            for ratio, along in ((self.MIDDLE, 0.0), (self.END, side * self.size / 2)):
                width = ratio * self.size
                for u, v in octagon(width, self.CHAMFER * width):
                    point = [u, y + v, u]
                    point[axis] = along
                    points.append(point)
            yield Polyhedron(points)


class Tetrapod:
    """Tetrapod of height H (Danel & Greslou 1962), centred, one leg up: four cones from the centre to the tips.

    Tip radius 0.151 H, base radius 0.235 H, leg length 0.477 H, 0.644 H from the centre to a tip.
    """

    TIP, BASE, LEG, REACH = 0.151, 0.235, 0.477, 0.644

    def __init__(self, height):
        self.height = height
        # 0.2799 H^3.
        self.volume = 0.2799 * height**3
        # Depth of the lowest points below the centre: the lower rims of the tips.
        self.foot = (self.REACH / 3 + self.TIP * math.sqrt(8) / 3) * height

    def solid(self):
        """Tag of a new volume."""
        at_centre = self.TIP + self.REACH * (self.BASE - self.TIP) / self.LEG
        flat = math.sqrt(8) / 3
        axes = [(0, 0, 1)]
        for turn in range(3):
            angle = 2 * math.pi * turn / 3
            axes.append((-flat * math.cos(angle), -flat * math.sin(angle), -1 / 3))
        h = self.height
        return united(
            gmsh.model.occ.addCone(0, 0, 0, *(self.REACH * h * a for a in axis), at_centre * h, self.TIP * h)
            for axis in axes
        )
