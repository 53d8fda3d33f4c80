"""MFiX DEM01 (fall, contact, rebound of a ball on a plate) and DEM02 (heights of its bounces)."""

import numpy as np
import pytest
from linear_contact import LinearContact
from verification_case import CONTACTS, FULL

R, H0, G, DENSITY = 0.1, 0.5, 9.80665, 2600.0
MASS = 4 / 3 * np.pi * R**3 * DENSITY
PLATES = ["wall", *CONTACTS]


def touchdown(t, z, w):
    """Time and velocity at which a flight from (t, z, w) ends, the centre at z = R."""
    v = np.sqrt(w**2 + 2 * G * (z - R))
    return t + (w + v) / G, -v


@pytest.mark.parametrize("plate", PLATES)
def test_dem01_fall_contact_rebound(case, plate):
    _, t, z, w = case.run(contact=plate).table("trace.txt").T
    first = np.flatnonzero(z < R)[0]
    t1, v1 = touchdown(t[first - 1], z[first - 1], w[first - 1])
    # free fall is exact with velocity Verlet: rounding alone
    case.check(f"DEM01, {plate}: time of contact [s]", 0.285617, t1, rel=2e-6)
    case.check(f"DEM01, {plate}: velocity at contact [m/s]", -2.800950, v1, rel=1e-6)

    closed = LinearContact(1e4, MASS, 0.9, G)
    length, rebound = closed.duration(-v1), closed.rebound(-v1)
    inside = (t > t1) & (t < t1 + length)
    depth = np.abs((R - z[inside]) - closed.overlap(t[inside] - t1, -v1)).max()
    case.check(f"DEM01, {plate}: largest error of overlap / largest overlap", 0.0, depth / (R - z).max(), abs=2e-4)
    after = np.flatnonzero(t > t1 + length + 1e-3)[0]
    last = np.sqrt(w[after] ** 2 + 2 * G * (z[after] - R))
    case.check(f"DEM01, {plate}: velocity of rebound [m/s]", rebound, last, rel=2e-4)


def apexes(t, z, w):
    """Height of the centre at the top of each flight after the first contact (energy, exact in flight)."""
    top = np.where(z > R, z + w**2 / (2 * G), np.nan)
    starts = np.flatnonzero((z[1:] > R) & (z[:-1] <= R)) + 1
    return top[starts[starts + 2 < len(top)] + 2]


def closed_heights(k: float, e: float, count: int):
    """The same by the closed form of each contact under gravity."""
    heights, height = [], H0
    for _ in range(count):
        v = LinearContact(k, MASS, e, G).rebound(np.sqrt(2 * G * (height - R)))
        height = R + v**2 / (2 * G)
        heights.append(height)
    return heights


def bounce(case, plate, k, e):
    dt = 2e-5 * np.sqrt(1e4 / k)  # as many steps per contact for each stiffness
    _, t, z, w = case.run(contact=plate, k=k, e=e, dt=dt, duration=2.6, every=20).table("trace.txt").T
    return t, z, apexes(t, z, w)


@pytest.mark.parametrize("plate", PLATES)
def test_dem02_heights_of_the_soft_ball(case, plate):
    for e in (0.8, 0.9) if FULL else (0.9,):
        heights = bounce(case, plate, 1e4, e)[2]
        for bounce_number, (height, closed) in enumerate(zip(heights[:4], closed_heights(1e4, e, 4)), start=1):
            case.check(f"DEM02, {plate}, k = 1e4, e = {e}: height {bounce_number} [m]", closed, height, rel=2e-4)


def test_dem02_heights_of_the_hard_ball(case):
    """The published heights are those of a hard ball: approached as k^(-1/2), the duration of a contact."""
    published = [0.42400, 0.36244, 0.31257640, 0.27218688]
    soft, hard = (bounce(case, "wall", k, 0.9)[2][:4] for k in ((1e6, 1e8) if FULL else (1e4, 1e6)))
    for number, reference in enumerate(published):
        case.report(f"DEM02, wall, soft spring: height {number + 1}, hard ball [m]", reference, soft[number])
        case.report(f"DEM02, wall, 100 times stiffer: height {number + 1}, hard ball [m]", reference, hard[number])
        limit = (10 * hard[number] - soft[number]) / 9
        case.check(f"DEM02, wall, k to infinity: height {number + 1} [m]", reference, limit, rel=2e-3)


def test_figure(case):
    with case.figure(2) as (left, right):
        _, t, z, w = case.run(contact="wall").table("trace.txt").T
        t1, v1 = touchdown(t[0], z[0], w[0])
        closed = LinearContact(1e4, MASS, 0.9, G)
        fine = np.linspace(0, closed.duration(-v1), 200)
        fall, rise = np.linspace(0, t1, 100), np.linspace(0, 0.1, 50)
        left.plot(fall, H0 - 0.5 * G * fall**2, "k-")
        left.plot(t1 + fine, R - closed.overlap(fine, -v1), "k-")
        left.plot(t1 + fine[-1] + rise, R + closed.rebound(-v1) * rise - 0.5 * G * rise**2, "k-", label="closed form")
        left.plot(t[::600], z[::600], "o", label="engine")
        left.set(xlabel="time [s]", ylabel="height of the centre [m]", title="DEM01")
        left.legend()
        for k in (1e4, 1e6):
            t, z, _ = bounce(case, "wall", k, 0.9)
            right.plot(t, z, label=f"engine, k = {k:.0e} N/m")
        for height in (0.42400, 0.36244, 0.31257640, 0.27218688):
            right.axhline(height, color="k", lw=0.6, ls="--")
        right.set(xlabel="time [s]", title="DEM02 (dashed: hard ball)")
        right.legend(loc="upper right")
