"""Profiles along the height and over the radius of a tube, against plain loops over clusters."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem import ArgumentError, Tube, height, lateral, radial
from clusterdem.frame import Box, Frame
from synthetic import SKEW, rows_of, skew_frame, write_skew_run

BOXES = [SKEW, Box(SKEW.lo, SKEW.hi, (False, True, True))]


def plain_bins(frame, bin_of, bins, along):
    """Solids (m³), momentum, mass, diameters, clusters of each bin."""
    sums = [[0.0] * 5 for _ in range(bins)]
    for i in range(len(frame)):
        if (which := bin_of(i)) is None:
            continue
        mass = float(frame.mass[i])
        for k, value in enumerate(
            (mass / 2500, mass * float(frame[f"v{along}"][i]), mass, float(frame.diameter[i]), 1)
        ):
            sums[which][k] += value
    return sums


def check(profile, sums, volumes, along):
    for i, ((solids, momentum, mass, diameters, clusters), volume) in enumerate(zip(sums, volumes, strict=True)):
        assert profile.fraction[i] == pytest.approx(solids / volume, rel=1e-12)
        assert profile.mass[i] == pytest.approx(mass, rel=1e-12) and profile.count[i] == clusters
        nan = math.nan
        assert profile.velocity[i] == pytest.approx(momentum / mass if mass else nan, rel=1e-11, nan_ok=True)
        assert profile.diameter[i] == pytest.approx(diameters / clusters if clusters else nan, rel=1e-12, nan_ok=True)
    assert profile.along == along


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("plane", ["xz", "zy", "yx"])
@pytest.mark.parametrize("count", [300, 1, 0])
def test_height(box, plane, count):
    frame = skew_frame(count, box=box).with_density(2500)
    axis = "xyz".index(plane[1])
    low, length = box.lo[axis], box.lengths[axis]
    profile = height(frame, 7, plane)
    sums = plain_bins(frame, lambda i: int((float(frame[plane[1]][i]) - low) / length * 7), 7, plane[1])
    check(profile, sums, [0.12 * 0.05 * 1.0 / 7] * 7, plane[1])
    assert profile.across == plane[1] and profile.edges[[0, -1]] == pytest.approx([low, low + length])
    # the mean over the height is the solids of the whole box
    assert profile.fraction.mean() * 0.006 == pytest.approx(frame.mass.sum() / 2500, rel=1e-12)
    assert profile.mass.sum() == pytest.approx(frame.mass.sum(), rel=1e-12)


def test_beyond_the_box_the_outermost_bin_takes_it():
    frame = skew_frame(3, box=BOXES[0]).with_density(2500)
    frame.columns["z"][:] = (-0.4, 0.75, 0.15)
    assert height(frame, 5).count.tolist() == [1, 0, 1, 0, 1]


@pytest.mark.parametrize("axis", "xyz")
@pytest.mark.parametrize("count", [300, 1, 0])
def test_radial(axis, count):
    frame = skew_frame(count).with_density(2500)
    a, b = (letter for letter in "xyz" if letter != axis)
    centre = {"x": 0.005, "y": 0.22, "z": -0.1}
    tube = Tube(axis, (centre[a], centre[b]), 0.11)
    length = SKEW.lengths["xyz".index(axis)]

    def bin_of(i):
        distance = math.hypot(float(frame[a][i]) - centre[a], float(frame[b][i]) - centre[b])
        return None if distance > 0.11 else int(distance / 0.11 * 5)

    sums = plain_bins(frame, bin_of, 5, axis)
    rings = [math.pi * ((0.022 * (i + 1)) ** 2 - (0.022 * i) ** 2) * length for i in range(5)]
    profile = radial(frame, tube, 5)
    check(profile, sums, rings, axis)
    assert profile.across == "r"
    # the mean over the area is the solids of the tube
    assert (profile.fraction * rings).sum() == pytest.approx(sum(s[0] for s in sums), rel=1e-12)


def test_even_solids_have_an_even_radial_profile():
    """Centres drawn evenly over the cross-section: the fraction of 40,000 of them is flat to 4 standard errors."""
    rng = np.random.default_rng(4)
    box = Box((0, 0, 0), (0.1, 0.1, 0.5), (False, False, True))
    columns = {"x": 0.1 * rng.random(40_000), "y": 0.1 * rng.random(40_000), "z": 0.5 * rng.random(40_000)}
    columns |= {"mass": np.full(40_000, 1e-9), "diameter": np.full(40_000, 2e-4)}
    profile = radial(Frame(0, 0.0, box, columns).with_density(2000), Tube.in_box(box), 8)
    even = 40_000 * 1e-9 / 2000 / 0.005
    assert np.all(np.abs(profile.fraction / even - 1) < 4 / np.sqrt(profile.count))


def test_on_borders():
    """On the border of two annuli the outer one counts, on the tube's radius the last."""
    box = Box((0, 0, 0), (1, 1, 1), (False, False, False))
    columns = {"x": np.array([0.5, 0.625, 0.75, 1.0]), "y": np.full(4, 0.5), "z": np.full(4, 0.5)}
    columns |= {"mass": np.ones(4), "diameter": np.full(4, 0.1)}
    assert radial(Frame(0, 0.0, box, columns), Tube("z", (0.5, 0.5), 0.25), 2, False).count.tolist() == [1, 2]


