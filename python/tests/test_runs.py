"""Runs: the same bits as the command line, Ctrl-C, results as tables and arrays."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import breakwater_sim as bw

# Keys of summary.json that depend on the machine and on the time of the run.
OF_THE_MACHINE = {"wall_s", "steps_per_s", "threads", "outputs_s", "processor", "device", "host", "memory_bytes"}


def summary_of(folder):
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return {key: value for key, value in summary.items() if key not in OF_THE_MACHINE}


def expect_same(one, other):
    """The result files of two runs are equal to the bit."""
    names = ["units.csv", "gauges.csv", "energy.csv", "contacts.csv", "diagnostics.csv"]
    names += ["fluid.vtkhdf", "surface.vtkhdf", "units.vtkhdf"]
    for name in names:
        assert (one / name).read_bytes() == (other / name).read_bytes(), name
    assert summary_of(one) == summary_of(other)


def test_the_results_are_those_of_the_command_line(case, run, tmp_path):
    file = tmp_path / "small.json"
    case.save(file)
    command = [sys.executable, "-m", "breakwater_sim", "run", os.fspath(file), "--out", os.fspath(tmp_path / "run")]
    subprocess.run([*command, "--threads", "2", "--device", "cpu", "--quiet"], check=True, capture_output=True)
    expect_same(run.path, tmp_path / "run")


@pytest.fixture
def ctrl_c():
    """Python raises KeyboardInterrupt, also if a shell started the tests in the background, where Ctrl-C is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("ctrl_c")
def test_ctrl_c_keeps_a_checkpoint_and_resume_continues_to_the_same_bits(case, run, tmp_path):
    folder = tmp_path / "stopped"

    def stop_after_a_checkpoint():
        while not (folder / "checkpoint.h5").exists():
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=stop_after_a_checkpoint)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        case.run(folder, threads=1, device="cpu", progress=False)
    thread.join()
    assert not (folder / "summary.json").exists()
    with pytest.raises(bw.RunError, match="has not finished"):
        bw.open_run(folder)
    resumed = bw.resume(folder, threads=1, progress=False)
    expect_same(run.path, resumed.path)


def test_a_folder_with_results_is_kept(case, run):
    with pytest.raises(FileExistsError, match="overwrite=True"):
        case.run(run.path)
    with pytest.raises(ValueError, match="device"):
        case.run(run.path.parent / "card", device="gpus")
    case["domain.dp_m"] = -1.0
    with pytest.raises(bw.CaseError):
        case.run(run.path.parent / "wrong")
    assert not (run.path.parent / "wrong").exists()


def test_tables_have_their_index_and_units_in_their_names(run):
    units = run.units
    assert units.index.names == ["unit", "time_s"] and set(units.index.get_level_values("unit")) == {1}
    assert {"x_m", "qw", "vx_m_s", "fluid_fx_n", "contact_fz_n"} <= set(units.columns)
    assert run.gauges.index.name == "time_s" and "middle_eta_m" in run.gauges
    assert {"kinetic_j", "potential_j"} <= set(run.energy.columns)
    assert len(run.contacts) >= 1 and len(run.impacts) >= 1
    assert {"peak_force_n", "point_x_m", "impulse_z_n_s", "rotation_w"} <= set(run.impacts.columns)
    assert run.damage_ratio == 0.0
    assert list(run.groups.index) == ["units"] and run.groups.loc["units", "displaced"] == 0
    assert run.displacement.index.tolist() == [1] and run.displacement[1] < 0.01
    with pytest.raises(FileNotFoundError, match="has not written"):
        run.table("waves")


def test_water_and_surface_are_arrays(run):
    assert np.allclose(np.diff(run.water_times_s)[:-1], 0.02, atol=2e-3)
    water = run.water(0.05)
    assert water.position.shape == water.velocity.shape == (len(water.pressure), 3)
    # Hydrostatic pressure within 20 % of that of the depth, 0.1 s after the start of a coarse case.
    deep = water.position[:, 2] < 0.03
    assert np.isclose(water.pressure[deep].mean(), 9810 * (0.12 - water.position[deep, 2].mean()), rtol=0.2)
    surface = run.surface(0.05)
    assert surface.triangles.max() < len(surface.points) and surface.velocity.shape == surface.points.shape
    a, b, c = (surface.points[surface.triangles[:, k]].astype(float) for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    # Water minus the Tetrapod; 10 %: the edges are round over one particle spacing, here an eighth of the depth.
    assert np.isclose(volume, 0.6 * 0.16 * 0.12 - 0.00013, rtol=0.1)


def test_xarray_has_names_of_the_cf_conventions(run):
    xarray = pytest.importorskip("xarray")
    data = run.to_xarray()
    assert isinstance(data, xarray.Dataset) and data.attrs["Conventions"].startswith("CF-")
    elevation = data["elevation"]
    assert elevation.dims == ("time", "elevation_gauge")
    assert elevation.attrs["standard_name"] == "sea_surface_height_above_mean_sea_level"
    assert elevation.attrs["units"] == "m" and data["time"].attrs["units"] == "s"
    assert data["x_m"].dims == ("unit_time", "unit")
    assert float(data["displacement"].sel(unit=1)) == run.displacement[1]


def test_progress_is_shown(case, tmp_path, capsys):
    case["stop.duration_s"] = 0.02
    bw.Case(case.to_dict()).run(tmp_path / "shown", threads=1, device="cpu", progress=True)
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err == "" or "simulated" in shown.err


def test_a_dry_test_is_a_run_too(dry_run):
    assert dry_run.displacement[1] >= 0.0 and len(dry_run.contacts) > 0
    with pytest.raises(FileNotFoundError, match="fluid_interval_s"):
        dry_run.water(0.0)


def test_a_fracture_run_has_cracks_and_pieces(fracture_run):
    assert isinstance(fracture_run, bw.FractureRun)
    assert {"kinetic_j", "fracture_j"} <= set(fracture_run.energy.columns)
    assert "mass_kg" in fracture_run.fragments and fracture_run.bodies.index.names == ["body", "time_s"]
