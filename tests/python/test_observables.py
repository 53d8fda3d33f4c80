"""The registry of observables, uniformity against chance, g(r), classes and bins that follow from the data, the ledger."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from clusterdem import (
    ArgumentError,
    Box,
    Frame,
    Grid,
    How,
    InputError,
    Observable,
    deposit,
    maps_of,
    measure,
    pair_correlation,
)
from clusterdem import observables as registry
from clusterdem.analysis.correlation import reach_of
from clusterdem.analysis.ledger import Flow, Totals, judge_particles, printed_digits, statements, totals_of
from clusterdem.analysis.overlap import mean_square_share
from clusterdem.analysis.sizes import borders_of, class_names, edges_of
from clusterdem.observables import find
from synthetic import BOX, random_frame, write_dump, write_run

OWN = """
import numpy as np
from clusterdem.observables import Observable, register

register(Observable("fastest", "fastest cluster", "m/s", lambda frame, how: np.array([frame["vz"].max()]), columns=("vz",)))
register(Observable("corners", "corners", "m", lambda frame, how: np.array([frame.x.min(), frame.z.max()]),
                    parts=lambda how: ("x", "z"), columns=("tau",)))
"""


@pytest.fixture
def own(tmp_path):
    before = dict(registry.REGISTRY)
    (tmp_path / "own.py").write_text(OWN)
    yield tmp_path / "own.py"
    registry.REGISTRY.clear()
    registry.REGISTRY.update(before)


def test_observables_of_one_own_are_columns_of_the_table(own, tmp_path, command):
    dumps = write_run(tmp_path, 2, 100)
    words = ("--observables", own, "--observe", "fastest", "corners", "dispersion", "--out", tmp_path / "s")
    assert command("sizes", *dumps, *words)[0] == 0
    with open(tmp_path / "s/sizes.csv") as file:
        rows = list(csv.DictReader(file))
    for row, frame in zip(rows, (random_frame(100), random_frame(200, 10000))):
        assert float(row["fastest"]) == frame["vz"].max()
        assert (float(row["corners x"]), float(row["corners z"])) == (frame.x.min(), frame.z.max())
        assert float(row["dispersion"]) == pytest.approx(find("dispersion")(frame, How())[0])


def test_observables_of_one_own_in_studies(own, tmp_path):
    from clusterdem.studies.calibrate.study import read_calibration
    from clusterdem.studies.trade.frames import keeping_of
    from clusterdem.studies.trade.study import read_study

    (tmp_path / "in.run").write_text("")
    (tmp_path / "s.toml").write_text(
        'input = "in.run"\nobservables_file = "own.py"\nobservables = ["fastest"]\nclasses = [1000, 2000]\nplane = "xy"\n'
        "[switches]\ndt = [1, 2]\n"
    )
    study = read_study(tmp_path / "s.toml")
    assert study.observables == ("fastest",) and study.how.borders == (1e-3, 2e-3) and study.how.plane == "xy"
    assert "vz" in keeping_of(study.observables).format and "vz" not in keeping_of(("clusters",)).format
    (tmp_path / "c.toml").write_text(
        'classes = [1000]\nobservables_file = "own.py"\n[[case]]\nname = "a"\ninput = "in.run"\n[[case.target]]\n'
        'quantity = "size_classes"\npart = ">1000"\ntime = 1\nvalue = 3\n[[case.target]]\nquantity = "fastest"\n'
        'time = 1\nvalue = 3\n[[parameter]]\nname = "K"\nlow = 0\nhigh = 1\n'
    )
    first, second = read_calibration(tmp_path / "c.toml").cases[0].targets
    assert (first.part, first.label, second.label) == (1, "share >1000(1)", "fastest cluster(1)")


@pytest.mark.parametrize(
    "text, said",
    [
        ("import nothing_at_all", "ended with ModuleNotFoundError"),
        ("1 +", "ended with SyntaxError"),
        (None, "cannot be read"),
    ],
)
def test_a_file_of_observables_that_is_none(tmp_path, text, said):
    if text is not None:
        (tmp_path / "own.py").write_text(text)
    with pytest.raises(InputError, match=said):
        registry.load(tmp_path / "own.py")
    with pytest.raises(InputError, match="must be a Python file"):
        registry.load(tmp_path / "own.txt")


def test_unknown_names_are_refused_with_those_that_there_are(tmp_path, command):
    with pytest.raises(ArgumentError, match="observables: there is no 'colour'; there are count, clusters"):
        find("colour")
    code, _, err = command("sizes", *write_run(tmp_path, 1), "--observe", "colour")
    assert code == 2 and err.startswith("clusterdem: --observables: there is no 'colour'")
    with pytest.raises(ArgumentError, match="name: must be a word"):
        registry.register(Observable("a b", "", "", lambda frame, how: np.zeros(1)))


# ---- chance


def spheres(count, radii, box, seed):
    rng = np.random.default_rng(seed)
    d = 2 * rng.choice(radii, count)
    columns = {axis: box.lo[i] + box.lengths[i] * rng.random(count) for i, axis in enumerate("xyz")}
    columns |= {"diameter": d, "mass": 1000 * np.pi / 6 * d**3}
    return Frame(0, 0.0, box, columns).with_density(2000)


@pytest.mark.parametrize("method", ["nearest", "overlap"])
@pytest.mark.parametrize("shape", [(6, 8), (20, 40), (60, 30), (1, 25), (2, 2)])
@pytest.mark.parametrize("periodic", [True, False])
def test_random_clusters_lie_as_by_chance_on_any_grid(method, shape, periodic):
    """Mean of 25 draws of 1000 spheres: the index scatters by sqrt(2 / (cells - 1)) in each, so by a fifth of that in the mean."""
    box = Box((0.0, 0.0, 0.0), (0.3, 0.05, 0.6), (periodic,) * 3)
    grid = Grid(box, *shape)
    found = []
    for seed in range(25):
        frame = spheres(1000, (2e-3, 6e-3, 8e-3), box, seed)
        fraction = maps_of(frame, grid, method)["fraction"]
        found.append(measure(fraction, frame, grid, method).dispersion)
    scatter = np.sqrt(2 / (shape[0] * shape[1] - 1) / 25)
    assert np.mean(found) == pytest.approx(1, abs=4 * scatter + 0.01)


def test_shares_of_spheres_on_a_grid_by_the_closed_form():
    """A sphere of radius r on cells of width a and b: 1 - 18/35 (r/a + r/b) + 4/(5 pi) r²/(ab); of none, 1; of one cell, 1."""
    r = np.array([0.1, 0.4])
    expected = 1 - 18 / 35 * (r / 1 + r / 2) + 4 / (5 * np.pi) * r**2 / 2
    np.testing.assert_allclose(mean_square_share(r, (1, 2), (30, 30), (True, True)), expected, rtol=1e-12)
    np.testing.assert_allclose(mean_square_share(r, (1, 2), (1, 1), (True, True)), 1.0, rtol=1e-6)
    walls = 1 - 18 / 35 * r * (9 / 10 + 0.5 * 4 / 5) + 4 / (5 * np.pi) * r**2 / 2 * (9 / 10) * (4 / 5)
    np.testing.assert_allclose(mean_square_share(r, (1, 2), (10, 5), (False, False)), walls, rtol=1e-12)


@pytest.mark.parametrize("shape", [(2, 30), (3, 30), (2, 2)])
def test_large_spheres_meet_their_own_image(shape):
    """A sphere nearly as wide as two cells of a side that repeats: shares by drawing 20,000 places, good to half a percent."""
    box = Box((0.0, 0.0, 0.0), (1.0 * shape[0], 9.0, 2.0 * shape[1]), (True, False, True))
    rng = np.random.default_rng(4)
    x, z = (side * rng.random(20_000) for side in (box.lengths[0], box.lengths[2]))
    shares = deposit(Grid(box, *shape), x, z, np.full(20_000, 1.96), "overlap")
    cells = shape[0] * shape[1]
    weights = np.bincount(shares.cluster * cells + shares.cell, shares.weight)
    expected = (weights**2).sum() / 20_000
    (found,) = mean_square_share(np.array([0.98]), (1.0, 2.0), shape, (True, True))
    assert found == pytest.approx(expected, rel=0.01)


def test_g_of_r_looks_as_far_as_the_clusters_are_large(tmp_path, command):
    box = Box((0.0, 0.0, 0.0), (0.3, 0.05, 0.6), (True,) * 3)
    frame = spheres(30_000, (3e-3,), box, 1)
    assert reach_of(frame) == pytest.approx(24e-3)  # four diameters of 6 mm; twice the distance of neighbours is 13 mm
    r, g = pair_correlation(frame)
    assert r[-1] == pytest.approx(24e-3 * (1 - 0.5 / 40)) and g[10:].mean() == pytest.approx(1, abs=0.03)
    few = spheres(10, (1e-4,), box, 1)
    assert reach_of(few) == pytest.approx(2 * (0.3 * 0.05 * 0.6 / 10) ** (1 / 3))
    assert pair_correlation(few)[0][-1] < 0.49 * 0.05  # never beyond half the box
    path = write_dump(tmp_path / "a.dump", frame, ["x", "y", "z", "diameter", "mass"])
    assert command("profile", path, "--rho", "2000", "--rmax", "10", "--out", tmp_path / "p")[0] == 0
    with open(tmp_path / "p/gr.csv") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["r"]) == pytest.approx(10e-3 * (1 - 0.5 / 40))
    assert command("profile", path, "--rmax", "-1")[0] == 2
    with pytest.raises(ArgumentError, match="rmax"):
        pair_correlation(frame, -1.0)


def test_pairs_are_counted_as_by_hand():
    """Four centres on a line at 0, 1.2, 3.3 and 9.4 mm of 10 mm: 1.2, 3.3, 0.6, 2.1, 1.8 and 3.9 mm apart, around the corner too."""
    box = Box((0.0, 0.0, 0.0), (0.01, 0.01, 0.01), (True, True, True))
    columns = {"x": np.array([0.0, 1.2e-3, 3.3e-3, 9.4e-3]), "y": np.full(4, 5e-3), "z": np.full(4, 5e-3)}
    columns |= {"mass": np.ones(4), "diameter": np.full(4, 1e-4)}
    r, g = pair_correlation(Frame(0, 0.0, box, columns), 4.5e-3, 9)
    ring = np.pi * np.diff(np.linspace(0, 4.5e-3, 10) ** 2)
    pairs = g * 4 * 3 * ring / 1e-4  # of 12 ordered pairs on 1e-4 m², in rings of 0.5 mm
    np.testing.assert_allclose(pairs, [0, 2, 2, 2, 2, 0, 2, 2, 0], atol=1e-9)


# ---- sizes


def test_classes_and_bins_follow_from_the_data(tmp_path, command):
    frame = spheres(500, (0.5e-3, 1.1e-3, 2e-3, 2.9e-3), BOX, 2)
    path = write_dump(tmp_path / "grains.dump", frame, ["x", "z", "diameter", "mass"])
    code, out, _ = command("sizes", path, "--out", tmp_path / "s")
    assert code == 0 and "<2000" in out and ">5000" in out
    with open(tmp_path / "s/sizes.csv") as file:
        (row,) = csv.DictReader(file)
    # borders 2, 3 and 5 mm: 1 mm, 2.2 mm, 4 mm and 5.8 mm in a class each
    shares = [100 * (frame.diameter == d).mean() for d in (1e-3, 2.2e-3, 4e-3, 5.8e-3)]
    assert [float(row[f"n_{name}"]) for name in ("lt2000", "2000_3000", "3000_5000", "gt5000")] == pytest.approx(shares)
    with open(tmp_path / "s/histogram.csv") as file:
        bins = list(csv.DictReader(file))
    assert float(bins[-2]["to"]) > 5.8e-3 and float(bins[-1]["to"]) == np.inf and float(bins[-1]["number_percent"]) == 0
    assert sum(float(one["number_percent"]) for one in bins) == pytest.approx(100)


def test_what_lies_beyond_given_bins_has_rows_of_its_own(tmp_path, command):
    frame = spheres(500, (0.5e-3, 1.1e-3, 2e-3, 2.9e-3), BOX, 2)
    path = write_dump(tmp_path / "grains.dump", frame, ["x", "z", "diameter", "mass"])
    words = ("--bin", "500", "--top", "2500", "--classes", "1500", "3000", "--out", tmp_path / "s")
    assert command("sizes", path, *words)[0] == 0
    with open(tmp_path / "s/histogram.csv") as file:
        bins = [(float(b["from"]), float(b["to"]), float(b["number_percent"])) for b in csv.DictReader(file)]
    assert [to for _, to, _ in bins] == pytest.approx([0.5e-3, 1e-3, 1.5e-3, 2e-3, 2.5e-3, np.inf])
    assert bins[-1][2] == pytest.approx(100 * (frame.diameter > 2.5e-3).mean())
    for wrong in (("--classes", "3", "2"), ("--classes", "0"), ("--bin", "1", "--top", "1e6"), ("--bin", "nan")):
        code, _, err = command("sizes", path, *wrong)
        assert code == 2 and wrong[0] in err


def test_borders_and_edges():
    assert borders_of(1e-3, 1e-3) == (1e-3,) and borders_of(np.inf, 0.0) == ()
    assert borders_of(0.1, 0.9) == pytest.approx((0.3, 0.5, 0.7))
    assert class_names(()) == ("all",) and class_names((1e-3,)) == ("<1000", ">1000")
    for low, high in ((1e-6, 1e-6), (3e-5, 0.123), (1e-3, 6e-3), (1.0, 7.0)):
        edges = edges_of(low, high)
        assert edges[0] == 0 and edges[-2] <= high * (1 + 1e-9) < edges[-1] * (1 + 1e-8) and 32 <= len(edges) - 1 <= 90


# ---- the ledger


def totals(particles, mass=1.0, digits=17):
    return Totals(5, particles, mass, 0.0, 0.0, 0.0, digits)


def test_whole_particles_are_judged_exactly():
    assert "400 in every frame (conserved exactly)" in judge_particles([400, 400])
    assert "from 399 to 400 (NOT conserved, unless" in judge_particles([400, 399])
    assert "from 399 to 400 (NOT conserved)." in judge_particles([400, 399], [Flow(0, 0), Flow(0, 0)])
    flows = [Flow(0, 0), Flow(50, 0), Flow(80, 30)]
    assert "100 at first, 80 fed, 30 left, 150 at last (conserved exactly)" in judge_particles([100, 150, 150], flows)
    assert "(NOT conserved: off by up to 1)" in judge_particles([100, 150, 151], flows)


def test_the_mass_goes_with_the_particles_however_it_is_printed():
    """Six digits of every mass round by 5e-6: no loss where the particles are all there."""
    said = statements([totals(400, 1.0), totals(400, 1.000004)])
    assert "conserved exactly" in said[0] and "goes with the particles" in said[1]


def test_masses_without_particles_are_judged_by_their_digits():
    assert "(conserved)" in statements([totals(None, 1.0, 6), totals(None, 1.000004, 6)])[1]
    assert "NOT conserved" in statements([totals(None, 1.0, 9), totals(None, 1.000004, 9)])[1]
    assert "NOT conserved" in statements([totals(None, 1.0, 6), totals(None, 1.001, 6)])[1]
    fed = [Flow(0, 0), Flow(5, 0)]
    assert "it is not judged" in statements([totals(None, 1.0), totals(None, 2.0)], fed)[1]


def test_digits_of_printed_numbers():
    values = np.array([1.23456e-6, 2.0])
    assert printed_digits(values) == 6 and printed_digits(np.array([1 / 3])) >= 16 and printed_digits(np.empty(0)) == 1


def test_totals_of_a_frame():
    frame = random_frame(50)
    found = totals_of(frame)
    assert found.particles == int(frame["n"].sum()) and found.mass == frame.mass.sum()
    assert found.momentum_z == pytest.approx((frame.mass * frame["vz"]).sum())
    assert found.kinetic == pytest.approx((frame.mass * (frame["vx"] ** 2 + frame["vz"] ** 2)).sum() / 2)
