"""Walls, temperature, inserted particles and contact models of LIGGGHTS around the fixes."""

import numpy as np
import pytest
from lammps_run import M_P, diameter
from liggghts_run import NEIGHBORS, needs_liggghts, pair_liggghts, run_liggghts, write_data

pytestmark = needs_liggghts

GAS = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 6\n"
WALL = "fix wall all wall/gran model hooke/stiffness tangential off primitive type 1 xplane 0.01\n"
DUMP = 'dump end all custom 1 end.dump id x z diameter mass f_size[1] f_Temp\ndump_modify end sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g"\n'
TEMPERATURE = "fix Temp all property/atom Temp scalar yes yes yes 300.0\n"


def start(folder, n, x, v, boundary: str = "f f f") -> str:
    folder.mkdir(parents=True, exist_ok=True)
    write_data(folder / "clusters.data", n, x, v)
    return (
        f"units si\natom_style granular\natom_modify map array sort 0 0\nboundary {boundary}\nnewton off\n"
        f"communicate single vel yes cutoff 11e-3\nread_data clusters.data\n{NEIGHBORS}{pair_liggghts()}"
    )


@pytest.mark.parametrize("np_", (1, 2))
def test_a_wall_is_refused_by_name_unless_a_region_lies_within_it(tmp_path, np_):
    size = "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.02"
    script = (
        start(tmp_path, [400], [[0.0105, 0.0015, 0.02]], [[0, 0, 0]])
        + TEMPERATURE
        + WALL
        + "fix move all nve/sphere\n"
        + GAS
    )
    r = run_liggghts(tmp_path, script + size + "\nrun 10\n", np_, check=False)
    assert r.code != 0 and "does not see where fix wall/gran wall is" in r.output
    region = "region free block 0.01 0.04 0 0.003 0 0.04 units box\n"
    told = (
        start(tmp_path / "told", [400], [[0.0105, 0.0015, 0.02]], [[0, 0, 0]])
        + TEMPERATURE
        + WALL
        + "fix move all nve/sphere\n"
        + GAS
    )
    row = run_liggghts(
        tmp_path / "told", told + region + size + " region free\ntimestep 1e-6\n" + DUMP + "run 100\n", np_
    ).dump()
    assert len(row["id"]) > 30 and row["f_size[1]"].sum() == 400 and (row["x"] - 0.5 * row["diameter"]).min() >= 0.01


@pytest.mark.parametrize("np_", (1, 2))
def test_temperature_through_breakup_and_merge(tmp_path, np_):
    """The column that fix heat/gran keeps: fragments have their parent's, a merged cluster the mass mean."""
    set_both = "run 0\nset atom 1 property/atom Temp 400.0\nset atom 2 property/atom Temp 300.0\n"
    gap = 0.499 * (diameter(60) + diameter(100))
    merge = start(
        tmp_path / "m", [60, 100], [[0.02, 0.0015, 0.02], [0.02 + gap, 0.0015, 0.02]], [[0, 0, 1], [0, 0, 1]], "p f p"
    )
    merge += TEMPERATURE + set_both + "fix move all nve\n" + GAS
    merge += (
        "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 1e6 terms mf break no\ntimestep 1e-9\n"
        + DUMP
        + "run 1\n"
    )
    row = run_liggghts(tmp_path / "m", merge, np_).dump()
    assert row["f_size[1]"] == [160] and row["f_Temp"][0] == pytest.approx(337.5, rel=1e-14)

    broken = start(tmp_path / "b", [400], [[0.02, 0.0015, 0.02]], [[0, 0, 0]], "p f p") + TEMPERATURE
    broken += "run 0\nset atom 1 property/atom Temp 400.0\nfix move all nve\n" + GAS
    broken += (
        "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 0.1 terms st merge no\ntimestep 1e-9\n"
        + DUMP
        + "run 1\n"
    )
    row = run_liggghts(tmp_path / "b", broken, np_).dump()
    assert len(row["id"]) > 1 and np.all(row["f_Temp"] == 400.0)
    assert (row["mass"] * row["f_Temp"]).sum() == pytest.approx(400 * M_P * 400.0, rel=1e-12)


def test_another_contact_model_where_contacts_are_not_looked_at(tmp_path):
    """hooke/stiffness is asked for by N_cc, merges and tests of contacts; without them any model does."""
    properties = (
        "fix m1 all property/global youngsModulus peratomtype 5e6\nfix m2 all property/global poissonsRatio peratomtype 0.25\n"
        "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3\n"
        "fix m4 all property/global coefficientFriction peratomtypepair 1 0.3\n"
    )
    script = start(tmp_path, [400], [[0.02, 0.0015, 0.02]], [[0, 0, 0]], "p f p").replace(
        pair_liggghts(), properties + "pair_style gran model hertz tangential history\npair_coeff * *\n"
    )
    script += TEMPERATURE + "fix move all nve\n" + GAS
    size = "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 0.1 terms st "
    r = run_liggghts(tmp_path, script + size + "\nrun 1\n", check=False)
    assert r.code != 0 and "needs a linear contact: pair_style gran model hooke/stiffness" in r.output
    row = run_liggghts(tmp_path, script + size + "merge no\ntimestep 1e-9\n" + DUMP + "run 1\n").dump()
    assert len(row["id"]) > 1 and row["f_size[1]"].sum() == 400


PLATE = """solid plate
facet normal 0 0 -1
outer loop
vertex 0.005 0.0005 0.03
vertex 0.035 0.0005 0.03
vertex 0.035 0.0025 0.03
endloop
endfacet
facet normal 0 0 -1
outer loop
vertex 0.005 0.0005 0.03
vertex 0.035 0.0025 0.03
vertex 0.005 0.0025 0.03
endloop
endfacet
endsolid plate
"""


def test_particles_that_insert_stream_still_carries_do_not_break(tmp_path):
    """They move with the stream until their release; all of them are far above their stable size, and whole as long as held."""
    (tmp_path / "plate.stl").write_text(PLATE)
    script = start(tmp_path, [3], [[0.002, 0.0015, 0.002]], [[0, 0, 0]], "p p f") + TEMPERATURE
    script += (
        "fix move all nve\n"
        + GAS
        + "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.02 terms st merge no\ntimestep 1e-6\n"
        + f"fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius constant {0.5 * diameter(400)!r}\n"
        + "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
        + "fix face all mesh/surface/planar file plate.stl type 1\n"
        + "fix ins all insert/stream seed 32452867 distributiontemplate pdd nparticles 20 vel constant 0 0 -1.0 "
        + "particlerate 200000 overlapcheck yes insertion_face face extrude_length 0.005\n"
        + 'dump end all custom 100 end.dump id x z diameter mass f_size[1] f_Temp\ndump_modify end sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g"\n'
        + "run 6000\n"
    )
    frames = run_liggghts(tmp_path, script).frames("end.dump")
    for frame in frames[1:]:
        held = frame["z"] > 0.03 + 1e-3
        assert np.all(frame["f_size[1]"][held & (frame["diameter"] > 1.1 * diameter(200))] == 400)
    first = frames[1]
    assert (first["f_size[1]"] == 400).sum() == 20  # before anyone has passed the face
    assert len(frames[-1]["id"]) > 100 and frames[-1]["f_size[1]"].sum() == 20 * 400 + 3
