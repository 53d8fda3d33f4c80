"""MFiX DEM06: a sphere released at rest in rising air, Schiller & Naumann's drag through fix drag/cluster."""

import numpy as np
from scipy.integrate import solve_ivp
from verification_case import FULL

D, RHO, RHO_G, NU, GAS, G = 1e-4, 2000.0, 1.2, 1.5e-5, 0.4, 9.80665
PUBLISHED = {0.01: -0.01255261, 0.05: -0.04078891, 0.10: -0.05263133, 0.20: -0.05701037, 0.35: -0.05739251}


def acceleration(_, state):
    """Equation of motion, written from the published problem."""
    slip = GAS - state[1]
    re = abs(slip) * D / NU
    c_d = 24 / re * (1 + 0.15 * re**0.687)
    return state[1], 0.75 * c_d * RHO_G / RHO * abs(slip) * slip / D - G * (1 - RHO_G / RHO)


def test_velocity_and_height(case):
    dt = 1e-6 if FULL else 1e-5
    _, t, z, w = case.run(dt=dt).table("trace.txt").T
    for time, velocity in PUBLISHED.items():
        k = int(np.argmin(np.abs(t - time)))
        assert abs(t[k] - time) < 1e-9
        # drag at half-step velocities: first order, dt/(2 tau) = 1e-4 at dt = 1e-5 s
        case.check(f"velocity at {time} s [m/s]", velocity, w[k], rel=2e-4 * dt / 1e-5)
    case.check("height at 0.35 s [m]", 0.07472122, z[-1], rel=5e-6 * dt / 1e-5)


def test_published_values_follow_from_the_equation():
    """The reference itself, integrated here to 1e-12."""
    path = solve_ivp(acceleration, (0, 0.35), (0.0925, 0.0), rtol=1e-12, atol=1e-14, t_eval=sorted(PUBLISHED))
    assert np.allclose(path.y[1], [PUBLISHED[t] for t in sorted(PUBLISHED)], rtol=2e-7)


def test_figure(case):
    _, t, _, w = case.run().table("trace.txt").T
    fine = np.linspace(0, 0.35, 200)
    path = solve_ivp(acceleration, (0, 0.35), (0.0925, 0.0), rtol=1e-10, atol=1e-12, t_eval=fine)
    with case.figure() as axes:
        axes.plot(fine, path.y[1] * 1e3, "k-", label="equation of motion")
        axes.plot(t, w * 1e3, "o", label="engine")
        axes.plot(list(PUBLISHED), np.array(list(PUBLISHED.values())) * 1e3, "x", color="C3", ms=7, label="published")
        axes.set(xlabel="time [s]", ylabel="velocity [mm/s]")
        axes.legend()
