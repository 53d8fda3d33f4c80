"""fix drag/cluster … field: gas from files, on the real engine."""

from __future__ import annotations

import numpy as np
import pytest
from gas_files import TITLE, uneven, write_field
from lammps_run import D_P, M_P, RHO_P, clusters, diameter, head, pair, random_clusters, run, write

L = 0.04  # the box is L x 0.003 x L, periodic along x and z
FLAT = np.array([0.0])
DRAG = "fix drag all drag/cluster 1.2 1.53e-5 field {} {}\n"
CLAMPED = "edge x clamp edge z clamp"
U, W = "f_drag[1]", "f_drag[3]"


def scene(field: str, more: str = "", steps: int = 0, count: int = 200, n: int = 400, motion: str = "nve") -> str:
    return (
        head() + random_clusters(count, n) + pair() + f"fix move all {motion}\n" + DRAG.format(field, more)
        + f"timestep 1e-6\nrun {steps}\n" + write("f_drag[*]", "y")
    )  # fmt: skip


def linear(x, y, z):
    return 3 * x - 50 * z + 7, -20 * x + y, 1 + 200 * x - 100 * z


# ---- space ----


@pytest.mark.parametrize("how", ["double", "float", "ascii", "solid"])
def test_linear_fields_are_exact(tmp_path, how):
    """To a few roundings of values up to 10: 1e-14; in single precision to those of the file, 6e-8 of its values."""
    y = uneven(0.0, 0.003, 4) if how == "solid" else FLAT
    axes = uneven(0.0, L, 17), y, uneven(0.0, L, 40, seed=2)
    write_field(tmp_path / "gas.vtk", axes, linear, binary=how != "ascii", kind="float" if how == "float" else "double")
    row = run(tmp_path, scene("gas.vtk", CLAMPED)).dump()
    depth = row["y"] if how == "solid" else 0.0
    tolerance = 10 * 2**-23 * 2 if how == "float" else 5e-14
    for k, expected in enumerate(linear(row["x"], depth, row["z"]), start=1):
        assert np.abs(row[f"f_drag[{k}]"] - expected).max() < tolerance


def test_structured_points_and_what_vtk_writes(tmp_path):
    """Laid out as VTK 9.7 does: version 5.1, SCALARS with three components, fields, metadata, other arrays."""
    numbers = " ".join(str(k) for k in range(18))
    (tmp_path / "gas.vtk").write_text(
        "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET STRUCTURED_POINTS\nFIELD FieldData 2\n"
        "TIME 1 1 double\n0.25 \nnote 2 1 int\n3 4\nMETADATA\nINFORMATION 0\n\nDIMENSIONS 3 1 2\nSPACING 0.02 1 0.04\n"
        "ORIGIN 0 0 0\nCELL_DATA 2\nSCALARS quality float\nLOOKUP_TABLE default\n0 0\nPOINT_DATA 6\n"
        f"SCALARS velocity double 3\nLOOKUP_TABLE default\n{numbers}\nMETADATA\nINFORMATION 1\n"
        "NAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\nFIELD FieldData 3\nids 1 6 long\n0 1 2 3 4 5\n"
        f"fluctuation 3 6 float\n{numbers}\nMETADATA\nCOMPONENT_NAMES\na\n\nviscosity 1 6 float\n1 1 1 1 1 1\n"
    )
    row = run(tmp_path, scene("gas.vtk", CLAMPED)).dump()
    assert row[U] == pytest.approx(3 * row["x"] / 0.02 + 9 * row["z"] / L, rel=1e-13)
    assert row["f_drag[7]"] == pytest.approx(
        np.sqrt(sum(row[f"f_drag[{k}]"] ** 2 for k in (1, 2, 3))) * diameter(400), rel=1e-12
    )


def test_periodic_edges_go_on_across_the_box(tmp_path):
    """Values at centres of uneven cells: half a cell at either end of the box is between the last and the first."""
    centres = uneven(0.001, 0.0385, 12)
    rng = np.random.default_rng(3)
    u = rng.uniform(-3, 3, 12)
    write_field(tmp_path / "gas.vtk", (centres, FLAT, FLAT), np.stack([u, 0 * u, -u], axis=1))
    row = run(tmp_path, scene("gas.vtk")).dump()
    expected = np.interp(row["x"], centres, u, period=L)
    assert ((row["x"] < centres[0]) | (row["x"] > centres[-1])).sum() > 5
    assert np.abs(row[U] - expected).max() < 1e-13
    assert np.abs(row[W] + expected).max() < 1e-13


