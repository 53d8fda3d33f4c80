"""Fix cluster/breakmerge in scripts that people bring: what must come out right, and what is refused in which words."""

import numpy as np
import pytest
from lammps_run import M_P, clusters, diameter, head, pair, random_clusters, run, write
from test_fix_cluster_breakmerge import NU_G, RHO_G, G, k_for, scene

RANKS = (1, 2, 4)
STEP, CLUSTERS, PARTICLES, BREAKUPS, MERGES, BORN, DEFERRED, E_LOST, E_BORN = range(9)  # columns of out.txt
E_CONTACTS = 29


def crowd(every: int, **box) -> str:
    """600 clusters that break again and again, as close as they can be thrown: 1/2 of the area is covered."""
    return (
        head(x=0.032, z=0.032, **box)
        + random_clusters(600, seed=77)
        + "pair_style gran/cluster 10.0 0.3 0.33 cutoff 1.5876e-3\npair_coeff * *\n"
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 plane xz\n"
        + f"fix size all cluster/breakmerge {every} 1e-4 2000 drag drag K 0.06 terms st merge no\n"
        + 'fix table all ave/time 100 1 100 f_size[*] mode scalar file out.txt format " %.17g"\ntimestep 1e-6\nrun 200\n'
    )


def test_the_rate_of_events_does_not_hang_on_the_check_interval(tmp_path):
    """Settled in rounds, a check leaves out those alone that have no room: ten times fewer checks, most of the
    breakups. What is left is the cascade, in which a fragment waits for the next check (at 14e5d1a: 0.37).
    """
    often, rarely = (run(tmp_path / str(every), crowd(every)).table()[-1] for every in (1, 10))
    assert often[PARTICLES] == rarely[PARTICLES] == 600 * 400
    assert often[CLUSTERS] > 1500 and rarely[CLUSTERS] > 0.75 * often[CLUSTERS]


@pytest.mark.parametrize("newton", ["on", "off"])
def test_a_crowd_breaks_alike_on_any_ranks(tmp_path, newton):
    tables = [run(tmp_path / str(n), crowd(10, newton=newton), n).table() for n in RANKS]
    for table in tables[1:]:
        assert np.array_equal(table[:, CLUSTERS : BORN + 2], tables[0][:, CLUSTERS : BORN + 2])


@pytest.mark.parametrize("test", ["end", "contact"])
@pytest.mark.parametrize("np_", RANKS)
def test_a_postponed_breakup_is_tested_again(tmp_path, test, np_):
    """Two clusters part after a collision, both above their stable size, too near for both to break at once. The one with the
    higher ID waits, touches nobody any more, and breaks later.
    """
    rows = clusters((400, (0.0290, 0.03), (0.5, 0.0)), (400, (0.0310, 0.03), (-0.5, 0.0)))
    script = (
        head(x=0.06, z=0.06)
        + rows
        + pair()
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2.0\n"
        + f"fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.105 terms st test {test} merge no hysteresis 0.1\n"
        + 'fix table all ave/time 10 1 10 f_size[*] mode scalar file out.txt format " %.17g"\ntimestep 1e-6\nrun 8000\n'
        + "write_restart end.restart\n"
    )
    table = run(tmp_path, script, np_).table()
    assert table[-1, BREAKUPS] == 2 and table[-1, PARTICLES] == 800
    assert np.diff(table[:, BREAKUPS]).max() == 1  # at two checks


def test_a_postponed_breakup_survives_a_restart(tmp_path):
    """A body in the way leaves no room; it is taken away after the restart, and the cluster that waits breaks at once."""
    ring = "".join(
        f"create_atoms 1 single {0.02 + 0.94e-3 * np.cos(a):.17g} 0.0015 {0.02 + 0.94e-3 * np.sin(a):.17g}\n"
        for a in np.arange(6) * np.pi / 3
    )
    start = (
        head()
        + clusters((400, (0.02, 0.02), (0.0, 0.0)))
        + ring
        + f"set atom 2*7 diameter {diameter(400)!r}\nset atom 2*7 density 1000.0\ngroup wall id 2:7\ngroup one id 1\n"
    )
    size = f"fix size one cluster/breakmerge 1 1e-4 2000 drag drag K {k_for(100.5)!r} terms st test contact merge no limits 3 400 claim 1.2e-3\n"
    # neighbors at 0.94 mm are further than a diameter: no contact but that of atom 2, which is pushed in for one step
    fixes = pair() + "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n" + size + "timestep 1e-12\n"
    touch = "set atom 2 x 0.0209\nrun 1\nset atom 2 x 0.02094\n"
    first = run(tmp_path, start + fixes + touch + "run 1\nwrite_restart wait.restart\n" + write("f_size[1]"))
    assert len(first.dump()["id"]) == 7
    again = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart wait.restart\nneighbor 0.5e-3 bin\n"
        + fixes
        + "delete_atoms group wall compress no\nrun 1\n"
        + write("f_size[1]")
    )
    assert sorted(run(tmp_path, again).dump()["f_size[1]"]) == [200] * 2  # the claim holds two halves


