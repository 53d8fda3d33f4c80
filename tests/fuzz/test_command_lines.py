"""Every line of a command, however wrong, runs with finite numbers or is refused in words that name the fault."""

import os
import re

import numpy as np
import pytest
from command_lines import COMMANDS, lines
from fork_server import Server
from gas_files import write_field
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from lammps_run import clusters, head, pair

# `./run fuzz` says how many; a plain test run takes the same few lines each time
LINES = int(os.environ.get("CLUSTERDEM_FUZZ_LINES", "0"))
PROFILE = settings(
    max_examples=(LINES or 500) // len(COMMANDS),
    derandomize=LINES == 0,
    deadline=None,
    print_blob=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow],
)

# two that touch and move alike (they merge), others at rest in the wind (they break)
SCENE = (
    head()
    + clusters(
        (300, (0.010, 0.010), (0.0, 1.0)),
        (300, (0.0108, 0.010), (0.0, 1.0)),
        (2000, (0.030, 0.010), (0.0, 0.0)),
        (400, (0.030, 0.030), (0.0, 0.0)),
        (3, (0.010, 0.030), (0.1, 0.0)),
    )
    + pair()
    + "variable u equal 0.5\nvariable w atom 2+x\nvariable bad equal 1/0\nregion room block 0 0.039 INF INF 0 0.039\n"
    + "fix held all property/atom d_own i_mark\nfix move all nve\ntimestep 1e-6\n"
)

# an error found when a run begins names who found it, and a cause that is not of one word
AT_RUN_TIME = (
    "Fix drag/cluster drag",
    "Fix cluster/breakmerge size",
    "Fix cluster/timestep step",
    "Fix nve/cluster move",
    "Pair style gran/cluster",
    "Variable ",
)
# numbers are taken at their word: what a gas of 1e300 kg/m3, or a cutoff of as many metres, does is for LAMMPS to say
ENGINE = ("Lost atoms", "Non-numeric atom coords", "out of range atoms", "Non-numeric box", "Cannot use neighbor bins")


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fuzz")
    (folder / "gas.txt").write_text("0 0 0 2\n0.04 0 0 3\n")
    x = np.array([0.0, 0.01, 0.02, 0.03])
    for name, time in (("gas.vtk", None), ("gas.0.vtk", 0.0), ("gas.1.vtk", 1.0)):
        write_field(folder / name, (x, x[:1], x), [0, 0, 2], time=time)
    write_field(folder / "eddies.vtk", (x, x[:1], x), [0, 0, 2], period=1e-6, eddy_size=1e-3)
    server = Server(folder, SCENE)
    yield server
    server.close()


@pytest.mark.parametrize("name", COMMANDS)
@PROFILE
@given(data=st.data())
def test_lines(server, name, data):
    command = COMMANDS[name]
    script = command.script(data.draw(lines(command), label="words"))
    answer = server.run(script)
    event(answer.ending)
    fault = judge(answer, command)
    assert not fault, f"{fault}\n{script}\n{answer.output[-3000:]}"


def judge(answer, command):
    """What is wrong with this end; nothing if it ran, or was refused as it should be."""
    if answer.status == 0:
        return None
    if command.start == "pair_coeff" and "exception: stol" in answer.output:
        return None  # of LAMMPS' own reading of types, any pair style's: it calls "-" a number
    if answer.status != 1:
        return answer.ending
    output = answer.output.splitlines()
    start = max((k for k, line in enumerate(output) if line.startswith("ERROR")), default=None)
    if start is None:
        return "ended with a failure, but without a message of LAMMPS"
    message = output[start].partition(": ")[2]
    carets = [line for line in output[start:] if line.strip() and set(line.strip()) == {"^"}]
    if carets:
        return judge_caret(message, output[output.index(carets[0]) - 1], carets[0], command)
    empty_word = "value:  (must be" in message or message.startswith("Unknown") and "keyword:  (" in message
    names_the_gap = re.match(rf"Illegal {command.start.split()[0]} .* (missing |the keyword|needs? )", message)
    if empty_word or names_the_gap or message.startswith(AT_RUN_TIME + ENGINE):
        return None
    types = "Numeric index|Integer .* out of range|Invalid range|Incorrect args"
    if command.start == "pair_coeff" and re.match(types, message):
        return None  # LAMMPS' own reading of types
    return "refused without naming the word"


def judge_caret(message, line, carets, command):
    start, stop = carets.index("^"), len(carets)
    if line[start - 1] != " " or line[stop : stop + 1] not in ("", " "):
        return "the caret does not stand under a whole word"
    if start < line.index(command.start) + len(command.start):
        return "the caret stands under the command itself"
    if line[start:stop].strip("\"'") not in message:
        return "the message does not name the word under the caret"
    return None
