"""A Run: frames, times, table, log, settings, primary particles; and fractions that are right for any particles."""

from __future__ import annotations

import csv
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from clusterdem import ArgumentError, Box, Frame, Grid, InputError, Primary, Run, lateral, maps_of, read_dumps
from clusterdem.analysis.gridded import read_gridded
from clusterdem.io.enginelog import read_log
from clusterdem.primary import Kind, primary_of_columns
from clusterdem.times import nearest, same_times
from synthetic import BOX, dump_text, random_frame, write_dump, write_run

ROOT = Path(__file__).resolve().parents[2]
LMP = Path(os.environ.get("CLUSTERDEM_LMP", ROOT / "build" / "bin" / "lmp"))
needs_engine = pytest.mark.skipif(not LMP.exists(), reason="no engine: build/bin/lmp is missing")

LOG = """LAMMPS (4 Feb 2025)
variable seed index 1
variable tend index 0.05
create_atoms 1 random 400 ${seed} plane overlap 0.001   # ${seed} again
create_atoms 1 random 400 7 plane overlap 0.001
fix size all cluster/breakmerge ${every} 6e-5 2500 drag drag K 0.03
fix size all cluster/breakmerge 10 6e-5 2500 drag drag K 0.03
"""


# ---- what belongs to a time


def test_the_nearest_frame_within_one_percent():
    times = [0.0, 0.0101, 0.0199, 0.03]
    assert [nearest(times, t) for t in (0.0, 0.01, 0.02, 0.03)] == [0, 1, 2, 3]
    assert nearest(times, 0.0105) is None and nearest([], 0.1) is None and nearest([np.nan, np.nan], 0.1) is None
    assert nearest([0.00005, 0.01], 0.0) == 0 and nearest([0.0005, 0.01], 0.0) is None  # of the interval, for time 0
    assert nearest([np.nan, 0.01], 0.01) == 1


def test_the_same_times():
    assert same_times([0.01, 0.02], [0.0101, 0.0199]) and not same_times([0.01, 0.02], [0.01])
    assert not same_times([0.01, 0.02], [0.02, 0.03])


# ---- the folder


@pytest.fixture
def folder(tmp_path):
    write_run(tmp_path, 3, 200)
    (tmp_path / "case1.log").write_text(LOG)
    (tmp_path / "case1.N.txt").write_text(
        "#case1,reading=B,seed=7,dt=1e-6\n# step time clusters particles fed left\n"
        "0 0 200 10 0 0\n10000 0.01 400 13 5 2\n20000 0.02 600 14 8 4\n"
    )
    (tmp_path / "command.txt").write_text("./run case1 -var seed 9 -var law 'trancong 0.8 1.2'\n")
    return tmp_path


def test_a_run(folder):
    run = Run(folder)
    assert (run.name, len(run), run.steps) == ("case1", 3, [0, 10000, 20000])
    assert run.times == pytest.approx([0, 0.01, 0.02]) and run.box == BOX
    assert [len(frame) for frame in run] == [200, 400, 600]
    assert len(run.at(0.0100001)) == 400 and run.at(0.02, ("vz",)).z.tolist() == random_frame(600, 20000).z.tolist()
    with pytest.raises(ArgumentError, match="time: no frame within 0.00015 s of 0.015 s; the nearest is at 0.0"):
        run.at(0.015)
    flow = run.flow(10000)
    assert (flow.fed, flow.left) == (5, 2) and run.flow(5) is None


def test_settings_and_seed_are_those_that_ran(folder):
    """The script's own seed is 1, the command says 9 (another run's), the log and the table say 7: that ran."""
    run = Run(folder)
    assert run.seed == "7" and run.settings["reading"] == "B" and run.settings["law"] == "trancong 0.8 1.2"
    assert run.settings["tend"] == "0.05"
    (folder / "case1.N.txt").unlink()
    assert Run(folder).seed == "7"  # from the log's filled-in line
    (folder / "case1.log").unlink()
    assert Run(folder).seed == "9" and Run(folder).series is None and Run(folder).log.version == ""


def test_filled_in_variables(tmp_path):
    (tmp_path / "log").write_text(
        "a ${x} b ${yy}   # c\na 1.5 b ${yy}   \na 1.5 b two words\nq $z$z\nq 7$z\nq 77\nx ${n}\ny 5\n"
    )
    assert read_log(tmp_path / "log").filled == {"x": "1.5", "yy": "two words", "z": "7"}


