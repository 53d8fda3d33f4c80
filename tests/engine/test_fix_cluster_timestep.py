"""fix cluster/timestep: bounds, rejection and repetition of steps, what is kept, what is said."""

import re

import numpy as np
import pytest
from lammps_run import CUTOFF, M_P, clusters, diameter, head, pair, random_clusters, run, write
from scenes import GAS

COLUMNS = "id x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"
ENERGIES = "variable time equal time\n"


def gran(k_n: float = 10.0, e: float = 1.0, mu: float = 0.33, options: str = "") -> str:
    return f"pair_style gran/cluster {k_n} {e} {mu} {options} cutoff {CUTOFF}\npair_coeff * *\n"


def two(v: float, offset: float = 0.0, n: int = 400, gap: float = 2e-5) -> str:
    """Two clusters, `gap` apart, that meet at 2 v; with an offset they meet obliquely."""
    half = 0.5 * (float(diameter(n)) + gap)
    return clusters((n, (0.02 - half, 0.02), (v, 0.0)), (n, (0.02 + half, 0.02 + offset), (-v, 0.0)))


def scene(bodies: str, contact: str, control: str, steps: int, motion: str = "nve/sphere", more: str = "") -> str:
    """A table out.txt of every step: time and the fix's vector; all states in steps.dump."""
    return (
        head()
        + bodies
        + contact
        + (f"fix dt all cluster/timestep {control}\n" if control else "")
        + f"fix move all {motion}\n"
        + more
        + ENERGIES
        + ('fix table all ave/time 1 1 1 v_time f_dt[*] mode scalar file out.txt format " %.17g"\n' if control else "")
        + f"dump steps all custom 1 steps.dump {COLUMNS}\ndump_modify steps sort id format float %.17g\n"
        + "thermo 100\nthermo_modify lost error\n"
        + f"run {steps}\n"
    )


STEP, TIME, DT, BY_OVERLAP, BY_ENERGY, UNTESTED, OVERLAP, WORST, ERROR, WORST_ERROR, LET_PASS = range(11)


def test_step_is_the_smallest_of_its_bounds(tmp_path):
    """DT_MAX, and C sqrt(m/k_n) of the lightest cluster."""
    m = 3 * M_P
    bodies = clusters((3, (0.01, 0.02), (0.0, 0.0)), (400, (0.03, 0.02), (0.0, 0.0)))
    paper = np.pi / 5 * np.sqrt(m / 10.0)
    for k, (control, expected) in enumerate(
        [("1e-6", 1e-6), ("1e-3", paper), ("1e-3 contact 0.1", 0.1 / (np.pi / 5) * paper), ("1e-3 contact off", 1e-3)]
    ):
        rows = run(tmp_path / str(k), scene(bodies, gran(), control + " predict no", 3)).table()
        assert rows[-1, DT] == pytest.approx(expected, rel=1e-12)
        assert rows[-1, TIME] == pytest.approx(3 * expected, rel=1e-12)


def test_rejected_drift_is_repeated_as_if_it_had_not_been(tmp_path):
    """The first step would drive 928 um clusters through each other; after it is rejected the state is bit for bit
    that of a run that took the smaller step at once.
    """
    control = "4e-5 contact off energy off predict no overlap 0.5 floor 1e-8"
    rejected = run(tmp_path / "rejected", scene(two(20.0, 3e-4), gran(1e4), control, 1))
    row = rejected.table()[-1]
    assert row[BY_OVERLAP] >= 1
    dt = 4e-5 * 0.5 ** row[BY_OVERLAP]
    assert row[DT] == dt
    plain = run(tmp_path / "plain", scene(two(20.0, 3e-4), gran(1e4), "", 1, more=f"timestep {float(dt)!r}\n"))
    a, b = rejected.frames("steps.dump")[-1], plain.frames("steps.dump")[-1]
    assert all(np.array_equal(a[c], b[c]) for c in a)
    assert np.abs(a["fx"]).max() > 0


OBLIQUE = two(0.5, 3e-4)
GUSTS = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 5e-6 5\n"


def energy_rejection(tmp_path, more: str = ""):
    """Oblique elastic impact with friction. Rows of the table, the rejected steps, and the first of them that finds the
    clusters sliding on each other.
    """
    control = "4e-6 contact off energy 1e-5 floor 1e-9"
    r = run(tmp_path / "controlled", scene(OBLIQUE, gran(1e3), control, 60, more=more))
    rows = r.table()
    rejected = np.flatnonzero(np.diff(rows[:, BY_ENERGY]) > 0) + 1
    pushed = [n for n in rejected if np.abs(r.frames("steps.dump")[n]["tqy"]).max() > 0]
    return r, rows, rejected, int(pushed[0])


