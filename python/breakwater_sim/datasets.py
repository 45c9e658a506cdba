"""Runs as xarray datasets, with names and units of the CF conventions (https://cfconventions.org)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import xarray

if TYPE_CHECKING:
    from .runs import Run

# Endings of the gauge columns: quantity, CF standard name (None if there is none), unit.
QUANTITIES = {
    "_eta_m": ("elevation", "sea_surface_height_above_mean_sea_level", "m"),
    "_p_pa": ("pressure", "sea_water_pressure_due_to_sea_water", "Pa"),
    "_u_m_s": ("velocity_x", "sea_water_x_velocity", "m s-1"),
    "_v_m_s": ("velocity_y", "sea_water_y_velocity", "m s-1"),
    "_w_m_s": ("velocity_z", "upward_sea_water_velocity", "m s-1"),
}
UNIT_COLUMNS = {
    "x_m": ("m", "position along the flume"),
    "y_m": ("m", "position across the flume"),
    "z_m": ("m", "height"),
    "fluid_fx_n": ("N", "force of the water along the flume"),
    "fluid_fy_n": ("N", "force of the water across the flume"),
    "fluid_fz_n": ("N", "vertical force of the water"),
    "contact_fx_n": ("N", "contact force along the flume"),
    "contact_fy_n": ("N", "contact force across the flume"),
    "contact_fz_n": ("N", "vertical contact force"),
}


def dataset(run: Run) -> xarray.Dataset:
    """Returns the gauges in the particle domain and the units of a run."""
    made = xarray.Dataset(
        attrs={
            "Conventions": "CF-1.11",
            "title": run.summary["title"],
            "source": f"breakwater {run.summary['breakwater_version']}",
            "history": f"case {run.summary['case_hash']}",
        }
    )
    if (run.path / "gauges.csv").exists():
        made = made.merge(_gauges(run), combine_attrs="override")
    if run.summary["units"]:
        made = made.merge(_units(run), combine_attrs="override")
    return made


def _time(name: str, values: np.ndarray) -> xarray.Variable:
    attributes = {"long_name": "flume time since the start of the wavemaker", "units": "s", "axis": "T"}
    return xarray.Variable(name, values, attributes)


def _gauges(run: Run) -> xarray.Dataset:
    table: pd.DataFrame = run.gauges
    made = xarray.Dataset(coords={"time": _time("time", table.index.to_numpy())})
    positions = {gauge["name"]: gauge["x_m"] for gauge in run.summary["gauges"]}
    for ending, (quantity, standard_name, unit) in QUANTITIES.items():
        names = [column.removesuffix(ending) for column in table.columns if column.endswith(ending)]
        if not names:
            continue
        dimension = f"{quantity}_gauge"
        values = table[[name + ending for name in names]].to_numpy()
        attributes = {"standard_name": standard_name, "units": unit}
        if quantity == "elevation":
            attributes["comment"] = "The reference level is the still water level."
            place = xarray.Variable(dimension, [positions.get(name, np.nan) for name in names], {"units": "m", "axis": "X"})
            made = made.assign_coords({"x": place})
        made = made.assign_coords({dimension: names})
        made[quantity] = xarray.Variable(("time", dimension), values, attributes)
    return made


def _units(run: Run) -> xarray.Dataset:
    table = run.units
    times = table.index.get_level_values("time_s").unique().sort_values()
    made = xarray.Dataset(coords={"unit_time": _time("unit_time", times.to_numpy())})
    for column, (unit, long_name) in UNIT_COLUMNS.items():
        values = table[column].unstack("unit")
        made = made.assign_coords({"unit": values.columns.to_numpy()})
        made[column] = xarray.Variable(("unit_time", "unit"), values.to_numpy(), {"units": unit, "long_name": long_name})
    displacement = run.displacement
    attributes = {"units": "m", "long_name": "horizontal displacement at the end of the run"}
    made["displacement"] = xarray.Variable("unit", displacement.to_numpy(), attributes)
    return made
