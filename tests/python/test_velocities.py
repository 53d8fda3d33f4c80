"""Histograms of velocities and their moments against plain loops."""

from __future__ import annotations

import csv
import math

import numpy as np
import pytest
from clusterdem import ArgumentError, InputError, velocity_moments
from clusterdem.frame import Frame
from synthetic import SKEW, rows_of, skew_frame, write_dump, write_skew_run


def plain_moments(frame, axis, by_mass):
    """Mean and variance along an axis by loops."""
    weights = [float(m) if by_mass else 1.0 for m in frame.mass]
    values = [float(v) for v in frame[f"v{axis}"]]
    if not values:
        return math.nan, math.nan
    whole = sum(weights)
    mean = sum(w * v for w, v in zip(weights, values, strict=True)) / whole
    if len(values) < 2:
        return mean, math.nan
    free = whole - sum(w * w for w in weights) / whole if by_mass else len(values) - 1
    return mean, sum(w * (v - mean) ** 2 for w, v in zip(weights, values, strict=True)) / free


@pytest.mark.parametrize("axes", ["xz", "y", "zyx"])
@pytest.mark.parametrize("by", ["number", "mass"])
@pytest.mark.parametrize("count", [300, 2, 1, 0])
def test_moments(axes, by, count):
    frame = skew_frame(count)
    found = velocity_moments(frame, axes, by)
    expected = [plain_moments(frame, axis, by == "mass") for axis in axes]
    np.testing.assert_allclose(found.mean, [mean for mean, _ in expected], rtol=1e-12)
    np.testing.assert_allclose(found.variance, [variance for _, variance in expected], rtol=1e-12)
    temperature = sum(variance for _, variance in expected) / len(axes)
    assert found.temperature == pytest.approx(temperature, rel=1e-12, nan_ok=True)


def test_the_variance_of_numpy():
    frame = skew_frame(50)
    assert velocity_moments(frame, "y").variance[0] == pytest.approx(np.var(frame["vy"], ddof=1), rel=1e-12)
    cov = np.cov(frame["vy"], aweights=frame.mass)  # numpy's own for reliability weights
    assert velocity_moments(frame, "y", "mass").variance[0] == pytest.approx(float(cov), rel=1e-12)


def test_small_samples_of_one_temperature_have_it_on_average():
    """N − 1: 4,000 samples of three clusters from a Maxwellian of 0.25 m²/s²; by N it would be 0.167."""
    rng = np.random.default_rng(8)
    found = []
    for _ in range(4000):
        columns = {f"v{axis}": rng.normal(1.0, 0.5, 3) for axis in "xyz"}
        columns |= {"x": np.zeros(3), "z": np.zeros(3), "mass": np.ones(3), "diameter": np.ones(3)}
        found.append(velocity_moments(Frame(0, 0.0, SKEW, columns), "xyz").temperature)
    assert np.mean(found) == pytest.approx(0.25, rel=0.03)


def test_what_is_refused():
    frame = skew_frame(3)
    for axes in ("", "xx", "xw"):
        with pytest.raises(ArgumentError, match="axes: must be some of x, y, z, each once"):
            velocity_moments(frame, axes)
    with pytest.raises(ArgumentError, match="by: must be number or mass, not volume"):
        velocity_moments(frame, "x", "volume")
    del frame.columns["vy"]
    with pytest.raises(InputError, match="no column vy"):
        velocity_moments(frame, "xy")