def test_energy_rejection_puts_everything_back(tmp_path):
    r, rows, rejected, n = energy_rejection(tmp_path)
    frames = r.frames("steps.dump")
    before, after = frames[n - 1], frames[n]
    assert np.abs(before["fz"]).max() > 0 and np.abs(before["tqy"]).max() > 0 and np.abs(before["omegay"]).max() > 0
    for c in before:
        assert np.array_equal(before[c], after[c]), c
    assert rows[n, TIME] == rows[n - 1, TIME]  # a step number of zero time
    following = next(k for k in range(n + 1, len(rows)) if k not in rejected)
    assert not np.array_equal(after["x"], frames[following]["x"])


@pytest.mark.parametrize("more", ["", GUSTS], ids=["alone", "in gusts"])
def test_history_and_gusts_are_put_back_too(tmp_path, more):
    """The run equals, to the bit, one that took the accepted steps alone: had a rejected one left anything behind in the
    contact history or in the gas, which is drawn anew every 5 us, friction or drag would tell.
    """
    r, rows, rejected, n = energy_rejection(tmp_path, more)
    frames = r.frames("steps.dump")
    last = max(k for k in range(n, len(rows)) if np.abs(frames[k]["tqy"]).max() > 0)
    assert last > n and rows[last, BY_ENERGY] >= 1
    script = scene(OBLIQUE, gran(1e3), "", 0, more=more)
    for k in range(1, last + 1):
        if k not in rejected:
            script += f"timestep {float(rows[k, DT])!r}\nrun 1 pre no post no\n"
    plain = run(tmp_path / "plain", script).frames("steps.dump")[-1]
    for c in plain:
        assert np.array_equal(plain[c], frames[last][c]), c


def test_contacts_create_no_energy(tmp_path):
    """A head-on elastic rebound with 7 steps in contact: left alone it can come out faster than it went in, depending
    on where the first step falls; with the test it never does, beyond what the tolerance adds up to.
    """
    gained = {"off": [], "1e-5": []}
    for k, gap in enumerate(np.linspace(1e-5, 9e-5, 8)):
        for energy, gains in gained.items():
            control = f"6e-5 contact off energy {energy} floor 1e-9"
            r = run(tmp_path / f"{energy}{k}", scene(two(0.5, gap=float(gap)), gran(), control, 1500))
            rows = r.table()
            gains.append((r.frames("steps.dump")[-1]["vx"][1] / 0.5) ** 2 - 1)
            if energy != "off":
                assert rows[:, ERROR].max() <= 1e-5 and rows[-1, LET_PASS] == 0
                assert gains[-1] <= 1e-5 * np.count_nonzero(rows[:, ERROR])
    assert max(gained["off"]) > 1e-3


@pytest.mark.parametrize("offset", [0.0, 3e-4])
def test_energy_that_is_all_but_gone_is_not_tested(tmp_path, offset):
    """After an impact with e = 0, seen from the centre of mass, what is left falls to the rounding of positions: no share
    of that means anything, and the run goes on.
    """
    contact = gran(10.0, 0.0, options="tangential linear")
    rows = run(tmp_path, scene(two(0.5, offset), contact, "1e-4", 1500)).table()
    assert rows[-1, STEP] == 1500 and rows[-1, LET_PASS] == 0


def test_step_grows_back_when_quiet(tmp_path):
    rows = run(tmp_path, scene(two(0.5), gran(), "2e-5 energy 1e-4", 200)).table()
    assert rows[:, DT].min() < 2e-5 and rows[-1, DT] == 2e-5
    assert rows[-1, TIME] == pytest.approx(rows[1:, DT][np.diff(rows[:, BY_ENERGY]) == 0].sum(), rel=1e-12)


def test_prediction_makes_rejections_rare(tmp_path):
    count = {}
    for predict in ("yes", "no"):
        control = f"2e-5 contact off energy off predict {predict}"
        rows = run(tmp_path / predict, scene(two(20.0), gran(1e4, 0.3), control, 200)).table()
        count[predict] = rows[-1, BY_OVERLAP]
        assert rows[:, OVERLAP].max() < 1.0
    assert count["yes"] == 0 < count["no"]


def enough_stiffness(output: str) -> float:
    return float(re.search(r"k_n of at least (\S+) would", output).group(1))


