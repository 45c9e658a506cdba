"""A small case that all tests share: a Tetrapod in still water."""

from pathlib import Path

import pytest

import breakwater_sim as bw

CASES = Path(__file__).parents[2] / "cases"

KEYS = {
    "title": "A Tetrapod in shallow water",
    "flume": {"bed_m": [[0.0, 0.0], [0.6, 0.0]], "still_water_level_m": 0.12, "material": "pvc"},
    "domain": {"x_m": [0.0, 0.6], "width_m": 0.16, "sides": "periodic", "top_z_m": 0.3, "dp_m": 0.014},
    "units": {
        "shape": "tetrapod",
        "height_m": 0.077,
        "mass_kg": 0.3,
        "material": "mortar",
        "count": 1,
        "pitch_m": 0.16,
        "x_m": 0.3,
    },
    "materials": [
        {"name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5},
        {"name": "pvc", "young_modulus_pa": 1e8, "poisson_ratio": 0.35, "restitution": 0.5},
    ],
    "numerics": {"hold_units_s": 0.01},
    "friction": [
        {"between": ["mortar", "mortar"], "coefficient": 0.65},
        {"between": ["mortar", "pvc"], "coefficient": 0.32},
    ],
    "gauges": [{"kind": "elevation", "name": "middle", "x_m": 0.2}],
    "output": {
        "fluid_interval_s": 0.02,
        "surface_interval_s": 0.02,
        "units_interval_s": 0.02,
        "series_interval_s": 0.01,
        "checkpoint_interval_s": 0.02,
    },
    "stop": {"duration_s": 0.08},
}


@pytest.fixture
def case():
    return bw.Case(KEYS)


@pytest.fixture(scope="session")
def run(tmp_path_factory):
    """A finished run of the case."""
    return bw.Case(KEYS).run(tmp_path_factory.mktemp("runs") / "small", threads=1, device="cpu", progress=False)


@pytest.fixture(scope="session")
def dry_run(tmp_path_factory):
    """A finished dry test."""
    drop = bw.Case.load(CASES / "tutorial" / "drop.json")
    return drop.run(tmp_path_factory.mktemp("runs") / "drop", progress=False)


@pytest.fixture(scope="session")
def fracture_run(tmp_path_factory):
    """A finished run of a fracture case, with all its snapshots."""
    impact = bw.Case.load(CASES / "tutorial" / "impact.json")
    impact["output.tets_interval_s"] = 5e-4
    impact["output.section"] = {"point_m": [0.0, 0.0, 0.5], "normal": [0.0, 1.0, 0.0]}
    return impact.run(tmp_path_factory.mktemp("runs") / "impact", progress=False)
