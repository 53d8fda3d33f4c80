"""Bodies beside clusters, of any size: no contact is lost to a cutoff, and no piece is placed into what a rank does not see."""

import re
from decimal import ROUND_CEILING, Context

import numpy as np
import pytest
import scenes
from lammps_run import CUTOFF, HOOKE, Run, diameter, head, pair, random_clusters, run, write

RANKS = (1, 2, 4)
D, LARGEST = diameter(400), diameter(2000)
CLAIM = 1.6 * LARGEST  # the default
SKIN = 0.5e-3


def two_types(ghost: float | str, x: float, z: float) -> str:
    return head(x, z, ghost=ghost).replace("create_box   1", "create_box   2")


def atom(number: int, kind: int, x: float, z: float, d: float, vx: float = 0.0) -> str:
    return (
        f"create_atoms {kind} single {x!r} 0.0015 {z!r}\n"
        f"set atom {number} diameter {d!r} density 1000\nset atom {number} vx {vx!r}\n"
    )


GROUPS = "group bodies type 2\ngroup clusters subtract all bodies\n"


def impact(contact: str, body: float = 6e-3, ghost: float = 6.5e-3, more: str = "", steps: int = 3000) -> str:
    """One cluster flies at 0.2 m/s against a body at rest, 20 um away; no gas, no events."""
    return (
        two_types(ghost, 0.04, 0.03)
        + atom(1, 1, 0.02 - (body + D) / 2 - 20e-6, 0.015, D, 0.2)
        + atom(2, 2, 0.02, 0.015, body)
        + more
        + GROUPS
        + contact
        + "fix move clusters nve\nfix size clusters cluster/breakmerge 10 1e-4 2000 terms mf umf 0.01 K 1.0 break no merge no\n"
        + f"fix still bodies freeze\ntimestep 1e-6\nrun {steps}\n"
        + write()
    )


def refused(r: Run) -> str:
    assert r.code != 0 and "ERROR" in r.output, r.output[-1000:]
    return " ".join(r.output.split())


def told(threshold: float) -> float:
    """Thresholds are told with four digits, never below what is needed."""
    return float(Context(prec=4, rounding=ROUND_CEILING).create_decimal_from_float(threshold))


def says(said: str, words: str, *values: float) -> None:
    """The words, with these numbers where braces are."""
    pattern = re.escape(words).replace(r"\{\}", r"([-+.e\d]*\d)")
    match = re.search(pattern, said)
    assert match, f"{words} is not in {said[-1200:]}"
    assert [float(v) for v in match.groups()] == pytest.approx(values, rel=1e-6)


@pytest.mark.parametrize("np_", RANKS)
def test_a_body_larger_than_the_cutoff_is_refused(tmp_path, np_):
    """(6 + 1.5874)/2 mm, where the largest cluster that the limits allow touches it."""
    touch = (6e-3 + LARGEST) / 2
    said = refused(run(tmp_path, impact(pair()), np_, check=False))
    says(said, "the pair cutoff of types 1 and 2 is {}, below {}, where the largest touch", CUTOFF, told(touch))
    says(said, "of diameters {} that the limits allow and {} outside of the group", told(LARGEST), 6e-3)
    says(said, "add 'cutoff {}' to pair_coeff", told(touch))


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize(
    "contact",
    [pair(HOOKE, 3.8e-3), "pair_style gran/cluster 10.0 0.3 0.33 cutoff 3.8e-3\npair_coeff * *\n"],
    ids=["granular", "gran/cluster"],
)
def test_with_the_cutoff_it_rebounds(tmp_path, contact, np_):
    """Coefficient of restitution 0.3 against a body that stays: -0.06 m/s, exact for the damping that it sets."""
    row = run(tmp_path, impact(contact), np_).dump()
    assert row["vx"][0] == pytest.approx(-0.06, rel=5e-3) and row["vx"][1] == 0.0


