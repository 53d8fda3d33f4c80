"""Gas from files in LIGGGHTS: a series of frames on a grid, as in LAMMPS, on one rank and two."""

import numpy as np
from gas_files import uneven, write_field
from liggghts_run import agree, in_both, needs_liggghts, run_liggghts, start_liggghts, write_data, write_liggghts

pytestmark = needs_liggghts

L = 0.04
FIXES = (
    "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 field ../gas.*.vtk edge z clamp plane xz "
    "fluctuation 1 0 1 own frozen 3\n"
    "fix size all cluster/breakmerge 1000000 1e-4 2000 drag drag K 1\ntimestep 1e-6\nrun 60\n"
)


def test_both_engines_see_one_gas(tmp_path):
    """The same interpolation from the same files: to the rounding of positions after 60 steps, 1e-12 of the largest value."""
    rng = np.random.default_rng(5)
    x = np.column_stack([(np.arange(80) % 9 + 0.5) * L / 9, np.full(80, 0.0015), (np.arange(80) // 9 + 0.5) * L / 9])
    write_data(tmp_path / "clusters.data", [400] * 80, x, rng.uniform(-1, 1, (80, 3)) * [1, 0, 1])
    axes = np.arange(12) * L / 12, np.array([0.0]), uneven(0.001, L - 0.001, 9)
    for k, time in enumerate((0.0, 2e-5, 1e-4)):
        write_field(
            tmp_path / f"gas.{k}.vtk", axes, rng.uniform(-3, 3, (108, 3)), time=time, kind="float",
            fluctuation=rng.uniform(0, 1, (108, 3)), density=1.2 + k, viscosity=rng.uniform(1e-5, 2e-5, 108),
        )  # fmt: skip
    lammps, liggghts = (run.dump() for run in in_both(tmp_path, FIXES))
    data = str(tmp_path / "clusters.data")
    two = run_liggghts(tmp_path / "two", start_liggghts(data=data) + FIXES + write_liggghts(), np_=2).dump()
    for column in [f"f_drag[{k}]" for k in (1, 3, 4, 6, 7, 8)] + ["x", "z", "vx", "vz"]:
        agree(lammps, liggghts, column, 1e-12)
        agree(liggghts, two, column, 1e-12)
    assert np.ptp(lammps["f_drag[1]"]) > 2.0