# ---- energy


@pytest.mark.parametrize("np_", (1, 2))
@pytest.mark.parametrize("pair_", ["gran/cluster", "granular"])
def test_elastic_energy_of_the_contacts_of_a_breakup(tmp_path, pair_, np_):
    """Two clusters pressed together by 10 % of a diameter; the first breaks: 1/2 k delta^2 goes, and entry 29 has it."""
    d = diameter(400)
    style = (
        "pair_style gran/cluster 10.0 0.3 0.33 cutoff 1.5876e-3\npair_coeff * *\n"
        if pair_ == "gran/cluster"
        else pair()
    )
    script = (
        head()
        + clusters((400, (0.02, 0.02), (0.0, 0.0)), (400, (0.02 + 0.9 * d, 0.02), (0.0, 0.0)))
        + style
        + "group one id 1\nfix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n"
        + f"fix size one cluster/breakmerge 1 1e-4 2000 drag drag K {k_for(100.5)!r} terms st merge no\ntimestep 1e-12\n"
        + "compute pe all pe\nvariable pe equal c_pe\n"
        + 'fix table all ave/time 1 1 1 f_size[*] v_pe mode scalar file out.txt format " %.17g"\nthermo_modify norm no\nrun 1\n'
    )
    table = run(tmp_path, script, np_).table()
    held = 0.5 * 10.0 * (0.1 * d) ** 2  # 4.3e-8 J
    assert table[-1, BREAKUPS] == 1
    assert table[-1, E_CONTACTS] == pytest.approx(held, rel=1e-9)
    if pair_ == "gran/cluster":  # whose energy the engine knows, too
        assert table[0, -1] - table[-1, -1] == pytest.approx(held, rel=1e-9)


def test_elastic_energy_of_the_contacts_of_a_merge(tmp_path):
    """A chain of three: the outer two merge over a contact of 2 % with the third further off; that contact's energy goes."""
    d = diameter(60)
    script = (
        head()
        + clusters((60, (0.02, 0.02), (0.0, 1.0)), (60, (0.02 + 0.98 * d, 0.02), (0.0, 1.0)))
        + pair()
        + "fix move all nve\n"
        + "fix size all cluster/breakmerge 1 1e-4 2000 terms mf umf 0.00646 K 1.0 break no\ntimestep 1e-12\n"
        + 'fix table all ave/time 1 1 1 f_size[*] mode scalar file out.txt format " %.17g"\nrun 1\n'
    )
    end = run(tmp_path, script).table()[-1]
    assert end[MERGES] == 1 and end[E_BORN] == 0
    assert end[E_CONTACTS] == pytest.approx(0.5 * 10.0 * (0.02 * d) ** 2, rel=1e-9)


HERTZ_K = 1.0e7  # of pair granular's hertz [Pa]


def three(law: str, gap: float, third: float, speed: float) -> str:
    """Two clusters in contact, and a third beside the middle of the two that the merged one would press into."""
    d = diameter(60)
    return (
        head()
        + clusters(
            (60, (0.02, 0.02), (0.0, speed)),
            (60, (0.02 + d + gap, 0.02), (0.0, speed)),
            (60, (0.02 + 0.5 * (d + gap), 0.02 + third), (0.0, speed)),
        )
        + pair(law)
        + "group two id 1 2\nfix move all nve\n"
        + "fix size two cluster/breakmerge 1 1e-4 2000 terms mf umf 0.00646 K 1.0 break no\ntimestep 1e-12\n"
        + 'fix table all ave/time 1 1 1 f_size[*] mode scalar file out.txt format " %.17g"\nrun 1\n'
    )


