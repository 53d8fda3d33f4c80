"""Fragments and merged clusters stay on their side of every wall that the scene has."""

import numpy as np
import pytest
from lammps_run import M_P, clusters, diameter, head, pair, run, write

RANKS = (1, 2, 4)
LAW = "granular hooke 10 0.3 tangential linear_history 8.57 1.0 0.33 damping coeff_restitution"
D = diameter(400)


def burst(place: tuple[float, float, float], walls: str, size: str, steps: int = 10, between: str = "") -> str:
    """One cluster of 400 that breaks to the smallest pieces at once, with room all around but for the walls."""
    x, y, z = place
    return (
        "units si\natom_style sphere\natom_modify map hash\nboundary f f f\ncomm_modify vel yes cutoff 6.5e-3\nneighbor 0.5e-3 bin\n"
        "region box block 0 0.03 0 0.03 0 0.03\ncreate_box 1 box\n"
        f"create_atoms 1 single {x} {y} {z}\nset type 1 diameter {D!r} density 1000\n"
        + pair()
        + f"{walls}\nfix move all nve/sphere\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 6\n"
        + f"fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.02 plane none {size}\ntimestep 1e-6\n"
        + between
        + f"run {steps}\n"
        + write()
    )


def radial(row: dict) -> np.ndarray:
    return np.hypot(row["x"] - 0.015, row["y"] - 0.015)


def tube(open_: str) -> str:
    return f"region tube cylinder z 0.015 0.015 0.01 0 0.03 side in units box {open_}\n"


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize("open_", ["", "open 1 open 2"])
@pytest.mark.parametrize("size", ["", "region tube"])
def test_a_tube_with_or_without_ends(tmp_path, open_, size, np_):
    """Wall of fix wall/gran/region, with and without the keyword: open ends make match() true everywhere."""
    walls = tube(open_) + f"fix wall all wall/gran/region {LAW} region tube"
    row = run(tmp_path, burst((0.0245, 0.015, 0.015), walls, size), np_).dump()
    assert len(row["id"]) == 133 and row["mass"].sum() == pytest.approx(400 * M_P, rel=1e-12)
    assert (radial(row) + 0.5 * row["diameter"]).max() <= 0.01 * (1 + 1e-12)


@pytest.mark.parametrize("np_", RANKS)
def test_a_second_wall_that_is_not_in_the_region(tmp_path, np_):
    walls = (
        tube("") + f"fix wall all wall/gran/region {LAW} region tube\nfix floor all wall/gran {LAW} zplane 0.01 NULL"
    )
    row = run(tmp_path, burst((0.015, 0.015, 0.0105), walls, "region tube"), np_).dump()
    assert len(row["id"]) == 133
    assert (row["z"] - 0.5 * row["diameter"]).min() >= 0.01 * (1 - 1e-12)


@pytest.mark.parametrize(
    "wall, place, outside",
    [
        (f"fix w all wall/gran {LAW} xplane 0.012 NULL", (0.0125, 0.015, 0.015), lambda r: 0.012 - (r["x"] - r["diameter"] / 2)),
        (f"fix w all wall/gran {LAW} yplane NULL 0.021", (0.015, 0.0205, 0.015), lambda r: r["y"] + r["diameter"] / 2 - 0.021),
        # from below: a cluster behind the wall stays behind it
        (f"fix w all wall/gran {LAW} zplane 0.012 NULL", (0.015, 0.015, 0.0115), lambda r: r["z"] + r["diameter"] / 2 - 0.012),
        (f"fix w all wall/gran {LAW} zcylinder 0.02", (0.01378, 0.01378, 0.015), lambda r: np.hypot(r["x"], r["y"]) + r["diameter"] / 2 - 0.02),
        ("fix w all wall/reflect xlo 0.012", (0.0125, 0.015, 0.015), lambda r: 0.012 - (r["x"] - r["diameter"] / 2)),
        ("fix w all wall/harmonic xlo 0.012 1.0 1.0 1e-4", (0.0125, 0.015, 0.015), lambda r: 0.012 - (r["x"] - r["diameter"] / 2)),
        # 0.012 + 1e-3 (1 - cos(pi)) = 0.014 at half of the period of 2e-5 s
        (f"fix w all wall/gran {LAW} xplane 0.012 NULL wiggle x 1e-3 2e-5", (0.0145, 0.015, 0.015), lambda r: 0.014 - (r["x"] - r["diameter"] / 2)),
    ],
)  # fmt: skip
def test_no_piece_in_a_wall(tmp_path, wall, place, outside):
    row = run(tmp_path, burst(place, wall, "")).dump()
    assert len(row["id"]) == 133 and outside(row).max() <= 1e-12
    alone = run(tmp_path / "alone", burst(place, "", "")).dump()
    assert outside(alone).max() > 1e-4  # the wall is what holds them


