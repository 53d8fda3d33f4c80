"""Averages over time of maps and profiles, with their standard errors, against plain loops."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem import ArgumentError, Grid, maps_of, time_average
from clusterdem.analysis.averages import average_of
from clusterdem.analysis.profiles import WEIGHTS, height
from synthetic import rows_of, write_skew_run


def plain_average(values, weights, blocks):
    """Mean and error of one number, a loop over frames and blocks; values may be NaN."""
    frames = len(values)
    mass, sums = [0.0] * blocks, [0.0] * blocks
    for number, (value, weight) in enumerate(zip(values, weights, strict=True)):
        if not math.isnan(value):
            block = math.floor(number * blocks / frames)
            mass[block] += weight
            sums[block] += weight * value
    used = [b for b in range(blocks) if mass[b] > 0]
    if not used:
        return math.nan, math.nan
    whole = sum(mass)
    mean = sum(sums) / whole
    if len(used) < 2:
        return mean, math.nan
    squares = sum((mass[b] / whole) ** 2 * (sums[b] / mass[b] - mean) ** 2 for b in used)
    return mean, math.sqrt(len(used) / (len(used) - 1) * squares)


def test_equal_blocks_are_the_textbooks():
    """The error is the standard deviation (n − 1) of the block means over the root of their number."""
    values = np.random.default_rng(1).normal(3, 1, (60, 4, 5)).cumsum(axis=0)
    found = time_average(values, 60, 6)
    means = values.reshape(6, 10, 4, 5).mean(axis=1)
    np.testing.assert_allclose(found.mean, values.mean(axis=0), rtol=1e-13)
    np.testing.assert_allclose(found.error, means.std(axis=0, ddof=1) / np.sqrt(6), rtol=1e-12)


def test_blocks_that_do_not_divide_the_frames_and_gaps():
    rng = np.random.default_rng(2)
    values, weights = rng.normal(size=(11, 3)), rng.random((11, 3))
    values[3:7, 1] = np.nan
    values[1:, 2] = np.nan  # a single block
    weights[2, 0] = 0.0
    found = time_average(values, 11, 3, weights)
    for i in range(3):
        mean, error = plain_average(values[:, i], weights[:, i], 3)
        assert found.mean[i] == pytest.approx(mean, rel=1e-13)
        assert found.error[i] == pytest.approx(error, rel=1e-12, nan_ok=True)
    assert math.isnan(found.error[2]) and not math.isnan(found.mean[2])


def test_what_never_has_a_value_has_no_average():
    found = time_average([np.array([np.nan, 1.0])] * 4, 4, 2)
    assert math.isnan(found.mean[0]) and math.isnan(found.error[0])
    assert (found.mean[1], found.error[1]) == (1.0, 0.0)


def test_longer_blocks_find_the_error_of_numbers_that_resemble_each_other():
    """A process x' = a x + noise has the error σ √((1 + a)/(1 − a)/F) of its mean: blocks of 200 τ find it to 20 %."""
    rng = np.random.default_rng(3)
    a, frames = 0.9, 4000
    x = np.zeros((frames, 200))
    x[0] = rng.normal(0, 1 / math.sqrt(1 - a * a), 200)
    for i in range(1, frames):
        x[i] = a * x[i - 1] + rng.normal(size=200)
    expected = math.sqrt(1 / (1 - a * a) * (1 + a) / (1 - a) / frames)
    assert np.sqrt((time_average(x, frames, 20).error ** 2).mean()) == pytest.approx(expected, rel=0.2)
    assert np.sqrt((time_average(x, frames, frames).error ** 2).mean()) < 0.3 * expected


@pytest.mark.parametrize(
    ("blocks", "said"), [(1, "average: needs 2 blocks or more, not 1"), (4, "4 blocks need 4 frames or more, not 3")]
)
def test_too_few_blocks_or_frames(blocks, said):
    with pytest.raises(ArgumentError, match=said):
        time_average([np.zeros(2)] * 3, 3, blocks)


