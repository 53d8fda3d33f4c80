"""Dumps, grids and logs of a real engine run."""

from __future__ import annotations

import gzip
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from clusterdem import Grid, maps_of, read_dumps
from clusterdem.io.enginelog import read_log
from clusterdem.io.series import read_series

BUILT = Path(__file__).parents[2] / "build/bin/lmp"
ENGINE = os.environ.get("CLUSTERDEM_LMP") or (str(BUILT) if BUILT.exists() else shutil.which("lmp"))

SCRIPT = """
units si
atom_style sphere
boundary p f p
newton on
comm_modify vel yes
region box block 0 0.3 0 0.003 0 0.6
create_box 1 box
create_atoms 1 random 3000 4711 NULL overlap 0.001 maxtry 100
set group all y 0.0015
set group all diameter 0.000928
region left block 0 0.1 INF INF INF INF
group left region left
set group left diameter 0.0005
set group all density 1000
velocity all create 1e16 123 dist gaussian
velocity all set NULL 0.0 NULL
pair_style gran/hooke 10 NULL 0.01 NULL 0.33 0
pair_coeff * *
neighbor 0.0005 bin
fix move all nve
fix g all ave/grid 50 1 50 30 1 30 density/mass density/number norm all
dump d all custom 50 run.*.dump vz id diameter xs z vx mass ys
dump_modify d sort id pad 7 units yes time yes format float %.17g
dump all all custom 50 all.dump id xu yu zu radius mass
dump_modify all units yes time yes format float %.17g
dump g all grid 50 grid.*.txt f_g:grid:data[*]
dump_modify g pad 7 format float %.17g
timestep 1e-6
variable N equal atoms
variable t equal time
fix N all ave/time 50 1 50 v_t v_N file run.N.txt title1 "# a run" title2 "# step time clusters"
run 100
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    if ENGINE is None:
        pytest.skip("no engine: build/bin/lmp is missing")
    path = tmp_path_factory.mktemp("engine")
    (path / "in.run").write_text(SCRIPT)
    done = subprocess.run(
        [ENGINE, "-in", "in.run", "-log", "run.log"], cwd=path, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    return path


def engine_grid(path):
    lines = path.read_text().split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith("ITEM: GRID CELLS")) + 1
    values = np.array([line.split() for line in lines[start:] if line], float)
    return values.reshape(30, 30, -1).transpose(1, 0, 2)  # x runs fastest in the file


def test_our_map_is_the_engines_own(folder):
    """``fix ave/grid`` counts the same clusters in the same cells and finds the same mass."""
    for frame in read_dumps(folder.glob("run.*.dump")):
        grid = Grid(frame.box, 30, 30)
        maps = maps_of(frame, grid)
        theirs = engine_grid(folder / f"grid.{frame.step:07d}.txt")
        np.testing.assert_allclose(maps["mass"] / grid.cell_volume, theirs[:, :, 0], rtol=1e-12)
        np.testing.assert_allclose(maps["number_density"], theirs[:, :, 1], rtol=1e-12)


def test_one_compressed_file_of_many_frames_is_the_same_run(folder):
    single = list(read_dumps(folder.glob("run.*.dump")))
    (folder / "all.dump.gz").write_bytes(gzip.compress((folder / "all.dump").read_bytes()))
    many = list(read_dumps([folder / "all.dump.gz"]))
    assert [f.step for f in many] == [f.step for f in single] == [0, 50, 100]
    for a, b in zip(single, many):
        order = np.argsort(b["id"])
        assert a.time == b.time == pytest.approx(a.step * 1e-6)
        np.testing.assert_allclose(a.x, b.x[order], rtol=0, atol=1e-15)
        np.testing.assert_array_equal(a.diameter, b.diameter[order])


def test_log_and_series(folder):
    log = read_log(folder / "run.log")
    assert log.version.startswith("LAMMPS (") and log.steps == 100 and {"Pair", "Neigh", "Modify"} <= set(log.phases)
    series = read_series(folder / "run.N.txt")
    assert series["step"].tolist() == [0, 50, 100] and (series["clusters"] == 3000).all()


def test_report_of_a_run_that_is_no_case(folder, command):
    code, out, err = command("report", folder, "--name", "run")
    assert (code, err) == (0, "")
    page = Path(out.strip()).read_text()
    assert "Beside the published numbers" not in page and "no column n" in page and "LAMMPS (" in page