@pytest.mark.parametrize("predict", ["yes", "no"])
@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_a_spring_that_is_too_soft_is_named(tmp_path, predict, e):
    """The pair, its overlap and approach, the k_n that does: and with that one the same run finishes."""
    control = f"1e-5 energy off predict {predict}"
    soft = run(tmp_path / "soft", scene(two(15.0), gran(10.0, e), control, 400), check=False)
    assert soft.code != 0
    assert "spring is too soft" in soft.output and "clusters 1 and 2 overlap by" in soft.output
    enough = enough_stiffness(soft.output)
    stiff = run(tmp_path / "stiff", scene(two(15.0), gran(enough, e), control, 400))
    assert stiff.table()[:, OVERLAP].max() < 1.0
    # and it is not far more than needed
    assert run(tmp_path / "less", scene(two(15.0), gran(0.85 * enough, e), control, 400), check=False).code != 0


def test_published_spring_passes_at_ten_metres_per_second(tmp_path):
    """MODEL: k_n = 10 N/m and e = 0.3 let two 928 um clusters pass each other from 10.2 m/s of approach on."""
    for speed, code in ((5.0, 0), (5.2, 1)):
        r = run(tmp_path / str(speed), scene(two(speed), gran(10.0, 0.3), "1e-6 energy off", 500), check=False)
        assert bool(r.code) == bool(code), r.output[-800:]


def test_last_good_state_is_written_before_the_error(tmp_path):
    r = run(tmp_path, scene(two(15.0), gran(10.0, 0.3), "1e-5 energy off", 400), check=False)
    name = re.search(r"is in (dt\.\d+\.restart)", r.output).group(1)
    good = int(name.split(".")[1])
    last = r.frames("steps.dump")[good]
    script = f"comm_modify vel yes cutoff 5.7e-3\natom_modify map hash\nread_restart {name}\n" + write(name="read.dump")
    read = run(tmp_path, script).dump("read.dump")
    for c in ("id", "x", "z", "vx", "vz"):
        assert np.array_equal(read[c], last[c])


def test_kinetic_test_is_the_papers_and_says_what_breaks_it(tmp_path):
    """Without gravity or a spring that lets go it holds; where a cluster just falls it cannot."""
    free = scene(two(0.2), gran(10.0, 0.3), "1e-6 test kinetic", 30)
    assert run(tmp_path / "free", free).table()[-1, BY_ENERGY] == 0
    fall = scene(two(0.0), gran(), "1e-6 test kinetic", 30, more="fix fall all gravity 9.81 vector 0 0 -1\n")
    r = run(tmp_path / "fall", fall, check=False)
    assert r.code != 0 and "test balance" in r.output and "kinetic energy rises" in r.output


def busy(steps: int, contact: str | None = None, control: str = "4e-6 energy 1e-4", np_newton: str = "on") -> str:
    """Breaks and merges in a crowd, with the step in control; the same clusters on any ranks."""
    stir = (
        "variable u atom 0.4*sin(79190*x+104729*z)\nvariable w atom 2+0.4*sin(61379*x-94321*z)\n"
        "velocity all set v_u 0 v_w\n"
    )
    return (
        head(newton=np_newton)
        + random_clusters(300)
        + (contact or gran(10.0, 0.3))
        + stir
        + fixes(control)
        + f"run {steps}\n"
        + write()
    )


def fixes(control: str) -> str:
    return (
        f"fix dt all cluster/timestep {control}\nfix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
        + GAS
        + "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.5 merge 0.2\n"
        + ENERGIES
        + 'fix table all ave/time 1 1 1 v_time f_dt[*] f_size[*] mode scalar file out.txt format " %.17g"\n'
        "thermo 500\nthermo_modify lost error\n"
    )


SIZE = 12  # first column of the fix cluster/breakmerge vector


def test_with_events_count_mass_and_energy_hold(tmp_path):
    r = run(tmp_path, busy(1500))
    rows = r.table()
    particles = rows[:, SIZE + 1]
    assert np.all(particles == particles[0])
    assert rows[-1, SIZE + 2] > 20 and rows[-1, SIZE + 3] > 5  # breakups, merges
    assert rows[:, ERROR].max() <= 1e-4 and rows[-1, LET_PASS] == 0
    assert rows[:, OVERLAP].max() < 1.0
    assert np.all(np.diff(rows[:, TIME]) >= 0)
    assert r.dump()["mass"].sum() == pytest.approx(particles[0] * M_P, rel=1e-12)


