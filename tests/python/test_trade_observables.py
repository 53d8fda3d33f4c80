"""Observables of hand-made frames, and errors against the spread between seeds."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from clusterdem.analysis.grid import grid_of_cells
from clusterdem.errors import InputError
from clusterdem.frame import Box, Frame
from clusterdem.observables import How
from clusterdem.studies.trade.errors import distance, error_between, errors_of, spread_between
from clusterdem.studies.trade.frames import read_frames, write_frames
from clusterdem.studies.trade.observe import DEFAULT, Observed, observe
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from synthetic import BOX as BOX_OF_CASES
from synthetic import random_frame

BOX = Box((0.0, 0.0, 0.0), (0.02, 0.003, 0.02))


def frame(x, z, diameter, step=1, box=BOX):
    diameter = np.array(diameter)
    mass = 1000 * np.pi / 6 * diameter**3
    return Frame(step, 1e-3 * step, box, {"x": np.array(x), "z": np.array(z), "diameter": diameter, "mass": mass})


START = frame([0.001], [0.001], [1e-3], step=0)


def observed(*frames, cell=(0.01, 0.01)):
    return observe([START, *frames], DEFAULT, How(cell, (3e-4, 6e-4, 9e-4)))


def test_two_clusters_by_hand():
    """Diameters 1 and 2 (in 0.1 mm): mean 1.5, Sauter 9/5; both below 300 um; masses 1 to 8 in two of four cells."""
    found = observed(frame([0.001, 0.011], [0.001, 0.011], [1e-4, 2e-4])).values
    unit = 1000 * np.pi / 6 * 1e-12
    assert found["clusters"][0] == pytest.approx([2 / (9 * unit)])
    assert found["mean_diameter"][0] == pytest.approx([1.5e-4]) and found["sauter_diameter"][0] == pytest.approx(
        [1.8e-4]
    )
    assert found["size_classes"][0].tolist() == [100, 0, 0, 0]
    volume = 0.01 * 0.01 * 0.003
    assert found["map"][0] == pytest.approx(np.array([1, 0, 0, 8]) * unit / 2000 / volume)
    assert found["lateral_fraction"][0] == pytest.approx(np.array([1, 8]) * unit / 2000 / (2 * volume))
    # 9 and 1 mm from the centre line, strips of 1.67 mm: 0.1 mm in the sixth, 0.2 mm in the first
    assert found["strip_diameter"][0] == pytest.approx([2e-4, np.nan, np.nan, np.nan, np.nan, 1e-4], nan_ok=True)
    # variance of the masses (1, 0, 0, 8) over that of 2 clusters on 4 cells by chance
    masses = np.array([1, 0, 0, 8.0])
    assert found["dispersion"][0] == pytest.approx([masses.var() / ((1 + 64) * (1 - 1 / 4) / 4)])


def test_the_start_is_left_out_and_one_is_not_enough():
    found = observed(frame([0.01], [0.01], [1e-3], step=5), frame([0.01], [0.01], [1e-3], step=9))
    assert found.times == pytest.approx([5e-3, 9e-3]) and found.values["map"].shape == (2, 4)
    with pytest.raises(InputError, match="no frame after the start"):
        observe([START], ("clusters",), How())


def test_cells_and_classes_that_are_open_follow_from_the_reference():
    """Diameters 1 to 5 mm in a box of 20 mm: 30 x 30 cells, borders at 2, 3 and 4 mm; what is said stays."""
    frames = [frame([0.01, 0.01], [0.01, 0.01], [1e-3, 3e-3]), frame([0.01], [0.01], [5e-3])]
    how = How().settled(frames)
    assert how.cell == pytest.approx((0.02 / 30, 0.02 / 30)) and how.borders == pytest.approx((2e-3, 3e-3, 4e-3))
    assert how.grid(frames[0]).shape == (30, 30) and How((1, 1), (1e-4,)).settled(frames) == How((1, 1), (1e-4,))
    assert How().settled([]) == How()


def test_cells_keep_their_size_in_another_box():
    assert grid_of_cells(BOX_OF_CASES, (0.01, 0.02)).shape == (30, 30)
    half = Box((0, 0, 0), (0.3, 0.003, 0.3))
    assert grid_of_cells(half, (0.01, 0.02)).shape == (30, 15)


def test_frames_come_back_as_they_were(tmp_path):
    frames = [replace(random_frame(50, step, 1e-3 * step), run={"load": 0.5 + step, "c_p[2]": 3.0}) for step in (0, 10)]
    assert write_frames(tmp_path / "frames.npz", frames) == 2
    for before, after in zip(frames, read_frames(tmp_path / "frames.npz")):
        assert (after.step, after.time, after.box) == (before.step, before.time, before.box)
        assert list(after.columns) == list(before.columns) and after.run == before.run
        for name in before.columns:
            assert np.array_equal(after[name], before[name])


# ---- errors

rows = arrays(float, (4, 6), elements=st.floats(0.1, 10))


def test_one_number_is_the_relative_difference():
    """Reference 9, 10, 11: mean 10, standard deviation 1, so a spread of 10 %."""
    reference = np.array([[9.0], [10.0], [11.0]])
    spread = spread_between(reference)
    assert spread == pytest.approx(0.1)
    error = error_between(reference + 0.5, reference, spread)
    assert error.value == pytest.approx(0.05) and error.inside
    # the shift is the same for every seed: only the mean that it is divided by varies, by half a percent
    assert error.uncertainty < 0.005
    error = error_between(reference * 1.2, reference, spread)
    assert error.value == pytest.approx(0.2) and not error.inside
    assert error.uncertainty == pytest.approx(0, abs=1e-15)


def test_jackknife_of_a_mean_is_its_standard_error():
    """For one number against a reference without spread, the jackknife is the textbook s/sqrt(n)."""
    samples = np.array([[11.0], [12.0], [14.0], [15.0]])
    error = error_between(samples, np.full((4, 1), 10.0), 0.0)
    assert error.value == pytest.approx(0.3)
    assert error.uncertainty == pytest.approx(samples.std(ddof=1) / math.sqrt(4) / 10)


def test_solids_moved_to_another_cell_count_twice():
    reference = np.array([3.0, 1.0, 0.0])
    assert distance(np.array([2.0, 1.0, 1.0]), reference, reference) == pytest.approx(2 * 0.25)
    assert distance(np.zeros(3), np.zeros(3), np.zeros(3)) == 0.0
    assert distance(np.ones(3), np.zeros(3), np.zeros(3)) == math.inf


@given(rows, rows, st.floats(0.1, 10))
def test_errors_do_not_depend_on_units_nor_on_the_order_of_seeds(samples, reference, unit):
    plain = error_between(samples, reference, spread_between(reference))
    scaled = error_between(unit * samples, unit * reference, spread_between(unit * reference))
    turned = error_between(samples[::-1], reference[::-1], spread_between(reference[::-1]))
    for other in (scaled, turned):
        assert (other.value, other.spread) == pytest.approx((plain.value, plain.spread), rel=1e-9, abs=1e-12)
        assert other.uncertainty == pytest.approx(plain.uncertainty, rel=1e-6, abs=1e-9)
    assert error_between(reference, reference, 0.0).value == 0.0


def test_other_seeds_of_the_same_model_are_no_error():
    """Two sets of five seeds of one noisy map: the distance of the means lies inside the spread of single seeds."""
    rng = np.random.default_rng(1)
    for _ in range(50):
        first, second = rng.poisson(8.0, (2, 5, 900)).astype(float)
        assert error_between(first, second, spread_between(second)).inside


def run(times, width, value):
    return Observed(np.array(times), {"map": np.full((len(times), width), value)})


def test_runs_that_cannot_be_compared():
    reference = {seed: run([1.0, 2.0], 4, 1.0 + 0.1 * seed) for seed in (1, 2, 3)}

    def error(*arguments):
        return errors_of({1: run(*arguments)}, reference, ("map",))["map"]

    assert error([1.0, 2.0], 4, 1.1).value == 0.0
    assert error([1.001, 1.999], 4, 1.1) is not None  # a step's length late
    assert error([1.0, 1.9], 4, 1.1) is None  # another time
    assert error([1.0], 4, 1.1) is None  # another number of frames
    assert error([1.0, 2.0], 2, 1.1) is None  # another box
    assert errors_of({}, reference, ("map",))["map"] is None


def test_seeds_of_a_reference_that_have_other_times_are_not_compared():
    reference = {1: run([1.0, 2.0], 4, 1.0), 2: run([1.0, 2.0], 4, 1.2), 3: run([1.0, 1.7], 4, 1.1)}
    assert errors_of({1: run([1.0, 2.0], 4, 1.0)}, reference, ("map",))["map"] is None


def test_what_is_nowhere_is_no_difference():
    """A strip without clusters in both is none; in one of them alone it cannot be bridged."""
    nan = math.nan
    assert distance(np.array([1.0, nan]), np.array([2.0, nan]), np.array([2.0, nan])) == 0.5
    assert distance(np.array([1.0, nan]), np.array([2.0, 1.0]), np.array([2.0, 1.0])) == math.inf


def test_only_seeds_in_common_are_compared_but_the_spread_is_of_all():
    reference = {seed: run([1.0], 1, float(seed)) for seed in (9, 10, 11)}
    error = errors_of({9: run([1.0], 1, 9.0), 11: run([1.0], 1, 11.0)}, reference, ("map",))["map"]
    assert error.value == 0.0 and error.spread == pytest.approx(0.1)
