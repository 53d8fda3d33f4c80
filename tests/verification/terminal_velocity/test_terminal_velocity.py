"""Terminal velocity of clusters under each drag law, against weight = drag solved for the velocity."""

import literature_drag as drag
import numpy as np
import pytest
from scipy.optimize import brentq

RHO_G, NU, G = 1.2, 1.53e-5, 9.81
SIZES = [3, 400, 2000]
# the words of fix drag/cluster, the law from the literature, its parameters
LAWS = {
    "stokes": (drag.stokes, ()),
    "schiller/naumann": (drag.schiller_naumann, ()),
    "wen/yu 0.9": (drag.wen_yu, (0.9,)),
    "difelice 0.9": (drag.di_felice, (0.9,)),
    "trancong 0.8 1.1": (drag.tran_cong, (0.8, 1.1)),
    "trancong 1 1": (drag.tran_cong, (1.0, 1.0)),
}


def diameter(n):
    return 1e-4 * np.cbrt(2.0 * n)


def terminal(law, n):
    force, parameters = LAWS[law]
    d = diameter(n)
    weight = n * np.pi / 6 * 1e-12 * 2000.0 * G
    return brentq(lambda v: force(v, d, NU, RHO_G, *parameters) - weight, 1e-6, 1e4, xtol=1e-14, rtol=1e-14)


@pytest.mark.parametrize("law", LAWS)
def test_terminal_velocity(case, law):
    last = case.run(law=law).table("trace.txt")[-1]
    for n, velocity in zip(SIZES, last[2:], strict=True):
        # the balance is reached to exp(-200 s / tau), tau <= 7.6 s; the law's table is good to 1e-10
        tolerance = 1e-9
        case.check(f"{law}, {n} particles: velocity [m/s]", -terminal(law, n), velocity, rel=tolerance)


def test_without_drag_it_falls_freely(case):
    last = case.run(law="none", duration=1.0).table("trace.txt")[-1]
    case.check("none: velocity after 1 s [m/s]", -G, last[3], rel=1e-12)


def test_figure(case):
    with case.figure() as axes:
        for law in ("stokes", "schiller/naumann", "wen/yu 0.9", "difelice 0.9", "trancong 0.8 1.1"):
            trace = case.run(law=law, duration=3.0).table("trace.txt")
            (line,) = axes.plot(trace[:, 1], -trace[:, 3], label=law)
            axes.axhline(terminal(law, 400), color=line.get_color(), ls="--", lw=0.7)
        axes.set(
            xlabel="time [s]", ylabel="falling speed, 400 particles [m/s]", ylim=(0, 6), title="dashed: weight = drag"
        )
        axes.legend(fontsize=7)
