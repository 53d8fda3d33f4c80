"""Start positions: as many as asked, none overlapping, also across the periodic sides, the same for the same seed."""

from __future__ import annotations

import numpy as np
import pytest
from clusterdem import ArgumentError
from clusterdem.io.start import diameter, place, write_start


def nearest(centres, lengths):
    """Smallest distance between two centres in a periodic box."""
    d = np.abs(centres[:, None, :] - centres[None, :, :])
    d = np.minimum(d, np.array(lengths) - d)
    r = np.hypot(d[..., 0], d[..., 1])
    return r[~np.eye(len(r), dtype=bool)].min()


@pytest.mark.parametrize("lengths, count", [((0.05, 0.03), 300), ((0.0021, 0.05), 20), ((0.003, 0.0021), 3)])
def test_none_overlap(lengths, count):
    d = diameter(400)
    centres = place(count, d, lengths, seed=2)
    assert centres.shape == (count, 2) and nearest(centres, lengths) >= d
    assert np.all((centres >= 0) & (centres < lengths))
    np.testing.assert_array_equal(centres, place(count, d, lengths, seed=2))
    assert not np.array_equal(centres, place(count, d, lengths, seed=3))


def test_file_and_command(tmp_path, command):
    code, out, _ = command("start", "--case", "case2", "--n", "1550", "--out", tmp_path / "s.data")
    assert code == 0 and out.strip() == str(tmp_path / "s.data")
    rows = np.loadtxt(tmp_path / "s.data", skiprows=10)
    assert rows.shape == (2000, 7) and np.all(rows[:, 0] == np.arange(1, 2001))
    assert set(rows[:, 2]) == {diameter(1550)} and set(rows[:, 3]) == {1000.0} and set(rows[:, 5]) == {0.0015}


def test_bad_input(tmp_path, command):
    with pytest.raises(ArgumentError, match="no room for cluster"):
        place(100, 0.01, (0.05, 0.05), seed=1)
    with pytest.raises(ArgumentError, match="at least two diameters"):
        write_start(tmp_path / "s", 1, 400, (0.001, 0.003, 0.05), seed=1)
    assert command("start", "--clusters", "0")[0] == 2