@pytest.mark.parametrize("share, merges", [(0.9, 1), (1.1, 0)])
def test_births_are_weighed_by_the_law_of_hertz(tmp_path, share, merges):
    """What the merged sphere of radius R would put into its contact with the third of radius r: 2/5 E* sqrt(R_eff) delta^(5/2)
    with pair granular's `hertz`, k = 4/3 E*: (2/5) k sqrt(R_eff) delta^(5/2). A merge waits above 1e-6 of its energy.
    """
    r, merged = 0.5 * diameter(60), 0.5 * diameter(120)
    overlap = 2e-6
    held = 0.4 * HERTZ_K * np.sqrt(merged * r / (merged + r)) * overlap**2.5
    law = f"hertz {HERTZ_K} 0.0 tangential linear_nohistory 0 0 damping velocity"
    # share < 1: the energy put in is below the limit, so that the merge goes ahead
    speed = float(np.sqrt(held / (share * 1e-6) / (0.5 * 120 * M_P)))
    end = run(tmp_path, three(law, -1e-6, float(merged + r - overlap), speed)).table()[-1]
    assert end[MERGES] == merges
    if merges:
        assert end[E_BORN] == pytest.approx(held, rel=1e-4)  # half-step drift of 1e-12 s


# ---- groups


def of_groups(drag: str = "all", size: str = "all", move: str = "fix move all nve") -> str:
    return (
        head()
        + clusters((400, (0.01, 0.02), (0, 0)), (400, (0.03, 0.02), (0, 0)))
        + pair()
        + f"group left id 1\ngroup none id 99\n{move}\n"
        + f"fix drag {drag} drag/cluster 1.2 1.53e-5 velocity 0 0 2\n"
        + f"fix size {size} cluster/breakmerge 1 1e-4 2000 drag drag K 1.0\ntimestep 1e-7\nrun 0\n"
    )


@pytest.mark.parametrize("np_", (1, 2))
def test_clusters_that_the_drag_does_not_hold_are_refused(tmp_path, np_):
    r = run(tmp_path, of_groups(drag="left"), np_, check=False)
    assert r.code != 0
    assert "1 clusters of its group all are not in the group left of fix drag/cluster drag" in r.output
    assert run(tmp_path / "left", of_groups(drag="all", size="left"), np_).code == 0


def test_clusters_that_nothing_moves_are_refused(tmp_path):
    r = run(tmp_path, of_groups(move="fix move left nve/cluster"), check=False)
    assert (
        r.code != 0
        and "1 clusters of its group all are moved by no fix: give fix nve/cluster the same group" in r.output
    )
    both = "group right id 2\nfix other right nve\nfix move left nve/cluster"
    assert run(tmp_path / "both", of_groups(move=both)).code == 0


def test_an_empty_group_is_told(tmp_path):
    r = run(tmp_path, of_groups(size="none"))
    assert "WARNING: Fix cluster/breakmerge size: there is no cluster in its group none" in r.output


# ---- the plane


def in_plane(y: float, vy: float, plane: str, thick: float = 0.003) -> str:
    return (
        f"units si\natom_style sphere\nboundary p f p\ncomm_modify vel yes cutoff 5.7e-3\nneighbor 0.5e-3 bin\nregion box block 0 0.04 0 {thick} 0 0.04\n"
        f"create_box 1 box\ncreate_atoms 1 single 0.01 0.0015 0.02\ncreate_atoms 1 single 0.03 {y} 0.02\n"
        f"set type 1 diameter {diameter(400)!r}\nset type 1 density 1000\nset atom 2 vy {vy}\n"
        + pair()
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n"
        + f"fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 1.0 {plane}\ntimestep 1e-7\nrun 0\n"
    )


def test_clusters_off_the_plane_are_refused(tmp_path):
    r = run(tmp_path / "off", in_plane(0.0016, 0.0, "plane xz"), check=False)
    assert r.code != 0 and "all clusters must lie in one plane, but their y go from 0.0015 to 0.0016" in r.output
    r = run(tmp_path / "moves", in_plane(0.0015, 0.25, "plane xz"), check=False)
    assert r.code != 0 and "must not move along y, but one does at 0.25" in r.output
    assert run(tmp_path / "in", in_plane(0.0015, 0.0, "plane xz")).code == 0
    assert run(tmp_path / "none", in_plane(0.0016, 0.25, "plane none", 0.012)).code == 0


def test_a_thick_box_without_the_keyword_plane_is_told(tmp_path):
    # two of the largest clusters, 1.5874 mm, are 3.1748 mm
    for thick, told in ((0.003174, False), (0.003176, True)):
        output = run(tmp_path / str(thick), in_plane(0.0015, 0.0, "", thick)).output
        assert ("the keyword plane is not given" in output) == told
    assert (
        "the keyword plane is not given" not in run(tmp_path / "said", in_plane(0.0015, 0.0, "plane xz", 0.02)).output
    )


