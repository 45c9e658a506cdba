"""Results of a run, read from its folder."""

from __future__ import annotations

import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import pandas as pd

from . import _native
from .cases import Case
from .errors import RunError, call
from .progress import Display

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Water:
    """Water particles at one time. Arrays have one row per particle; a field that the run did not record is None."""

    time_s: float
    position: np.ndarray
    """x, y, z [m], shape (n, 3)."""
    velocity: np.ndarray | None
    """Velocity [m/s], shape (n, 3)."""
    pressure: np.ndarray | None
    """Pressure [Pa], shape (n,)."""
    density: np.ndarray | None
    """Density [kg/m3], shape (n,)."""
    id: np.ndarray | None
    """Number of the particle, the same at all times, shape (n,)."""


@dataclass(frozen=True)
class Surface:
    """Surface of the water at one time."""

    time_s: float
    points: np.ndarray
    """x, y, z [m], shape (n, 3)."""
    triangles: np.ndarray
    """Indices of the corner points, counter-clockwise for a viewer outside the water, shape (m, 3)."""
    velocity: np.ndarray
    """Velocity at the points [m/s], shape (n, 3)."""
    pressure: np.ndarray
    """Pressure at the points [Pa], shape (n,)."""


class Snapshots:
    """A VTKHDF file of points or triangles at several times."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def times_s(self) -> np.ndarray:
        """Returns the recorded times [s]."""
        with h5py.File(self.path, "r", locking=False) as file:
            steps = file["VTKHDF/Steps"]
            return steps["Values"][: steps.attrs["NSteps"]]

    def index(self, time_s: float) -> int:
        """Returns the index of the recorded time nearest to a time [s]."""
        times = self.times_s()
        if times.size == 0:
            raise RunError(f"{self.path}: the run has recorded nothing yet")
        return int(np.argmin(np.abs(times - time_s)))

    def read(self, index: int, fields: list[str]) -> tuple[np.ndarray, dict[str, np.ndarray | None]]:
        """Returns the points at a recorded time, and their fields; None for a field that is missing."""
        with h5py.File(self.path, "r", locking=False) as file:
            root = file["VTKHDF"]
            steps = root["Steps"]
            count = int(root["NumberOfPoints"][index])
            first = int(steps["PointOffsets"][index])
            found: dict[str, np.ndarray | None] = {}
            for name in fields:
                if name in root["PointData"]:
                    start = int(steps[f"PointDataOffsets/{name}"][index])
                    found[name] = root[f"PointData/{name}"][start : start + count]
                else:
                    found[name] = None
            return root["Points"][first : first + count], found

    def triangles(self, index: int) -> np.ndarray:
        """Returns the triangles at a recorded time."""
        with h5py.File(self.path, "r", locking=False) as file:
            polygons = file["VTKHDF/Polygons"]
            count = int(polygons["NumberOfConnectivityIds"][index])
            first = int(file["VTKHDF/Steps/ConnectivityIdOffsets"][index, 2])
            return polygons["Connectivity"][first : first + count].reshape(-1, 3)


class Folder:
    """The folder of a finished run of any kind."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        summary = self.path / "summary.json"
        if not summary.exists():
            words = "the run has not finished; continue it with breakwater_sim.resume"
            raise RunError(f"{self.path}: {words if (self.path / 'case.json').exists() else 'is not the folder of a run'}")
        self.summary: dict[str, Any] = json.loads(summary.read_text(encoding="utf-8"))
        """Content of `summary.json`."""

    @property
    def case(self) -> Case:
        """The case that was run."""
        return Case.load(self.path / "case.json")

    @property
    def report(self) -> Path:
        """Path of `report.html`."""
        return self.path / "report.html"

    def table(self, name: str) -> pd.DataFrame:
        """Reads a table of the run, for example `energy`. The columns are those of `energy.csv`."""
        path = self.path / f"{name}.csv"
        if not path.exists():
            raise FileNotFoundError(f"{path}: the run has not written this table")
        return pd.read_csv(path)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({os.fspath(self.path)!r})"


