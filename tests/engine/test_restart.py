"""A continued run equals the same input cut by `run` at that step."""

import numpy as np
import pytest
import scenes
from lammps_run import clusters, diameter, head, pair, run


def cut(tmp_path, np_, options="", gas=scenes.GAS):
    setup = scenes.start() + scenes.fixes(options=options, gas=gas) + scenes.outputs()
    whole = run(tmp_path / "whole", setup + "run 601\nrun 600\n" + scenes.final(), np_)
    run(tmp_path / "half", setup + "run 601\nwrite_restart half.restart\n", np_)
    return whole


OWN = scenes.GAS.replace("cell 8 1 8 4e-4 5", "own 4e-4 5")


@pytest.mark.parametrize("np_", [1, 2])
@pytest.mark.parametrize(
    "options, gas",
    [
        ("", scenes.GAS),
        ("test end", scenes.GAS),
        ("", OWN),
        ("refused break up cell nsmf paper grid 4 1 4", scenes.GAS),
    ],
)
def test_bit_equal_on_the_same_ranks(tmp_path, np_, options, gas):
    whole = cut(tmp_path, np_, options, gas)
    script = scenes.again("../half/half.restart", options=options, gas=gas) + "run 600\n" + scenes.final()
    continued = run(tmp_path / "again", script, np_)
    a, b = whole.dump(), continued.dump()
    assert whole.table()[-1, scenes.BREAKUPS] + whole.table()[-1, scenes.MERGES] > 10
    for column in a:
        assert np.array_equal(a[column], b[column]), column
    counts = slice(1, 7)
    assert np.array_equal(whole.table()[-1, counts], continued.table()[-1, counts])


def test_same_events_on_other_ranks(tmp_path):
    whole = cut(tmp_path, 1)
    script = scenes.again("../half/half.restart") + "run 600\n" + scenes.final()
    continued = run(tmp_path / "again", script, 4)
    counts = slice(1, 7)
    assert np.array_equal(whole.table()[-1, counts], continued.table()[-1, counts])
    assert np.array_equal(whole.dump()["id"], continued.dump()["id"])


def test_ids_of_the_dead_are_never_used_again(tmp_path):
    """Newborns after a restart are numbered above every ID ever used, not just above those alive."""
    setup = scenes.start() + scenes.fixes() + scenes.outputs()
    half = run(tmp_path / "half", setup + "run 1500\nwrite_restart half.restart\n" + scenes.final()).dump()
    script = scenes.again("../half/half.restart") + "run 300\n" + scenes.final()
    later = run(tmp_path / "again", script).dump()
    new = np.setdiff1d(later["id"], half["id"])
    assert len(new) > 10 and new.min() > half["id"].max()


def test_contacts_of_every_rank_fit_into_the_file(tmp_path):
    """All contacts are on the second rank. One that is lost on the way would count as ended, and break its cluster."""
    d = diameter(400)
    rows = [(400, (0.005 + 2e-3 * k, 0.02), (0.0, 0.0)) for k in range(4)]  # alone, on the first rank
    rows += [(400, (0.03 + 0.999 * d * i, 0.02 + 0.999 * d * k), (0.0, 0.0)) for i in range(3) for k in range(3)]
    start = "processors 2 1 1\n" + head() + clusters(*rows) + pair()
    gas = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 20 plane xz\n"
    words = {"options": "test end merge no", "gas": gas}
    run(tmp_path, start + scenes.fixes(**words) + "run 10\nwrite_restart half.restart\n", 2)
    again = "processors 2 1 1\n" + scenes.again("half.restart", **words)
    continued = run(tmp_path, again + "run 40\n", 2)
    assert continued.table()[-1, scenes.BREAKUPS] == 0


TESTS = ("always", "contact", "end")


@pytest.mark.parametrize("np_", (1, 2))
@pytest.mark.parametrize("read", TESTS)
@pytest.mark.parametrize("written", TESTS)
def test_a_file_of_another_test_is_read(tmp_path, written, read, np_):
    """What it remembers of contacts is left; totals, particles and IDs go on, and with the same test all does."""
    run(tmp_path, scenes.busy(steps=100, count=60, options=f"test {written}") + "write_restart half.restart\n", np_)
    before = run(tmp_path, scenes.again("half.restart", options=f"test {written}") + "run 0\n", np_).table()[-1]
    r = run(
        tmp_path, scenes.again("half.restart", options=f"test {read}") + "run 0\n" + scenes.final() + "run 50\n", np_
    )
    assert np.array_equal(r.table()[0, 1:13], before[1:13])
    assert r.table()[-1, scenes.PARTICLES] == 60 * 400
    assert "atoms have other IDs" not in r.output
