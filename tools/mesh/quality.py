"""Sizes and shapes of tetrahedra."""

from itertools import combinations

import numpy as np


def volumes(tets):
    """Volumes [m3] of tetrahedra, an array (n, 4, 3) of corners [m]; negative for an inverted tetrahedron."""
    a, b, c = (tets[:, k] - tets[:, 0] for k in (1, 2, 3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)) / 6


def edge_lengths(tets):
    """Lengths [m] of the six edges of every tetrahedron."""
    return np.stack([np.linalg.norm(tets[:, a] - tets[:, b], axis=1) for a, b in combinations(range(4), 2)], axis=1)


def dihedral_angles(tets):
    """The six angles [degrees] between the faces of every tetrahedron."""
    normals = []
    for opposite in range(4):
        a, b, c = (tets[:, k] for k in range(4) if k != opposite)
        normal = np.cross(b - a, c - a)
        outward = np.sign(np.einsum("ij,ij->i", normal, a - tets[:, opposite]))
        normals.append(normal * (outward / np.linalg.norm(normal, axis=1))[:, None])
    cosines = [-np.einsum("ij,ij->i", normals[a], normals[b]) for a, b in combinations(range(4), 2)]
    return np.degrees(np.arccos(np.clip(np.stack(cosines, axis=1), -1, 1)))
