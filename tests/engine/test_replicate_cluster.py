"""replicate/cluster: copies of the box, the same on any number of ranks, and what it refuses."""

import numpy as np
import pytest
from lammps_run import bits_of_ids, head, pair, random_clusters, run, write

ONE = head() + random_clusters(30)
COPIES = (3, 2)


def replicated(folder, np_=1, style="sphere", before=""):
    one = ONE.replace("atom_style   sphere", f"atom_style {style}") + before
    script = one + write(name="one.dump") + f"replicate/cluster {COPIES[0]} 1 {COPIES[1]}\n" + write(name="all.dump")
    return run(folder, script, np_)


def assert_copies(one, all_):
    count = len(one["id"])
    assert np.array_equal(all_["id"], np.arange(1, 6 * count + 1))
    copy = 0
    for k in range(COPIES[1]):
        for i in range(COPIES[0]):
            these = {name: values[copy * count : (copy + 1) * count] for name, values in all_.items()}
            # a sum of two numbers, rounded once
            np.testing.assert_allclose(these["x"], one["x"] + i * 0.04, rtol=0, atol=1e-16)
            np.testing.assert_allclose(these["z"], one["z"] + k * 0.04, rtol=0, atol=1e-16)
            for name in ("y", "vx", "vz", "diameter", "mass"):
                assert np.array_equal(these[name], one[name])
            copy += 1


@pytest.mark.parametrize("np_, style", [(1, "sphere"), (1, "cluster"), (2, "cluster")])
def test_every_copy_is_the_box_shifted(tmp_path, np_, style):
    r = replicated(tmp_path, np_, style, "velocity all set 0.1 0 0.7\n")
    assert_copies(r.dump("one.dump"), r.dump("all.dump"))


# More than the 1000 that the engine's map of IDs has to spare.
MANY = "create_atoms 1 random 1500 5 NULL\nset group all diameter 4e-4\nset group all density 1000\n"
NO_HISTORY = "pair_style gran/cluster 10.0 0.3 0.0 tangential none cutoff 1.5876e-3\npair_coeff * *\n"
STARTS = {
    "created": MANY,
    "read": MANY + "write_data start.data\nclear\n{settings}read_data start.data\n",
    "after a run": MANY + NO_HISTORY + "run 0\n",
}


@pytest.mark.parametrize("np_, style", [(1, "sphere"), (1, "cluster"), (2, "sphere"), (2, "cluster")])
@pytest.mark.parametrize("map_", ["hash", "array", "yes"])
@pytest.mark.parametrize("start", STARTS)
def test_more_copies_than_the_map_of_ids_had_room_for(tmp_path, start, map_, np_, style):
    box = head().replace("atom_style   sphere", f"atom_style {style}").replace("map hash", f"map {map_}")
    settings = box[: box.index("region ")]
    script = (
        box
        + STARTS[start].format(settings=settings)
        + write(name="one.dump")
        + f"replicate/cluster {COPIES[0]} 1 {COPIES[1]}\n"
        + write(name="all.dump")
        + NO_HISTORY
        + "fix move all nve\nrun 1\n"
    )
    r = run(tmp_path, script, np_)
    one = r.dump("one.dump")
    assert len(one["id"]) == 1500
    assert_copies(one, r.dump("all.dump"))


@pytest.mark.parametrize(
    "line, message",
    [
        ("replicate/cluster 2 1", "missing nz"),
        ("replicate/cluster 0 1 1", "nx value: 0 (must be an integer from 1"),
        ("replicate/cluster 2 1 1 1", "Unknown replicate/cluster keyword: 1"),
        pytest.param(
            "replicate/cluster 30000 1 3000",
            "above the largest of this LAMMPS build",
            marks=pytest.mark.skipif(bits_of_ids() != 32, reason="64-bit IDs hold them"),
        ),
    ],
)
def test_refusals(tmp_path, line, message):
    r = run(tmp_path, ONE + line + "\n", check=False)
    assert r.code != 0 and message in r.output


def test_refused_after_a_fix_that_keeps_something_per_cluster(tmp_path):
    fix = "fix size all cluster/breakmerge 5 1e-4 2000 terms cc K 0.5\n"
    r = run(tmp_path, ONE + pair() + fix + "replicate/cluster 2 1 1\n", check=False)
    assert r.code != 0 and "give it before any fix" in r.output
