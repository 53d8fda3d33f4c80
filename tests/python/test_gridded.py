"""Maps that the engine makes while it runs are those of its dumps of clusters."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from clusterdem import InputError, read_dumps
from clusterdem.analysis.grid import Grid, maps_of
from clusterdem.analysis.gridded import COLUMNS, is_gridded, read_gridded

ROOT = Path(__file__).resolve().parents[2]
LMP = Path(os.environ.get("CLUSTERDEM_LMP", ROOT / "build" / "bin" / "lmp"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    if not LMP.exists():
        pytest.skip("no engine: build/bin/lmp is missing")
    path = tmp_path_factory.mktemp("maps")
    options = "-var tend 4e-4 -var frame_time 2e-4 -var maps yes -var map_x 15 -var map_z 20 -var height 0.2".split()
    command = [LMP, "-in", "inputs/case1.in", *options, "-var", "digits", "17", "-var", "outdir", path, "-log", "none"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    return path


def test_equal_to_maps_of_the_clusters(folder):
    """To 15 digits of the file: 1e-13; the temperature is a difference of squares of 4 m²/s²: 1e-12 of these."""
    frames = list(read_dumps(folder.glob("case1.*.dump")))
    gridded = [found for path in sorted(folder.glob("case1.*.maps")) for found in read_gridded(path)]
    assert [head.step for head, _, _ in gridded] == [frame.step for frame in frames] == [0, 200, 400]
    for frame, (head, grid, maps) in zip(frames, gridded):
        assert head.time == pytest.approx(frame.time) and head.box.same_as(frame.box) and grid.shape == (15, 20)
        expected = maps_of(frame, Grid(frame.box, 15, 20))
        assert set(maps) == set(expected)
        for name, values in expected.items():
            tolerance = {"atol": 1e-11} if name == "temperature" else {"rtol": 1e-12, "atol": 1e-12}
            np.testing.assert_allclose(maps[name], values, **tolerance, err_msg=name)
    assert np.nanmax(maps["temperature"]) > 1e-8  # young motion, a thousand times the tolerance


def test_drawn_by_the_same_command(folder, command, tmp_path):
    code, out, err = command("map", *folder.glob("case1.*.maps"), "--out", tmp_path)
    assert (code, err) == (0, "")
    for name in ("map.0000000400.csv", "fraction.png", "mean_diameter.png", "velocity_z.png", "temperature.png"):
        assert (tmp_path / name).stat().st_size > 1000 and name in out


def test_averages_of_the_runs_maps_are_those_of_its_clusters(folder, command, tmp_path):
    for kind, words in (("maps", ()), ("dump", ("--grid", "15", "20"))):
        given = folder.glob(f"case1.*.{kind}")
        code, out, err = command("map", *given, *words, "--average", "2", "--out", tmp_path / kind)
        assert (code, err) == (0, "") and "error_fraction.png" in out
    with np.load(tmp_path / "maps/average.npz") as made, np.load(tmp_path / "dump/average.npz") as expected:
        assert set(made.files) == set(expected.files) and made["step"].tolist() == [0, 200, 400]
        for name in ("fraction", "fraction_error", "velocity_z", "velocity_z_error", "mean_diameter"):
            np.testing.assert_allclose(made[name], expected[name], rtol=1e-10, atol=1e-10, err_msg=name)


def test_no_clusters_are_written_where_none_are_asked_for(tmp_path):
    command = [LMP, "-in", "inputs/case1.in", *"-var tend 2e-5 -var maps yes -var dump_style none -log none".split()]
    done = subprocess.run(
        [*command, "-var", "outdir", tmp_path], cwd=ROOT, capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stdout[-2000:]
    assert len(list(tmp_path.glob("*.maps"))) == 2 and not list(tmp_path.glob("*.dump*"))


HEAD = "ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 1\n0 1\nITEM: DIMENSION\n3\nITEM: GRID SIZE nx ny nz\n{}\n"
CELLS = "ITEM: GRID CELLS {}\n{}"


@pytest.mark.parametrize(
    ("size", "columns", "rows", "said"),
    [
        ("1 1", COLUMNS, "", "the grid's size must be three numbers"),
        ("1 0 1", COLUMNS, "", "the grid's size must be three numbers"),
        ("1 2 1", COLUMNS, "1 1 1 1 1 1\n" * 2, "one cell along y, not 2"),
        ("1 1 1", COLUMNS[:-1], "1 1 1 1 1\n", "missing: energy"),
        ("2 1 1", COLUMNS, "1 1 1 1 1 1\n", "2"),
        ("1 1 1", COLUMNS, "1 1 1 x 1 1\n", "momentum_x"),
    ],
)
def test_what_is_wrong_with_a_file_is_said(tmp_path, size, columns, rows, said):
    path = tmp_path / "a.maps"
    path.write_text(HEAD.format(size) + CELLS.format(" ".join(columns), rows))
    with pytest.raises(InputError, match=said):
        list(read_gridded(path))


def test_maps_are_no_clusters(tmp_path):
    path = tmp_path / "a.maps"
    path.write_text(HEAD.format("1 1 1") + CELLS.format(" ".join(COLUMNS), "1 1 1 1 1 1\n"))
    assert is_gridded(path)
    with pytest.raises(InputError, match="clusterdem map reads such files"):
        list(read_dumps([path]))
