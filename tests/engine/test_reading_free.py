"""inputs/reading_free.in: the readings of a file each, reached by switches alone."""

import numpy as np
import pytest
from test_case_switches import case1

QUARTER = {"height": 0.25, "tend": 3e-4, "setting": "fast"}
LAST = "case1.00000060.dump"
FREE = {
    "A": {},
    "B": {"K_3": 0.03075, "nsmf": "paper", "up": "cell", "ncc": 0, "hysteresis": 0.1},
    "C": {"K_3": 0.0303, "gust_time": "frozen", "unshielded": 1, "ncc": 0.1, "hysteresis": 0.1},
    "E": {
        **{"K_3": 0.1602, "K_power": 2, "begin": "rest", "gust_of": "own", "gust_time": "frozen"},
        **{"unshielded": 0.1, "test": "end", "ncc": 0, "hysteresis": 0},
    },
    "F": {
        **{"K_3": 0.03675, "law": "trancong 0.8 1.17", "gust_time": 0.006},
        **{"nsmf": "paper", "ncc": 0, "hysteresis": 0.2},
    },
}


@pytest.mark.parametrize("reading", FREE)
def test_switches_reach_every_reading(tmp_path, reading):
    """To rounding: K is a product in one file and a power in the other."""
    runs = []
    for name, variables in ((reading, {}), ("free", FREE[reading])):
        runs.append(case1(tmp_path / name, frame=LAST, reading=name, **QUARTER, **variables))
    file, free = (last for _, last, _ in runs)
    assert np.array_equal(file["n"], free["n"])
    assert np.allclose(file["vz"], free["vz"], rtol=0, atol=1e-9)


def test_a_fitted_reading_has_a_drag_law_that_the_user_may_change(tmp_path):
    """Reading F brings its d_A/d_n; -var law still wins."""
    runs = {
        law: case1(tmp_path / str(law), frame=LAST, reading="F", **QUARTER, **({"law": law} if law else {}))[1]
        for law in (None, "trancong 0.8 1.17", "trancong 0.8 1.1")
    }
    assert np.array_equal(runs[None]["vz"], runs["trancong 0.8 1.17"]["vz"])
    assert not np.array_equal(runs[None]["vz"], runs["trancong 0.8 1.1"]["vz"])
