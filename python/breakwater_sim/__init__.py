"""breakwater: will this wave move the armour units, and will the units break?

A `Case` is a case file whose keys can be read and changed. `Case.check` validates it, `Case.run` simulates it and
returns a `Run`: the results as pandas tables and numpy arrays. `open_run` opens the folder of an earlier run.
All quantities are in SI units; column names include the unit.
"""

from ._native import version as __version__
from .cases import Case, Check
from .errors import CaseError, Problem, RunError
from .runs import FractureRun, Run, Surface, Water, open_run, resume
from .sweeps import Sweep, sweep
from .units import UnitShape, catalogue

__all__ = [
    "Case",
    "CaseError",
    "Check",
    "FractureRun",
    "Problem",
    "Run",
    "RunError",
    "Surface",
    "Sweep",
    "UnitShape",
    "Water",
    "__version__",
    "catalogue",
    "open_run",
    "resume",
    "sweep",
]
