"""Studies to begin with: they run as they are."""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

TRADE = """\
# What case 1 can do without, on a fifteenth of its domain up to 2 ms.
#   clusterdem trade study.toml --tolerance 0.05
# All keys: clusterdem trade --schema
input = {input}    # the script; relative to this file
seeds = 3          # every setting with seeds 1 to 3, by the variable seed
# ranks = 4        # MPI ranks of a run
# launcher = "srun -n {{np}}"    # what starts a run; mpirun -np {{np}} otherwise
observables = ["clusters", "mean_diameter", "speed"]

[[observable]]     # of your own: columns of the dump, numpy's functions, run.NAME of table and thermo output
name = "speed"
label = "mean speed"
unit = "m/s"
value = "sum(mass*sqrt(vx**2 + vz**2))/sum(mass)"

[variables]        # of every run, as -var NAME VALUE
tend = 0.002
height = 0.0666666667

[switches]         # the first value is the most careful one; all first values together are the reference
every = [10, 100]
dt = [1e-6, 2e-6]

[[axis]]           # settings of several variables
name = "contact"
settings = [
  {{ name = "linear", contact = "linear" }},
  {{ name = "frictionless", contact = "frictionless" }},
]
"""

CALIBRATE = """\
# The constant of the size law and the start of case 1 fitted to two numbers, on a fifteenth of its domain up to 2 ms.
#   clusterdem calibrate study.toml
# All keys: clusterdem calibrate --schema
seeds = 2          # of every stage that names no others
# ranks = 4        # MPI ranks of a run
# launcher = "srun -n {{np}}"    # what starts a run; mpirun -np {{np}} otherwise

[variables]        # of every run, as -var NAME VALUE; {{c}} would be the place of a parameter c
reading = "free"
setting = "fast"
tend = 0.002
height = 0.0666666667

[[observable]]     # of your own: columns of the dump, numpy's functions, run.NAME of table and thermo output
name = "speed"
label = "mean speed"
unit = "m/s"
value = "sum(mass*sqrt(vx**2 + vz**2))/sum(mass)"

[[case]]           # one or more, fitted together
name = "case1"
input = {input}    # the script; relative to this file
solids = 2.0944e-3           # kg that the observed number of clusters belongs to

[[case.target]]    # what was observed: value, or below or above where only a bound is known
quantity = "clusters"
time = 0.002       # s
value = 5400
error = 0.05       # its standard deviation, a share of 1

[[case.target]]
quantity = "speed"
time = 0.002
below = 3

[[parameter]]      # sets the variable of its name
name = "K_3"
low = 0.005
high = 0.1
log = true

[[parameter]]
name = "begin"
choices = ["gas", "rest"]

[start]            # known points, tried first
A = {{ K_3 = 0.0399, begin = "gas" }}

[search]
trials = 6
limit = 60         # core-seconds; a run that takes longer counts as far off

[local]            # sensitivities about the best point

[confirm]          # the best point and starts to compare it with, run again
starts = ["A"]
"""


def _inputs() -> Iterator[Path]:
    """Where the inputs may lie: in the sources, or where they are installed beside an engine or a Python."""
    yield Path(__file__).parents[4] / "inputs"
    engines = [found for name in ("lmp", "lmp_cluster") if (found := shutil.which(name))]
    for prefix in (
        *(Path(engine).resolve().parents[1] for engine in engines),
        Path(sys.prefix),
        Path.home() / ".local",
        Path("/usr"),
    ):
        yield prefix / "share/clusterdem/inputs"


def filled(template: str) -> str:
    """A template with the path of case 1's script, or its bare name where it is not found."""
    script = next((folder / "case1.in" for folder in _inputs() if (folder / "case1.in").is_file()), Path("case1.in"))
    return template.format(input=json.dumps(str(script), ensure_ascii=False))
