"""Haff's law: the granular temperature of a free dilute gas of inelastic spheres falls as 1/(1 + t/tau)^2."""

import numpy as np
import pytest
from verification_case import CONTACTS, FULL

COUNT, FRACTION, E = 5000, 0.05, 0.8
DIAMETER = 0.9283177667225557e-3
MASS = np.pi / 6 * DIAMETER**3 * 1000.0
CONTACT_TIME = np.pi * np.sqrt(0.5 * MASS / 10.0)


def cool(case, contact, speed, taus):
    """Time, T/T0 and tau of kinetic theory."""
    n = FRACTION / (np.pi / 6 * DIAMETER**3)
    g0 = (1 - 0.5 * FRACTION) / (1 - FRACTION) ** 3  # Carnahan & Starling (1969)
    rough = 6 / (4 * np.sqrt(np.pi) * n * DIAMETER**2 * g0 * speed * (1 - E**2))
    _, t, kinetic = case.run(contact=contact, speed=speed, duration=taus * rough).table("trace.txt").T
    temperature = 2 / 3 * kinetic / COUNT  # T [J]: m <v_x^2>
    rate = 4 * np.sqrt(np.pi) * n * DIAMETER**2 * g0 * np.sqrt(temperature[0] / MASS)
    return t, temperature / temperature[0], 6 / (rate * (1 - E**2)), rate


# contact model, start speed [m/s], tolerance: the theory's collisions are instants, and spheres that are in contact
# for 2 % of the time collide about 2 % less often. Slower spheres have shorter contacts beside their flights.
RUNS = [(contact, 0.05, 0.05) for contact in CONTACTS] + ([("gran/cluster", 0.005, 0.025)] if FULL else [])


@pytest.mark.parametrize("contact, speed, tolerance", RUNS)
def test_haff(case, contact, speed, tolerance):
    t, temperature, tau, rate = cool(case, contact, speed, 1.5)
    # 1/sqrt(T) is a straight line in t; its slope is the mean rate of cooling
    slope = np.sum(t * (temperature**-0.5 - 1)) / np.sum(t**2)
    name = f"{contact}, {rate * CONTACT_TIME:.1%} of the time in contact"
    case.check(f"{name}: tau [s]", tau, 1 / slope, rel=tolerance)
    case.check(f"{name}: T/T0 at 1.5 tau", (1 + t[-1] / tau) ** -2, temperature[-1], rel=2 * tolerance)


def test_figure(case):
    with case.figure() as axes:
        t, temperature, tau, _ = cool(case, "gran/cluster", 0.05, 6.0 if FULL else 0.5)
        axes.loglog(1 + t / tau, (1 + t / tau) ** -2, "k-", label="Haff")
        some = np.unique(np.geomspace(1, len(t) - 1, 30).astype(int))
        axes.loglog(1 + t[some] / tau, temperature[some], "o", label="engine, gran/cluster")
        axes.set(xlabel="1 + t/τ", ylabel="T / T0")
        axes.legend()
