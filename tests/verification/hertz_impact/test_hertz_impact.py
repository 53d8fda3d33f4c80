"""Chung & Ooi (2011), test 1: elastic normal impact of two identical spheres, Hertz."""

import numpy as np
import pytest
from scipy.special import gamma

RADIUS, SPEED = 0.01, 10.0
# name: E, nu, rho; largest overlap [m], largest force [N], contact time [s] as published
MATERIALS = {
    "glass": ((48e9, 0.20, 2800.0), (274.113e-6, 10.6969e3, 40.339e-6)),
    "limestone": ((20e9, 0.25, 2500.0), (368.304e-6, 7.1082e3, 54.201e-6)),
}


def hertz(e_mod, nu, rho):
    """Closed form of the elastic impact: largest overlap, largest force, contact time."""
    m, r, e_star, v = 2 / 3 * np.pi * RADIUS**3 * rho, RADIUS / 2, e_mod / (2 * (1 - nu**2)), 2 * SPEED
    depth = (15 * m * v**2 / (16 * np.sqrt(r) * e_star)) ** 0.4
    duration = 2 * depth / v * np.sqrt(np.pi) * gamma(1.4) / gamma(0.9)  # 2.943 depth/v
    return depth, 4 / 3 * e_star * np.sqrt(r) * depth**1.5, duration


def impact(case, e_mod, nu, rho):
    """Time, overlap, force and speed of one impact."""
    _, t, gap, force, speed = case.run(E=e_mod, nu=nu, rho=rho).table("trace.txt").T
    return t, 2 * RADIUS - gap, force, speed


@pytest.mark.parametrize("material", MATERIALS)
def test_overlap_force_and_time(case, material):
    properties, published = MATERIALS[material]
    assert hertz(*properties) == pytest.approx(published, rel=3e-5)  # the printed digits
    t, overlap, force, speed = impact(case, *properties)
    touching = np.flatnonzero(overlap > 0)
    first, last = touching[0], touching[-1]
    begin = t[first - 1] - overlap[first - 1] / (2 * SPEED)
    end = t[last + 1] + overlap[last + 1] / (2 * SPEED)
    # 4000 steps per contact: the peak lies within half a step of a sample, (pi/8000)^2 / 2 = 8e-8 below it
    case.check(f"{material}: largest overlap [m]", published[0], overlap.max(), rel=3e-5)
    case.check(f"{material}: largest force [N]", published[1], force.max(), rel=3e-5)
    case.check(f"{material}: contact time [s]", published[2], end - begin, rel=3e-5)
    case.check(f"{material}: rebound / approach speed", 1.0, speed[-1] / SPEED, rel=1e-6)


def test_figure(case):
    with case.figure() as axes:
        for name, (properties, published) in MATERIALS.items():
            t, overlap, force, _ = impact(case, *properties)
            (line,) = axes.plot(overlap * 1e6, force / 1e3, "-", label=f"{name}, engine")
            axes.plot(published[0] * 1e6, published[1] / 1e3, "o", color=line.get_color(), label="largest, closed form")
        axes.set(xlabel="overlap [µm]", ylabel="force [kN]", xlim=(0, None), ylim=(0, None))
        axes.legend()
