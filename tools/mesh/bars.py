"""Bars, beams and prisms: elastic waves, vibration, bending, splitting, crushing, sliding."""

import math

import gmsh

from scene import IMPACT_GAP, RESTING_GAP, Body, Scene, extruded, solid_of


def box(name, low, high, size):
    """Body between two corners [m]."""
    edges = [b - a for a, b in zip(low, high)]
    return Body(name, [gmsh.model.occ.addBox(*low, *edges)], math.prod(edges), size)


def bar_single(size):
    """One bar of 0.5 m, 50 mm square: speed of an elastic wave along the bar."""
    bar = box("bar", (0, 0, 0), (0.5, 0.05, 0.05), size)
    gmsh.model.occ.synchronize()
    return Scene([bar], {"left": bar.faces_at(0, 0), "right": bar.faces_at(0, 0.5)})


def bar(size):
    """Two bars of 0.5 m, 50 mm square, just before an end-to-end impact at x = 0."""
    half_gap = IMPACT_GAP / 2
    one = box("bar_1", (-0.5 - half_gap, 0, 0), (-half_gap, 0.05, 0.05), size)
    two = box("bar_2", (half_gap, 0, 0), (0.5 + half_gap, 0.05, 0.05), size)
    gmsh.model.occ.synchronize()
    return Scene(
        [one, two],
        {
            "bar_1_left": one.faces_at(0, -0.5 - half_gap),
            "bar_1_right": one.faces_at(0, -half_gap),
            "bar_2_left": two.faces_at(0, half_gap),
            "bar_2_right": two.faces_at(0, 0.5 + half_gap),
        },
    )


def cantilever(size):
    """Cantilever of 1 m, 0.1 m square: first natural frequency 53.85 Hz with E = 26 GPa and 2340 kg/m3."""
    beam = box("cantilever", (0, 0, 0), (1, 0.1, 0.1), size)
    gmsh.model.occ.synchronize()
    return Scene([beam], {"clamped": beam.faces_at(0, 0), "tip": beam.faces_at(0, 1)})


def compression(size):
    """Prism of 50 x 50 x 100 mm for a concrete compression test, twice as high as wide."""
    prism = box("prism", (0, 0, 0), (0.05, 0.05, 0.1), size)
    gmsh.model.occ.synchronize()
    return Scene([prism], {"bottom": prism.faces_at(2, 0), "top": prism.faces_at(2, 0.1)})


def block_on_slab(size):
    """Cube of 0.1 m that slides on a slab towards +x; in the incline test gravity is rotated instead."""
    block = box("block", (0.05, -0.05, RESTING_GAP), (0.15, 0.05, 0.1 + RESTING_GAP), size)
    slab = box("slab", (0, -0.1, -0.05), (0.4, 0.1, 0), size)
    gmsh.model.occ.synchronize()
    top, bottom = block.faces_at(2, 0.1 + RESTING_GAP), slab.faces_at(2, -0.05)
    return Scene([block, slab], {"block_top": top, "slab_bottom": bottom})


def beam(size):
    """Beam of 320 x 40 x 20 mm on two supports 314 mm apart, loaded in the middle: three-point bending of Guo (2014).

    Supports and load are lines of nodes across the beam; fixing a strip of nodes would clamp the beam.
    """
    length, height, width, half_span = 0.320, 0.040, 0.020, 0.157
    foot = [-length / 2, -half_span, half_span, length / 2]
    profile = [(x, 0.0) for x in foot] + [(length / 2, height), (0.0, height), (-length / 2, height)]
    body = Body("beam", [extruded(profile, (-width / 2, width / 2))], length * height * width, size)
    gmsh.model.occ.synchronize()
    lines = {"support_left": (-half_span, 0, 0), "support_right": (half_span, 0, 0), "load": (0, 0, height)}
    return Scene([body], curves={name: body.curve_about(middle) for name, middle in lines.items()})


def disc(size):
    """Disc of 40 mm, 15 mm thick, compressed along z until it splits: Brazilian test of Guo (2014).

    The load acts on strips of 10 degrees, the contact width of curved jaws. Under a line load the concrete would crush
    before it splits.
    """
    radius, width, half_strip = 0.020, 0.015, math.radians(5)
    occ = gmsh.model.occ
    centre = occ.addPoint(0, -width / 2, 0)
    # Angles from the x axis: the ends of the top strip, then of the bottom strip.
    angles = [side * math.pi / 2 + shift for side in (1, -1) for shift in (-half_strip, half_strip)]
    points = [occ.addPoint(radius * math.cos(a), -width / 2, radius * math.sin(a)) for a in angles]
    arcs = [occ.addCircleArc(a, centre, b) for a, b in zip(points, points[1:] + points[:1])]
    face = occ.addPlaneSurface([occ.addCurveLoop(arcs)])
    occ.remove([(0, centre)])
    solid = solid_of(occ.extrude([(2, face)], 0, width, 0))
    occ.synchronize()
    body = Body("disc", [solid], math.pi * radius**2 * width, size)
    # Centroid of a strip.
    z = radius * math.sin(half_strip) / half_strip
    return Scene([body], {"top": body.face_about((0, 0, z)), "bottom": body.face_about((0, 0, -z))})