def test_times_from_the_table_where_dumps_hold_none(tmp_path):
    (tmp_path / "a.dump").write_text(
        "".join(dump_text(random_frame(20, s), units=False, time=False) for s in (0, 50, 100))
    )
    assert np.isnan(Run(tmp_path).times).all()
    with pytest.raises(ArgumentError, match="time: the run's frames hold no time: give dt"):
        Run(tmp_path).at(0.1)
    (tmp_path / "a.N.txt").write_text("# t\n# step time\n0 0\n50 1e-4\n100 2e-4\n")
    assert Run(tmp_path).times == pytest.approx([0, 1e-4, 2e-4])
    assert Run(tmp_path, dt=1e-3).times == pytest.approx([0, 0.05, 0.1])
    (tmp_path / "a.N.txt").write_text("# t\n# step time\n0 0\n50 1e-4\n100 5e-4\n")  # a variable step
    assert np.isnan(Run(tmp_path).times).all()


def test_several_runs_and_none(tmp_path):
    with pytest.raises(InputError, match="holds no dump file"):
        Run(tmp_path)
    for name in ("a.1.dump", "b.1.dump.gz", "c.1.maps", ".hidden.1.dump"):
        (tmp_path / name).write_text("")
    with pytest.raises(ArgumentError, match=r"name: must be chosen: .* holds several runs \(a, b, c\)"):
        Run(tmp_path)
    assert Run(tmp_path, "b").dumps == [tmp_path / "b.1.dump.gz"] and Run(tmp_path, "c").maps == [tmp_path / "c.1.maps"]
    with pytest.raises(ArgumentError, match="name: must be among a, b, c"):
        Run(tmp_path, "d")


def test_a_box_that_changes_is_no_box(tmp_path):
    write_dump(tmp_path / "a.1.dump", random_frame(5, 1))
    write_dump(tmp_path / "a.2.dump", random_frame(5, 2, box=Box(BOX.lo, (0.4, 0.003, 0.6), BOX.periodic)))
    with pytest.raises(InputError, match="the box differs"):
        _ = Run(tmp_path).box
    assert len(Run(tmp_path)) == 2


# ---- the primary particles


def clusters_of(d_p, rho, count=60, voidage=0.5, seed=1):
    rng = np.random.default_rng(seed)
    n = rng.integers(3, 2001, count).astype(float)
    columns = {"x": 0.3 * rng.random(count), "z": 0.6 * rng.random(count), "y": np.full(count, 0.0015), "n": n}
    columns |= {"mass": n * rho * np.pi / 6 * d_p**3, "diameter": d_p * np.cbrt(n / (1 - voidage))}
    columns |= {"vx": rng.normal(size=count), "vy": np.zeros(count), "vz": rng.normal(size=count)}
    return columns


PARTICLE = np.pi / 6 * 60e-6**3


@pytest.fixture
def newcomer(tmp_path):
    """Clusters of particles of 60 µm and 2500 kg/m³, as a dump without a log, and their volume of solids."""
    columns = clusters_of(60e-6, 2500)
    names = ["id", "x", "y", "z", "vx", "vy", "vz", "diameter", "mass", "n"]
    columns["id"] = np.arange(1.0, 61)
    path = write_dump(tmp_path / "mine.0.dump", Frame(0, 0.0, BOX, columns), names)
    return path, columns["n"].sum() * PARTICLE


def test_the_columns_tell_the_particles(newcomer):
    (frame,) = read_dumps(newcomer[0])
    ((_, kind),) = frame.particles.kinds
    assert kind.diameter == pytest.approx(60e-6, rel=1e-12) and kind.density == pytest.approx(2500, rel=1e-12)
    assert frame.particles.words.startswith("primary particles of 60 µm and 2500 kg/m³ (from the columns n, mass")