def test_a_wall_that_comes_between_two_runs(tmp_path):
    between = f"fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 1e6 plane none\nrun 10\nfix w all wall/gran {LAW} xplane 0.012 NULL\n"
    between += "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.02 plane none\n"
    row = run(tmp_path, burst((0.0125, 0.015, 0.015), "", "", between=between)).dump()
    assert len(row["id"]) == 133 and (row["x"] - 0.5 * row["diameter"]).min() >= 0.012 * (1 - 1e-12)


@pytest.mark.parametrize("away, merged", [(0.5 * D, 0), (0.5 * diameter(800), 1)])
@pytest.mark.parametrize("np_", (1, 2))
def test_a_merge_at_a_wall_waits(tmp_path, away, merged, np_):
    """Beside a wall there is room for two clusters of 400, not for one of 800: R = 1.26 r."""
    x = 0.01 + away * (1 + 1e-9)
    script = (
        head().replace("boundary     p f p", "boundary f f f")
        + clusters((400, (x, 0.0200), (0.0, 0.5)), (400, (x, 0.0200 + 0.999 * D), (0.0, 0.5)))
        + pair()
        + f"fix w all wall/gran {LAW} xplane 0.01 NULL\nfix move all nve\n"
        + "fix size all cluster/breakmerge 1 1e-4 2000 terms mf umf 0.01 K 0.0266 break no\ntimestep 1e-9\nrun 5\n"
        + write()
    )
    row = run(tmp_path, script, np_).dump()
    assert len(row["id"]) == 2 - merged
    assert (row["x"] - 0.5 * row["diameter"]).min() >= 0.01


HALVES = (
    "region a block 0.005 0.015 0.005 0.025 0.005 0.025 units box open 2\n"
    "region b block 0.015 0.025 0.005 0.025 0.005 0.025 units box open 1\nregion u union 2 a b\n"
)
MOVING = "variable dx equal 1e-4*step\nregion u block 0.005 0.025 0.005 0.025 0.005 0.025 units box open 6 move v_dx NULL NULL\n"


@pytest.mark.parametrize(
    "region, why", [(HALVES, "joins regions with open faces"), (MOVING, "has open faces and moves")]
)
def test_open_regions_without_an_inside_are_refused(tmp_path, region, why):
    """The engine says of every place that it is within: 0.7 mm behind the wall in the first, 0.2 mm in the second."""
    wall = region + f"fix w all wall/gran/region {LAW} region u"
    r = run(tmp_path, burst((0.0145, 0.0245, 0.015), wall, ""), check=False)
    assert r.code != 0 and f"does not see where fix wall/gran/region w, whose region u {why}" in r.output, r.output[
        -900:
    ]
    kept = run(
        tmp_path / "told",
        burst(
            (0.0145, 0.0245, 0.015),
            wall + "\nregion in block 0.006 0.024 0.006 0.025 0.006 0.024 units box",
            "region in",
        ),
    ).dump()
    assert len(kept["id"]) == 133 and (kept["y"] + kept["diameter"] / 2).max() <= 0.025 * (1 + 1e-12)
