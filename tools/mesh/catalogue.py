"""All meshes by name: the function that builds them and their mesh sizes."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass

import bars
import core_locs
import dolos_tests
import tetrapods


@dataclass(frozen=True)
class Entry:
    """How to build a mesh."""

    # Function that returns the scene for the given mesh sizes [m].
    build: Callable
    # Mesh size [m] of the fine mesh, for results, and of the coarse mesh, for a first run and for tests.
    size: float
    coarse: float
    # Mesh size of the base divided by mesh size of the unit, for the fine and the coarse mesh; None: no base.
    base: tuple = None

    def scene(self, coarse, size=None, height=None):
        """Scene with mesh size `size` [m] and unit height `height` [m]; None selects the default of the entry."""
        size = size or (self.coarse if coarse else self.size)
        sizes = [size] if self.base is None else [size, size * self.base[coarse]]
        return self.build(*sizes, height) if height else self.build(*sizes)

    def has_height(self):
        """Returns True if the height of the unit is a parameter."""
        return "height" in inspect.signature(self.build).parameters


MESHES = {
    "bar": Entry(bars.bar, 0.0125, 0.035),
    "bar_single": Entry(bars.bar_single, 0.0125, 0.035),
    "cantilever": Entry(bars.cantilever, 0.0125, 0.05),
    "beam": Entry(bars.beam, 0.0025, 0.01),
    "disc": Entry(bars.disc, 0.0012, 0.004),
    "compression": Entry(bars.compression, 0.005, 0.0125),
    "block_on_slab": Entry(bars.block_on_slab, 0.0125, 0.03),
    # Mean edge length 2.9 cm in unit and base (sections 3.1.1, 3.2.1).
    "dolos_drop": Entry(dolos_tests.dolos_drop, 0.029, 0.1, (1, 1.4)),
    "dolos_drop_cracked": Entry(dolos_tests.dolos_drop_cracked, 0.029, 0.1, (1, 1.4)),
    "dolos_pendulum": Entry(dolos_tests.dolos_pendulum, 0.029, 0.1, (1, 1.4)),
    "dolos_pendulum_cracked": Entry(dolos_tests.dolos_pendulum_cracked, 0.029, 0.1, (1, 1.4)),
    # Approximately 0.15 m and 19,331 tetrahedra in a unit, 1.5 m and 2,079 in the base (section 4.1).
    "core_loc_five": Entry(core_locs.core_loc_five, 0.165, 0.6, (10, 5)),
    "tetrapod": Entry(tetrapods.tetrapod, 0.03, 0.1),
    "tetrapod_on_base": Entry(tetrapods.tetrapod_on_base, 0.03, 0.1, (1, 2.4)),
}
