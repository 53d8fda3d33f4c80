"""fix nve/cluster: the same motion as nve, gravity and drag in passes of their own, whatever is looked at in between."""

import numpy as np
import pytest
from lammps_run import clusters, head, pair, run, write
from scenes import BREAKUPS, GAS, PARTICLES, again, busy

APART = "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
TOGETHER = "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag\n"
HELD = GAS.replace("plane", "refresh 10 plane")
STATE = ("x", "y", "z", "vx", "vy", "vz")


def together(script: str) -> str:
    assert APART in script
    return script.replace(APART, TOGETHER)


def scene(steps: int = 300, gas: str = HELD, **options) -> str:
    """A crowd with contacts whose clusters keep their size, so that rounding is all that can differ."""
    return busy(steps, gas=gas, options="break no merge no", **options)


def same(a, b, columns=STATE):
    return all(np.array_equal(a[c], b[c]) for c in columns)


@pytest.mark.parametrize("gas", [HELD, GAS], ids=["held", "every step"])
@pytest.mark.parametrize("integrator", ["explicit", "exponential"])
def test_moves_as_the_engines_own_fixes_do(tmp_path, gas, integrator):
    """Relative 1e-9 after 300 steps with contacts: the engine's own integrator is compiled with fused multiply-add."""
    script = scene(gas=gas.replace("plane", f"integrator {integrator} plane"))
    apart = run(tmp_path / "apart", script).dump()
    fused = run(tmp_path / "together", together(script)).dump()
    for c in STATE:
        assert np.allclose(fused[c], apart[c], rtol=1e-9, atol=1e-12), c
    assert np.ptp(fused["vz"]) > 0.1


def test_looking_changes_nothing(tmp_path):
    """Steps that end in an output are done in separate passes; the others in one. Same bits, and the same events."""
    script = together(busy(600, gas=HELD))
    seldom = run(tmp_path / "seldom", script)
    often = run(tmp_path / "often", script.replace("thermo 500", "thermo 1"))
    between = run(tmp_path / "between", script.replace("thermo 500", "thermo 7\nfix v all ave/atom 3 1 3 vx"))
    assert same(seldom.dump(), often.dump()) and same(seldom.dump(), between.dump())
    assert often.table()[-1, BREAKUPS] > 20


def test_forces_and_sums_at_an_output_are_those_of_the_step(tmp_path):
    """Forces in the dump, the drag's total and kinetic energy at a step in the middle of a held stretch."""
    show = (
        "dump f all custom 37 f.*.dump id vx vz fx fz\ndump_modify f format float %.17g sort id\n"
        "fix sums all ave/time 37 1 37 f_drag[*] c_thermo_temp file sums.txt format ' %.17g'\n"
    )
    script = scene(111).replace("thermo 500\n", "thermo 500\n" + show)
    apart, fused = run(tmp_path / "apart", script), run(tmp_path / "together", together(script))
    for step in (37, 74):
        a, b = apart.dump(f"f.{step}.dump"), fused.dump(f"f.{step}.dump")
        weight = np.abs(a["fz"]).max()
        for c in ("fx", "fz"):
            assert np.allclose(b[c], a[c], rtol=1e-9, atol=1e-12 * weight), (step, c)
    assert np.allclose(fused.table("sums.txt"), apart.table("sums.txt"), rtol=1e-9, atol=1e-20)


def test_free_fall_is_exact(tmp_path):
    """Z = -g t^2/2, tilted by a direction that is normalised; velocity Verlet is exact here: rounding, 1e-12."""
    fall = run(
        tmp_path,
        head()
        + clusters((27, (0.03, 0.03), (0, 0)))
        + pair()
        + "fix move all nve/cluster gravity 9.81 3 0 -4\ntimestep 1e-6\nthermo 5000\nrun 5000\n"
        + write(),
    ).dump()
    t = 5000e-6
    assert np.allclose([fall["x"][0], fall["z"][0]], [0.03 + 0.3 * 9.81 * t**2, 0.03 - 0.4 * 9.81 * t**2], rtol=1e-12)
    assert np.allclose([fall["vx"][0], fall["vz"][0]], [0.6 * 9.81 * t, -0.8 * 9.81 * t], rtol=1e-12)