@pytest.mark.parametrize("newton", ["on", "off"])
def test_same_steps_on_any_ranks(tmp_path, newton):
    """Rejections included. Sums are added in another order and elastic collisions amplify the rounding: 200 steps, times
    to 1e-9.
    """
    control = "1.6e-5 contact off energy 1e-8"
    one = run(tmp_path / "1", busy(200, gran(), control))
    assert one.table()[-1, BY_ENERGY] > 0
    for ranks in (2, 4):
        many = run(tmp_path / str(ranks), busy(200, gran(), control, newton), ranks)
        counts = [STEP, BY_OVERLAP, BY_ENERGY, UNTESTED]
        assert np.array_equal(many.table()[:, counts], one.table()[:, counts])
        assert np.allclose(many.table()[:, TIME], one.table()[:, TIME], rtol=1e-9)
        a, b = many.dump(), one.dump()
        assert np.array_equal(a["id"], b["id"])
        assert np.allclose(a["x"], b["x"], rtol=1e-9)


def test_a_restart_continues(tmp_path):
    """Bit-equal to the same run cut at that step; totals and the step go on."""
    control = "1.6e-5 contact off energy 1e-6"
    cut = busy(400, gran(), control).replace("run 400\n", "run 400\nwrite_restart half.restart\nrun 400\n")
    whole = run(tmp_path, cut)
    assert whole.table()[-1, BY_ENERGY] > 0
    resumed = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart half.restart\nneighbor 0.5e-3 bin\n"
        + fixes(control).replace("out.txt", "resumed.txt")
        + "run 400\n"
        + write(name="resumed.dump")
    )
    r = run(tmp_path, resumed)
    a, b = whole.dump(), r.dump("resumed.dump")
    for c in a:
        assert np.array_equal(a[c], b[c]), c
    assert np.array_equal(whole.table()[-1], r.table("resumed.txt")[-1])


@pytest.mark.parametrize(
    "contact, control, words",
    [
        (pair(), "1e-6", ["energy test needs pair style gran/cluster", "energy off"]),
        (pair(), "1e-6 energy off", ["stiffness k_n", "stiffness K_N", "contact off"]),
        (gran(), "0", ["DT_MAX value: 0", "> 0"]),
        (gran(), "1e-6 overlap -1", ["overlap value: -1", "from 1e-06 to"]),
        (gran(), "1e-6 floor 1e-5", ["floor value: 1e-5", "at most DT_MAX"]),
        (gran(), "1e-6 retries 0", ["retries value: 0", "integer from 1"]),
        (gran(), "1e-6 test energy", ["test value: energy", "balance | kinetic"]),
        (gran(), "1e-6 predict maybe", ["predict value: maybe"]),
        (gran(), "1e-6 energy", ["missing energy"]),
        (gran(), "1e-6 tolerance 1", ["Unknown fix cluster/timestep keyword: tolerance"]),
    ],
)
def test_bad_input_is_named(tmp_path, contact, control, words):
    r = run(tmp_path, scene(two(0.1), contact, control, 1), check=False)
    assert r.code != 0
    for word in words:
        assert word in r.output


def test_works_with_stock_pairs_without_the_energy_test(tmp_path):
    rows = run(tmp_path, scene(two(0.5), pair(), "1e-5 energy off stiffness 10", 100)).table()
    assert rows[-1, DT] == pytest.approx(1e-5)
    r = run(tmp_path / "soft", scene(two(15.0), pair(), "1e-5 energy off stiffness 10", 400), check=False)
    assert r.code != 0 and "spring is too soft" in r.output


def test_must_come_before_what_moves_clusters(tmp_path):
    text = scene(two(0.1), gran(), "1e-6", 1)
    line = "fix dt all cluster/timestep 1e-6\n"
    r = run(
        tmp_path,
        text.replace(line, "").replace("fix move all nve/sphere\n", "fix move all nve/sphere\n" + line),
        check=False,
    )
    assert r.code != 0 and "must be defined before fix move (nve/sphere)" in r.output
    r = run(tmp_path, text.replace("fix dt all", "group some id 1\nfix dt some"), check=False)
    assert r.code != 0 and "group: some (must be all" in r.output


def test_velocity_that_is_not_a_number_stops_the_run(tmp_path):
    more = "variable nan equal sqrt(-1)\nvelocity all set v_nan NULL NULL units box\n"
    r = run(tmp_path, scene(two(0.1), gran(), "1e-6", 5, more=more), check=False)
    assert r.code != 0
