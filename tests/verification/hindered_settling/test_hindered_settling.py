"""Hindered settling against Richardson & Zaki (1954): V = V_0 eps^n, V_0 the speed of one sphere."""

import literature_drag as drag
import numpy as np
import pytest
from scipy.optimize import brentq

RHO, G, D = 1.2, 9.81, 1e-4 * np.cbrt(800.0)
WEIGHT = np.pi / 6 * D**3 * 1000.0 * G
LAWS = {"wen/yu": drag.wen_yu, "difelice": drag.di_felice}
SOLIDS = (0.02, 0.1, 0.2, 0.4)
# kinematic viscosity; Richardson & Zaki's exponent by the Reynolds number of one sphere (creeping: 4e-7)
REGIMES = {"creeping": (1.0, 4.65), "Re 220": (1.53e-5, None), "Re 4000": (1e-6, 2.4)}


def alone(law, nu):
    """Speed of one sphere: weight = drag."""
    return brentq(lambda v: LAWS[law](v, D, nu, RHO, 1.0) - WEIGHT, 1e-8, 1e3, xtol=1e-16, rtol=1e-14)


def balance(law, nu, eps):
    """Speed in the vessel, V = eps slip: weight = drag + pressure gradient, which is drag/eps in all (model B)."""
    slip = brentq(lambda u: LAWS[law](u, D, nu, RHO, eps) / eps - WEIGHT, 1e-9, 1e3, xtol=1e-16, rtol=1e-14)
    return eps * slip


def exponent(re, given):
    """Richardson & Zaki: 4.65 below Re = 0.2, 4.4 Re^-0.1 from 1 to 500, 2.4 above."""
    return given if given else 4.4 * re**-0.1


def settle(case, law, solids, nu):
    expected = balance(law, nu, 1 - solids)
    result = case.run(law=law, solids=solids, nu=nu, fall=expected)
    return float(result.output.split("SETTLES ")[-1].split()[0])


@pytest.mark.parametrize("solids", SOLIDS)
@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("law", LAWS)
def test_settling(case, law, regime, solids):
    nu, given = REGIMES[regime]
    speed = settle(case, law, solids, nu)
    what = f"{law}, {regime}, solids {solids}: V [m/s]"
    # 20 relaxation times where drag is linear, 40 where it is quadratic: exp(-20) = 2e-9 of the speed is left
    case.check(what, balance(law, nu, 1 - solids), speed, rel=1e-8)
    v_0 = alone(law, nu)
    rz = v_0 * (1 - solids) ** exponent(v_0 * D / nu, given)
    case.report(f"{what}, Richardson-Zaki", rz, speed)
    if law == "wen/yu" and given == 4.65:
        # where drag is linear F/eps = 3 pi mu d slip eps^-3.65, so V = eps slip = V_0 eps^4.65; 0.15 Re^0.687 is 6e-6
        case.check(f"{what}, Richardson-Zaki n = 4.65", rz, speed, rel=1e-5)


def test_figure(case):
    with case.figure() as axes:
        eps = np.linspace(0.55, 1, 50)
        for regime, (nu, given) in REGIMES.items():
            v_0 = alone("wen/yu", nu)
            (line,) = axes.plot(eps, eps ** exponent(v_0 * D / nu, given), lw=1, label=f"{regime}: Richardson–Zaki")
            for law, mark in (("wen/yu", "o"), ("difelice", "x")):
                v = [settle(case, law, s, nu) / alone(law, nu) for s in SOLIDS]
                axes.plot(1 - np.array(SOLIDS), v, mark, color=line.get_color())
        axes.set(xlabel="voidage", ylabel="V / V of one sphere", title="o wen/yu, x difelice; cells, pressure yes")
        axes.legend(fontsize=7)
