"""The case inputs as users run them (short)."""

import numpy as np
import pytest
from lammps_run import M_P, ROOT, run, run_file

INPUTS = ROOT / "inputs"


def case(folder, name, np_=1, **variables):
    folder.mkdir(parents=True, exist_ok=True)
    variables = {"inputs": INPUTS, "tend": 2e-4, "digits": 17, **variables}
    return run_file(folder, ["-in", str(INPUTS / f"{name}.in"), "-log", f"{name}.log"], np_, **variables)


@pytest.mark.parametrize("name, particles", [("case1", 2_000_000), ("case2", 3_100_000), ("case3", 3_100_000)])
@pytest.mark.parametrize("reading", ["A", "B", "C", "E", "F", "free"])
def test_runs(tmp_path, name, particles, reading):
    r = case(tmp_path, name, reading=reading)
    first, last = r.dump(f"{name}.00000000.dump"), r.dump(f"{name}.00000200.dump")
    assert list(first)[:11] == "id x y z vx vy vz diameter mass n l".split()
    assert first["n"].tolist() == [400] * (particles // 400)
    assert last["n"].sum() == particles and last["mass"].sum() == pytest.approx(particles * M_P, rel=1e-12)
    assert np.all(last["y"] == 0.0015)
    table = r.table(f"{name}.N.txt")
    assert table[0, 1] == 0.0 and table[-1, 1] == pytest.approx(2e-4) and np.all(table[:, 3] == particles)
    assert (tmp_path / f"{name}.restart").stat().st_size > 0


@pytest.mark.parametrize("setting, steps", [("careful", 300), ("standard", 300), ("fast", 60)])
def test_settings(tmp_path, setting, steps):
    """Breaks of the first check, after 0.25 ms at most, do not hang on the setting."""
    r = case(tmp_path, "case1", setting=setting, tend=3e-4)
    assert r.table("case1.N.txt")[-1, 0] == steps and r.dump(f"case1.{steps:08d}.dump")["n"].sum() == 2_000_000
    assert 5500 < len(r.dump(f"case1.{steps:08d}.dump")["n"]) < 6000


def test_sheared_crowd(tmp_path):
    """Contacts decide a good part of its breakups; the table names each of its columns."""
    r = case(tmp_path, "shear", tend=2e-3, dt=2e-6, every=10)
    first, last = r.dump("shear.00000000.dump"), r.dump("shear.00001000.dump")
    assert first["n"].tolist() == [400] * 2000 and last["n"].sum() == 800_000
    gas = 1 + 2 * np.abs(first["x"] - 0.03) / 0.03
    assert first["vz"] == pytest.approx(gas, abs=1e-12)
    assert np.abs(first["ug_z"] - gas).max() <= 0.75 + 1e-12
    names = (tmp_path / "shear.N.txt").read_text().splitlines()[1].split()[1:]
    end = dict(zip(names, r.table("shear.N.txt")[-1], strict=True))
    assert end["breakups"] > 100 and end["breakups_by_cc"] > 0.1 * end["breakups"]


def test_other_contact_laws(tmp_path):
    for law in ("hertz", "md"):
        assert (
            case(tmp_path / law, "case1", contact=law, atoms="sphere", motion="nve")
            .dump("case1.00000200.dump")["n"]
            .sum()
            == 2_000_000
        )


def test_controlled_step_changes_nothing_where_nothing_is_rejected(tmp_path):
    """The largest step is the fixed one: the same clusters to the bit."""
    fixed = case(tmp_path / "fixed", "case1", contact="md").dump("case1.00000200.dump")
    controlled = case(tmp_path / "controlled", "case1", contact="md", step="controlled").dump("case1.00000200.dump")
    assert all(np.array_equal(fixed[c], controlled[c]) for c in fixed)


def test_same_events_on_two_ranks(tmp_path):
    one, two = (case(tmp_path / str(n), "case1", np_=n, tend=5e-4).table("case1.N.txt") for n in (1, 2))
    assert np.array_equal(one[:, 2:7], two[:, 2:7]) and one[-1, 4] > 100


def test_replicas(tmp_path):
    r = case(tmp_path, "case3", nx=2, nz=1, tend=2e-5)
    last = r.dump("case3.00000020.dump")
    assert last["n"].sum() == 2 * 3_100_000 and last["x"].max() > 0.5
    s = 2 * np.abs(last["x"] / 0.3 - np.floor(last["x"] / 0.3) - 0.5)
    assert np.abs(last["ug_z"] - (8 - 9 * s**2)).max() <= 0.75 + 1e-12


def test_start_is_the_local_gas_velocity_without_overlaps(tmp_path):
    first = case(tmp_path, "case3", tend=1e-6).dump("case3.00000000.dump")
    s = np.abs(first["x"] - 0.15) / 0.15
    assert first["vz"] == pytest.approx(8 - 9 * s**2, abs=1e-12)
    order = np.argsort(first["x"])
    x, z, d = first["x"][order], first["z"][order], first["diameter"][0]
    for shift in range(1, 60):  # neighbours in x order are the only ones that could overlap
        dx, dz = x[shift:] - x[:-shift], np.abs(z[shift:] - z[:-shift])
        assert (
            np.hypot(dx, np.minimum(dz, 0.6 - dz))[dx < d].size == 0
            or np.hypot(dx, np.minimum(dz, 0.6 - dz))[dx < d].min() >= d
        )


def test_plugin_survives_clear(tmp_path):
    script = "units si\natom_style sphere\nclear\nunits si\natom_style sphere\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\nfix d all drag/cluster 1 1\n"
    run(tmp_path, script)