# ---- units


def in_units(units: str, length: float, mass: float, gravity: str) -> str:
    """One cluster in the same gas, in units of 1/length m and 1/mass kg; seconds."""
    density = mass / length**3
    return (
        f"units {units}\natom_style sphere\nboundary p f p\ncomm_modify vel yes cutoff {5.7e-3 * length}\n"
        f"neighbor {0.5e-3 * length} bin\nregion box block 0 {0.04 * length} 0 {0.003 * length} 0 {0.04 * length}\ncreate_box 1 box\n"
        f"create_atoms 1 single {0.02 * length} {0.0015 * length} {0.02 * length}\n"
        f"set type 1 diameter {diameter(400) * length!r}\nset type 1 density {1000 * density!r}\nvelocity all set 0 0 {1.5 * length}\n"
        f"pair_style granular\npair_coeff * * hooke {10 * mass} 0.3 tangential linear_history {8.57 * mass} 1.0 0.33 "
        f"damping coeff_restitution cutoff {1.5876e-3 * length}\n"
        "fix move all nve\n"
        f"fix drag all drag/cluster {RHO_G * density!r} {NU_G * length**2!r} velocity 0 0 {2 * length} law stokes\n"
        f"fix size all cluster/breakmerge 1 {1e-4 * length!r} {2000 * density!r} drag drag K {0.1 * length**3} break no {gravity}\n"
        "timestep 1e-7\nfix table all ave/atom 1 1 1 f_size[*]\nrun 0\n" + write("f_size[3]", "f_size[4]", "f_size[6]")
    )


@pytest.mark.parametrize("units, length, mass", [("cgs", 100.0, 1000.0), ("micro", 1e6, 1e15), ("lj", 10.0, 3.0)])
def test_other_units_give_the_same_powers(tmp_path, units, length, mass):
    """Powers per mass are length^2/time^3; U_mf of Wen & Yu and |V_g| enter with the gravity that is given."""
    si = run(tmp_path / "si", in_units("si", 1.0, 1.0, "")).dump()
    # by hand: U_mf 6.46 mm/s (theory.md), U_p = 1.5 m/s: [U_mf + 0.5 U_p/0.5] g
    archimedes = G * 1e-12 * (2000 - RHO_G) / (RHO_G * NU_G**2)
    umf = NU_G / 1e-4 * (np.sqrt(33.7**2 + 0.0408 * archimedes) - 33.7)
    assert si["f_size[6]"][0] == pytest.approx((umf + 1.5) * G, rel=1e-9)
    refused = run(tmp_path / "no", in_units(units, length, mass, ""), check=False)
    assert refused.code != 0 and f"the keyword gravity is required with units {units}" in refused.output
    row = run(tmp_path / "yes", in_units(units, length, mass, f"gravity {G * length} z")).dump()
    for column, power in (("f_size[3]", 1), ("f_size[4]", 2), ("f_size[6]", 2)):
        assert row[column][0] == pytest.approx(si[column][0] * length**power, rel=1e-9)


@pytest.mark.parametrize("units", ["metal", "real", "electron"])
@pytest.mark.parametrize(
    "fix", ["drag/cluster 1.2 1.53e-5", "cluster/breakmerge 1 1e-4 2000 K 1.0 terms cc", "nve/cluster gravity 1 0 0 -1"]
)
def test_units_whose_force_is_no_mass_times_acceleration_are_refused(tmp_path, units, fix):
    script = (
        f"units {units}\natom_style sphere\nboundary p f p\ncomm_modify vel yes cutoff 5.7e-3\nneighbor 0.5e-3 bin\n"
        "region box block 0 0.04 0 0.003 0 0.04\n"
        f"create_box 1 box\ncreate_atoms 1 single 0.02 0.0015 0.02\nset type 1 diameter {diameter(400)!r}\nset type 1 density 1000\n"
        + pair()
        + f"fix it all {fix}\nrun 0\n"
    )
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and f"does not support units {units}" in r.output


def test_gravity_that_differs_from_that_of_fix_gravity_is_told(tmp_path):
    def output(fix: str, gravity: str = "") -> str:
        rows = clusters((400, (0.02, 0.02), (0, 0)))
        return run(tmp_path / f"{len(fix)}{len(gravity)}", scene(rows, f"K 1.0 {gravity}", fixes=fix)).output

    words = "gravity 9.81 along z of the size law is not that of fix gravity fall, 0 0 -1.62"
    assert words in output("fix fall all gravity 1.62 vector 0 0 -1\n")
    assert "of the size law is not that" not in output("fix fall all gravity 9.81 vector 0 0 -1\n")
    assert "of the size law is not that" not in output("fix fall all gravity 1.62 vector 0 0 -1\n", "gravity 1.62 z")


