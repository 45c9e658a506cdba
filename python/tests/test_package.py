"""Catalogue, sweeps, command line, and the files in VTK's own reader."""

import subprocess
import sys

import numpy as np
import pytest

import breakwater_sim as bw


def test_the_catalogue_has_volumes_and_closed_surfaces():
    units = bw.catalogue()
    assert {"tetrapod", "dolos", "core_loc", "grooved_cube", "cuboid"} == set(units)
    # Volume of a Tetrapod: 0.280 H^3 (Shore Protection Manual 1984).
    assert np.isclose(units["tetrapod"].volume_m3, 0.280, rtol=0.01)
    assert units["cuboid"].volume(2.0) == pytest.approx(8.0)
    assert units["tetrapod"].nominal_diameter(1.0) == pytest.approx(units["tetrapod"].volume_m3 ** (1 / 3))
    for unit in units.values():
        a, b, c = (unit.vertices_m[unit.triangles[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        assert np.isclose(volume, unit.volume_m3, rtol=1e-9), unit.name


def test_a_sweep_gives_a_table_and_its_runs(case, tmp_path):
    case["stop.duration_s"] = 0.02
    case.save(tmp_path / "small.json")
    keys = {
        "title": "Two friction coefficients",
        "case": str(tmp_path / "small.json"),
        "vary": [{"key": "friction[1].coefficient", "values": [0.3, 0.6]}],
    }
    sweep = bw.sweep(keys, tmp_path / "sweep", device="cpu", progress=False)
    assert len(sweep.table) == 2 and len(sweep.runs) == 2
    assert sorted(run.case["friction[1].coefficient"] for run in sweep.runs) == [0.3, 0.6]
    with pytest.raises((bw.CaseError, bw.RunError)):
        bw.sweep({**keys, "vary": [{"key": "friction[9].coefficient", "values": [0.3]}]}, tmp_path / "wrong")


def test_the_command_line_is_installed():
    shown = subprocess.run([sys.executable, "-m", "breakwater_sim", "--version"], capture_output=True, text=True)
    assert shown.returncode == 0 and bw.__version__ in shown.stdout
    refused = subprocess.run([sys.executable, "-m", "breakwater_sim", "check", "none.json"], capture_output=True, text=True)
    assert refused.returncode == 2 and "none.json" in refused.stderr


FILMS = {
    "run": {"fluid.vtkhdf", "surface.vtkhdf", "units.vtkhdf"},
    "dry_run": {"units.vtkhdf"},
    "fracture_run": {"cracks.vtkhdf", "section.vtkhdf", "surfaces.vtkhdf", "tets.vtkhdf"},
}


@pytest.mark.parametrize("fixture", FILMS)
def test_the_reader_of_vtk_opens_every_film(fixture, request):
    io = pytest.importorskip("vtkmodules.vtkIOHDF")
    folder = request.getfixturevalue(fixture).path
    assert {path.name for path in folder.glob("*.vtkhdf")} == FILMS[fixture]
    for name in sorted(FILMS[fixture]):
        reader = io.vtkHDFReader()
        assert reader.CanReadFile(str(folder / name))
        reader.SetFileName(str(folder / name))
        reader.UpdateInformation()
        steps = reader.GetNumberOfSteps()
        assert steps >= 2, name
        for step in range(steps):
            reader.SetStep(step)
            reader.Update()
            data = reader.GetOutputDataObject(0)
            # Without a crack, the faces of the cracks are an empty mesh.
            assert name == "cracks.vtkhdf" or (data.GetNumberOfPoints() > 0 and data.GetNumberOfCells() > 0), name
            fields = data.GetPointData()
            for index in range(fields.GetNumberOfArrays()):
                assert fields.GetArray(index).GetNumberOfTuples() == data.GetNumberOfPoints(), name
