"""fix cluster/timestep beside what other people's scenes hold: what a rejected step does not undo is undone, or refused
before the run.
"""

import numpy as np
import pytest
from lammps_run import CUTOFF, D_P, clusters, diameter, run

R = 0.5 * float(diameter(400))
HEAD = """
units si
atom_style sphere
atom_modify map hash sort 0 0
newton on
boundary p f f
comm_modify vel yes cutoff 0.0065
neighbor 0.5e-3 bin
processors {ranks} 1 1
region box block 0 0.03 0 0.003 0 0.03
create_box {types} box
"""
BODIES = clusters(
    (400, (0.005, 1e-3 + R - 5e-7), (0.01, 0.0)), (400, (0.015, 0.02), (4.0, 0.0)), (400, (0.0172, 0.02), (-4.0, 0.0))
)
CONTACT = f"pair_style gran/cluster 300.0 1.0 0.0 cutoff {CUTOFF}\npair_coeff * *\n"
CONTROL = "fix dt all cluster/timestep 4e-5 contact off energy 1e-6\n"
STICKY = "granular hooke 10.0 0.0 tangential linear_history 8.57 0.0 10.0 damping mass_velocity"
PLANE = f"fix wall one wall/gran {STICKY} zplane 0.001 NULL\n"
REGION = f"region floor block EDGE EDGE EDGE EDGE 0.001 EDGE open 1 open 2 open 3 open 4 open 6\nfix wall one wall/gran/region {STICKY} region floor\n"
MOTION = "group one id 1\nfix move all nve\nfix fall one gravity 9.81 vector 0 0 -1\n"


def scene(ranks: int, wall: str, control: str = CONTROL) -> str:
    dump = "dump each all custom 1 each.dump id x z vx vz fx fz\ndump_modify each sort id format float %.17g\n"
    table = "variable t equal time\nfix table all ave/time 1 1 1 v_t f_dt[1] f_dt[3] file out.txt format ' %.17g'\n"
    return (
        HEAD.format(ranks=ranks, types=1)
        + BODIES
        + CONTACT
        + control
        + MOTION
        + wall
        + dump
        + (table if control else "")
    )


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("wall", [PLANE, REGION], ids=["plane", "region"])
def test_contact_with_a_wall_is_put_back(tmp_path, wall, ranks):
    """A cluster swings on the spring of a wall while two others collide elsewhere so hard that steps are rejected. To the bit
    as with the accepted steps alone; and its swing stays that of m x'' = -k_t x with v = 1 cm/s.
    """
    control = run(tmp_path / "control", scene(ranks, wall) + "timestep 4e-5\nrun 400\n", ranks)
    rows, frames = control.table(), control.frames("each.dump")
    rejected = np.flatnonzero(np.diff(rows[:, 3]) > 0) + 1
    assert len(rejected) >= 10
    plain = scene(ranks, wall, control="")
    for k in range(1, len(rows)):
        if k not in rejected:
            plain += f"timestep {float(rows[k, 2])!r}\nrun 1 pre no post no\n"
    end = run(tmp_path / "plain", plain, ranks).frames("each.dump")[-1]
    for column in end:
        assert np.array_equal(end[column], frames[-1][column]), column
    x = np.array([frame["x"][0] for frame in frames])
    m = 1000.0 * 4 / 3 * np.pi * R**3
    assert np.abs(x - 0.005).max() == pytest.approx(0.01 * np.sqrt(m / 8.57), rel=0.05)


def refusal(tmp_path, ranks: int, body: str, types: int = 1, contact: str = CONTACT, control: str = CONTROL) -> str:
    """What is said before any step is taken."""
    text = HEAD.format(ranks=ranks, types=types) + BODIES + contact + control + body
    r = run(tmp_path, text + "timestep 4e-5\nthermo 1\nrun 10\n", ranks, check=False)
    assert r.code != 0
    assert "Per MPI rank memory" not in r.output  # the run has not begun
    return r.output


