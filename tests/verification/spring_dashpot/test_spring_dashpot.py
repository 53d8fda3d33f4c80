"""Contact time and rebound of a linear spring-dashpot pair against the closed form."""

import numpy as np
import pytest
from linear_contact import LinearContact
from verification_case import CONTACTS

K, SPEED, DIAMETER, DENSITY = 10.0, 0.1, 0.9283177667225557e-3, 1000.0
M_EFF = 0.5 * np.pi / 6 * DENSITY * DIAMETER**3


def collide(case, **variables):
    """(contact time, rebound over approach speed, t since contact, overlap) of one collision."""
    _, t, gap, slip = case.run(**variables).table("trace.txt").T
    overlap = DIAMETER - gap
    touching = np.flatnonzero(overlap > 0.0)
    first, last = touching[0], touching[-1]

    def crossing(k):  # free flight before and after: the distance is linear in time next to the crossing
        return t[k] - overlap[k] * (t[k + 1] - t[k]) / (overlap[k + 1] - overlap[k])

    begin, end = crossing(first - 1), crossing(last)
    return end - begin, slip[-1] / -slip[0], t - begin, overlap


@pytest.mark.parametrize("contact", CONTACTS)
def test_contact_time_and_rebound(case, contact):
    for e in (0.01, 0.3, 0.9, 1.0):
        closed = LinearContact(K, M_EFF, e)
        t_c, rebound, _, _ = collide(case, contact=contact, e=e)
        case.check(f"{contact}, e = {e}: contact time [s]", closed.free_duration, t_c, rel=4e-4)
        case.check(f"{contact}, e = {e}: rebound / approach speed", e, rebound, abs=3e-4)


def test_limit_of_a_dashpot_that_swallows_everything(case):
    """E -> 0: rebound -> 0 and the contact lasts ever longer, as ln(1/e)."""
    e = 1e-4
    closed = LinearContact(K, M_EFF, e)
    t_c, rebound, _, _ = collide(case, e=e)
    # it parts at 20 um/s: 0.07 nm of overlap, 2e-6 of the largest, is 0.25 % of the contact time
    case.check(f"granular, e = {e}: contact time [s]", closed.free_duration, t_c, rel=5e-3)
    case.check(f"granular, e = {e}: rebound / approach speed", e, rebound, abs=3e-4)


def test_zero_restitution_is_beyond_the_formula(case):
    """Ln 0: stock `granular` takes e = 0, says nothing, and its velocities are no numbers from the contact on."""
    slip = case.run(e=0).table("trace.txt")[:, 3]
    assert np.isfinite(slip[0]) and np.isnan(slip[-1])


def test_zero_restitution_is_critical_damping_in_gran_cluster(case):
    """E -> 0 in the formula of eta is damping ratio 1: overlap v t exp(-omega_0 t), the pair never parts."""
    _, t, gap, slip = case.run(contact="gran/cluster", e=0, duration=4e-3).table("trace.txt").T
    omega = np.sqrt(K / M_EFF)
    since = t - (gap[0] - DIAMETER) / (2 * SPEED)
    expected = np.where(since > 0, 2 * SPEED * since * np.exp(-omega * since), 2 * SPEED * since)
    worst = np.abs(DIAMETER - gap - expected).max() / expected.max()
    case.check("gran/cluster, e = 0: largest error of overlap / largest overlap", 0.0, worst, abs=1e-3)
    case.check("gran/cluster, e = 0: speed left after 4 ms / approach speed", 0.0, slip[-1] / slip[0], abs=1e-6)


def test_figure(case):
    with case.figure() as axes:
        for e in (0.01, 0.3, 0.9, 1.0):
            closed = LinearContact(K, M_EFF, e)
            _, _, t, overlap = collide(case, e=e)
            inside = (t > 0) & (t < closed.free_duration)
            (line,) = axes.plot(t[inside] * 1e3, closed.overlap(t[inside], 2 * SPEED) * 1e6, "-")
            some = slice(None, None, 400)
            axes.plot(t[inside][some] * 1e3, overlap[inside][some] * 1e6, "o", color=line.get_color(), label=f"e = {e}")
        axes.set(xlabel="time since contact [ms]", ylabel="overlap [µm]", title="lines: closed form, dots: engine")
        axes.legend()
