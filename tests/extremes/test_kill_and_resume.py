"""A run that was killed ends as the same run cut by `run` commands, to the last bit."""

import pytest
from kill_and_resume import SETTINGS, tried


@pytest.mark.parametrize("np_", [1, 2])
@pytest.mark.parametrize("setting", SETTINGS, ids=lambda s: s.name)
def test_killed_at_random_moments(tmp_path, setting, np_):
    difference, chain = tried(tmp_path, setting, np_, kills=2, seed=np_)
    assert chain.kills == 2
    assert difference == "", (chain, difference)
