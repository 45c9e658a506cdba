"""Cases: keys, validation, and exceptions for wrong values."""

from pathlib import Path

import numpy as np
import pytest

import breakwater_sim as bw

ROOT = Path(__file__).parents[2]


def test_keys_are_read_set_and_removed_by_their_path(case):
    assert case["friction[1].coefficient"] == 0.32
    case["friction[1].coefficient"] = 0.4
    case["numerics.cfl"] = 0.2
    assert case["friction[1].coefficient"] == 0.4 and case["numerics"] == {"hold_units_s": 0.01, "cfl": 0.2}
    assert "numerics.cfl" in case and "numerics.h" not in case and "friction[7]" not in case
    del case["numerics.cfl"]
    assert case["numerics"] == {"hold_units_s": 0.01}
    del case["gauges[0]"]
    assert case["gauges"] == []
    with pytest.raises(KeyError, match="no such key"):
        del case["domain.dp_m.x"]
    for missing in ["waves", "friction[5].coefficient", "domain.dp_m.x", "friction.coefficient"]:
        with pytest.raises(KeyError, match="no such key"):
            case[missing]
    with pytest.raises(ValueError, match=r"friction has 2 entries"):
        case["friction[2].coefficient"] = 0.1


def test_a_copy_changes_alone_and_a_case_reads_back(case, tmp_path):
    other = case.copy()
    other["domain.dp_m"] = 0.01
    assert case["domain.dp_m"] == 0.014
    path = tmp_path / "small.json"
    case.save(path)
    read = bw.Case.load(path)
    assert read.to_dict() == case.to_dict() and read.path == path
    assert "small.json" in repr(read)


def test_values_may_be_arrays_and_paths(case, tmp_path):
    case["domain.x_m"] = np.array([0.0, 0.6])
    case["units.count"] = np.int64(1)
    case["reference"] = tmp_path
    assert case["domain.x_m"] == [0.0, 0.6] and case["reference"] == str(tmp_path)
    with pytest.raises(TypeError, match="cannot be a value"):
        case["units"] = object()
    with pytest.raises(ValueError, match="domain.dp_m = nan: must be a finite number"):
        case["domain.dp_m"] = float("nan")


def test_a_check_gives_the_cost(case):
    check = case.check()
    assert check.kind == "flume"
    assert any("domain.width_m = 0.16 is 11.43 particle spacings" in warning for warning in check.warnings)
    # 0.6 x 0.16 x 0.12 m of water with one particle per (14 mm)^3: 4200.
    assert check.particles > 4200 and check.steps > 100 and check.memory_bytes > 0


@pytest.mark.parametrize("path", sorted((ROOT / "cases").rglob("*.json")), ids=lambda path: path.stem)
def test_every_case_of_the_repository_is_valid(path):
    if path.stem == "reference":
        pytest.skip("the description of a reference folder")
    assert bw.Case.load(path).check().kind in ["flume", "dry_test", "fracture", "sweep", "placement"]


# Key, wrong value, and a part of what the exception says is allowed or wrong.
WRONG = [
    ("domain.dp_m", -0.014, "m"),
    ("domain.dp_m", 0, "m"),
    ("domain.dp_m", "0.014", "number"),
    ("domain.dp_m", None, ""),
    ("domain.width_m", 0.02, "m"),
    ("domain.sides", "open", "periodic"),
    ("domain.x_m", [0.6, 0.0], ""),
    ("domain.x_m", [0.0], ""),
    ("domain.top_z_m", 0.01, "m"),
    ("flume.still_water_level_m", -1.0, ""),
    ("flume.bed_m", [], ""),
    ("flume.bed_m", [[0.0, 0.0], [-1.0, 0.0]], ""),
    ("flume.material", "steel", ""),
    ("units.mass_kg", -0.3, ""),
    ("units.mass_kg", 1e9, ""),
    ("units.height_m", 0.0, ""),
    ("units.shape", "tetrapot", "tetrapod"),
    ("units.count", 0, ""),
    ("units.count", 2.5, ""),
    ("units.pitch_m", 0.01, ""),
    ("units.x_m", 17.0, ""),
    ("units.material", "", ""),
    ("materials[0].young_modulus_pa", 0.0, "Pa"),
    ("materials[0].poisson_ratio", 0.7, ""),
    ("materials[0].restitution", 1.5, ""),
    ("friction[0].coefficient", -0.1, ""),
    ("friction[1].between", ["mortar"], ""),
    ("gauges[0].kind", "elevations", "elevation"),
    ("gauges[0].x_m", 99.0, ""),
    ("output.fluid_interval_s", -1.0, "s"),
    ("output.surface_interval_s", -0.1, "s"),
    ("output.fluid_fields", ["speed"], "velocity"),
    ("stop.duration_s", 0.0, "s"),
    ("stop.duration_s", True, "number"),
    ("numerics.cfl", 9.0, ""),
    ("numerics.scheme", "best", ""),
    ("wave.height_m", 0.05, ""),
    ("wawe", {}, "wave"),
]


@pytest.mark.parametrize(("key", "value", "part"), WRONG, ids=lambda value: str(value)[:24])
def test_a_wrong_value_raises_an_exception_that_names_it(case, key, value, part):
    case[key] = value
    with pytest.raises(bw.CaseError) as raised:
        case.check()
    error = raised.value
    assert error.key and error.allowed, str(error)
    # An error names the key, an object that contains it, or a key that depends on it.
    first = key.split(".")[0].split("[")[0]
    words = " ".join(problem.message for problem in error.problems)
    assert first in words or "wave" in words, words
    assert part in words, words
    assert all(problem.message for problem in error.problems)


@pytest.mark.parametrize("path", sorted((ROOT / "tests" / "bad_cases").glob("*.json")), ids=lambda path: path.stem)
def test_no_bad_file_ends_the_process(path):
    with pytest.raises((bw.CaseError, bw.RunError)) as raised:
        bw.Case.load(path).check()
    assert str(raised.value)


def test_files_that_cannot_be_read_raise(tmp_path):
    with pytest.raises(bw.CaseError, match="cannot be read"):
        bw.Case.load(tmp_path / "none.json")
    broken = tmp_path / "broken.json"
    broken.write_text('{ "title": ', encoding="utf-8")
    with pytest.raises(bw.CaseError, match="not valid JSON") as raised:
        bw.Case.load(broken)
    assert raised.value.problems[0].line == 1
