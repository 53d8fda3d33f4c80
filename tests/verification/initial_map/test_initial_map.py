"""Statistics of clusters per cell at the start: Poisson, less the room that a cluster takes."""

import numpy as np
import pytest
from scipy.stats import poisson
from verification_case import FULL, VerificationCase

CELLS = 900  # 30 x 30 of 10 mm x 20 mm
SEEDS = range(1, 21) if FULL else range(1, 4)
DIAMETER = 1e-4 * np.cbrt(800.0)
# % of solids of one cluster in a cell, on the paper's scale: 10 times the true one (slab of 0.3 mm)
PERCENT = 10 * 100 * 400 * np.pi / 6 * 1e-12 / (0.3 * 0.003 * 0.6 / CELLS)
# how create_atoms places them: anywhere, or without overlaps as in inputs/common.in
POINTS, DISCS = "maxtry 10", f"overlap {float(DIAMETER)!r} maxtry 10000"
PUBLISHED = {5000: 5.5, 7750: 8.0}  # densest cell [%]


def counts(case, clusters, seed, rule):
    """Clusters in each cell."""
    row = case.run(clusters=clusters, seed=seed, rule=rule).dump("start.dump")
    assert len(row["id"]) == clusters
    return np.histogram2d(row["x"], row["z"], bins=30, range=[[0, 0.3], [0, 0.6]])[0].ravel().astype(int)


def hard_disc_dispersion(clusters):
    """Variance over mean of the number of hard discs in a large window, S(0) = (1 - f)^3/(1 + f).

    f: covered area (scaled particle theory, Helfand, Frisch & Lebowitz 1961); 1 for points.
    """
    f = clusters * 0.25 * np.pi * DIAMETER**2 / (0.3 * 0.6)
    return (1 - f) ** 3 / (1 + f)


def dispersion(sample):
    """Index of dispersion; the total is fixed, so the variance is that of a multinomial times n/(n-1)."""
    return np.var(sample, ddof=1) / np.mean(sample)


@pytest.fixture(scope="module")
def samples(tmp_path_factory, request):
    """Counts per cell, [seed, cell], of (number of clusters, rule): shared, for they take a second each."""
    case = VerificationCase(request.path.parent, tmp_path_factory.mktemp("maps"), None)
    return {
        (clusters, rule): np.array([counts(case, clusters, seed, rule) for seed in SEEDS])
        for clusters in PUBLISHED
        for rule in (POINTS, DISCS)
    }


@pytest.mark.parametrize("clusters", PUBLISHED)
def test_dispersion(case, samples, clusters):
    # the index of 900 Poisson cells scatters by sqrt(2/899) = 4.7 %, its mean over seeds by 1/sqrt(seeds) of that
    scatter = 3 * np.sqrt(2 / (CELLS - 1) / len(SEEDS))
    points, discs = (np.mean([dispersion(s) for s in samples[clusters, rule]]) for rule in (POINTS, DISCS))
    case.check(f"{clusters} clusters, overlaps allowed: variance / mean", 1.0, points, rel=scatter)
    # random sequential placement is not the equilibrium of the formula, and cells are finite: 2 % more
    case.check(
        f"{clusters} clusters, no overlaps: variance / mean", hard_disc_dispersion(clusters), discs, rel=scatter + 0.02
    )


@pytest.mark.parametrize("clusters", PUBLISHED)
def test_densest_cell(case, samples, clusters):
    """Mean of the largest count over the seeds, against that of 900 Poisson cells; the published map's beside it."""
    k = np.arange(100)
    below = poisson.cdf(k, clusters / CELLS) ** CELLS  # P(largest <= k)
    expected = np.sum(1 - below)
    spread = np.sqrt(np.sum((2 * k + 1) * (1 - below)) - expected**2)
    points, discs = (samples[clusters, rule].max(axis=1) for rule in (POINTS, DISCS))
    case.check(
        f"{clusters} clusters, overlaps allowed: largest count, mean of the seeds",
        expected,
        np.mean(points),
        abs=3 * spread / np.sqrt(len(SEEDS)),
    )
    published = PUBLISHED[clusters]
    case.report(
        f"{clusters} clusters: densest cell published, Poisson mean [%, paper's scale]", published, PERCENT * expected
    )
    case.report(
        f"{clusters} clusters: densest cell published, mean of the seeds [%, paper's scale]",
        published,
        PERCENT * np.mean(discs),
    )
    case.report(
        f"{clusters} clusters: densest cell published, largest of the seeds [%, paper's scale]",
        published,
        PERCENT * np.max(discs),
    )
    needed = int(np.ceil(published / PERCENT - 0.5))
    case.report(
        f"{clusters} clusters: probability that a Poisson map has a cell as dense as published ({needed})",
        1.0,
        1 - below[needed - 1],
    )


def test_figure(case, samples):
    with case.figure() as axes:
        for clusters, color in ((5000, "C0"), (7750, "C1")):
            k = np.arange(0, 26)
            share = np.bincount(samples[clusters, DISCS].ravel(), minlength=len(k)) / samples[clusters, DISCS].size
            axes.semilogy(k, poisson.pmf(k, clusters / CELLS), "-", color=color, label=f"{clusters}: Poisson")
            axes.semilogy(k[share > 0], share[share > 0], "o", color=color, label=f"{clusters}: engine, no overlaps")
            axes.axvline(PUBLISHED[clusters] / PERCENT, color=color, ls="--", lw=0.8, label="densest cell published")
        axes.axhline(1 / CELLS, color="k", ls=":", lw=0.8)
        axes.set(
            xlabel="clusters in a cell", ylabel="share of the cells", ylim=(1e-6, 0.3), title="dotted: one cell of 900"
        )
        axes.legend(fontsize=7, loc="lower left")