def test_fractions_are_right_everywhere(newcomer, tmp_path, command):
    """Every fraction, times the volume it stands for, adds up to the volume of the particles: map, profile, film's scale, VTK."""
    path, solids = newcomer
    cell, whole = 0.03 * 0.06 * 0.003, 0.3 * 0.003 * 0.6
    for method in ("nearest", "overlap"):
        words = ("map", path, "--grid", "10", "10", "--deposit", method, "--out", tmp_path / method)
        code, out, _ = command(*words)
        assert code == 0 and out.startswith("solids fractions with primary particles of 60 µm and 2500 kg/m³")
        with np.load(tmp_path / method / "map.0000000000.npz") as maps:
            assert maps["fraction"].sum() * cell == pytest.approx(solids, rel=1e-12)
            assert "fraction_paper" not in maps and "60 µm" in str(maps["particles"])
        with open(tmp_path / method / "nonuniformity.csv") as file:
            (row,) = csv.DictReader(file)
        assert float(row["mean"]) == pytest.approx(solids / whole, rel=1e-12)
    assert command("profile", path, "--out", tmp_path / "p")[0] == 0
    for name in ("lateral", "strips"):
        with open(tmp_path / f"p/{name}.csv") as file:
            rows = list(csv.DictReader(file))
        assert sum(float(row["fraction"]) for row in rows) * whole / len(rows) == pytest.approx(solids, rel=1e-12)
    assert command("report", tmp_path)[0] == 0
    page = (tmp_path / "report.html").read_text()
    assert f"<td>{100 * solids / whole:.4f}</td>" in page and "60 µm and 2500 kg/m³" in page and "paper" not in page
    assert command("map", path, "--rho", "2000", "--grid", "10", "10", "--out", tmp_path / "given")[0] == 0
    with np.load(tmp_path / "given/map.0000000000.npz") as maps:
        assert maps["fraction"].sum() * cell == pytest.approx(1.25 * solids, rel=1e-12)  # as was said


def test_the_log_tells_them_where_the_columns_do_not(tmp_path):
    columns = clusters_of(60e-6, 2500, voidage=0.4)
    frame = Frame(0, 0.0, BOX, columns)
    write_dump(tmp_path / "mine.0.dump", frame, ["x", "z", "diameter", "mass"])
    (tmp_path / "log.lammps").write_text(LOG)
    (read,) = read_dumps(tmp_path / "mine.0.dump")
    assert read.particles.kinds == ((0, Kind(60e-6, 2500.0)),) and read.particles.source == "log.lammps"
    assert read.solids.sum() == pytest.approx(columns["n"].sum() * PARTICLE, rel=1e-12)
    assert Run(tmp_path).primary.words == "primary particles of 60 µm and 2500 kg/m³ (log.lammps)"
    assert Run(tmp_path, density=3000).primary.density == 3000


def test_the_last_fix_of_a_log_counts(tmp_path):
    """A script that defines the fix again, with kinds and a line that goes on: that is what ran last."""
    again = "fix size all cluster/breakmerge 10 1e-4 2000 &\n  kind 2 2e-4 5000 K 0.1\n"
    (tmp_path / "log.lammps").write_text(LOG + again)
    write_dump(tmp_path / "mine.0.dump", Frame(0, 0.0, BOX, clusters_of(60e-6, 2500)), ["x", "z", "diameter", "mass"])
    (read,) = read_dumps(tmp_path / "mine.0.dump")
    assert read.particles.kinds == ((0, Kind(1e-4, 2000.0)), (2, Kind(2e-4, 5000.0)))


def test_two_kinds_each_by_its_own():
    """Kinds of one size and two densities, told apart by type, or without types by mass / n; and by the columns alone."""
    light, heavy = clusters_of(60e-6, 2000, seed=1), clusters_of(60e-6, 5000, seed=2)
    both = {name: np.concatenate([light[name], heavy[name]]) for name in light}
    volume = both["n"] * PARTICLE
    primary = Primary(((0, Kind(60e-6, 2000.0)), (2, Kind(60e-6, 5000.0))), "log")
    types = np.repeat([1.0, 2.0], 60)
    np.testing.assert_allclose(primary.solids(both["mass"], None, types), volume, rtol=1e-12)
    np.testing.assert_allclose(primary.solids(both["mass"], both["n"]), volume, rtol=1e-12)
    with pytest.raises(ArgumentError, match="density: .*a column type or n must tell them apart"):
        primary.solids(both["mass"])
    frame = Frame(0, 0.0, BOX, both)
    assert [kind.density for _, kind in frame.particles.kinds] == pytest.approx([2000, 5000])
    np.testing.assert_allclose(frame.solids, volume, rtol=1e-12)
    assert lateral(frame, 5).fraction.sum() * 0.3 * 0.003 * 0.6 / 5 == pytest.approx(volume.sum())


def test_a_column_n_of_another_meaning_is_not_taken():
    rng = np.random.default_rng(1)
    d = rng.uniform(1e-3, 6e-3, 500)
    assert primary_of_columns(2500 * np.pi / 6 * d**3, d, rng.integers(1, 13, 500).astype(float)) is None
    assert primary_of_columns(d, d, np.zeros(500)) is None and primary_of_columns(d, d, None) is None


