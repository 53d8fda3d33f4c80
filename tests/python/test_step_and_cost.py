"""Time step and core-seconds of a run: from its log, table or frames, and in the report's table of settings."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from clusterdem import Run, write_report
from clusterdem.io.enginelog import read_log
from synthetic import random_frame, write_dump

BUILT = Path(__file__).parents[2] / "build/bin/lmp"
ENGINE = os.environ.get("CLUSTERDEM_LMP") or (str(BUILT) if BUILT.exists() else shutil.which("lmp"))

FALLING = """
units si
atom_style sphere
boundary p f p
region box block 0 0.3 0 0.003 0 0.6
create_box 1 box
create_atoms 1 random 50 4711 NULL
set group all diameter 0.0001
set group all density 1000
pair_style none
comm_modify cutoff 0.01
fix move all nve
fix fall all gravity 9.81 vector 0 0 -1
velocity all set 0 0 -0.05
fix step all dt/reset 10 1e-9 1e-2 5e-6
dump all all custom 20 run.*.dump id x y z radius mass
dump_modify all units yes time yes format float %.17g
thermo 10
thermo_modify lost ignore norm no format float %.15g
thermo_style custom step time {more}
run 200
run 40
"""


def by_log(thermo):
    """A folder whose log holds thermo output, without table or times in dumps."""
    return f"LAMMPS (1 Apr 2026)\n{thermo}Loop time of 2.5 on 4 procs for 90 steps with 9 atoms\n\n64.0% CPU use with 4 MPI tasks\n"


def frames(folder, times, steps):
    for time, step in zip(times, steps):
        write_dump(folder / f"own.{step:05d}.dump", random_frame(30, step, time))


def settings_of(folder):
    path, error = write_report(Run(folder))
    assert error is None
    cells = re.findall(r"<tr><td[^>]*>([^<]*)</td><td[^>]*>([^<]*)</td></tr>", path.read_text())
    return dict(cells)


def test_the_logs_own_column_rules(tmp_path):
    """Dt of both runs of the log, over what table and frames would say."""
    frames(tmp_path, (0, 0.1), (0, 10))
    (tmp_path / "own.N.txt").write_text("# step time\n0 0\n10 0.5\n")
    thermo = "   Step   Dt\n 0 3e-6\n 10 7e-6\n"
    (tmp_path / "own.log").write_text(
        by_log(thermo) + by_log("Step Dt Temp\n10 2e-6 1\n20 4e-6 1\nWARNING: x\n30 5e-6 1\n40 9e-\n")
    )
    run = Run(tmp_path)
    assert run.time_step == (2e-6, 7e-6)
    settings = settings_of(tmp_path)
    assert settings["time step"] == "2e-06 to 7e-06 s"
    # 2 loops of 2.5 s on 4 ranks, of which they computed 64 %
    assert settings["core-seconds"] == "12.8 (5 s in the loop × 4 ranks × 64% CPU use)"
    assert run.log.core_seconds == pytest.approx(2 * 2.5 * 4 * 0.64)


def test_then_the_table_then_the_frames(tmp_path):
    frames(tmp_path, (0, 0.1, 0.4), (0, 10, 50))
    assert Run(tmp_path).time_step == pytest.approx((0.3 / 40, 0.1 / 10))
    assert settings_of(tmp_path)["time step"] == "0.0075 to 0.01 s"
    (tmp_path / "own.N.txt").write_text("# step time\n0 0\n10 0.2\n10 0.2\n30 0.7\n50 0.9\n")
    assert Run(tmp_path).time_step == pytest.approx((0.2 / 20, 0.5 / 20))
    assert "core-seconds" not in settings_of(tmp_path)
    (tmp_path / "own.N.txt").write_text("# step time\n0 0\n10 0.2\n50 1.0000001\n")
    assert settings_of(tmp_path)["time step"] == "0.02 s"  # one step, printed with rounding
    (tmp_path / "own.log").write_text(by_log("").replace("4 procs", "1 procs"))
    assert settings_of(tmp_path)["core-seconds"] == "1.6 (2.5 s in the loop × 1 rank × 64% CPU use)"


def test_nothing_tells(tmp_path):
    frames(tmp_path, (0.3,), (10,))
    assert Run(tmp_path).time_step is None and "time step" not in settings_of(tmp_path)


def test_thermo_output_of_a_log(tmp_path):
    (tmp_path / "log").write_text(
        by_log("   Step c_p[2]\n 0 1.5\n 10 nan\n") + by_log("Step Temp c_p[2]\n10 7 8\n20 9 10 11\n30 4\n")
    )
    log = read_log(tmp_path / "log")
    assert [list(table) for table in log.thermo] == [["Step", "c_p[2]"], ["Step", "Temp", "c_p[2]"]]
    assert log.thermo[0]["c_p[2]"] == pytest.approx([1.5, np.nan], nan_ok=True)
    assert log.at(0) == {"Step": 0, "c_p[2]": 1.5} and log.at(20) == {}
    assert log.at(10) == {"Step": 10, "Temp": 7, "c_p[2]": 8}  # the later run's


@pytest.mark.skipif(ENGINE is None, reason="no engine: build/bin/lmp is missing")
@pytest.mark.parametrize("more", ["dt", ""])
def test_a_step_that_the_engine_varies(tmp_path, more):
    """Falling particles with at most 5 µm per step: from 0.1 mm/s² on the step is 5 µm over their speed, here 0.1 ms and less."""
    (tmp_path / "in.run").write_text(FALLING.format(more=more))
    done = subprocess.run(
        [ENGINE, "-in", "in.run", "-log", "run.log"], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stdout[-2000:]
    run = Run(tmp_path)
    low, high = run.time_step
    speed = 0.05 + 9.81 * run.times  # m/s at the frames
    # the step is set by the speed of that moment; at the first step, and within an interval, it is somewhat longer
    assert low == pytest.approx(5e-6 / speed[-1], rel=0.05) and high == pytest.approx(5e-6 / speed[0], rel=0.15)
    assert low < 0.6 * high and run.steps[-1] == 240
    assert run.numbers_at(40)["dt"] == pytest.approx(np.diff(run.times)[1] / 20, rel=1e-12)
    assert run.numbers_at(40)["Time"] == pytest.approx(run.times[2], rel=1e-9)
    assert run.numbers_at(40)["core_seconds"] == run.log.core_seconds and (run.log.steps, run.log.ranks) == (240, 1)
