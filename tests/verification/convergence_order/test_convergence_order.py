"""Order of convergence in the time step: inside a contact, across its entry and exit, with damping, with friction."""

import numpy as np
import pytest
from linear_contact import LinearContact
from matplotlib.ticker import NullFormatter
from verification_case import CONTACTS, FULL

K, DIAMETER, SLIP = 10.0, 0.9283177667225557e-3, 0.2
M_EFF = 0.5 * np.pi / 6 * DIAMETER**3 * 1000.0
STEPS = (25, 50, 100, 200, 400) if FULL else (25, 100, 400)
INSIDE = {"gap": -1e-5, "time": 1.5e-4}  # from 10 um of overlap to just past the deepest point
PAIRS = 24  # side by side, so that contact begins at 24 places within a step
WHOLE = 8e-4  # from before the contact to after it, at any e [s]; a contact lasts 4.5 to 4.9e-4 s


def order(steps, errors):
    """Slope of log error over log dt."""
    return -np.polyfit(np.log(steps), np.log(errors), 1)[0]


def inside_error(case, contact, e, steps):
    """Relative error of the overlap at the end of a run that begins and ends within the contact."""
    row = case.run(contact=contact, e=e, steps=steps, **INSIDE).dump()
    closed = LinearContact(K, M_EFF, e).overlap(INSIDE["time"], SLIP, -INSIDE["gap"])
    return abs(DIAMETER - (row["x"][1] - row["x"][0]) - closed) / closed


def rebounds(case, steps, more=None, **variables):
    """Slip of the pairs [approach speed] and their spin [the same, of the surface], one row per pair."""
    more = SLIP * WHOLE / steps / PAIRS if more is None else more
    row = case.run(steps=steps, gap=2e-6, pairs=PAIRS, more=f"{more:.8e}", time=WHOLE, **variables).dump()
    slip = [(row[v][1::2] - row[v][::2]) / SLIP for v in ("vx", "vz")]
    return np.array([*slip, DIAMETER * row["omegay"][::2] / SLIP]).T


def rms(differences):
    return float(np.sqrt(np.mean(np.sum(np.square(differences), axis=-1))))


def collision_error(case, contact, e, steps):
    """Error of the rebound speed over the approach speed: root mean square over where in a step contact begins."""
    return rms(rebounds(case, steps, contact=contact, e=e)[:, :1] - e)


@pytest.mark.parametrize("contact", CONTACTS)
def test_inside_the_contact(case, contact):
    for e, expected in ((1.0, 2.0), (0.3, 1.0)):
        errors = [inside_error(case, contact, e, steps) for steps in STEPS]
        case.check(f"{contact}, e = {e}: order inside a contact", expected, order(STEPS, errors), abs=0.1)
        case.report(
            f"{contact}, e = {e}: error inside a contact at dt = {INSIDE['time'] / STEPS[-1]:.1e} s",
            0.0,
            errors[-1],
            relative=False,
        )


COLLISION_STEPS = (50, 100, 200, 400, 800) if FULL else (50, 400)


@pytest.mark.parametrize("contact", CONTACTS)
def test_whole_collision(case, contact):
    for e, expected in ((1.0, 2.0), (0.3, 1.0)):
        errors = [collision_error(case, contact, e, n) for n in COLLISION_STEPS]
        case.check(f"{contact}, e = {e}: order of the rebound speed", expected, order(COLLISION_STEPS, errors), abs=0.2)
        for n, error in zip(COLLISION_STEPS, errors, strict=True):
            density = f"{4.5e-4 / WHOLE * n:.0f} steps a contact"
            case.report(f"{contact}, e = {e}: error of rebound / approach speed, {density}", 0.0, error, relative=False)


@pytest.mark.parametrize("contact", CONTACTS)
def test_oblique_collision_with_friction(case, contact):
    """Rebound velocity and spin of an oblique collision, against the same with 16 times finer steps."""
    steps = (100, 200, 400, 800, 1600) if FULL else (100, 1600)
    for e, expected in ((1.0, 2.0), (0.3, 1.0)):
        errors = []
        for n in steps:
            same = {"more": SLIP * WHOLE / n / PAIRS, "contact": contact, "e": e, "mu": 0.33, "offset": 5e-4}
            errors.append(rms(rebounds(case, n, **same) - rebounds(case, 16 * n, **same)))
        name, density = f"{contact}, e = {e}, mu = 0.33", f"{4.5e-4 / WHOLE * steps[0]:.0f} steps a contact"
        # sticking and sliding follow each other at other instants for each pair: the errors scatter
        case.check(f"{name}: order of an oblique rebound", expected, order(steps, errors), abs=0.4)
        case.report(f"{name}: error of an oblique rebound, {density}", 0.0, errors[0], relative=False)


def test_figure(case):
    with case.figure(2) as (left, right):
        steps = np.array(STEPS)
        for e, mark in ((1.0, "o"), (0.3, "s")):
            for contact, line in zip(CONTACTS, ("-", ":"), strict=True):
                left.loglog(
                    INSIDE["time"] / steps,
                    [inside_error(case, contact, e, n) for n in STEPS],
                    mark + line,
                    mfc="none",
                    label=f"{contact}, e = {e}",
                )
                right.loglog(
                    WHOLE / np.array(COLLISION_STEPS),
                    [collision_error(case, contact, e, n) for n in COLLISION_STEPS],
                    mark + line,
                    mfc="none",
                    label=f"{contact}, e = {e}",
                )
        left.set(xlabel="dt [s]", ylabel="relative error of the overlap", title="inside a contact")
        right.set(xlabel="dt [s]", ylabel="error of rebound / approach speed", title="whole collision")
        left.xaxis.set_minor_formatter(NullFormatter())
        left.legend(fontsize=7)
