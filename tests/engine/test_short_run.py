"""A short run with a bit of everything, small enough to be run under valgrind (./run sanitize)."""

import pytest
import scenes
from lammps_run import run

OPTIONS = "test end refused break up cell nsmf paper grid 4 1 4"
GAS = scenes.GAS.replace("cell 8 1 8 4e-4 5", "own 4e-5 5")


@pytest.mark.parametrize("np_", [1, 2])
def test_breaks_merges_and_a_restart(tmp_path, np_):
    first = scenes.busy(steps=300, every=3, count=150, options=OPTIONS, gas=GAS)
    before = run(tmp_path / "first", first + "write_restart end.restart\n", np_)
    again = scenes.again("../first/end.restart", every=3, options=OPTIONS, gas=GAS)
    after = run(tmp_path / "again", again + "run 100\n" + scenes.final(), np_)
    counts = after.table()[-1]
    assert counts[scenes.BREAKUPS] > before.table()[-1, scenes.BREAKUPS] > 0
    assert counts[scenes.MERGES] > 0
    assert counts[scenes.PARTICLES] == 150 * 400