class Run(Folder):
    """A flume run or a dry test."""

    @property
    def units(self) -> pd.DataFrame:
        """Motion and loads of every unit: one row per unit and time; index `unit`, `time_s`."""
        return self.table("units").set_index(["unit", "time_s"]).sort_index()

    @property
    def gauges(self) -> pd.DataFrame:
        """Gauges in the particle domain; index `time_s`."""
        return self.table("gauges").set_index("time_s")

    @property
    def flume_gauges(self) -> pd.DataFrame:
        """Gauges in the flume model; index `time_s`."""
        return self.table("flume_gauges").set_index("time_s")

    @property
    def contacts(self) -> pd.DataFrame:
        """Contact events: one row per event."""
        return self.table("contacts")

    @property
    def energy(self) -> pd.DataFrame:
        """Energy balance; index `time_s`."""
        return self.table("energy").set_index("time_s")

    @property
    def impacts(self) -> pd.DataFrame:
        """The hardest impacts of the units: one row per impact, the hardest first."""
        path = self.path / "impacts.h5"
        if not path.exists():
            raise FileNotFoundError(f"{path}: the run has not recorded impacts")
        columns: dict[str, np.ndarray] = {}
        with h5py.File(path, "r", locking=False) as file:
            for name, data in file["impacts"].items():
                values = data[()]
                if values.ndim == 1:
                    columns[name] = values
                else:
                    # The axis stands before the unit: peak_force_vector_x_n, rotation_x.
                    stem, unit = re.fullmatch(r"(.*?)((?:_(?:m_s|rad_s|n_m|n_s|m|n))?)", name.removesuffix("_xyzw")).groups()
                    for axis in range(values.shape[1]):
                        columns[f"{stem}_{'xyzw'[axis]}{unit}"] = values[:, axis]
        return pd.DataFrame(columns)

    @property
    def displacement(self) -> pd.Series:
        """Displacement of each unit [m], as in `summary.json`; index `unit`."""
        units = self.summary["units"]
        key = "displacement_m" if units and "displacement_m" in units[0] else "moved_m"
        numbers = pd.Index([unit["unit"] for unit in units], name="unit")
        return pd.Series([unit[key] for unit in units], index=numbers, name="displacement_m", dtype=float)

    @property
    def damage_ratio(self) -> float | None:
        """Share of the units that moved further than the damage distance; None without units."""
        return self.summary.get("damage_ratio")

    @property
    def groups(self) -> pd.DataFrame:
        """Damage ratio, displaced, rocking and rotated units, N_od, N_or and settlement of each group, by its name."""
        return pd.DataFrame(self.summary.get("groups", [])).set_index("name")

    @property
    def water_times_s(self) -> np.ndarray:
        """Times at which the water particles are recorded [s]."""
        return self._snapshots("fluid.vtkhdf", "output.fluid_interval_s").times_s()

    @property
    def surface_times_s(self) -> np.ndarray:
        """Times at which the surface of the water is recorded [s]."""
        return self._snapshots("surface.vtkhdf", "output.surface_interval_s").times_s()

    def water(self, time_s: float) -> Water:
        """Returns the water particles at the recorded time nearest to a time [s]."""
        file = self._snapshots("fluid.vtkhdf", "output.fluid_interval_s")
        index = file.index(time_s)
        position, fields = file.read(index, ["velocity", "pressure", "density", "id"])
        return Water(float(file.times_s()[index]), position, **fields)

    def surface(self, time_s: float) -> Surface:
        """Returns the surface of the water at the recorded time nearest to a time [s]."""
        file = self._snapshots("surface.vtkhdf", "output.surface_interval_s")
        index = file.index(time_s)
        points, fields = file.read(index, ["velocity", "pressure"])
        triangles = file.triangles(index)
        return Surface(float(file.times_s()[index]), points, triangles, fields["velocity"], fields["pressure"])

    def to_xarray(self) -> xarray.Dataset:
        """Returns gauges and units as an xarray dataset with names and units of the CF conventions.

        The dimension `time` is the flume time of the gauges, `unit_time` that of the units. Needs the package xarray.
        """
        from .datasets import dataset

        return dataset(self)

    def _snapshots(self, name: str, key: str) -> Snapshots:
        path = self.path / name
        if not path.exists():
            raise FileNotFoundError(f"{path}: the run has not recorded this; set {key} in the case")
        return Snapshots(path)


class FractureRun(Folder):
    """A run of a fracture case."""

    @property
    def energy(self) -> pd.DataFrame:
        """Energy balance; index `time_s`."""
        return self.table("energy").set_index("time_s")

    @property
    def bodies(self) -> pd.DataFrame:
        """Energies and largest stress of every body; index `body`, `time_s`."""
        return self.table("bodies").set_index(["body", "time_s"]).sort_index()

    @property
    def cracks(self) -> pd.DataFrame:
        """Failed faces: one row per face, in chronological order."""
        return self.table("cracks")

    @property
    def fragments(self) -> pd.DataFrame:
        """Pieces at the end of the run: one row per piece, the heaviest first; index `fragment`."""
        return self.table("fragments").set_index("fragment")


def open_run(path: str | os.PathLike[str]) -> Run | FractureRun:
    """Opens the folder of a finished run. Raises `RunError` if the run has not finished."""
    folder = Folder(path)
    return FractureRun(path) if "tets" in folder.summary else Run(path)


def resume(
    path: str | os.PathLike[str], *, threads: int | None = None, device: str | None = None, progress: bool = True
) -> Run | FractureRun:
    """Continues an interrupted run from its last checkpoint. The results are those of an uninterrupted run."""
    with Display(progress) as display:
        call(_native.resume, os.fspath(path), threads or 0, device, display.show)
    return open_run(path)
