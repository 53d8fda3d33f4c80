"""Energy of a closed box of colliding spheres: conserved, or lost in just the dashpots; never created."""

import numpy as np
import pytest
from linear_contact import LinearContact
from scipy.spatial import cKDTree
from verification_case import CONTACTS, FULL

K, BOX, DT = 10.0, 0.01, 2e-6


def frames(run):
    """Array [frame, sphere, column] of the dump."""
    blocks = (run.folder / "frames.dump").read_text().split("ITEM: ATOMS")[1:]
    rows = [block.split("\n", 1)[1].split("ITEM:", 1)[0].split() for block in blocks]
    return np.array(rows, dtype=float).reshape(len(rows), -1, 11)


class Ledger:
    """Energies of every frame, from positions and velocities alone."""

    def __init__(self, run, e, every):
        rows = frames(run)
        x, v, omega, radius, mass = rows[:, :, :3], rows[:, :, 3:6], rows[:, :, 6:9], rows[0, :, 9], rows[0, :, 10]
        self.t = np.arange(len(rows)) * DT * every
        self.kinetic = 0.5 * np.einsum("j,ijk,ijk->i", mass, v, v)
        self.rotation = 0.5 * np.einsum("j,ijk,ijk->i", 0.4 * mass * radius**2, omega, omega)
        self.mass = mass.sum()
        self.momentum = np.einsum("j,ijk->ik", mass, v)
        self.elastic, self.dissipated_power, self.contacts = (np.zeros(len(rows)) for _ in range(3))
        for frame, (xf, vf) in enumerate(zip(x, v, strict=True)):
            near = cKDTree(xf % BOX, boxsize=BOX).query_pairs(2 * radius.max(), output_type="ndarray")
            i, j = near.T
            apart = xf[i] - xf[j]
            apart -= BOX * np.round(apart / BOX)
            r = np.linalg.norm(apart, axis=1)
            overlap = radius[i] + radius[j] - r
            approach = np.einsum("ik,ik->i", vf[i] - vf[j], apart) / r
            eta = LinearContact(K, mass[i] * mass[j] / (mass[i] + mass[j]), e).eta
            touching = overlap > 0
            self.elastic[frame] = 0.5 * K * np.sum(overlap[touching] ** 2)
            self.dissipated_power[frame] = np.sum((eta * approach**2)[touching])
            self.contacts[frame] = touching.sum()
        self.total = self.kinetic + self.rotation + self.elastic
        mean_power = 0.5 * (self.dissipated_power[1:] + self.dissipated_power[:-1])
        self.dissipated = np.concatenate([[0.0], np.cumsum(mean_power) * DT * every])


def ledger_of(case, every=20, **variables):
    return Ledger(case.run(every=every, **variables), variables["e"], every)


@pytest.mark.parametrize("contact", CONTACTS)
def test_elastic_box_conserves(case, contact):
    run = case.run(contact=contact, e=1.0, every=20)
    ledger = Ledger(run, 1.0, 20)
    assert ledger.contacts.sum() > 300 and ledger.elastic.max() > 0.01 * ledger.kinetic[0]
    # velocity Verlet within a contact: bounded by (omega dt)^2 / 8 = 2e-5 of the energy in it
    case.check(
        f"{contact}, e = 1: largest change of total energy / at the start",
        0.0,
        np.abs(ledger.total / ledger.total[0] - 1).max(),
        abs=2e-5,
    )
    momentum = np.abs(ledger.momentum).max() / np.sqrt(2 * ledger.kinetic[0] * ledger.mass)
    case.check(f"{contact}, e = 1: largest momentum / sqrt(2 m E)", 0.0, momentum, abs=1e-12)
    if contact == "gran/cluster":  # stock `granular` reports no energy
        error = np.abs(run.table("trace.txt")[:, 1] - ledger.elastic).max() / ledger.elastic.max()
        case.check(
            "gran/cluster: elastic energy that the engine reports, largest error / largest energy", 0.0, error, abs=1e-9
        )


@pytest.mark.parametrize("contact", CONTACTS)
def test_what_is_lost_is_dissipated(case, contact):
    for e in (0.9, 0.3) if FULL else (0.9,):
        ledger = ledger_of(case, 5, contact=contact, e=e)
        lost = ledger.total[0] - ledger.total[-1]
        assert lost > 0.1 * ledger.total[0]
        # 46 frames per contact, whose power jumps at its beginning, anywhere within a frame
        share = ledger.dissipated[-1] / lost
        case.check(f"{contact}, e = {e}: dissipated in the dashpots / lost", 1.0, share, abs=0.01)
        case.check(
            f"{contact}, e = {e}: largest rise of energy between frames / at the start",
            0.0,
            max(0.0, np.diff(ledger.total).max() / ledger.total[0]),
            abs=1e-5,
        )


@pytest.mark.parametrize("contact", CONTACTS)
def test_friction_creates_no_energy(case, contact):
    """Between frames without a contact no spring holds energy: translation and rotation together can only fall."""
    for e in (0.9, 1.0) if FULL else (0.9,):
        ledger = ledger_of(case, contact=contact, e=e, mu=0.33)
        free = ledger.total[ledger.contacts == 0]
        assert len(free) > 100 and ledger.rotation[-1] > 0.01 * ledger.kinetic[-1]
        case.check(
            f"{contact}, e = {e}, mu = 0.33: largest rise of energy between free frames / at the start",
            0.0,
            max(0.0, np.diff(free).max() / free[0]),
            abs=1e-5,
        )


def test_figure(case):
    with case.figure() as axes:
        for e, mu, color in ((0.9, 0.0, "C1"), (1.0, 0.0, "C0"), (0.9, 0.33, "C2"))[: None if FULL else 1]:
            ledger = ledger_of(case, 5, contact="gran/cluster", e=e, mu=mu)
            start = ledger.total[0]
            axes.plot(ledger.t * 1e3, ledger.total / start, color=color, label=f"e = {e}, µ = {mu}: total")
            if mu == 0.0 and e < 1.0:
                axes.plot(
                    ledger.t * 1e3,
                    (ledger.total + ledger.dissipated) / start,
                    color=color,
                    ls="--",
                    zorder=3,
                    label=f"e = {e}, µ = {mu}: total + dissipated",
                )
        axes.set(xlabel="time [ms]", ylabel="energy / energy at the start")
        axes.legend(fontsize=7)