def test_tubes():
    assert Tube.in_box(SKEW, "x").centre == pytest.approx((0.225, 0.2))
    assert Tube.in_box(SKEW, "x").radius == pytest.approx(0.025)
    assert Tube.in_box(SKEW, "y", radius=0.02).centre == pytest.approx((0.01, 0.2))
    for wrong, said in (
        ((0.0,), "radius: must be above 0 m, not 0"),
        ((math.nan,), "radius: must be above 0 m, not nan"),
    ):
        with pytest.raises(ArgumentError, match=said):
            Tube("z", (0, 0), *wrong)
    with pytest.raises(ArgumentError, match="axis: must be x, y or z, not w"):
        Tube("w", (0, 0), 1.0)
    for kind in (lambda: height(skew_frame(2), 0), lambda: radial(skew_frame(2), Tube.in_box(SKEW), 0)):
        with pytest.raises(ArgumentError, match="bins: must be 1 or more, not 0"):
            kind()


def test_the_command_writes_them(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [50, 0, 80])
    words = ("--radial", "4", "--centre", "0.01", "0.22", "--radius", "0.03", "--bins", "5", "--no-gr", "--rho", "2500")
    code, out, err = command("profile", *dumps, *words, "--out", tmp_path / "p")
    tube = Tube("z", (0.01, 0.22), 0.03)
    outside = sum(int((tube.distance(frame) > 0.03).sum()) for frame in frames)
    assert code == 0 and f"leaves out {outside} clusters beyond the tube's radius" in err
    assert all((tmp_path / f"p/{name}.png").stat().st_size > 1000 for name in ("height", "radial", "lateral"))
    frames = [frame.with_density(2500) for frame in frames]
    for name, profiles in (
        ("radial", [radial(frame, tube, 4) for frame in frames]),
        ("height", [height(frame, 5) for frame in frames]),
        ("lateral", [lateral(frame, 5) for frame in frames]),
    ):
        rows = rows_of(tmp_path / f"p/{name}.csv")
        assert list(rows[0]) == "step time from to fraction velocity_z mean_diameter clusters mass".split()
        expected = np.concatenate([p.fraction for p in profiles])
        assert [row["fraction"] for row in rows] == pytest.approx(expected, rel=1e-12)
        assert sum(row["mass"] for row in rows) == pytest.approx(sum(p.mass.sum() for p in profiles), rel=1e-12)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--radial", "0"), "--radial: must be 1 to 1000 annuli, not 0"),
        (("--radius", "0.1"), "--radius: is of the tube of a radial profile: give --radial N too"),
        (("--radial", "3", "--radius", "-1"), "--radius: must be above 0 m, not -1"),
    ],
)
def test_tubes_that_cannot_be(words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [5])
    code, _, err = command("profile", *dumps, *words, "--out", tmp_path / "out")
    assert code == 2 and said in err and not (tmp_path / "out").exists()