HOPPER = "region hopper block 0 0.01 0 0.003 0.02 0.03\n"
WITH_ITS_REASON = {
    "pour": (
        HOPPER + f"fix feed all pour 6 1 5 region hopper vol 0.1 100 diam one {D_P * 8} dens 1000 1000\n",
        ["fix feed (pour)", "fix deposit"],
    ),
    "move": ("group one id 1\nfix carry one move linear 0.1 0 0\n", ["fix carry (move)", "setforce"]),
    "deform": ("fix box all deform 1 x erate 1.0\n", ["fix box (deform)"]),
    "wiggle": (
        PLANE.replace("0.001 NULL", "0.001 NULL wiggle x 1e-4 1e-2").replace(" one ", " all "),
        ["fix wall (wall/gran)", "wiggles"],
    ),
    "nvt/sphere": ("fix warm all nvt/sphere temp 1 1 1\n", ["fix warm (nvt/sphere)", "nve/sphere"]),
    "moving region": (
        "variable up equal 1e-4*time\n"
        + REGION.replace("open 6\n", "open 6 move NULL NULL v_up\n").replace(" one ", " all "),
        ["fix wall (wall/gran/region)", "energy off"],
    ),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("what", WITH_ITS_REASON)
def test_refused_before_the_run(tmp_path, what, ranks):
    body, words = WITH_ITS_REASON[what]
    # fix pour asks for gravity, fix move does the moving of its atoms
    body = "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n" + body
    said = refusal(tmp_path, ranks, body.replace("boundary p f f", "boundary p p f"))
    assert "changes and repeats time steps" in said
    for word in words:
        assert word in said


def test_all_that_does_not_go_is_said_at_once(tmp_path):
    body = "fix move all nve\nfix warm all nvt/sphere temp 1 1 1\nfix box all deform 1 x erate 1.0\n"
    said = refusal(tmp_path, 1, body)
    assert "fix warm (nvt/sphere)" in said and "fix box (deform)" in said


HYBRID = f"""pair_style hybrid gran/cluster 10 0.95 0.0 cutoff {CUTOFF} granular
pair_coeff 1 1 gran/cluster
pair_coeff * 2 granular hooke 1000.0 0.95 tangential linear_nohistory 0 0 damping coeff_restitution cutoff {CUTOFF}
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_contacts_of_another_style_are_not_blamed(tmp_path, ranks):
    """Their energy is not known, so that the energy test is refused; so is k_n of one style for the contacts of both."""
    move = "fix move all nve\n"
    said = refusal(tmp_path / "energy", ranks, move, 2, HYBRID)
    assert "energy test needs pair style gran/cluster" in said
    assert "pair style granular does not: use 'energy off'" in said
    said = refusal(tmp_path / "bound", ranks, move, 2, HYBRID, "fix dt all cluster/timestep 4e-5 energy off\n")
    assert "stiffness K_N" in said


def test_a_sub_style_without_forces_is_no_other_style(tmp_path):
    contact = f"pair_style hybrid/overlay gran/cluster 300.0 1.0 0.0 zero {CUTOFF}\npair_coeff * * gran/cluster\npair_coeff * * zero\n"
    text = HEAD.format(ranks=1, types=1) + BODIES + contact + CONTROL + MOTION + PLANE + "run 20\n"
    assert run(tmp_path, text).code == 0


@pytest.mark.parametrize("ranks", [1, 2])
def test_fed_by_fix_deposit(tmp_path, ranks):
    """The remedy that is named for fix pour runs, births and step control together."""
    m = 1000.0 * 4 / 3 * np.pi * R**3
    (tmp_path / "size.mol").write_text(
        f"one cluster\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 {2 * R!r}\n\nMasses\n\n1 {m!r}\n"
    )
    feed = (
        "molecule size size.mol\nregion hopper block 0 0.01 0.0015 0.0015 0.02 0.03\n"
        "fix feed all deposit 6 0 5 4711 mol size region hopper near 1.4e-3 attempt 100 vz -0.1 -0.1\n"
    )
    text = HEAD.format(ranks=ranks, types=1) + BODIES + CONTACT + CONTROL + "fix move all nve\n" + feed
    text += 'run 60\nprint "LEFT $(atoms)"\n'
    assert "LEFT 9" in run(tmp_path, text, ranks).output