def test_clamped_edges_hold_the_outermost_values(tmp_path):
    x = np.array([0.01, 0.02, 0.03])
    write_field(tmp_path / "gas.vtk", (x, FLAT, FLAT), lambda x, y, z: (100 * x, 0 * x, 0 * x))
    row = run(tmp_path, scene("gas.vtk", "edge x clamp")).dump()
    assert row[U] == pytest.approx(100 * np.clip(row["x"], 0.01, 0.03), rel=1e-13)


def test_field_adds_to_velocity_and_profile(tmp_path):
    write_field(tmp_path / "gas.vtk", (FLAT, FLAT, FLAT), [1.0, 0, 2.0])
    (tmp_path / "profile.txt").write_text("0 0 0 10\n1 0 0 10\n")
    row = run(tmp_path, scene("gas.vtk", "velocity 100 0 200 profile profile.txt x")).dump()
    assert np.all(row[U] == 101.0) and np.all(row[W] == 212.0)


def test_uniform_field_is_uniform_gas(tmp_path):
    """Bit for bit, through a run in which clusters collide."""
    axes = uneven(0.0, 0.99 * L, 9), FLAT, uneven(0.0, 0.99 * L, 8)
    write_field(tmp_path / "gas.vtk", axes, lambda x, y, z: (0 * x + 0.1, 0 * x, 0 * x + 1 / 3))
    gust = "fluctuation 0.7 0 0.3 own 1e-4 5 plane xz"
    field = run(tmp_path, scene("gas.vtk", gust, steps=300)).dump()
    text = scene("gas.vtk", gust, steps=300).replace("field gas.vtk", f"velocity 0.1 0 {1 / 3!r}")
    uniform = run(tmp_path / "uniform", text).dump()
    assert all(np.array_equal(field[c], uniform[c]) for c in field)


# ---- order of interpolation ----

TAYLOR_GREEN = (16, 32, 64, 128)
ABC = (8, 16, 32, 64)


def vortices(x, y, z):
    """Taylor-Green."""
    k = 2 * np.pi / L
    return np.sin(k * x) * np.cos(k * z), 0 * x, -np.cos(k * x) * np.sin(k * z)


def abc(x, y, z):
    """Arnold-Beltrami-Childress with A = 1, B = 0.8, C = 0.6."""
    k = 2 * np.pi / L
    return (
        np.sin(k * z) + 0.6 * np.cos(k * y),
        0.8 * np.sin(k * x) + np.cos(k * z),
        0.6 * np.sin(k * y) + 0.8 * np.cos(k * x),
    )


@pytest.mark.parametrize("flow, sizes", [(vortices, TAYLOR_GREEN), (abc, ABC)])
def test_second_order_where_the_gas_is_smooth(tmp_path, flow, sizes):
    """Largest and root-mean-square error at 1500 clusters fall by four each time that the spacing is halved.

    The next term of the series, (k h)^2/12 with k h = 2 pi/n, is 5 % at n = 8 and 1 % at 16. What varies more is where
    clusters lie in the cells: 0.15 in the largest error's order, 0.05 in that of the mean.
    """
    solid = flow is abc
    script = "units si\natom_style sphere\natom_modify map hash sort 0 0\n"
    script += f"boundary p {'p' if solid else 'f'} p\ncomm_modify vel yes\nregion box block 0 {L} 0 {L if solid else 0.003} 0 {L}\n"
    script += "create_box 1 box\n"
    script += (
        f"create_atoms 1 random 1500 7 box overlap {diameter(3)!r} maxtry 1000\nset type 1 diameter {diameter(3)!r}\n"
        "set type 1 density 1000\n" if solid else random_clusters(1500, n=3)
    )  # fmt: skip
    script += pair()
    for n in sizes:
        x = np.arange(n) * L / n
        y = x if solid else FLAT
        write_field(tmp_path / f"{n}.vtk", (x, y, x if n % 32 else np.append(x, L)), flow)  # closed, and open
        script += DRAG.format(f"{n}.vtk", "") + f"run 0\n{write('f_drag[*]', 'y', name=f'{n}.dump')}unfix drag\n"
    done = run(tmp_path, script)
    largest, mean = [], []
    for n in sizes:
        row = done.dump(f"{n}.dump")
        error = np.stack([row[f"f_drag[{k}]"] for k in (1, 2, 3)]) - flow(row["x"], row["y"], row["z"])
        largest.append(np.abs(error).max())
        mean.append(np.sqrt((error**2).mean()))
        order = [np.log2(e[-2] / e[-1]) if len(e) > 1 else np.nan for e in (largest, mean)]
        print(f"{flow.__name__} {n:4d} {largest[-1]:.3e} {order[0]:5.2f} {mean[-1]:.3e} {order[1]:5.2f}")
    assert np.log2(np.divide(largest[:-1], largest[1:])) == pytest.approx(2.0, abs=0.15)
    assert np.log2(np.divide(mean[:-1], mean[1:])) == pytest.approx(2.0, abs=0.05)