# ---- the time step


@pytest.mark.parametrize("breaking, lightest", [("yes", 3), ("no", 400)])
def test_a_step_too_long_for_contacts_is_told(tmp_path, breaking, lightest):
    """pi/5 sqrt(m/k) of a fragment of the lower limit, or of the lightest cluster if none breaks."""
    bound = np.pi / 5 * np.sqrt(lightest * M_P / 10.0)
    for dt, told in ((0.99 * bound, False), (1.01 * bound, True)):
        rows = clusters((400, (0.02, 0.02), (0, 0)))
        script = scene(rows, f"K 1e6 merge no break {breaking} terms mf", dt=float(dt), steps=0)
        output = run(tmp_path / f"{dt:.3e}", script).output
        assert (f"is above {bound:.4g}, pi/5 sqrt(m/k) of" in output) == told
        assert ("Use a shorter step, fix cluster/timestep, or a higher lower limit" in output) == told


# ---- what is said


def test_all_that_is_not_met_is_told_at_once(tmp_path):
    rows = clusters((400, (0.01, 0.02), (0, 0)), (400, (0.03, 0.02), (0, 0)))
    script = (
        head(x=0.008, ghost=5.0e-3).replace("units        si", "units        cgs")
        + rows.replace("0.01 ", "0.001 ").replace("0.03 ", "0.006 ")
        + pair()
        + "group left id 1\nfix move all nve\nfix drag left drag/cluster 1.2 1.53e-5 velocity 0 0 2\n"
        + "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 1.0\ntimestep 1e-7\nrun 0\n"
    )
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and "Fix cluster/breakmerge size: 4 requirements are not met:" in r.output
    for words in ("gravity is required", "not in the group left", "ghost cutoff", "periodic box is 0.008 long"):
        assert words in r.output, words


@pytest.mark.parametrize(
    "size, words",
    [
        ("100 2000", "d_p = 100 and rho_p = 2000: are d_p and rho_p given in this order, and in units si"),
        ("2000 1e-4", "d_p = 2000 and rho_p = 0.0001: are d_p and rho_p given in this order"),
        ("1e-4 2500", "a voidage of 0.6 for particles of density 2500"),
    ],
)
def test_particles_in_other_units_are_told_before_cutoffs(tmp_path, size, words):
    script = scene(clusters((400, (0.02, 0.02), (0, 0))), "K 1.0 terms st", ghost=1e-3).replace(
        "cluster/breakmerge 1 0.0001 2000.0", f"cluster/breakmerge 1 {size}"
    )
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and words in r.output


# ---- the mean velocity of the particle phase


@pytest.mark.parametrize("np_", RANKS)
def test_up_vector_is_the_speed_of_the_mean(tmp_path, np_):
    """In one cell: 400 particles at 1.0 m/s up and 100 at 0.5 down: |mean| = 0.7, mean of magnitudes 0.9."""
    rows = clusters((400, (0.01, 0.02), (0, 1.0)), (100, (0.03, 0.021), (0, -0.5)))
    for reading, speed in (("vector", 0.7), ("cell", 0.9)):
        size = f"K 1e9 terms mf umf 0.01 up {reading} grid 1 1 1 merge no break no"
        row = run(tmp_path / reading, scene(rows, size), np_).dump()
        assert row["f_size[6]"] == pytest.approx([(0.01 + speed) * G] * 2, rel=1e-9)


@pytest.mark.parametrize("np_", (2, 3))
def test_cells_follow_fix_balance(tmp_path, np_):
    def balanced(where: str, ranks: int):
        rows = random_clusters(60).replace("EDGE EDGE 0.0015", "0 0.02 0.0015", 1)
        size = "K 0.03 merge 0.2 up cell grid 8 1 8 hysteresis 0.1"
        script = scene(
            rows,
            size,
            steps=400,
            gas="velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 4e-4 5 plane xz",
            dt=2e-6,
            newton="off",
        )
        return run(
            tmp_path / where, script.replace("timestep", "fix even all balance 20 1.0 shift xz 10 1.0\ntimestep"), ranks
        )

    one, more = balanced("one", 1), balanced("more", np_)
    assert one.table()[-1, BREAKUPS] > 20
    assert np.array_equal(one.table()[:, CLUSTERS : BORN + 1], more.table()[:, CLUSTERS : BORN + 1])
