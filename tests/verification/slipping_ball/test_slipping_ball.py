"""MFiX DEM04: a ball that slides on a rough plate until it rolls; end-of-slip values for every mu."""

import numpy as np
import pytest
from verification_case import CONTACTS

V0, G = 0.1, 9.80665
FRICTION = [0.1, 0.2, 0.3, 0.5, 0.7, 1.0]


def slide(case, mu, **variables):
    """Time, velocity and R omega of a run that goes on for half as long as the slip lasts."""
    return case.run(mu=mu, duration=1.5 * 2 / 7 * V0 / (mu * G), **variables).table("trace.txt")[:, 1:].T


def end_of_slip(t, v, rolling):
    """Time, velocity and R omega at the moment when the contact point comes to rest."""
    slip = v - rolling
    k = np.flatnonzero(slip <= 0.0)[0]
    share = slip[k - 1] / (slip[k - 1] - slip[k])
    return [series[k - 1] + share * (series[k] - series[k - 1]) for series in (t, v, rolling)]


# how the plate is made, and which tangential model of gran/cluster
PLATES = (
    [{"contact": "wall"}]
    + [{"contact": name} for name in CONTACTS if name == "granular"]
    + [
        {"contact": name, "tangential": model}
        for name in CONTACTS
        if name == "gran/cluster"
        for model in ("md", "linear")
    ]
)


@pytest.mark.parametrize("plate", PLATES, ids=lambda plate: " ".join(plate.values()))
def test_end_of_slip(case, plate):
    name = " ".join(plate.values())
    for mu in FRICTION:
        t, v, rolling = end_of_slip(*slide(case, mu, **plate))
        # the spring loads over mu m g/k_t, 1e-6 of the slide; the large sphere bends by 5e-5 over it,
        # which adds up to mu^-1 times that to the pull of gravity along it (mu = 0.1: 3e-4)
        case.check(f"{name}, mu = {mu}: mu g t / v0", 2 / 7, mu * G * t / V0, rel=5e-4)
        case.check(f"{name}, mu = {mu}: v / v0 = R omega / v0", 5 / 7, v / V0, rel=5e-4)
        assert rolling == pytest.approx(v, rel=1e-9)


@pytest.mark.parametrize("plate", PLATES, ids=lambda plate: " ".join(plate.values()))
def test_rolls_on(case, plate):
    """After the slip the velocity stays: a ball that rolls on a plate feels no friction (on the mean)."""
    t, v, rolling = slide(case, 0.3, **plate)
    late = t > 1.1 * 2 / 7 * V0 / (0.3 * G)
    case.check(f"{' '.join(plate.values())}, mu = 0.3: mean v / v0 while rolling", 5 / 7, v[late].mean() / V0, rel=5e-4)
    case.check(
        f"{' '.join(plate.values())}, mu = 0.3: mean R omega / v0 while rolling",
        5 / 7,
        rolling[late].mean() / V0,
        rel=5e-4,
    )


def test_figure(case):
    with case.figure() as axes:
        axes.plot([0, 2 / 7, 3 / 7], [1, 5 / 7, 5 / 7], "k-", label="closed form")
        axes.plot([0, 2 / 7, 3 / 7], [0, 5 / 7, 5 / 7], "k-")
        for mu, mark in ((0.1, "o"), (0.3, "s"), (1.0, "^")):
            t, v, rolling = slide(case, mu)
            some = slice(None, None, len(t) // 20)
            axes.plot(mu * G * t[some] / V0, v[some] / V0, mark, color="C0", label=f"v / v0, µ = {mu}")
            axes.plot(mu * G * t[some] / V0, rolling[some] / V0, mark, color="C1", label=f"R ω / v0, µ = {mu}")
        axes.set(xlabel="µ g t / v0")
        axes.legend(ncols=2, fontsize=7)
