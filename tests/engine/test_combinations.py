"""What else a script may contain: each combination runs with exact balance and events, or stops with a clear error."""

import numpy as np
import pytest
import scenes
from lammps_run import CUTOFF, M_P, diameter, have_mpirun, pair, random_clusters, run, run_file

HEAD = """
units        si
atom_style   sphere
atom_modify  map hash
boundary     p f p
comm_modify  vel yes cutoff 6.5e-3
neighbor     0.5e-3 bin
region       box block 0 0.03 0 0.003 0 0.03
create_box   2 box
"""
START = HEAD + random_clusters(100) + pair() + "velocity all set 0.5 0 2\n"
MOVE = "fix move all nve\n"
GAS = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 4e-4 5 plane xz\n"
SIZE = "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.3 merge 0.2\n"
OUT = (
    'timestep 2e-6\nfix table all ave/time 10 1 10 f_size[*] mode scalar file out.txt format " %.17g"\n'
    "thermo 100\nthermo_modify lost error\n"
)
RUN = "run 300\n"
ALL = START + MOVE + GAS + SIZE + OUT + RUN
WALLS = "granular hooke 10 0.3 tangential linear_history 8.57 1.0 0.33 damping coeff_restitution"


def after(line: str, what: str = OUT) -> str:
    """The scene with a line more, before its outputs."""
    return ALL.replace(what, line + "\n" + what)


def closed(*walls: str) -> str:
    """Fixed sides in x and z, clusters away from them."""
    edges, inner = "EDGE EDGE 0.0015 0.0015 EDGE EDGE", "0.006 0.024 0.0015 0.0015 0.006 0.024"
    script = after("\n".join(walls), GAS).replace("boundary     p f p", "boundary f f f").replace(edges, inner)
    script = script.replace(" 100 1 plane", " 60 1 plane").replace("all set 0.5 0 2", "all set 0 0 0")
    return script.replace("velocity 0 0 2", "velocity 0 0 0.5")


TUBE = "region tube cylinder y 0.015 0.015 0.013 INF INF units box\n"

WORKS = {
    "shrink-wrapped sides": ALL.replace("boundary     p f p", "boundary p f m"),
    "walls on fixed sides": closed(f"fix walls all wall/gran {WALLS} xplane 0 0.03", f"fix ends all wall/gran {WALLS} zplane 0 0.03"),
    "a wall in y": after(f"fix wall all wall/gran {WALLS} yplane 0 0.003"),
    "walls within, told by a region": closed(TUBE + f"fix wall all wall/gran/region {WALLS} region tube").replace("merge 0.2", "merge 0.2 region tube"),
    "a plane inside the box": closed(f"fix walls all wall/gran {WALLS} xplane 0.003 0.027"),
    "a plane that moves": closed(f"fix walls all wall/gran {WALLS} zplane 0.003 0.027 wiggle z 1e-3 1"),
    "a tube": closed(f"fix wall all wall/gran {WALLS} zcylinder 0.1"),
    "a region's wall": closed(TUBE + f"fix wall all wall/gran/region {WALLS} region tube"),
    "mirrors": closed("fix walls all wall/reflect xlo 0.003 xhi EDGE zlo EDGE zhi EDGE"),
    "hybrid/overlay": ALL.replace(pair(), f"pair_style hybrid/overlay gran/hooke/history 10 8.57 50 25 0.33 1 zero {CUTOFF}\npair_coeff * * gran/hooke/history\npair_coeff * * zero\n"),
    "neigh_modify exclude": after("group one id <= 50\ngroup two subtract all one\nneigh_modify exclude group one two"),
    "a smaller group": (ALL.replace(GAS, "group some id <= 60\n" + GAS).replace("fix size all", "fix size some")),
    "hybrid atom style": ALL.replace("atom_style   sphere", "atom_style hybrid sphere charge"),
    "fix deform": after("fix wider all deform 1 x scale 1.05 remap x"),
    "fix balance": after("fix even all balance 50 1.0 shift xz 5 1.0"),
    "tiled ranks": after("comm_style tiled\nfix even all balance 50 1.0 rcb").replace("units        si", "units si\nnewton off"),
    "fix freeze": after("group still id <= 5\nfix still still freeze"),
    "fix addforce": after("fix push all addforce 1e-8 0 0"),
    "fix nve/limit": ALL.replace("all nve\n", "all nve/limit 1e-4\n"),
    "fix nve/noforce": ALL.replace("all nve\n", "all nve/noforce\n"),
    "a second run after a set command": ALL + f"set atom 1 diameter {diameter(1000)!r} density 1000\nrun 100\n",
    "minimize in between": ALL + "min_style cg\nminimize 0 1e-4 5 5\n" + RUN,
    "minimize in between, by fire": ALL + "min_style fire\nminimize 0 1e-4 50 50\n" + RUN,
    "reset_atoms id in between": ALL + "reset_atoms id sort yes\n" + RUN,
    "change_box in between": ALL + "change_box all z final 0 0.04 boundary p f p\n" + RUN,
    "run every": ALL.replace(RUN, 'run 300 every 30 "set group all omega 0 0 0"\n'),
}  # fmt: skip