def test_density_is_asked_for_where_a_cluster_is_heavier_than_any_particle(tmp_path, command):
    columns = {"x": np.array([0.1]), "z": np.array([0.1]), "diameter": np.array([1e-3])}
    columns["mass"] = 2500 * np.pi / 6 * columns["diameter"] ** 3
    path = write_dump(tmp_path / "a.dump", Frame(0, 0.0, BOX, columns), ["x", "z", "diameter", "mass"])
    for name in ("map", "profile", "report"):
        code, _, err = command(name, tmp_path if name == "report" else path, "--out", tmp_path / "out")
        assert code == 2 and err.startswith(
            "clusterdem: --rho: a cluster of 2500 kg/m³ (mass over volume) cannot be made of"
        )
        assert "2000 kg/m³ (assumed): give the density" in err and err.count("\n") == 1
    (frame,) = read_dumps(path)
    assert maps_of(frame.with_density(2500), Grid(BOX, 3, 3))["fraction"].max() == pytest.approx(
        np.pi / 6 * 1e-9 / (0.1 * 0.2 * 0.003)
    )
    with pytest.raises(ArgumentError, match="density: a cluster of 2500"):
        maps_of(frame.with_density(2400), Grid(BOX, 3, 3))
    assert "fraction" not in maps_of(frame, Grid(BOX, 3, 3), fractions=False)
    with pytest.raises(ArgumentError, match="density: must be 0.001 to 1e\\+06 kg/m³, not -1"):
        frame.with_density(-1)


@needs_engine
def test_a_newcomers_own_script(tmp_path):
    """A script of one's own, particles of 60 µm and 2500 kg/m³ at voidage 0.4: n particles of d_p in every cluster's volume."""
    own = """units si
atom_style sphere
atom_modify map yes
boundary p f p
comm_modify vel yes cutoff 4e-3
neighbor 0.3e-3 bin
region box block 0 0.02 0 0.003 0 0.02
create_box 1 box
region plane block 0 0.02 0.0015 0.0015 0 0.02
variable d equal 6e-5*(400/0.6)^(1/3)
create_atoms 1 random 60 3 plane overlap ${d} maxtry 1000
set group all diameter ${d}
set group all density 1500
velocity all set 0 0 2
pair_style gran/cluster 10.0 0.3 0.0 tangential none cutoff 1.0e-3
pair_coeff * *
timestep 1e-6
fix move all nve
fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 plane xz particle 6e-5 2500
variable p equal 6e-5
fix size all cluster/breakmerge 50 ${p} 2500 void 0.4 drag drag K 0.01
dump d all custom 200 mine.*.dump id x y z diameter mass f_size[1]
dump_modify d units yes time yes sort id format float %.12g
run 400
"""
    (tmp_path / "in.mine").write_text(own)
    done = subprocess.run(
        [str(LMP), "-in", "in.mine"], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stdout[-2000:]
    run = Run(tmp_path)
    assert run.primary.words == "primary particles of 60 µm and 2500 kg/m³ (log.lammps)"
    last = list(run)[-1]
    assert last["n"].sum() == 60 * 400
    np.testing.assert_allclose(last.solids, last["n"] * PARTICLE, rtol=1e-9)
    fraction = maps_of(last, Grid(last.box, 4, 4))["fraction"]
    assert fraction.mean() == pytest.approx(60 * 400 * PARTICLE / (0.02 * 0.003 * 0.02), rel=1e-9)


def test_maps_made_by_a_run_take_its_density(tmp_path):
    head = "ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 1\n0 1\nITEM: DIMENSION\n3\nITEM: GRID SIZE nx ny nz\n1 1 1\n"
    cells = "ITEM: GRID CELLS mass_density number_density diameter momentum_x momentum_z energy\n5 1 1 1 1 1\n"
    (tmp_path / "mine.0.maps").write_text(head + cells)
    ((frame, _, maps),) = read_gridded(tmp_path / "mine.0.maps")
    assert maps["fraction"][0, 0] == 5 / 2000 and frame.primary.source == "assumed"
    ((_, _, maps),) = read_gridded(tmp_path / "mine.0.maps", 1000)
    assert maps["fraction"][0, 0] == 5 / 1000
    (tmp_path / "other.0.maps").write_text(head + cells)
    (tmp_path / "other.log").write_text(LOG)
    ((frame, _, maps),) = read_gridded(tmp_path / "other.0.maps")
    assert maps["fraction"][0, 0] == 5 / 2500
    (tmp_path / "two.0.maps").write_text(head + cells)
    (tmp_path / "two.log").write_text(LOG.replace("2500 drag", "2500 kind 2 6e-5 5000 drag"))
    with pytest.raises(ArgumentError, match="density: maps made by the run do not tell"):
        list(read_gridded(tmp_path / "two.0.maps"))