@pytest.mark.parametrize("np_", (1, 2))
def test_two_bodies_may_meet(tmp_path, np_):
    """One alone of its type meets no other of it, two do: 6 mm."""
    said = refused(run(tmp_path, impact(pair(HOOKE, 3.8e-3), more=atom(3, 2, 0.035, 0.015, 6e-3)), np_, check=False))
    assert (
        "the pair cutoff of types 2 and 2 is 0.0038, below the largest cluster diameter 0.006 outside of the group"
        in said
    )


def test_bodies_without_contacts_need_no_cutoff(tmp_path):
    """Where no granular style acts, the user wants no contact."""
    contact = (
        f"pair_style hybrid granular zero {CUTOFF}\npair_coeff 1 1 granular {HOOKE} cutoff {CUTOFF}\n"
        "pair_coeff 1 2 zero\npair_coeff 2 2 zero\n"
    )
    row = run(tmp_path, impact(contact, steps=500)).dump()
    assert row["vx"][0] == pytest.approx(0.2, rel=1e-12)


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize(
    "body, cutoff, words, values",
    [
        (8e-3, 3.8e-3, "the pair cutoff of types 2 and 2 is {}, below the largest cluster diameter {}", (3.8e-3, 8e-3)),
        (18e-3, 9.9e-3, "the ghost cutoff {} is below {}", (9.9e-3 + SKIN, told(CLAIM + 9e-3 + SKIN))),
    ],
)
def test_a_body_that_arrives_in_mid_run(tmp_path, body, cutoff, words, values, np_):
    (tmp_path / "ball.mol").write_text(
        f"a ball\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 2\n\nDiameters\n\n1 {body}\n\nMasses\n\n1 1e-4\n"
    )
    late = (
        "molecule ball ball.mol\nregion high block 0.030 0.032 0.0014 0.0016 0.022 0.024 units box\n"
        "fix drop bodies deposit 1 0 50 12345 region high mol ball\n"
    )
    script = impact(pair(HOOKE, cutoff), body=1e-3, ghost=7.5e-3).replace("fix still", late + "fix still")
    said = refused(run(tmp_path, script, np_, check=False))
    assert "Per MPI rank memory" in said  # it had begun
    says(said, words, *values)


# ---- what a rank does not see ----

BODY = 16e-3


def beside(ghost: str | float, along: float = 0.0, mode: str = "", cutoff: float = 8.9e-3) -> str:
    """Three clusters that break at once, 0.65 mm from a body of 16 mm whose center is 9.44 mm away, behind a rank's side."""
    at = lambda x: (x + along) % 0.08  # noqa: E731
    script = (
        two_types(ghost, 0.08, 0.04)
        + atom(1, 2, at(0.03065625999999999), 0.02, BODY)
        + "".join(atom(k, 1, at(0.0401), z, LARGEST) for k, z in ((2, 0.017), (3, 0.020), (4, 0.023)))
        + GROUPS
        + f"pair_style gran/cluster 10.0 0.3 0.33 cutoff {cutoff}\npair_coeff * *\n"
        + "fix move clusters nve\nfix drag clusters drag/cluster 1.2 1.53e-5 velocity 0 0 8 plane xz\n"
        + "fix size clusters cluster/breakmerge 1 1e-4 2000 drag drag K 0.02 merge no terms st\n"
        + "fix still bodies freeze\ntimestep 1e-9\nrun 20\n"
        + write()
    )
    if mode:
        script = by_type(script, "create_box   2 box\n", mode)
    return "processors * 1 1\n" + script


def by_type(script: str, create_box: str, cutoffs: str) -> str:
    """Ghosts in mode multi, which needs to know how many types there are."""
    lines = [line for line in script.splitlines() if not line.startswith(("comm_modify", "neighbor"))]
    multi = f"create_box 2 box\nneighbor 0.5e-3 multi\ncomm_modify mode multi vel yes {cutoffs}\n"
    return "\n".join(lines).replace(create_box.rstrip(), multi) + "\n"


@pytest.mark.parametrize("np_", RANKS)
def test_ranks_must_see_a_body_as_far_as_it_reaches(tmp_path, np_):
    """Claim 2.54 mm + radius 8 mm + skin 0.5 mm"""
    need = CLAIM + BODY / 2 + SKIN
    said = refused(run(tmp_path, beside(6.5e-3), np_, check=False))
    says(said, "the ghost cutoff {} is below {}, the claim", 8.9e-3 + SKIN, told(need))
    says(said, "the largest radius {} of atoms of type 2 outside of the group", BODY / 2)
    says(said, "use 'comm_modify cutoff {}' or", told(need))