def particles(name: str, table: np.ndarray) -> np.ndarray:
    names = "walls on fixed sides,a plane inside the box,a plane that moves,a tube,a region's wall,mirrors,a smaller group".split(
        ","
    )
    at_start = dict.fromkeys([*names, "walls within, told by a region"], 60)
    return np.full(len(table), at_start.get(name, 100) * 400.0)


ON_TWO_RANKS = {"fix balance", "tiled ranks", "fix deform", "shrink-wrapped sides", "hybrid atom style"}


@pytest.mark.parametrize("name", WORKS)
def test_works(tmp_path, name):
    r = run(tmp_path, WORKS[name], 2 if name in ON_TWO_RANKS else 1, check=False)
    assert r.code == 0, r.output[-1500:]
    table = r.table()
    assert np.array_equal(table[:, 2], particles(name, table) + table[:, 25] - table[:, 26])
    assert table[-1, scenes.BREAKUPS] > 0


DUMPED = "dump d all custom 50 d.dump id type x y z vx vy vz\nrun 300\nundump d\n"

REFUSED = {
    "two dimensions": ("units si\ndimension 2\natom_style sphere\ncomm_modify vel yes\nregion box block 0 1 0 1 -0.1 0.1\ncreate_box 1 box\n" + pair() + GAS + SIZE, "requires a 3-d simulation"),
    "triclinic": (ALL.replace(RUN, "change_box all triclinic\n" + RUN), "does not support triclinic boxes"),
    "triclinic before": (ALL.replace(SIZE, "change_box all triclinic\n" + SIZE), "does not support triclinic boxes"),
    "no radius": (HEAD.replace("atom_style   sphere", "atom_style charge") + "mass * 1\n" + pair() + SIZE, "requires atom style sphere or cluster"),
    "rerun": (ALL.replace(RUN, DUMPED + "rerun d.dump first 0 last 300 dump x y z vx vy vz\n"), "does not support rerun of events"),
    "rerun that makes atoms anew": (ALL.replace("merge 0.2", "merge no break no").replace(RUN, DUMPED + "rerun d.dump dump x y z vx vy vz purge yes add yes replace no\n"), "has diameter 1, which does not fit its"),
    "respa": (ALL.replace(RUN, "run_style respa 2 2\n" + RUN), "does not support run_style respa"),
    "fix adapt": (after("variable d equal 1e-3\nfix grow all adapt 10 atom diameter v_d").replace("atom_style   sphere", "atom_style sphere 1"), "does not support fix adapt grow, which changes diameters"),
    "two fixes": (after(SIZE.replace("fix size", "fix more")), "only one fix cluster/breakmerge at a time"),
    "dynamic group": (ALL.replace(SIZE, "group low dynamic all region box every 10\n" + SIZE.replace("all", "low")), "dynamic group"),
    "an indenter": (after("fix ball all indent 10.0 sphere 0.015 0.0015 0.015 0.002 units box"), "does not see where fix indent ball is"),
    "a wall that is a variable": (closed("variable low equal 0.001\nfix walls all wall/reflect xlo v_low"), "does not see where fix wall/reflect walls, whose place is a variable"),
    "a region that is not there": (ALL.replace("merge 0.2", "merge 0.2 region tube"), "region ID tube does not exist"),
    "a box that shrinks": (after("fix shrink all deform 1 x final 0 0.009 remap x").replace(RUN, "run 300\n"), "an event would meet its own image"),
    "a set command within a run": (ALL.replace(RUN, 'run 300 every 30 "set atom 1 diameter 1e-3"\n'), "does not fit its 400 primary particles"),
    "replicate": (ALL.replace(RUN, "run 0\nreplicate 1 1 2\n"), "Cannot replicate with fixes that store per-atom quantities"),
    "tiled ranks, contact history, newton on": (after("comm_style tiled"), "Reverse comm fix variable not yet supported by CommTiled"),
    "no pair style": (ALL.replace(pair(), ""), "must be defined after the pair_style command"),
    "a pair style without contacts": (ALL.replace(pair(), f"pair_style zero {CUTOFF}\npair_coeff * *\n"), "needs a granular pair style"),
    "no cutoff for growth": (ALL.replace(f" cutoff {CUTOFF}", ""), "below the largest cluster diameter"),
    "a short ghost cutoff": (ALL.replace("comm_modify  vel yes cutoff 6.5e-3", "comm_modify vel yes cutoff 3e-3"), "use 'comm_modify cutoff"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_refused(tmp_path, name):
    script, message = REFUSED[name]
    r = run(tmp_path, script, check=False)
    assert r.code != 0
    assert message in r.output, r.output[-1500:]


def test_narrow_parts_of_the_box_are_found_while_it_runs(tmp_path):
    """Fix balance gives a rank a strip that is thinner than a claim: fragments could skip it."""
    crowd = ALL.replace("EDGE EDGE 0.0015 0.0015 EDGE EDGE", "0.001 0.009 0.0015 0.0015 EDGE EDGE").replace(
        "plane overlap", "plane overlap", 1
    )
    script = "processors 4 1 1\n" + crowd.replace(" 100 1 plane", " 60 1 plane").replace(
        OUT, "fix even all balance 50 1.0 shift x 20 1.0\n" + OUT
    )
    r = run(tmp_path, script, 4, check=False)
    assert r.code != 0 and "a rank's part of the box is" in r.output, r.output[-1500:]


def test_fragments_stay_within_the_region(tmp_path):
    """Clusters along the wall of a tube break: no piece may reach through it."""
    ring = "".join(
        f"create_atoms 1 single {float(0.015 + 0.0124 * np.cos(a))!r} 0.0015 {float(0.015 + 0.0124 * np.sin(a))!r}\n"
        for a in np.arange(0, 2 * np.pi, 0.35)
    )
    script = HEAD.replace("boundary     p f p", "boundary f f f") + ring
    script += f"set type 1 diameter {diameter(400)!r} density 1000\n" + pair() + TUBE + MOVE
    script += "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 20\n" + SIZE.replace(
        "merge 0.2", "merge no region tube"
    )
    script += (
        "timestep 1e-12\nrun 100\nwrite_dump all custom end.dump id x z diameter modify sort id format float %.17g\n"
    )
    row = run(tmp_path, script).dump()
    assert len(row["id"]) > 3 * 18
    reach = np.hypot(row["x"] - 0.015, row["z"] - 0.015) + 0.5 * row["diameter"]
    assert reach.max() < 0.013 * (1 + 1e-12)


@pytest.mark.parametrize("np_", (1, 2))
def test_rerun_of_a_run_without_events(tmp_path, np_):
    """The table of the rerun is that of the run, frame by frame: counts, sizes and forces are measured anew."""
    script = ALL.replace("merge 0.2", "merge no break no").replace(RUN, DUMPED)
    again = script.replace("run 300\n", "").replace(DUMPED.splitlines()[0] + "\n", "").replace("undump d\n", "")
    first = run(tmp_path, script, np_).table()
    second = run(tmp_path, again + "rerun d.dump dump x y z vx vy vz\n", np_).table()
    frames = np.isin(first[:, 0], second[:, 0])
    assert len(second) == 7 and frames.sum() == 7
    assert np.allclose(second[:, 1:12], first[frames, 1:12], rtol=1e-4)


MOLECULE = """two clusters, no bond

2 atoms

Coords

1 0 0 0
2 0.0012 0 0

Types

1 1
2 1

Diameters

1 {d}
2 {d}

Masses

1 {m}
2 {m}
"""


@pytest.mark.parametrize("np_", (1, 2))
def test_clusters_come_as_molecules(tmp_path, np_):
    """Command molecule as a template of several clusters at once, for fix deposit."""
    (tmp_path / "two.mol").write_text(MOLECULE.format(d=repr(diameter(400)), m=repr(400 * M_P)))
    feed = "molecule two two.mol\nfix feed all deposit 5 0 20 777 region plane mol two near 0.001\n"
    table = run(tmp_path, ALL.replace("timestep 2e-6\n", feed + "timestep 2e-6\n"), np_).table()
    assert table[-1, 25] == 5 * 2 * 400
    assert np.array_equal(table[:, 2], 100 * 400 + table[:, 25] - table[:, 26]) and table[-1, scenes.BREAKUPS] > 0


def test_partitions_run_side_by_side(tmp_path):
    """Each is as it is alone."""
    if not have_mpirun():
        pytest.skip("needs mpirun")
    script = ALL.replace("100 1 plane", "100 ${seed} plane").replace("file out.txt", "file out.${seed}.txt")
    (tmp_path / "in.lmp").write_text("variable seed universe 1 2\n" + script)
    run_file(tmp_path, ["-partition", "2x1", "-in", "in.lmp", "-screen", "none"], 2)
    for seed in (1, 2):
        alone = run(tmp_path / str(seed), f"variable seed index {seed}\n" + script)
        assert np.array_equal(alone.table(f"out.{seed}.txt"), np.loadtxt(tmp_path / f"out.{seed}.txt"))
