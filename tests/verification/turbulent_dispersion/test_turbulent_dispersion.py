"""Dispersion of tracers by eddies of given lifetimes, against Taylor (1921) with the exact correlation of each kind."""

import numpy as np
import pytest

SIGMA2, T = 1.0 / 3.0, 1.0  # variance of a number uniform in [-1, 1]; lifetime
TRACERS = 10000

# WHERE PERIOD SEED OPTIONS of the fluctuation, and <x^2>(t) = 2 sigma^2 int_0^t (t - s) R(s) ds with its correlation R


def at_once(t):
    """Lifetimes all alike, all eddies born at t = 0: n whole gusts and the part of one, each a straight way."""
    n = np.floor(t / T + 1e-9)
    return SIGMA2 * (n * T**2 + (t - n * T) ** 2)


def staggered(t):
    """Lifetimes all alike at random phases: R = 1 - s/T up to T, then 0."""
    return SIGMA2 * np.where(t < T, t**2 - t**3 / (3 * T), T * (t - T / 3))


def taylor(t):
    """Exponential lifetimes: R = exp(-s/T), Taylor's own example."""
    return 2 * SIGMA2 * T * (t - T * (1 - np.exp(-t / T)))


KINDS = {
    "own field 11": at_once,
    "own 1.0 11": at_once,
    "own field 11 stagger": staggered,
    "own 1.0 11 stagger": staggered,
    "own field 11 exponential": taylor,
}


@pytest.mark.parametrize("gusts", KINDS)
def test_spread(case, gusts):
    trace = case.run(gusts=gusts, tracers=TRACERS).table("trace.txt")
    for moment in (0.5, 1.0, 2.5, 4.0):
        (row,) = trace[np.isclose(trace[:, 1], moment)]
        # 2 N squares of a nearly Gaussian number: their mean scatters by sqrt(2/(2 N)) = 1 %; four times that. The tracer
        # meets a gust within a step of its beginning: 0.01 s of 1 s, whose effect is below 1 % of the spread
        expected = float(KINDS[gusts](np.array(moment)))
        case.check(f"{gusts}: <x^2> at {moment} s [m^2]", expected, (row[2] + row[3]) / 2, rel=0.05)


def test_drift_in_a_profile(case):
    """Eddy models gather tracers where the amplitude is low (Thomson 1987). Here the velocity is a(z) f with f constant
    for a lifetime, so that the tracer's motion in the coordinate int dz/a is that of homogeneous turbulence: uniform
    there, its density goes as 1/a. a falls from 3/2 at half the height to 1/2 at the ends.
    """
    words = {"gusts": "own field 11 exponential", "height": 10.0, "shape": 0.5, "begin": "everywhere", "duration": 60.0}
    z = case.run(**words).dump()["z"]
    share = np.mean(np.abs(z - 5.0) < 2.5)
    # sqrt(0.37 * 0.63/10000) = 0.5 % of all; four times that
    case.check("amplitude 0.5 to 1.5: share in the middle half", float(np.log(1.5) / np.log(3)), share, abs=0.02)
    case.report("the same against tracers that stay mixed", 0.5, share)


def test_figure(case):
    with case.figure() as axes:
        t = np.linspace(0, 4, 200)
        for gusts, label in (
            ("own field 11", "lifetimes alike, at once"),
            ("own field 11 stagger", "alike, staggered"),
            ("own field 11 exponential", "exponential (Taylor 1921)"),
        ):
            trace = case.run(gusts=gusts, tracers=TRACERS).table("trace.txt")
            (line,) = axes.plot(trace[:, 1], (trace[:, 2] + trace[:, 3]) / 2, "o", ms=2, label=label)
            axes.plot(t, KINDS[gusts](t), color=line.get_color(), lw=1)
        axes.set(xlabel="time / lifetime", ylabel="⟨x²⟩ [m²]", title="points: engine; lines: exact")
        axes.legend(fontsize=7)
