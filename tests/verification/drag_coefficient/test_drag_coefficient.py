"""Drag coefficient of Tran-Cong, Gay & Michaelides (2004) from the force on held clusters."""

import literature_drag as drag
import numpy as np
import pytest

RHO_G, NU = 1.2, 1.53e-5
DIAMETER = 1e-4 * np.cbrt(800.0)
VALUES = {  # law: C_D at Re = 1, 100, 1000
    "trancong 1 1": (27.6000, 1.09379, 0.46615),
    "trancong 0.8 1.1": (31.1270, 1.38548, 0.61216),
}


def curve(case, law, **variables):
    """Re and C_D of the clusters of one run."""
    row = case.run(law=law, **variables).dump("forces.dump")
    re = row["f_drag[7]"]
    return re, row["f_drag[6]"] / drag.sphere_drag(1.0, re * NU / DIAMETER, DIAMETER, RHO_G)


@pytest.mark.parametrize("law", VALUES)
def test_values(case, law):
    re, c_d = curve(case, law)
    for k, published in zip((0, 2, 3), VALUES[law], strict=True):
        assert re[k] == pytest.approx(10**k, rel=1e-12)
        case.check(f"{law}: C_D at Re = {10**k}", published, c_d[k], rel=1.1e-5)  # the printed digits


PARAMETERS = [(1.0, 1.0), (0.8, 1.1), (0.4, 1.5)]


@pytest.mark.parametrize("parameters", PARAMETERS)
def test_whole_range(case, parameters):
    """Over the range of the fit, against the formula as written here."""
    law = "trancong {} {}".format(*parameters)
    re, c_d = curve(case, law, lowest=0.15, highest=1500, count=200)
    worst = np.abs(c_d / drag.tran_cong_cd(re, *parameters) - 1).max()
    case.check(f"{law}: largest error of C_D, 0.15 < Re < 1500", 0.0, worst, abs=2e-10)  # the table's bound


def test_figure(case):
    re = np.geomspace(0.15, 1500, 200)
    with case.figure() as axes:
        for c, ratio in PARAMETERS:
            (line,) = axes.loglog(re, drag.tran_cong_cd(re, c, ratio), label=f"c = {c}, d_A/d_n = {ratio}")
            dots = curve(case, f"trancong {c} {ratio}", lowest=0.15, highest=1500, count=20)
            axes.loglog(*dots, "o", color=line.get_color())
        axes.set(xlabel="Re", ylabel="C_D", title="lines: formula, dots: engine")
        axes.legend()
