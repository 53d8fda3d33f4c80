"""The answer: cheapest within the tolerance, no change that the clock cannot show; the Pareto front."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from clusterdem import InputError
from clusterdem.studies.runs import Cost, Failure, Setting, StudyRun
from clusterdem.studies.trade.answer import in_words
from clusterdem.studies.trade.errors import Error
from clusterdem.studies.trade.observe import Observed
from clusterdem.studies.trade.weigh import Weighed, _check_times, cheapest, front, untold


def weighed(axis, seconds, error, failures=()):
    errors = {"map": None if error is None else Error(error, 0.0, 0.02)}
    return Weighed(Setting(axis, axis, {}), {k: Cost(s, s) for k, s in enumerate(seconds, 1)}, errors, failures)


REFERENCE = weighed("reference", [10.0, 11.0, 12.0], 0.0)


def test_cheapest_within_the_tolerance():
    coarse, fine = weighed("dt", [2.0, 2.1, 2.2], 0.2), weighed("every", [5.0, 5.1, 5.2], 0.04)
    assert cheapest([REFERENCE, coarse, fine], 0.05) is fine
    assert cheapest([REFERENCE, coarse, fine], 0.2) is coarse
    assert cheapest([REFERENCE, coarse, fine], 0.01) is REFERENCE


def open_at(value, uncertainty, spread=0.5):
    w = weighed("dt", [2.0, 2.1, 2.2], value)
    return replace(w, errors={"map": Error(value, uncertainty, spread)})


def test_an_error_and_twice_its_standard_error_must_keep_the_tolerance():
    """Whatever single seeds differ by: 0.03 ± 0.01 is within 0.05, 0.03 ± 0.02 may be or not, 0.1 ± 0.02 is not."""
    within, may_be, beyond = open_at(0.03, 0.01), open_at(0.03, 0.02), open_at(0.1, 0.02)
    assert [w.within(0.05) for w in (within, may_be, beyond)] == [True, None, False]
    assert cheapest([REFERENCE, within], 0.05) is within
    assert cheapest([REFERENCE, may_be], 0.05) is REFERENCE and untold([REFERENCE, may_be], REFERENCE, 0.05) == [may_be]
    assert cheapest([REFERENCE, beyond], 0.05) is REFERENCE and not untold([REFERENCE, beyond], REFERENCE, 0.05)
    words = in_words([REFERENCE, may_be, beyond], REFERENCE, 0.05)
    assert words.startswith("Cannot be told within 5 %, more seeds are needed: dt (map 3 ± 2 %, 2.1 core-seconds). ")
    assert words.endswith("Cheapest within 5 %: the reference itself, 11 core-seconds.")


def test_one_seed_alone_tells_nothing_within_the_tolerance():
    assert open_at(0.01, float("nan")).within(0.05) is None


@pytest.mark.parametrize("seconds", [[9.9, 10.9, 11.9], [10.1, 5.0, 5.0]], ids=["less than 2 %", "not with every seed"])
def test_what_the_clock_cannot_show_is_no_saving(seconds):
    assert cheapest([REFERENCE, weighed("digits", seconds, 0.0)], 0.05) is REFERENCE


def test_of_equals_the_one_with_fewest_changes():
    one, two = weighed("dt", [2.0, 2.1, 2.2], 0.0), weighed("dt + merge", [1.99, 2.08, 2.19], 0.0)
    assert cheapest([REFERENCE, two, one], 0.05) is one
    two = weighed("dt + merge", [1.0, 1.1, 1.2], 0.0)
    assert cheapest([REFERENCE, two, one], 0.05) is two


def test_what_failed_or_cannot_be_compared_is_no_answer():
    run = StudyRun(REFERENCE.setting, 1, "key", Path("runs/key"), (), ("lmp",), 1, None, None)
    failed, other_box = (
        weighed("dt", [1.0, 1.0], 0.0, (Failure(run, "lost"),)),
        weighed("height", [1.0, 1.0, 1.0], None),
    )
    assert cheapest([REFERENCE, failed, other_box], 0.05) is REFERENCE


def test_a_reference_whose_seeds_have_frames_at_other_times_is_refused():
    """Dumps by step of a variable step: the same steps are other times."""
    study = SimpleNamespace(path=Path("s.toml"))
    one, same, other = (Observed(np.array(times), {}) for times in ([0.01, 0.02], [0.01001, 0.02], [0.01, 0.03]))
    _check_times(study, {1: one, 2: same})
    with pytest.raises(InputError, match="s.toml: the reference's seeds 1 and 3 have frames at different times"):
        _check_times(study, {1: one, 2: same, 3: other})


def test_front():
    """Settings at 10, 5, 4 and 2 s: that of 4 s is beaten by 2 s, which is as accurate."""
    all_of_them = [REFERENCE, *(weighed("dt", [s, s, s], 0.0) for s in (5.0, 4.0, 2.0))]
    assert front(all_of_them, {0: 0.0, 1: 0.1, 2: 0.3, 3: 0.3}) == [3, 1, 0]
