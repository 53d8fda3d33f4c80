"""fix cluster/breakmerge counts what decides: each entry by hand on one or two clusters; the same on any ranks."""

import struct

import numpy as np
import pytest
import scenes
from lammps_run import M_P, clusters, diameter, pair, run
from test_fix_cluster_breakmerge import G, k_for, scene, stokes, two

FIRST = 12  # entry of the global vector, which is also the column after the step
NAMES = (
    "tests share_st share_cc share_mf breakups_by_st breakups_by_cc whole_by_st whole_by_mf merges_by_st merges_by_mf "
    "drag contact weight"
).split()
FLOW = 4  # entries after these: particles and clusters that came in and left
ENERGIES = 2  # and after those: of contacts that vanished, of spins


def needs(result, row: int = -1) -> dict[str, float]:
    line = result.table()[row]
    assert len(line) == FIRST + len(NAMES) + FLOW + ENERGIES
    assert not line[FIRST + len(NAMES) :][:FLOW].any()  # closed scenes
    return dict(zip(NAMES, line[FIRST:]))


def one(tmp_path, size, v=(0.0, 0.0), n=400, **options):
    return run(tmp_path, scene(clusters((n, (0.02, 0.02), v)), size, **options))


def test_gas_breaks_a_cluster(tmp_path):
    """Shares and forces of one check; the fragments are not tested before the next."""
    v = (0.3, -0.2)
    found = needs(one(tmp_path, f"K {k_for(199.5, v=v)!r} terms st", v))
    slip = np.hypot(0.3, 2.2)
    expected = dict.fromkeys(NAMES, 0.0) | {"tests": 1, "share_st": 1, "breakups_by_st": 1}
    expected |= {"drag": stokes(diameter(400)) * slip, "weight": 400 * M_P * G}
    # the time step of 1e-12 s changes velocities by 1e-11
    assert [found[name] for name in NAMES] == pytest.approx([expected[name] for name in NAMES], rel=1e-9)


def test_fluidization_keeps_a_cluster_whole(tmp_path):
    """E_in* = N_st - N_smf is below the threshold, N_st alone above it: at each of three checks."""
    n_st = stokes(1e-4) * 4.0 / M_P  # slip and gas at 2 m/s
    size = f"K {k_for(180)!r} terms st mf umf {0.2 * n_st / G!r} epsmf 0"
    found = needs(one(tmp_path, size, steps=3))
    assert (found["tests"], found["whole_by_mf"], found["whole_by_st"]) == (3, 3, 0)
    assert found["weight"] == pytest.approx(3 * 400 * M_P * G, rel=1e-12)
    # N_smf off: it breaks, and nothing keeps it
    assert (
        run(tmp_path / "without", scene(clusters((400, (0.02, 0.02), (0, 0))), f"K {k_for(180)!r} terms st")).table()[
            -1, 3
        ]
        == 1
    )


def approach(speed):
    """Two clusters of 400 that move towards each other at this speed: overlap, and the normal force by Eq. (3)."""
    rows, gap = two(400, 400, v1=(0.5 * speed, 0.0), v2=(-0.5 * speed, 0.0))
    m = 200 * M_P
    eta = -2 * np.log(0.3) * np.sqrt(m * 10.0) / np.sqrt(np.pi**2 + np.log(0.3) ** 2)
    return rows, 10.0 * (diameter(400) - gap) + eta * speed


GRAN_CLUSTER = "pair_style gran/cluster 10.0 0.3 0.33 cutoff 1.5876e-3\npair_coeff * *\n"


@pytest.mark.parametrize("style", ["granular", "gran/cluster"])
@pytest.mark.parametrize("newton, np_", [("on", 1), ("off", 1), ("on", 2), ("off", 2)])
def test_contacts_break_a_cluster(tmp_path, style, newton, np_):
    """N_st is far too small, N_cc is enough; across a border between ranks, too."""
    speed = 0.4
    rows, force = approach(speed)
    n_cc = force * speed / (400 * M_P)
    slip, u = np.array([0.5 * speed, -2.0]), np.array([0.0, 2.0])
    n_st = stokes(1e-4) * (-slip @ u) / M_P
    k = float(diameter(150.5) * (n_st + n_cc))
    text = scene(rows, f"K {k!r} terms st cc", newton=newton)
    if style == "gran/cluster":
        text = text.replace(pair(), GRAN_CLUSTER)
    result = run(tmp_path, text, np_)
    found, breakups = needs(result), result.table()[-1, 3]
    assert breakups >= 1  # the other may have to wait for room
    assert found["breakups_by_cc"] == breakups and found["breakups_by_st"] in (0, breakups)
    assert found["share_cc"] == pytest.approx(breakups * n_cc / (n_st + n_cc), rel=1e-7)  # overlap to 1e-9 of d
    assert found["share_st"] + found["share_cc"] == pytest.approx(breakups, rel=1e-12)
    assert found["contact"] == pytest.approx(2 * force, rel=1e-7)
    assert found["drag"] == pytest.approx(2 * stokes(diameter(400)) * np.hypot(*slip), rel=1e-9)