# ---- time ----

TIMES = np.array([2e-5, 5e-5, 6e-5, 1.1e-4])
VALUES = np.array([1.0, -2.0, 3.0, 0.5])
WATCH = (
    "compute gas all reduce ave f_drag[3]\nvariable t equal time\nvariable w equal c_gas\n"
    'fix watch all print 1 "$(v_t:%.17g) $(v_w:%.17g)" append watch.txt screen no\n'
)


def write_series(folder, times=TIMES, values=VALUES, **options):
    for k, (t, w) in enumerate(zip(times, values, strict=True)):
        name = (3 * k + 1) % 7  # files in another order than their times
        write_field(folder / f"gas.{name}.vtk", (FLAT, FLAT, FLAT), [0, 0, w], time=float(t), **options)


def one(more: str = "", motion: str = "fix move all nve\n") -> str:
    return head() + clusters((400, (0.02, 0.02), (0.0, 0.0))) + pair() + motion + DRAG.format("gas.*.vtk", more) + WATCH


def watched(folder):
    return np.loadtxt(folder / "watch.txt").T


def test_linear_in_time_between_frames_and_held_beyond(tmp_path):
    """Through runs of no steps, runs with other time steps; to the rounding of times summed up: 1e-11."""
    write_series(tmp_path)
    run(tmp_path, one() + "timestep 1e-6\nrun 0\nrun 33\nrun 0\ntimestep 3e-6\nrun 20\ntimestep 1e-6\nrun 60\n")
    t, w = watched(tmp_path)
    assert t[0] == 0.0 and t[-1] == pytest.approx(1.53e-4) and len(t) >= 114
    assert np.abs(w - np.interp(t, TIMES, VALUES)).max() < 1e-11


@pytest.mark.parametrize("period", [1.2e-4, float(TIMES[-1] - TIMES[0])])
def test_loop_repeats_the_series(tmp_path, period):
    """From before its first frame to its third turn. Where the period is the series' own length it jumps at its end."""
    write_series(tmp_path)
    run(tmp_path, one(f"loop {period!r}") + "timestep 1e-6\nrun 360\n")
    t, w = watched(tmp_path)
    phase = (t - TIMES[0]) % period + TIMES[0]
    away = np.minimum(phase - TIMES[0], TIMES[0] + period - phase) > 1e-9  # from a jump
    expected = np.interp(phase, np.append(TIMES, TIMES[0] + period), np.append(VALUES, VALUES[0]))
    if period < 1.2e-4:
        expected = np.interp(phase, TIMES, VALUES)
    assert away.sum() > 350
    assert np.abs(w - expected)[away].max() < 1e-10


def test_time_is_the_engines(tmp_path):
    """reset_timestep, with and without the time keyword, before the fix is defined."""
    write_series(tmp_path)
    gas = DRAG.format("gas.*.vtk", "") + WATCH
    before = one().replace(gas, "") + "timestep 1e-6\nrun 10\n"
    run(tmp_path, before + "reset_timestep 0 time 4e-5\n" + gas + "run 20\n")
    t, w = watched(tmp_path)
    assert t[0] == pytest.approx(4e-5)
    assert np.abs(w - np.interp(t, TIMES, VALUES)).max() < 1e-11
    (tmp_path / "watch.txt").unlink()
    run(tmp_path, before + "reset_timestep 500\n" + gas + "run 20\n")  # LAMMPS counts the steps left out as done
    t, w = watched(tmp_path)
    assert t[0] == pytest.approx(5e-4) and np.all(w == VALUES[-1])


