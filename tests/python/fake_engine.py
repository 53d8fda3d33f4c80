"""An engine for tests of studies: notes how it was started, and writes dumps, table and log of clusters drawn by seed."""

from __future__ import annotations

import stat
import sys
from pathlib import Path

SOURCE = """#!{python}
import json, os, random, sys
if "-var" not in sys.argv:
    print("LAMMPS (1 Apr 2026)")
    sys.exit()
given = {{a: b for v, a, b in zip(sys.argv, sys.argv[1:], sys.argv[2:]) if v == "-var"}}
shown = {{name: value for name, value in os.environ.items() if name.startswith(("LAMMPS_", "OMP_"))}}
with open("{calls}", "a") as file:
    file.write(json.dumps([sys.argv, os.getcwd(), shown]) + "\\n")
seed, gain, other = int(given["seed"]), float(given.get("gain", 1)), float(given.get("other", 1))
draw = random.Random(f"{{seed}}")
names = "id x y z vx vy vz diameter mass charge"
with open("flow.N.txt", "w") as table:
    table.write("# flow\\n# step time load\\n")
    for frame in range(4):
        step, time = 10 * frame * frame, 0.01 * frame
        rows = []
        for k in range(20 + 3 * frame):
            d = draw.uniform(1e-4, 9e-4)
            row = [k + 1, draw.uniform(0, 0.3), 0.001, draw.uniform(0, 0.6)]
            row += [gain * draw.gauss(0.2, 0.4), draw.gauss(0, 0.1), gain * draw.gauss(1, 0.3), d, 1e3 * d**3, draw.uniform(-1, 3)]
            rows.append(" ".join(repr(v) for v in row))
        text = f"ITEM: TIME\\n{{time}}\\nITEM: TIMESTEP\\n{{step}}\\nITEM: NUMBER OF ATOMS\\n{{len(rows)}}\\n"
        text += "ITEM: BOX BOUNDS pp ff pp\\n0 0.3\\n0 0.003\\n0 0.6\\nITEM: ATOMS " + names + "\\n" + "\\n".join(rows) + "\\n"
        for folder in (".", "{kept}"):
            os.makedirs(folder, exist_ok=True)
            name = "flow" if folder == "." else f"{{given.get('gain', 1)}}-{{seed}}"
            with open(os.path.join(folder, f"{{name}}.{{step:06d}}.dump"), "w") as file:
                file.write(text)
        table.write(f"{{step}} {{time}} {{gain * seed + 7 * frame}}\\n")
ranks = {ranks}
with open("log.lammps", "w") as log:
    log.write("LAMMPS (1 Apr 2026)\\n   Step          Temp          c_p[2]\\n")
    for frame in range(4):
        log.write(f"{{10 * frame * frame}} 0 {{100 * seed + frame}}\\n")
    log.write(f"Loop time of {{10.0 * seed / gain / other}} on {{ranks}} procs for 90 steps with 29 atoms\\n\\n80.0% CPU use with {{ranks}} MPI tasks\\n")
"""


def fake_engine(folder: Path, ranks: int = 1) -> Path:
    """An executable in a folder; ``calls`` beside it lists how it was started, ``kept/GAIN-SEED.STEP.dump`` what it wrote."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "lmp"
    path.write_text(SOURCE.format(python=sys.executable, calls=folder / "calls", kept=folder / "kept", ranks=ranks))
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path