@pytest.mark.parametrize("newton", ["on", "off"])
def test_does_not_depend_on_ranks(tmp_path, newton):
    script = together(busy(400, gas=HELD, newton=newton))
    one = run(tmp_path / "1", script)
    for ranks in (2, 4):
        many = run(tmp_path / str(ranks), script, ranks)
        assert np.array_equal(many.table()[:, :6], one.table()[:, :6])
        for c in STATE:
            assert np.allclose(many.dump()[c], one.dump()[c], rtol=1e-9, atol=1e-12), c
    assert len(set(one.table()[:, PARTICLES])) == 1


def test_restart_in_a_held_stretch_continues_bit_equal(tmp_path):
    """Both runs stop at step 205, where drag is computed anew as at the start of any run."""
    script = together(busy(205, gas=HELD))
    whole = run(tmp_path / "whole", script.replace("run 205\n", "run 205\nwrite_restart half\nrun 195\n"))
    continued = run(tmp_path / "again", together(again("../whole/half", gas=HELD)) + "run 195\n" + write("f_size[1]"))
    assert same(whole.dump(), continued.dump())


def test_a_run_cut_short_is_complete(tmp_path):
    """A run that a timeout ends after some step leaves the state of that step, not one half a kick behind."""
    script = together(scene(1))
    cut = script.replace(
        "run 1\n",
        "timer timeout 0:00:01 every 10\nrun 100000000\ntimer timeout off\nprint $(step) file steps.txt\nrun 7\n",
    )
    ended = run(tmp_path / "cut", cut)
    steps = int((ended.folder / "steps.txt").read_text())
    whole = run(tmp_path / "whole", script.replace("run 1\n", f"run {steps}\nrun 7\n"))
    assert steps >= 10 and same(ended.dump(), whole.dump())


def test_other_forces_come_last_as_they_are_defined(tmp_path):
    """With fix setforce after it, every force is there when setforce acts, and nothing moves sideways."""
    script = scene(50).replace("timestep", "fix hold all setforce 0 NULL NULL\ntimestep")
    apart = run(tmp_path / "apart", script).dump()
    fused = run(tmp_path / "together", together(script)).dump()
    assert np.all(fused["fx"] == 0) and np.ptp(fused["x"] - apart["x"]) < 1e-12
    for c in STATE:
        assert np.allclose(fused[c], apart[c], rtol=1e-9, atol=1e-12), c


def test_moves_its_group_alone(tmp_path):
    script = (
        head()
        + clusters((27, (0.03, 0.03), (0, 0)), (27, (0.01, 0.01), (0, 0)))
        + pair()
        + "group one id 1\nfix move one nve/cluster gravity 9.81 0 0 -1\ntimestep 1e-5\nrun 100\n"
        + write()
    )
    end = run(tmp_path, script).dump()
    assert end["vz"][0] == pytest.approx(-9.81e-3, rel=1e-12) and end["vz"][1] == 0 and end["z"][1] == 0.01


def test_a_changing_time_step_finishes_the_last_one_with_the_old(tmp_path):
    """Fix dt/reset looks every 10 steps; with an output at every step nothing is ever postponed."""
    script = together(scene(200)).replace("timestep", "fix reset all dt/reset 10 1e-8 4e-6 1e-6\ntimestep")
    seldom = run(tmp_path / "seldom", script).dump()
    often = run(tmp_path / "often", script.replace("thermo 500", "thermo 1")).dump()
    assert same(seldom, often)


@pytest.mark.parametrize(
    "text, words",
    [
        ("gravity 9.81 0 0", "missing gravity direction"),
        ("gravity inf 0 0 1", "Illegal fix nve/cluster gravity value: inf (must be a finite number [acceleration])"),
        ("gravity 9.81 0 0 0", "one of three numbers that are not all 0"),
        ("drag", "missing drag fix-ID"),
        ("drag nobody", "drag nobody is not the ID of a fix drag/cluster"),
        ("spin yes", "Unknown fix nve/cluster keyword: spin"),
    ],
)
def test_bad_words(tmp_path, text, words):
    result = run(tmp_path, scene(1).replace(APART, f"fix move all nve/cluster {text}\n"), check=False)
    assert result.code != 0 and words in result.output


def test_bad_company(tmp_path):
    swapped = scene(1).replace(APART, "").replace(HELD, HELD + TOGETHER)
    assert "must be defined before fix drag/cluster drag" in run(tmp_path / "order", swapped, check=False).output
    other = together(scene(1)).replace("fix move all", "group some id 1\nfix move some")
    assert "must act on the same group" in run(tmp_path / "group", other, check=False).output
    respa = together(scene(1)).replace("timestep", "run_style respa 2 2\ntimestep")
    assert "does not support run_style respa" in run(tmp_path / "respa", respa, check=False).output