def test_merges_that_fluidization_allows(tmp_path):
    """N_st alone would allow 699 particles, and the pair makes 700."""
    rows = two(400, 300)[0]
    k = k_for(699, v=(1, 0))
    allowed = needs(run(tmp_path / "by", scene(rows, f"K {k!r} terms st mf")))
    assert (allowed["merges_by_mf"], allowed["merges_by_st"]) == (1, 0)
    # a size that both terms allow is decided by none
    freely = run(tmp_path / "freely", scene(rows, f"K {k_for(701, v=(1, 0))!r} terms st mf"))
    assert freely.table()[-1, 4] == 1 and needs(freely)["merges_by_mf"] == 0


@pytest.mark.parametrize("np_", [1, 2])
def test_either_partner_may_need_a_term(tmp_path, np_):
    """N_st of the leader allows 700 particles, that of its partner, a ghost on two ranks, only 699."""
    rows, gap = two(400, 300, v1=(1.0, 0.004), v2=(1.0, 0.0), x=0.0199)
    script = scene(rows, f"K {k_for(699.9, v=(1, 0.0))!r} terms st mf")
    found = needs(run(tmp_path, ("processors 2 1 1\n" if np_ == 2 else "") + script, np_))
    assert 0.0199 + gap > 0.02 and found["merges_by_mf"] == 1


def test_what_is_off_is_not_looked_at(tmp_path):
    """Contacts are walked where N_cc, merging or the test asks for them, and else not at all."""
    rows, force = approach(0.4)
    for name, size, seen in (
        ("nobody", "K 1 terms st cc mf ncc 0 merge no", 0.0),
        ("merging", "K 1 terms st cc mf ncc 0", 2 * force),
        ("N_cc", "K 1 terms st cc mf merge no", 2 * force),
    ):
        found = needs(run(tmp_path / name, scene(rows, size).replace(pair(), GRAN_CLUSTER)))
        assert found["contact"] == pytest.approx(seen, rel=1e-7), name
    # forces of other pair styles are asked for N_cc alone
    assert needs(run(tmp_path / "granular", scene(rows, "K 1 terms st cc mf ncc 0")))["contact"] == 0.0
    # drag is known to its own fix, without N_st, too; to nobody if no such fix is named
    speed = np.hypot(0.2, 2.0)
    for name, terms, seen in (
        ("drag", "drag drag umf 0.01", 2 * stokes(diameter(400)) * speed),
        ("no drag", "umf 0.01", 0.0),
    ):
        text = scene(rows, "K 1 terms cc mf").replace("drag drag K 1", f"{terms} K 1")
        assert needs(run(tmp_path / name, text))["drag"] == pytest.approx(seen, rel=1e-9), name


COUNTS = ["tests", "breakups_by_st", "breakups_by_cc", "whole_by_st", "whole_by_mf", "merges_by_st", "merges_by_mf"]


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    return needs(run(tmp_path_factory.mktemp("serial"), scenes.busy(steps=1500)))


@pytest.mark.parametrize("newton, np_", [("off", 1), ("on", 2), ("off", 2), ("on", 4)])
def test_same_on_any_number_of_ranks(tmp_path, serial, newton, np_):
    found = needs(run(tmp_path, scenes.busy(steps=1500, newton=newton), np_))
    assert all(serial[name] > 0 for name in NAMES if name not in ("whole_by_st", "merges_by_st"))
    assert {name: found[name] for name in COUNTS} == {name: serial[name] for name in COUNTS}
    # sums of up to 1e5 numbers, whose own rounding grows with the run: forces at a contact to 1e-7
    assert [found[name] for name in NAMES] == pytest.approx([serial[name] for name in NAMES], rel=1e-6)


def test_goes_on_after_a_restart(tmp_path):
    setup = scenes.start() + scenes.fixes() + scenes.outputs()
    whole = run(tmp_path / "whole", setup + "run 601\nrun 600\n")
    run(tmp_path / "half", setup + "run 601\nwrite_restart half.restart\n", 2)
    continued = needs(run(tmp_path / "again", scenes.again("../half/half.restart") + "run 600\n"))
    assert needs(whole)["breakups_by_st"] > 10
    assert {name: continued[name] for name in COUNTS} == {name: needs(whole)[name] for name in COUNTS}
    assert list(continued.values()) == pytest.approx(list(needs(whole).values()), rel=1e-6)  # as between ranks


def test_restart_file_of_another_layout_is_refused(tmp_path):
    run(tmp_path, scenes.busy(steps=10, count=50) + "write_restart end.restart\n")
    data = (tmp_path / "end.restart").read_bytes()
    count = 6 + len(NAMES) + FLOW + ENERGIES
    ours = struct.pack("=iq", 8 * (count + 2), (3 << 32) + count)  # of layout 3, test always
    assert data.count(ours) == 1
    (tmp_path / "other.restart").write_bytes(data.replace(ours, struct.pack("=id", 8 * (count + 2), 3.0)))
    result = run(tmp_path, scenes.again("other.restart") + "run 1\n", check=False)
    assert result.code != 0 and "written by another version of this fix" in result.output
