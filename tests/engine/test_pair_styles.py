"""N_cc on top of every granular pair style: the power of the very forces that the pair style applies."""

import numpy as np
import pytest
from lammps_run import CUTOFF, head, random_clusters, run, write

DAMPED = "damping coeff_restitution"
GRANULAR = {
    "hooke, linear_history": f"hooke 10.0 0.3 tangential linear_history 8.57 1.0 0.33 {DAMPED}",
    "hooke, linear_nohistory": f"hooke 10.0 0.3 tangential linear_nohistory 1.0 0.33 {DAMPED}",
    "hertz, linear_nohistory": "hertz 1e5 50.0 tangential linear_nohistory 1.0 0.33",
    "hertz, mindlin": "hertz 1e5 50.0 tangential mindlin 1e5 1.0 0.33",
    "hertz/material, mindlin": "hertz/material 1.7e5 0.3 0.25 tangential mindlin NULL 1.0 0.33",
    "hertz/material, linear_history": f"hertz/material 1.7e5 0.3 0.25 tangential linear_history 8.57 1.0 0.33 {DAMPED}",
}
OVERLAY = f"pair_style hybrid/overlay {{}} zero {CUTOFF}\npair_coeff * * {{}}\npair_coeff * * zero\n"
STYLES = {name: f"pair_style granular\npair_coeff * * {text} cutoff {CUTOFF}\n" for name, text in GRANULAR.items()}
STYLES["gran/hooke"] = OVERLAY.format("gran/hooke 10.0 8.57 1000.0 500.0 0.33 1", "gran/hooke")
STYLES["gran/hooke/history"] = OVERLAY.format("gran/hooke/history 10.0 8.57 1000.0 500.0 0.33 1", "gran/hooke/history")
STYLES["gran/hertz/history"] = OVERLAY.format("gran/hertz/history 1e5 8e4 1e6 5e5 0.33 1", "gran/hertz/history")
STYLES["hybrid"] = (
    f"pair_style hybrid granular\npair_coeff * * granular {GRANULAR['hooke, linear_history']} cutoff {CUTOFF}\n"
)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("style", STYLES)
def test_n_cc_is_the_power_of_the_contact_forces(tmp_path, style, newton):
    """Contacts with history behind them; forces and N_cc of one instant (a run of 0 steps)."""
    script = (
        head(x=0.02, z=0.02, newton=newton)
        + random_clusters(150)
        + STYLES[style]
        + "variable u atom random(-3,3,5)\nvariable w atom random(-3,3,6)\nvelocity all set v_u 0 v_w\n"
        "fix move all nve/sphere\ntimestep 2e-6\nrun 150\n"
        "fix size all cluster/breakmerge 1 1e-4 2000 K 1 terms cc ncc 0.7 break no merge no\nrun 0\n"
        "compute pairs all property/local patom1 patom2 cutoff radius\n"
        "dump pairs all local 1 pairs.txt index c_pairs[1] c_pairs[2]\nrun 0\n" + write("f_size[5]")
    )
    r = run(tmp_path, script)
    row = r.dump()
    touching = np.loadtxt(tmp_path / "pairs.txt", skiprows=9, ndmin=2)[:, 1:].astype(int)
    pairs = np.unique(np.sort(touching, axis=1), axis=0)
    index = {int(k): i for i, k in enumerate(row["id"])}
    partners = {}
    for a, b in pairs:
        partners.setdefault(index[a], []).append(index[b])
        partners.setdefault(index[b], []).append(index[a])
    checked = 0
    for i in range(len(row["id"])):
        if i not in partners:
            assert row["f_size[5]"][i] == 0.0
        elif len(partners[i]) == 1:  # its force is that of its only contact
            j = partners[i][0]
            power = row["fx"][i] * (row["vx"][i] - row["vx"][j]) + row["fz"][i] * (row["vz"][i] - row["vz"][j])
            # forces and velocities are printed exactly; the sum rounds, more so where its terms cancel
            size = np.hypot(row["fx"][i], row["fz"][i]) * np.hypot(
                row["vx"][i] - row["vx"][j], row["vz"][i] - row["vz"][j]
            )
            assert abs(row["f_size[5]"][i] - 0.7 * abs(power) / row["mass"][i]) <= 1e-11 * size / row["mass"][i]
            checked += 1
    assert checked >= 10


def test_other_pair_styles_are_refused(tmp_path):
    script = (
        head()
        + random_clusters(5)
        + (
            "pair_style lj/cut 0.002\npair_coeff * * 1.0 1e-3\nfix move all nve\n"
            "fix size all cluster/breakmerge 1 1e-4 2000 K 1 terms cc\nrun 0\n"
        )
    )
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and "needs a granular pair style (granular or gran/*), but the pair style is lj/cut" in r.output
