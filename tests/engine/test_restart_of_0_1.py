"""Restart files of version 0.1 go on: totals, contacts of the last test, draws of each cluster's own fluctuation.

The file and the gas velocities beside it were written by commit 14e5d1a (LAMMPS 4 Feb 2025, one rank): 40 clusters of 400 particles for 1500
steps with `test end` and `fluctuation own`; one of them broke into three, two merged.
"""

from pathlib import Path

import numpy as np
import pytest
from lammps_run import Run, bits_of_ids, run

pytestmark = pytest.mark.skipif(bits_of_ids() != 32, reason="the file holds 32-bit IDs, which this LAMMPS refuses")

FILES = Path(__file__).parent / "version_0_1"
SCRIPT = f"""
atom_modify map hash sort 0 0
comm_modify vel yes cutoff 5.7e-3
read_restart {FILES / "clusters.restart"}
neighbor 0.5e-3 bin
fix move all nve
fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 own 4e-4 5 plane xz
fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.3 merge 0.2 test end
timestep 2e-6
fix table all ave/time 100 1 100 f_size[*] mode scalar file out.txt format " %.17g"
run 0
write_dump all custom end.dump id f_drag[1] f_drag[3] modify sort id format float %.17g
run 200
"""


@pytest.mark.parametrize("np_", (1, 2))
def test_it_goes_on(tmp_path, np_):
    r = run(tmp_path, SCRIPT, np_)
    table = r.table()
    # clusters, particles, breakups, merges, born, deferred; tested
    assert table[0, :8].tolist() == [1500, 41, 16000, 1, 1, 3, 0, table[0, 7]] and table[0, 12] == 2
    # as 0.1 went on: nobody breaks for contacts that did not end, two were tested
    assert table[-1, :7].tolist() == [1700, 41, 16000, 1, 1, 3, 0] and table[-1, 12] == 4
    gas, before = r.dump(), Run(0, "", FILES).dump("gas.dump")
    assert np.array_equal(gas["id"], before["id"])
    for column in ("f_drag[1]", "f_drag[3]"):
        assert np.array_equal(gas[column], before[column])


@pytest.mark.parametrize("test", ["always", "contact"])
def test_another_test_leaves_the_contacts_of_the_file(tmp_path, test):
    """Clusters and totals go on, whoever is tested from here on."""
    table = run(tmp_path, SCRIPT.replace("test end", f"test {test}")).table()
    assert table[0, :7].tolist() == [1500, 41, 16000, 1, 1, 3, 0]
    assert table[-1, 2] == 16000