def test_the_command(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [150, 0, 1, 90])
    code, out, err = command("velocities", *dumps, "--axes", "yz", "--bins", "9", "--out", tmp_path / "v")
    assert (code, err) == (0, "") and all(f"{name}.png" in out for name in ("histogram", "velocities"))
    rows = rows_of(tmp_path / "v/velocities.csv")
    with open(tmp_path / "v/histogram.csv") as file:
        bins = list(csv.DictReader(file))
    assert len(bins) == 4 * 2 * 11
    for frame, row in zip(frames, rows, strict=True):
        assert row["clusters"] == len(frame)
        for key, by_mass in (("n", False), ("m", True)):
            variances = []
            for axis in "yz":
                mean, variance = plain_moments(frame, axis, by_mass)
                variances.append(variance)
                assert row[f"{key}_mean_{axis}"] == pytest.approx(mean, rel=1e-11, nan_ok=True)
                assert row[f"{key}_variance_{axis}"] == pytest.approx(variance, rel=1e-11, nan_ok=True)
            assert row[f"{key}_temperature"] == pytest.approx(sum(variances) / 2, rel=1e-11, nan_ok=True)
        for axis in "yz":
            mine = [b for b in bins if int(b["step"]) == frame.step and b["axis"] == axis]
            for weight, name in ((np.ones(len(frame)), "number_percent"), (frame.mass, "mass_percent")):
                for b in mine:
                    inside = (frame[f"v{axis}"] >= float(b["from"])) & (frame[f"v{axis}"] < float(b["to"]))
                    share = 100 * weight[inside].sum() / weight.sum() if len(frame) else math.nan
                    assert float(b[name]) == pytest.approx(share, rel=1e-10, abs=1e-12, nan_ok=True)
                # all of it lies between the ends: the slowest in the first bin, the fastest in the last
                if len(frame):
                    assert sum(float(b[name]) for b in mine[1:-1]) == pytest.approx(100)
    for axis in "yz":
        borders = [float(b["from"]) for b in bins if b["step"] == "0" and b["axis"] == axis][1:]
        every = np.concatenate([frame[f"v{axis}"] for frame in frames])
        assert borders[0] == every.min() and borders[-1] == pytest.approx(every.max(), rel=1e-15)


def test_a_given_range_and_what_lies_beyond(tmp_path, command):
    dumps, (frame,) = write_skew_run(tmp_path, [100])
    words = ("--axes", "z", "--range", "0", "2", "--bins", "4", "--out", tmp_path / "v", "--no-figures")
    assert command("velocities", *dumps, *words)[0] == 0
    with open(tmp_path / "v/histogram.csv") as file:
        found = [(float(b["from"]), float(b["to"]), float(b["number_percent"])) for b in csv.DictReader(file)]
    assert [to for _, to, _ in found] == [0, 0.5, 1, 1.5, 2, math.inf]
    assert found[0][2] == pytest.approx((frame["vz"] < 0).sum()) and found[-1][2] == pytest.approx(
        (frame["vz"] >= 2).sum()
    )
    assert found[0][2] > 0 and found[-1][2] > 0


def test_all_at_rest_and_none(tmp_path, command):
    frame = skew_frame(5)
    frame.columns["vz"][:] = 0.0
    for name, one in (("rest", frame), ("none", skew_frame(0))):
        path = write_dump(tmp_path / f"{name}.dump", one, "id x y z vx vy vz diameter mass".split())
        assert command("velocities", path, "--axes", "z", "--out", tmp_path / name)[0] == 0
    assert rows_of(tmp_path / "rest/velocities.csv")[0]["n_temperature"] == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--axes", "zz"), "--axes: must be some of x, y, z, each once, such as xz, not zz"),
        (("--bins", "0"), "--bins: must be 1 to 100,000, not 0"),
        (("--range", "2", "1"), "--range: needs two velocities that rise (m/s), not 2 1"),
        (("--range", "nan", "1"), "--range: needs two velocities that rise (m/s), not nan 1"),
    ],
)
def test_words_that_cannot_be(words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [5])
    code, _, err = command("velocities", *dumps, *words, "--out", tmp_path / "out")
    assert code == 2 and said in err
    path = write_dump(tmp_path / "still.dump", skew_frame(3), "id x z diameter mass".split())
    code, _, err = command("velocities", path, "--out", tmp_path / "out")
    assert code == 2 and f"{path}:5: no column vx" in err