def test_changing_steps_of_step_control(tmp_path):
    write_series(tmp_path)
    control = "fix step all cluster/timestep 2e-6 stiffness 10.0 energy off\n"
    script = one(motion=control + "fix move all nve\n").replace(
        "fix watch", 'variable now equal dt\nfix dts all print 1 "$(v_now:%.17g)" append dt.txt screen no\nfix watch'
    )
    # two clusters that meet: the step shrinks where they would go through each other
    script = script.replace(clusters((400, (0.02, 0.02), (0.0, 0.0))), clusters(
        (3, (0.02, 0.02), (0.0, 60.0)), (3, (0.02, 0.0206), (0.0, -60.0))))  # fmt: skip
    run(tmp_path, script + "timestep 1e-6\nrun 100\n", check=False)
    t, w = watched(tmp_path)
    steps = np.loadtxt(tmp_path / "dt.txt")
    assert len(set(steps)) > 1
    assert np.abs(w - np.interp(t, TIMES, VALUES)).max() < 1e-11


def test_restart_in_the_middle_of_a_series(tmp_path):
    """Bit for bit that of a run cut there."""
    write_series(tmp_path)
    axes = np.linspace(0, L, 6)[:-1], FLAT, np.linspace(0, L, 8)[:-1]
    for k, t in enumerate(TIMES):
        write_field(tmp_path / f"flow.{k}.vtk", axes, lambda x, y, z, k=k: tuple((k + 1) * c for c in vortices(x, y, z)),
                    time=float(t))  # fmt: skip
    setup = head() + random_clusters(100) + pair()
    fixes = (
        "fix move all nve\n"
        + DRAG.format("../flow.*.vtk", "plane xz fluctuation .1 0 .1 own 3e-5 7")
        + "timestep 1e-6\n"
    )
    whole = run(tmp_path / "whole", setup + fixes + "run 40\nrun 40\n" + write("f_drag[*]")).dump()
    run(tmp_path / "half", setup + fixes + "run 40\nwrite_restart half.restart\n")
    again = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart ../half/half.restart\n"
        "neighbor 0.5e-3 bin\n" + fixes + "run 40\n" + write("f_drag[*]")
    )
    continued = run(tmp_path / "again", again).dump()
    assert np.ptp(whole[U]) > 1.0
    for column in whole:
        assert np.array_equal(whole[column], continued[column]), column


# ---- ranks ----


def write_flow(folder, n=41, times=(0.0, 1e-4, 3e-4)):
    x = np.arange(n) * L / n
    for k, t in enumerate(times):
        write_field(folder / f"flow.{k}.vtk", (x, FLAT, x), lambda x, y, z, k=k: tuple((k + 1) * c for c in vortices(x, y, z)),
                    time=t)  # fmt: skip


def test_same_on_any_number_of_ranks_while_they_are_balanced(tmp_path):
    """Clusters crowd at one side, so that the ranks' parts shift; to the rounding of contact sums in another order."""
    write_flow(tmp_path)
    squeeze = "variable far atom x>0.6*lx\ngroup far variable far\ndelete_atoms group far compress no\n"
    balance = "fix even all balance 40 1.0 shift xz 10 1.01\nthermo 20\nthermo_style custom step f_drag[5] f_even[3]\n"
    script = scene("../flow.*.vtk", "plane xz", steps=200, count=300).replace("fix move", squeeze + "fix move")
    script = script.replace("timestep", balance + "timestep")
    one, *others = [run(tmp_path / str(n), script, n) for n in (1, 2, 4)]
    a = one.dump()
    assert np.ptp(a[U]) > 2.0
    for other in others:
        b = other.dump()
        for c in ("x", "z", "vx", "vz", U, W):
            assert np.allclose(a[c], b[c], rtol=1e-11, atol=1e-13), c
    held = [line.split() for line in others[1].output.splitlines() if line.split()[:1] and line.split()[0].isdigit()]
    assert len({float(row[1]) for row in held if len(row) == 3}) > 1  # parts were read anew


