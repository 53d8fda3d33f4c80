"""What a rank sends does not depend on how many ranks there are: counted at MPI itself, on 4 and on 16 ranks."""

import math
import os
import sys

import pytest
from lammps_run import ROOT, have_mpirun

sys.path.insert(0, str(ROOT / "bench"))
os.environ.setdefault("CLUSTERDEM_LMP", str(ROOT / "build" / "bin" / "lmp"))
import messages  # noqa: E402
from growth import SPACING  # noqa: E402
from scaling_plan import Part, processor_grid  # noqa: E402

CLUSTERS, STEPS = 400, 20  # of each rank; lists are rebuilt where a check finds events
CHECKS = STEPS // messages.EVERY


@pytest.fixture(scope="module")
def sent(tmp_path_factory):
    if not have_mpirun():
        pytest.skip("mpirun is missing")
    folder = tmp_path_factory.mktemp("messages")
    counter = messages.build_counter(folder)
    return {
        ranks: messages.count(folder, counter, messages.script(ranks, CLUSTERS, "a check", STEPS), ranks)
        for ranks in (4, 16)
    }


def mean(counted, take) -> float:
    return sum(map(take, counted.ranks)) / len(counted.ranks)


def test_messages_and_bytes_do_not_grow_with_the_ranks(sent):
    few, many = sent[4], sent[16]
    assert few.newborns > 0 and many.newborns > 0
    # two ranks along an axis hand migrating clusters to one neighbor, more ranks to two: two messages each
    most = 2 * 2 * many.lists + (many.lists - few.lists) * 8
    assert mean(many, lambda r: r.messages[0]) <= mean(few, lambda r: r.messages[0]) + most
    # parts are alike, events are not: they add some clusters to the ghosts of a rank
    assert mean(many, lambda r: r.bytes[0]) == pytest.approx(mean(few, lambda r: r.bytes[0]), rel=0.1)


def test_numbers_of_newborns_take_two_messages_per_doubling_of_the_ranks(sent):
    for ranks, counted in sent.items():
        routed = max(sum(n for tag, n in r.messages.items() if tag) for r in counted.ranks)
        times = routed / (2 * math.log2(ranks))
        assert times == int(times) and 1 <= times <= counted.lists  # a rebuild may be for merges alone


def test_no_collective_call_has_an_entry_for_every_rank(sent):
    for counted in sent.values():
        assert all(set(r.calls) <= set(messages.REDUCTIONS) for r in counted.ranks)
    each = [sum(c.ranks[0].given.values()) / sum(c.ranks[0].calls.values()) for c in sent.values()]
    assert max(each) < 32  # bytes: a few numbers


def test_the_plan_says_what_is_sent(sent):
    """bench/scaling_plan.py, from which doc/scaling.md extrapolates."""
    for ranks, counted in sent.items():
        side = round(CLUSTERS**0.5) * SPACING
        part = Part(*processor_grid(ranks), side, side, CLUSTERS / side**2)
        plan = STEPS * part.bytes_of("a step") + CHECKS * part.bytes_of("a check")
        plan += counted.lists * (part.bytes_of("a rebuild") + part.bytes_of("events"))
        # not in the plan: clusters that are born or move to another rank, and further rounds
        assert mean(counted, lambda r: r.bytes[0]) == pytest.approx(plan, rel=0.1)
