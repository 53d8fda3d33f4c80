"""Observables of one's own in studies: their numbers are numpy's of the dumps that the engine wrote."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from clusterdem import Run
from clusterdem.errors import ArgumentError, InputError
from clusterdem.frame import Box, Frame
from clusterdem.observables import REGISTRY, How, check_frame, find
from clusterdem.studies.expression import expression
from clusterdem.studies.runs import frames_of
from fake_engine import fake_engine
from synthetic import random_frame, write_dump

NAMES = "id x y z vx vy vz diameter mass charge".split()
TRADE = """
input = "in.flow"
seeds = 3
observables = ["speed", "charged", "load", "pressure", "timestep", "core_seconds"]
[[observable]]
name = "speed"
label = "mean speed"
unit = "m/s"
value = "sum(mass*sqrt(vx**2 + vz**2))/sum(mass)"
[[observable]]
name = "charged"
value = "percentile(where(charge > 0, diameter, 0), 90)"
[[observable]]
name = "load"
value = "run.load - 3"
[[observable]]
name = "pressure"
value = 'run["c_p[2]"]*mean(mass)'
[switches]
gain = [1, 1.5]
"""
CALIBRATE = """
seeds = [4, 7]
[[observable]]
name = "speed"
label = "mean speed"
unit = "m/s"
value = "sum(mass*sqrt(vx**2 + vz**2))/sum(mass)"
[[observable]]
name = "charge_of_mass"
value = "average(charge, weights=mass)"
relative = false
[[case]]
name = "flow"
input = "in.flow"
[[case.target]]
quantity = "speed"
time = 0.02
value = 1.4
[[case.target]]
quantity = "charge_of_mass"
time = 0.03
below = 0.5
[[parameter]]
name = "gain"
low = 1
high = 2
[start]
A = { gain = 1.25 }
[search]
trials = 1
"""


@pytest.fixture(autouse=True)
def registry():
    """Own entries end with the test."""
    before = dict(REGISTRY)
    yield
    REGISTRY.clear()
    REGISTRY.update(before)


@pytest.fixture
def place(tmp_path):
    (tmp_path / "in.flow").write_text("variable gain index 1\nvariable seed index 1\n")
    fake_engine(tmp_path)
    return tmp_path


def rows(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def written(folder, gain, seed):
    """What the engine wrote after the start: columns by name, frame by frame, read by numpy."""
    frames = []
    for step in (10, 40, 90):
        numbers = np.loadtxt(folder / f"kept/{gain}-{seed}.{step:06d}.dump", skiprows=11)
        frames.append(dict(zip(NAMES, numbers.T)))
    return frames


def speed(frame):
    return np.average(np.hypot(frame["vx"], frame["vz"]), weights=frame["mass"])


def test_errors_of_a_trade_are_numpys(place, command):
    (place / "own.toml").write_text(TRADE)
    assert command("trade", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp", "--jobs", "1")[0] == 0

    def of(name, gain, seed):
        frames = written(place, gain, seed)
        number = float(gain)
        return np.array(
            {
                "speed": [speed(f) for f in frames],
                "charged": [np.percentile(np.where(f["charge"] > 0, f["diameter"], 0.0), 90) for f in frames],
                "load": [number * seed + 7 * k - 3 for k in (1, 2, 3)],
                "pressure": [(100 * seed + k) * f["mass"].mean() for k, f in enumerate(frames, 1)],
                "timestep": [0.01 / 10, 0.01 / 30, 0.01 / 50],
                "core_seconds": [0.8 * 10 * seed / number] * 3,
            }[name]
        )

    table = rows(place / "out/own.csv")
    assert [row["setting"] for row in table] == ["gain = 1", "gain = 1.5"]
    for name in ("speed", "charged", "load", "pressure", "timestep", "core_seconds"):
        first, second = (np.mean([of(name, gain, seed) for seed in (1, 2, 3)], axis=0) for gain in ("1", "1.5"))
        expected = np.abs(second - first).sum() / np.abs(first).sum()
        assert float(table[1][f"{name}_error"]) == pytest.approx(expected, rel=1e-9, abs=1e-15), name
        assert float(table[0][f"{name}_error"]) == 0
        samples = np.array([of(name, "1", seed) for seed in (1, 2, 3)])
        apart = np.abs(samples - first).sum(axis=1) / np.abs(first).sum()
        assert float(table[0][f"{name}_spread"]) == pytest.approx(np.sqrt((apart**2).sum() / 2), rel=1e-9, abs=1e-15)
    assert float(table[1]["core_seconds"]) == pytest.approx(0.8 * 10 * 2 / 1.5)  # the median is seed 2's
    assert "mean speed" in (place / "out/own.md").read_text()


def test_numbers_of_a_calibration_are_numpys(place, command):
    (place / "own.toml").write_text(CALIBRATE)
    arguments = ("calibrate", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp", "--jobs", "1")
    assert command(*arguments)[0] == 0
    (row,) = rows(place / "out/own.csv")
    frames = [written(place, "1.25", seed) for seed in (4, 7)]
    assert float(row["flow mean speed(0.02)"]) == pytest.approx(np.mean([speed(f[1]) for f in frames]), rel=1e-12)
    charge = np.mean([(f[2]["charge"] * f[2]["mass"]).sum() / f[2]["mass"].sum() for f in frames])
    assert float(row["flow charge_of_mass(0.03)"]) == pytest.approx(charge, rel=1e-12)

    # another expression of the same name is another number: its runs are done anew
    (place / "calls").unlink()
    (place / "own.toml").write_text(CALIBRATE.replace("sqrt(vx**2 + vz**2)", "abs(vz)"))
    assert command(*arguments)[0] == 0 and len((place / "calls").read_text().splitlines()) == 2
    (row,) = rows(place / "out/own.csv")
    expected = np.mean([np.average(np.abs(f[1]["vz"]), weights=f[1]["mass"]) for f in frames])
    assert float(row["flow mean speed(0.02)"]) == pytest.approx(expected, rel=1e-12)


def test_a_file_that_registers_decides_the_numbers_too(place, command):
    (place / "own.py").write_text(
        "from clusterdem.observables import Observable, register\n"
        "register(Observable('speed', 'v', 'm/s', lambda frame, how: frame['vz'].max(), columns=('vz',)))\n"
    )
    text = CALIBRATE.replace("seeds = [4, 7]", "seeds = [4, 7]\nobservables_file = 'own.py'")
    text = text.replace(text[text.index("[[observable]]") : text.index('[[observable]]\nname = "charge')], "")
    (place / "own.toml").write_text(text)
    arguments = ("calibrate", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp", "--jobs", "1")
    for which in (np.max, np.min):
        code, _, err = command(*arguments)
        assert code == 0, err
        expected = np.mean([which(written(place, "1.25", seed)[1]["vz"]) for seed in (4, 7)])
        assert float(rows(place / "out/own.csv")[0]["flow v(0.02)"]) == pytest.approx(expected, rel=1e-12)
        (place / "own.py").write_text((place / "own.py").read_text().replace("max", "min"))


FRAME = Frame(
    7,
    0.5,
    Box((0, 0, 0), (1, 1, 1)),
    {
        "x": np.array([0.1, 0.7, 0.2]),
        "vz": np.array([-3.0, 1.0, 5.0]),
        "mass": np.array([1.0, 2.0, 5.0]),
        "diameter": np.ones(3),
    },
    path="some.dump",
    run={"load": 4.0, "c_p[2]": 11.0},
)
EMPTY = Frame(8, 0.6, FRAME.box, {name: np.empty(0) for name in ("x", "vz", "mass", "diameter")}, run={"load": 6.0})


@pytest.mark.parametrize(
    "value, expected, columns, of_run",
    [
        ("mean(vz)", 1.0, ("vz",), ()),
        ("sum(mass*vz)/sum(mass)", 3.0, ("mass", "vz"), ()),
        ("max(vz) - min(vz)", 8.0, ("vz",), ()),
        ("std(vz)", np.sqrt(32 / 3), ("vz",), ()),
        ("sum(vz > 0)", 2.0, ("vz",), ()),
        ("median(x)", 0.2, ("x",), ()),
        ("run.load*2 + run['c_p[2]']", 19.0, (), ("load", "c_p[2]")),
        ("pi/6*sum(diameter**3)/run.load", np.pi / 8, ("diameter",), ("load",)),
        (" -abs(min(vz)) ", -3.0, ("vz",), ()),
    ],
)
def test_an_expression(value, expected, columns, of_run):
    own = expression("own", value)
    assert (own.columns, own.of_run) == (columns, of_run)
    assert own(FRAME, How()).tolist() == pytest.approx([expected])


def test_what_a_study_says_of_its_observable():
    plain, own = expression("own", "mean(vz)"), expression("own", "mean(vz)", "v up", "m/s", False)
    assert (plain.name, plain.label, plain.unit, plain.relative) == ("own", "own", "", True)
    assert (own.name, own.label, own.unit, own.relative, own.source) == ("own", "v up", "m/s", False, "mean(vz)")


def test_an_expression_of_no_clusters():
    assert expression("own", "sum(mass)")(EMPTY, How()).tolist() == [0.0]
    assert np.isnan(expression("own", "mean(mass)")(EMPTY, How())).all()
    assert np.isnan(expression("own", "max(mass)")(EMPTY, How())).all()
    assert expression("own", "run.load")(EMPTY, How()).tolist() == [6.0]


@pytest.mark.parametrize(
    "value, words",
    [
        ("mean(vz", "is no expression: '(' was never closed, at character 5"),
        ("maen(vz)", "unknown function 'maen' (did you mean 'mean'?): the functions are mean, sum"),
        ("vz.mean()", "unknown function 'vz.mean'"),
        ("vz.size", "vz.size is neither a column nor run.NAME"),
        ("run[2]", "run[2] is neither a column nor run.NAME"),
        ("[v for v in vz]", "[v for v in vz] is no formula"),
        ("lambda: 1", "is no formula"),
        ("__import__('os').getcwd()", "unknown function"),
    ],
)
def test_what_is_no_expression_is_refused_in_the_study(place, command, value, words):
    with pytest.raises(ArgumentError) as refused:
        expression("own", value)
    text = CALIBRATE.replace("average(charge, weights=mass)", value.replace('"', "'"))
    (place / "own.toml").write_text(text)
    code, _, err = command("calibrate", place / "own.toml", "--lmp", place / "lmp")
    assert code == 2 and words in str(refused.value) and words in err and err.count("\n") == 1
    assert f"own.toml: observable 'charge_of_mass'.value = {value!r}: " in err


def test_one_number_is_asked_for():
    with pytest.raises(InputError, match=r"some.dump: observable 'own', 'vz': gives a number for each cluster"):
        expression("own", "vz")(FRAME, How())
    with pytest.raises(InputError, match="observable 'own', 'mean.*': .*axis 3"):
        expression("own", "mean(vz, axis=3)")(FRAME, How())


def test_what_a_frame_lacks_is_told(place, command):
    REGISTRY["own"] = expression("own", "mean(vq) + run.lode")
    with pytest.raises(
        InputError, match="some.dump: no column 'vq', which observable 'own' needs; there are x, vz, mass"
    ):
        check_frame(FRAME, ["own"])
    REGISTRY["own"] = expression("own", "mean(vz) + run.lode")
    with pytest.raises(
        InputError, match=r"no number of the run 'lode', which observable 'own' needs; there are load, c_p\[2\]"
    ):
        check_frame(FRAME, ["own"])
    check_frame(FRAME, ["count"])

    (place / "own.toml").write_text(TRADE.replace("vx**2", "vq**2"))
    code, _, err = command("trade", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp")
    assert code == 2 and "no column 'vq', which observable 'speed' needs" in err and err.count("\n") == 1


def test_the_frame_after_the_start_must_have_what_is_needed(tmp_path):
    names = ["id", "x", "z", "mass", "diameter"]
    write_dump(tmp_path / "own.0.dump", random_frame(9, 0, 0.0))
    write_dump(tmp_path / "own.5.dump", random_frame(9, 5, 0.1), names)
    REGISTRY["own"] = expression("own", "mean(vz)")
    with pytest.raises(InputError, match="own.5.dump: no column 'vz', which observable 'own' needs"):
        frames_of(Run(tmp_path), ["own"])
    write_dump(tmp_path / "own.0.dump", random_frame(9, 0, 0.0), names)  # the start is not observed
    write_dump(tmp_path / "own.5.dump", random_frame(9, 5, 0.1))
    assert len(frames_of(Run(tmp_path), ["own"])) == 2


def test_numbers_of_a_run(place, command):
    (place / "own.toml").write_text(TRADE)
    command("trade", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp")
    folder = place / "again"
    folder.mkdir()
    for dump in place.glob("kept/1.5-2.*.dump"):
        (folder / f"flow.{dump.name.split('.')[-2]}.dump").write_text(dump.read_text())
    (folder / "flow.N.txt").write_text("# step time load\n0 0 3\n40 0.02 17\n40 0.02 18\n")
    (folder / "flow.log").write_text(
        "Step Temp\n0 300\n40 310\nLoop time of 3 on 2 procs for 90 steps with 9 atoms\n50% CPU use with 2 tasks\n"
    )
    run = Run(folder)
    assert run.numbers_at(40) == {
        "Step": 40, "Temp": 310, "step": 40, "time": 0.02, "load": 18, "dt": pytest.approx(0.01 / 30), "core_seconds": 3,
    }  # fmt: skip
    assert np.isnan(run.numbers_at(0)["dt"]) and run.numbers_at(90).keys() == {"dt", "core_seconds"}
    frames = frames_of(run, ["timestep", "core_seconds"])
    assert [find("timestep")(f, How())[0] for f in frames[1:]] == pytest.approx([1e-3, 1e-2 / 30, 2e-4])
    (folder / "flow.log").unlink()
    assert np.isnan(Run(folder).numbers_at(40)["core_seconds"])


def test_frames_without_their_run_have_none_of_its_numbers():
    assert np.isnan(find("timestep")(FRAME, How())).all() and np.isnan(find("core_seconds")(FRAME, How())).all()


def test_kept_numbers_of_the_run_come_back(place, command):
    (place / "own.toml").write_text(TRADE)
    arguments = ("trade", place / "own.toml", "--out", place / "out", "--lmp", place / "lmp")
    assert command(*arguments)[0] == 0
    before = (place / "out/own.csv").read_text()
    calls = (place / "calls").read_text().splitlines()
    assert command(*arguments)[0] == 0
    assert (place / "out/own.csv").read_text() == before and len(calls) == 6 == len(
        (place / "calls").read_text().splitlines()
    )
    assert all(json.loads(call)[0][0] == str(place / "lmp") for call in calls)