@pytest.mark.parametrize("binary", [True, False])
def test_each_rank_holds_its_part(tmp_path, binary):
    """Points of its part of the box, the skin and one cell around, of two frames: bytes of the rank that holds most."""
    n = 160
    x = np.arange(n) * L / n
    for k in range(2):
        write_field(tmp_path / f"flow.{k}.vtk", (x, FLAT, x), vortices, time=k * 1e-3, binary=binary)
    script = scene("../flow.*.vtk", steps=2) + 'print "$(f_drag[5])" file bytes.txt\n'
    most, rows = {}, {}
    for ranks in (1, 4):
        rows[ranks] = run(tmp_path / str(ranks), script, ranks).dump()
        most[ranks] = float((tmp_path / str(ranks) / "bytes.txt").read_text())
    point = 2 * 3 * 8
    assert most[1] == point * (n + 1) ** 2
    skin = int(np.ceil(0.5e-3 / (L / n)))
    assert point * (n // 2) ** 2 <= most[4] <= point * (n // 2 + 2 * skin + 3) ** 2
    assert np.array_equal(rows[1][U], rows[4][U])


def test_clusters_that_leave_their_rank_between_rebuilds_find_their_gas(tmp_path):
    """Lists are never rebuilt: clusters fly over half of the box, each still with the rank that it began with."""
    write_field(tmp_path / "gas.vtk", (uneven(0, L, 30), FLAT, uneven(0, L, 30, seed=3)), linear)
    script = scene("../gas.vtk", f"{CLAMPED} law none", steps=100, count=60).replace(
        "fix move", "neigh_modify delay 10000 every 10000 check no\nvelocity all set 100 0 200\nfix move"
    )
    row = run(tmp_path / "4", script, 4).dump()
    x, z = row["x"] % L, row["z"] % L
    assert np.abs(row[U] - linear(x, 0, z)[0]).max() < 1e-12
    assert np.abs(row[W] - linear(x, 0, z)[2]).max() < 1e-12


def test_follows_a_box_that_changes(tmp_path):
    write_field(tmp_path / "gas.vtk", (uneven(0, L, 30), FLAT, uneven(0, L, 30, seed=3)), linear)
    script = scene("gas.vtk", CLAMPED, count=60).replace("run 0\n", "run 0\nchange_box all x scale 0.7 remap\nrun 0\n")
    row = run(tmp_path, script).dump()
    assert np.ptp(row["x"]) < 0.7 * L
    assert np.abs(row[U] - linear(row["x"], 0, row["z"])[0]).max() < 1e-13


# ---- what else a file may hold ----


def test_amplitude_of_the_fluctuation(tmp_path):
    """The file's amplitude, times the numbers of the command, times the same random numbers as without a file."""
    axes = uneven(0.0, L, 9), FLAT, FLAT
    write_field(tmp_path / "gas.vtk", axes, [0, 0, 2.0], fluctuation=lambda x, y, z: (100 * x, 0 * x, 1 + 0 * x))
    random = "fluctuation 0.5 0 2 own frozen 7"
    row = run(tmp_path, scene("gas.vtk", f"edge x clamp {random}")).dump()
    plain = run(tmp_path / "plain", scene("", random).replace("field", "velocity 0 0 2")).dump()
    assert row[U] == pytest.approx(100 * row["x"] * plain[U], rel=1e-12)
    assert row[W] == pytest.approx(plain[W], rel=1e-12)
    still = run(tmp_path / "still", scene("../gas.vtk", "edge x clamp")).dump()
    assert np.all(still[U] == 0.0) and np.all(still[W] == 2.0)


def rho(x):
    return 1.0 + 20 * x


def nu(x):
    return 1e-5 + 1e-3 * x


def test_density_and_viscosity_of_the_place(tmp_path):
    """In drag, Reynolds number and relaxation time, and in both gas terms of the size law. Stokes' drag in closed form."""
    axes = uneven(0.0, L, 9), FLAT, FLAT
    write_field(
        tmp_path / "gas.vtk", axes, [0, 0, 2.0], density=lambda x, y, z: rho(x), viscosity=lambda x, y, z: nu(x)
    )
    size = f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 0.0266 break no merge no\n"
    script = scene("gas.vtk", "edge x clamp law stokes plane xz").replace("timestep", size + "timestep")
    script = script.replace("run 0\n", "velocity all set 0 0 0.5\nrun 1\n").replace("f_drag[*]", "f_drag[*] f_size[*]")
    script = script.replace("timestep 1e-6", "timestep 1e-12")
    row = run(tmp_path, script).dump()
    x, d, slip = row["x"], diameter(400), 1.5
    # the time step of 1e-12 s and velocities of half a step: 1e-8
    assert row["f_drag[7]"] == pytest.approx(slip * d / nu(x), rel=1e-7)
    assert row["f_drag[8]"] == pytest.approx(400 * M_P / (3 * np.pi * rho(x) * nu(x) * d), rel=1e-10)
    assert row["f_size[4]"] == pytest.approx(3 * np.pi * rho(x) * nu(x) * D_P * slip * 2.0 / M_P, rel=1e-7)
    ar = 9.81 * D_P**3 * (RHO_P - rho(x)) / (rho(x) * nu(x) ** 2)
    u_mf = (np.sqrt(33.7**2 + 0.0408 * ar) - 33.7) * nu(x) / D_P  # Wen & Yu (1966)
    assert row["f_size[6]"] == pytest.approx((u_mf + 0.5 * 0.5 / 0.5) * 9.81, rel=1e-7)


# ---- together with what else holds or moves ----


def test_held_gas_and_the_pass_of_nve_cluster(tmp_path):
    """With refresh, drag by its own pass and drag taken along by nve/cluster are the same; at a refresh the gas is new."""
    write_flow(tmp_path)
    field = "../flow.*.vtk", "plane xz refresh 10"
    apart = scene(*field, steps=200).replace(
        "fix move all nve\n", "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
    )
    fused = scene(*field, steps=200).replace(
        "fix move all nve\n", "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag\n"
    )
    a, b = run(tmp_path / "apart", apart).dump(), run(tmp_path / "fused", fused).dump()
    for c in ("x", "z", "vx", "vz", U, W):
        assert np.allclose(a[c], b[c], rtol=1e-9, atol=1e-12), c
    # the last refresh was at step 200: the gas at the place and time of then, to the interpolation error 2 (k h)^2/8
    strength = 1 + np.interp(2e-4, [0, 1e-4, 3e-4], [0, 1, 2])
    assert np.abs(a[U] - strength * vortices(a["x"], 0, a["z"])[0]).max() < 3 * 2 * (2 * np.pi / 41) ** 2 / 8


def test_events_in_a_field(tmp_path):
    """Breaks and merges look at the field in the middle of a step; particles are kept; the same on two ranks."""
    write_flow(tmp_path)
    size = f"fix size all cluster/breakmerge 5 {D_P} {RHO_P} drag drag K 0.02 merge 0.2\n"
    script = scene("../flow.*.vtk", "velocity 0 0 2 plane xz", steps=100).replace("timestep", size + "timestep")
    script += 'print "$(f_size[1]) $(f_size[2]) $(f_size[3])" file events.txt\n'
    found = []
    for ranks in (1, 2):
        run(tmp_path / str(ranks), script, ranks)
        found.append(np.loadtxt(tmp_path / str(ranks) / "events.txt"))
    assert found[0][1] == 200 * 400 and found[0][2] > 20
    assert np.array_equal(*found)


# ---- bad input ----

GOOD = (np.linspace(0, L, 6)[:-1], FLAT, np.linspace(0, L, 6)[:-1])


def spoiled(**change):
    """A writer of gas.vtk with something wrong."""

    def write_it(folder):
        options = {"axes": GOOD, "velocity": [0, 0, 1.0], "binary": False} | change
        replacements = options.pop("replace", [])
        cut = options.pop("cut", None)
        write_field(folder / "gas.vtk", **options)
        data = (folder / "gas.vtk").read_bytes()
        for old, new in replacements:
            assert old.encode() in data
            data = data.replace(old.encode(), new.encode(), 1)
        (folder / "gas.vtk").write_bytes(data[:cut])

    return write_it


def not_finite(x, y, z):
    return 0 * x, 0 * x, np.where((x == GOOD[0][2]) & (z == GOOD[2][3]), np.nan, 1.0)


def frames(*times, **change):
    def write_it(folder):
        for k, t in enumerate(times):
            axes = change.get("axes", [GOOD] * len(times))[k]
            write_field(
                folder / f"gas.{k}.vtk", axes, [0, 0, 1.0], time=t, **change.get("arrays", [{}] * len(times))[k]
            )

    return write_it


def huge(folder):
    """A header that would ask for 16 GB."""
    (folder / "gas.vtk").write_text(
        "# vtk DataFile Version 3.0\nhuge\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2000000000 1 1\n"
        "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 2000000000\n"
    )


RHO = {"density": 1.2}
BAD = [
    (None, "gas.vtk", "field gas.vtk: the file cannot be opened"),
    (None, "*.vtk", "no file has such a name"),
    (None, "", "missing field FILE"),
    (spoiled(replace=[("# vtk DataFile", "<VTKFile type=")]), "gas.vtk", "not a legacy VTK file: its first line is '<VTKFile"),
    (spoiled(replace=[("3.0", "6.2")]), "gas.vtk", "version '6.2' of VTK's format: known are 1.0 to 5.1"),
    (spoiled(replace=[("RECTILINEAR", "STRUCTURED")]), "gas.vtk", "must be DATASET RECTILINEAR_GRID or STRUCTURED_POINTS"),
    (spoiled(replace=[("ASCII", "UTF8")]), "gas.vtk", "must be ASCII or BINARY"),
    (spoiled(replace=[("velocity double", "velocity int")]), "gas.vtk", "array velocity is of type int (must be float or double)"),
    (spoiled(binary=True, density=1.2, replace=[("density double", "remark complex")]), "gas.vtk",
     "array remark is of the unknown type complex"),
    (spoiled(replace=[("velocity double", "speed double")]), "gas.vtk", "no array velocity in POINT_DATA"),
    (spoiled(replace=[("POINT_DATA 25", "CELL_DATA 25")]), "gas.vtk", "array velocity is at cells (CELL_DATA)"),
    (spoiled(replace=[("POINT_DATA 25", "POINT_DATA 24")]), "gas.vtk", "'POINT_DATA 24' does not fit DIMENSIONS, which give 25"),
    (huge, "gas.vtk", "DIMENSIONS give more points than the file has bytes"),
    (spoiled(replace=[("DIMENSIONS 5", "DIMENSIONS -5")]), "gas.vtk", "-5 is no integer from 0 to 1e15"),
    (spoiled(binary=True, cut=-40), "gas.vtk", "the file ends within array velocity: 561 of 600 bytes"),
    (spoiled(cut=-9), "gas.vtk", "the file ends within array velocity: 71 of 75 numbers"),
    (spoiled(replace=[("VECTORS velocity double\n0", "VECTORS velocity double\nzero")]), "gas.vtk",
     "'zero' within array velocity is no number"),
    (spoiled(velocity=not_finite), "gas.vtk", "array velocity is nan at point 2 0 3, position 0.016 0 0.024 (must be finite)"),
    (spoiled(velocity=[0, np.inf, 0], binary=True), "gas.vtk", "array velocity is inf at point 0 0 0"),
    (spoiled(**{"density": 0.0}), "gas.vtk", "array density is 0 at point 0 0 0, position 0 0 0 (must be finite and > 0)"),
    (spoiled(**{"viscosity": -1.0}), "gas.vtk", "array viscosity is -1 at point"),
    (spoiled(**{"fluctuation": [1.0, 0, -2.0]}), "gas.vtk fluctuation 1 0 1 own frozen 3",
     "array fluctuation is -2 at point 0 0 0, position 0 0 0 (must be finite and >= 0)"),
    (spoiled(axes=(GOOD[0], FLAT, GOOD[2][::-1])), "gas.vtk", "Z_COORDINATES: plane 1 is at"),
    (spoiled(title="of m and s; SI units"), "gas.vtk UNITS",
     "says SI units, the units of this run are cgs"),
    (spoiled(axes=(GOOD[0] / 2, FLAT, GOOD[2])), "gas.vtk",
     "the box reaches from 0 to 0.04 along x, the field from 0 to 0.016, and no more than one spacing"),
    (spoiled(axes=(GOOD[0] * 2, FLAT, GOOD[2])), "gas.vtk", "the field is 0.064 long along x"),
    (spoiled(axes=(np.linspace(0, L, 6), FLAT, GOOD[2]), velocity=linear), "gas.vtk",
     "between the first and the last plane along x, which are one period of the box apart"),
    (spoiled(), "gas.vtk edge y periodic", "edge y periodic needs a box that is periodic along y"),
    (spoiled(), "gas.vtk edge w clamp", "field edge axis value: w (must be x | y | z)"),
    (spoiled(), "gas.vtk edge x open", "field edge value: open (must be periodic | clamp)"),
    (spoiled(), "gas.vtk loop 0", "field loop PERIOD value: 0 (must be a number > 0 [time])"),
    (spoiled(), "gas.vtk loop 1", "loop needs a series of at least two files"),
    (frames(0.0, 1.0, 2.0), "gas.*.vtk loop 1.5", "loop 1.5 [time] is shorter than the series, which lasts 2"),
    (frames(0.0, None), "gas.*.vtk", "gas.1.vtk: a frame of a series needs its time"),
    (frames(0.0, 1.0, 0.0), "gas.*.vtk", "gas.0.vtk and gas.2.vtk have the same TIME 0"),
    (frames(0.0, 1.0, axes=[GOOD, (GOOD[0], FLAT, GOOD[2][:-1])]), "gas.*.vtk",
     "gas.1.vtk: its grid along z is not that of gas.0.vtk: 4 planes from 0 to 0.024, not 5 from 0 to 0.032"),
    (frames(0.0, 1.0, arrays=[{}, RHO]), "gas.*.vtk", "array density is in this frame, not in gas.0.vtk alone"),
]  # fmt: skip


@pytest.mark.parametrize("make, words, message", BAD, ids=[m[:60] for *_, m in BAD])
def test_bad_input_is_named(tmp_path, make, words, message):
    if make:
        make(tmp_path)
    script = scene(words.replace(" UNITS", ""), count=20)
    if "UNITS" in words:
        script = script.replace("units        si", "units cgs")
    done = run(tmp_path, script, check=False)
    assert done.code != 0
    assert message in " ".join(done.output.split()), done.output[-600:]


def test_one_spacing_beyond_the_field_is_covered(tmp_path):
    """Values in centres of cells: the walls along y are half a cell beyond; along x with walls, too."""
    centres = (np.arange(10) + 0.5) * L / 10
    write_field(tmp_path / "gas.vtk", (centres, FLAT, centres), linear, title=TITLE)
    script = scene("gas.vtk", count=60).replace("boundary     p f p", "boundary f f f")
    row = run(tmp_path, script).dump()
    assert (
        np.abs(row[U] - linear(*np.clip([row["x"], 0 * row["x"], row["z"]], centres[0], centres[-1]))[0]).max() < 1e-13
    )


@pytest.mark.parametrize("np_", (1, 2))
@pytest.mark.parametrize(
    "times, said",
    [
        (
            (1e-5, 2e-5),
            ("time 0 of the run is before the series, which goes from 1e-05 to 2e-05: its first frame holds",),
        ),
        ((0.0, 2e-5), ("is after the series, which goes from 0 to 2e-05: its last frame holds",)),
        ((1e-5, 2e-5), ("is before the series", "is after the series")),
        ((0.0, 4e-5), ()),
    ],
)
def test_a_run_outside_of_the_series_is_told_once(tmp_path, times, said, np_):
    for k, t in enumerate(times):
        write_field(tmp_path / f"flow.{k}.vtk", ([0.0], FLAT, [0.0, L]), [0, 0, 1.0 + k], time=t)
    script = head() + random_clusters(20) + pair() + "fix move all nve\n" + DRAG.format("../flow.*.vtk", "edge z clamp")
    script += "timestep 1e-6\nrun 20\nrun 20\n"
    output = " ".join(run(tmp_path / "run", script, np_).output.split())
    for words in said:
        assert output.count(words) == 1, output[-1500:]
    assert output.count("of the run is") == (0 if not said else 1 if times[0] == 0.0 else 2)