@pytest.mark.parametrize(
    "along", [0.0, 0.0401, 0.0449], ids=["at a rank's side", "across a periodic side", "body on it"]
)
def test_pieces_beside_a_body_are_the_same_on_all_ranks(tmp_path, along):
    end = {n: run(tmp_path / str(n), beside(11.1e-3, along), n).dump() for n in RANKS}
    row = end[1]
    body = row["diameter"] == BODY
    gap_x = np.abs(row["x"] - row["x"][body])
    gap = (
        np.hypot(np.minimum(gap_x, 0.08 - gap_x), row["z"] - row["z"][body])[~body]
        - (row["diameter"][~body] + BODY) / 2
    )
    assert len(gap) > 100 and gap.min() >= -1e-12
    for n in RANKS[1:]:
        assert np.array_equal(end[n]["id"], row["id"])
        for column in ("x", "z", "diameter"):
            assert np.allclose(end[n][column], row[column], rtol=0, atol=1e-12), column


# ---- ghosts of each type ----


@pytest.mark.parametrize("np_", (1, 2))
def test_mode_multi_is_asked_type_by_type(tmp_path, np_):
    """Clusters of type 2 are sent 2.09 mm far, the cutoff and the skin; two claims and the skin are 5.58 mm."""
    said = refused(run(tmp_path, multi("1"), np_, check=False))
    need = 2 * CLAIM + SKIN
    says(said, "the ghost cutoff of type 2 {} is below {}, twice the claim", CUTOFF + SKIN, told(need))
    says(said, "use 'comm_modify cutoff/multi * {}' or", told(need))


def multi(types: str) -> str:
    two = "variable odd atom id%2==0\ngroup two variable odd\nset group two type 2\n"
    script = (
        scenes.head() + random_clusters(300, seed=5) + two + f"set group all diameter {D!r} density 1000\n" + pair()
    )
    script = by_type(script, "create_box   1 box\n", f"cutoff/multi {types} 5.7e-3")
    return script + "velocity all set 0 0 2\n" + scenes.fixes().replace("K 0.5", "K 0.2") + "run 300\n" + write()


def test_in_mode_multi_with_enough_events_are_the_same_on_all_ranks(tmp_path):
    end = {n: run(tmp_path / str(n), multi("*"), n).dump() for n in RANKS}
    assert len(end[1]["id"]) > 600
    for n in RANKS[1:]:
        assert np.array_equal(end[n]["id"], end[1]["id"]) and np.array_equal(end[n]["diameter"], end[1]["diameter"])


@pytest.mark.parametrize("ghosts, enough", [("cutoff/multi 1 11.1e-3", False), ("cutoff/multi * 11.1e-3", True)])
def test_bodies_in_mode_multi(tmp_path, ghosts, enough):
    """The pair cutoff alone sends a body 9.4 mm far."""
    r = run(tmp_path, beside("unused", mode=ghosts), 2, check=False)
    if enough:
        assert r.code == 0, r.output[-800:]
    else:
        said = refused(r)
        assert "the ghost cutoff of type 2 0.0094 is below" in said and "use 'comm_modify cutoff/multi * 0.0110" in said


def test_collections_of_ones_own_need_it_all(tmp_path):
    """Which type a collection holds is not asked: the shortest of them counts."""
    own = "neighbor 0.5e-3 multi\nneigh_modify collection/interval 2 2e-3 2e-2\n"
    script = beside("unused", mode="cutoff/multi 2 11.1e-3").replace("neighbor 0.5e-3 multi\n", own)
    says(refused(run(tmp_path, script, 1, check=False)), "the ghost cutoff of type 2 {} is below", 0.0)
    everything = script.replace("cutoff/multi 2", "cutoff/multi *")
    assert len(run(tmp_path / "all", everything).dump()["id"]) > 100