def test_map_average(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [40, 0, 90, 55, 70, 1, 200])
    words = ("--average", "3", "--grid", "3", "5", "--out", tmp_path / "m")
    code, out, err = command("map", *dumps, *words)
    assert (code, err) == (0, "") and "average_velocity_z.png" in out and "error_fraction.png" in out
    assert (tmp_path / "m/error_temperature.png").stat().st_size > 1000
    maps = [maps_of(frame, Grid(frame.box, 3, 5)) for frame in frames]
    weight = {"velocity_x": "mass", "velocity_z": "mass", "temperature": "mass", "mean_diameter": "number_density"}
    with np.load(tmp_path / "m/average.npz") as data:
        assert data["step"].tolist() == [f.step for f in frames] and data["blocks"] == 3
        for name in maps[0]:
            for cell in np.ndindex(3, 5):
                weights = [float(m[weight[name]][cell]) if name in weight else 1.0 for m in maps]
                mean, error = plain_average([float(m[name][cell]) for m in maps], weights, 3)
                assert data[name][cell] == pytest.approx(mean, rel=1e-11, nan_ok=True), (name, cell)
                assert data[f"{name}_error"][cell] == pytest.approx(error, rel=1e-9, nan_ok=True), (name, cell)
        mean_mass = sum(frame.mass.sum() for frame in frames) / 7
        assert data["mass"].sum() == pytest.approx(mean_mass, rel=1e-12)
        momentum = sum((frame.mass * frame["vz"]).sum() for frame in frames)
        assert np.nansum(data["mass"] * data["velocity_z"]) * 7 == pytest.approx(momentum, rel=1e-12)
        rows = rows_of(tmp_path / "m/average.csv")
        assert [row["fraction_error"] for row in rows] == data["fraction_error"].ravel().tolist()
        assert [row["x"] for row in rows[::5]] == pytest.approx([-0.03, 0.01, 0.05])


@pytest.mark.parametrize("since", ["0.0199", "0.02", "0.0200000000000001"])
def test_average_since_a_time(since, tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [40, 30, 90, 55, 70])
    words = ("--average", "2", "--since", since, "--grid", "2", "2", "--no-figures", "--out", tmp_path / "m")
    assert command("map", *dumps, *words)[0] == 0
    with np.load(tmp_path / "m/average.npz") as data:
        assert data["time"].tolist() == [0.02, 0.03, 0.04]
        mass = np.mean([maps_of(frame, Grid(frame.box, 2, 2))["mass"] for frame in frames[2:]], axis=0)
        np.testing.assert_allclose(data["mass"], mass, rtol=1e-12)


def test_profile_average(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [40, 30, 90, 55, 70])
    words = ("--average", "2", "--bins", "6", "--radial", "3", "--no-gr", "--out", tmp_path / "p")
    code, out, err = command("profile", *dumps, *words)
    assert code == 0 and "radial_average.png" in out and "beyond the tube's radius" in err
    profiles = [height(frame, 6).columns for frame in frames]
    assert WEIGHTS["velocity_z"] == "mass"
    for i, row in enumerate(rows_of(tmp_path / "p/height_average.csv")):
        assert (row["from"], row["to"]) == pytest.approx((-0.3 + i / 6, -0.3 + (i + 1) / 6))
        for name, weight in (
            ("fraction", None),
            ("velocity_z", "mass"),
            ("mean_diameter", "clusters"),
            ("clusters", None),
        ):
            weights = [1.0 if weight is None else float(p[weight][i]) for p in profiles]
            mean, error = plain_average([float(p[name][i]) for p in profiles], weights, 2)
            assert row[name] == pytest.approx(mean, rel=1e-12, nan_ok=True)
            assert row[f"{name}_error"] == pytest.approx(error, rel=1e-10, nan_ok=True)


def test_averages_of_maps_go_through_the_frames_once():
    frames = iter(
        [{"a": np.array([1.0, 3.0]), "m": np.array([1.0, 0.0])}, {"a": np.array([3.0, 5.0]), "m": np.array([3.0, 2.0])}]
    )
    found = average_of(frames, 2, 2, {"a": "m"})
    assert found["a"].mean.tolist() == [2.5, 5.0] and found["m"].mean.tolist() == [2.0, 1.0]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--average", "1"), "--average: needs 2 blocks or more, not 1"),
        (("--average", "3"), "--average: 3 blocks need 3 frames or more, not 2"),
        (("--since", "0.1"), "--since: 0.1 s is for averages: give --average too"),
        (("--average", "2", "--since", "0.005"), "--average: 2 blocks need 2 frames or more, not 1"),
    ],
)
@pytest.mark.parametrize("name", ["map", "profile"])
def test_averages_that_cannot_be(name, words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [5, 6])
    code, _, err = command(
        name, *dumps, *words, "--out", tmp_path / "out", *(("--grid", "2", "2") if name == "map" else ())
    )
    assert code == 2 and said in err
