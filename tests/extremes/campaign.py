"""Runs the scenes of all families, or of some; a run of everything writes README.md.

./run extremes                     every scene, then kills and cut restart files; writes tests/extremes/README.md
./run extremes gas "all merge:3"   one family, one scene
./run extremes --each 8            the first 8 scenes of every family, nothing written
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "engine")]

import cut_restart  # noqa: E402
import kill_and_resume  # noqa: E402
from families import FAMILIES, SEED  # noqa: E402
from lammps_run import LMP  # noqa: E402
from outcomes import Outcome, ran  # noqa: E402

KILLS = 4  # of each chain; two settings, np 1 and 2, two chains of each
CUTS = 40  # of each restart file


def scenes(words: list[str], seed: int, keep: Path, each: int | None, patience: float) -> dict[str, list[Outcome]]:
    seen: dict[str, list[Outcome]] = {}
    for word in words:
        name, _, index = word.partition(":")
        family = FAMILIES[name]
        for k in [int(index)] if index else range(family.count)[:each]:
            began = time.monotonic()
            scene = family.scene(k, seed)
            scene.time_limit *= patience
            outcome = ran(scene, keep / name.replace(" ", "_").replace("/", "_") / str(k))
            outcome.seconds = time.monotonic() - began
            seen.setdefault(name, []).append(outcome)
            print(f"{scene.name} np {scene.np_}: {outcome.kind} {outcome.why} ({outcome.seconds:.1f} s)", flush=True)
    return seen


def kills(keep: Path, seed: int) -> tuple[str, int]:
    """Every chain against its reference; what was seen, and the number of failures."""
    count: Counter[str] = Counter()
    for number in range(2):
        for setting in kill_and_resume.SETTINGS:
            for np_ in (1, 2):
                folder = keep / "kill" / f"{setting.name}-{np_}-{number}".replace(" ", "_")
                difference, chain = kill_and_resume.tried(folder, setting, np_, KILLS, seed + 10 * number + np_)
                print(f"killed, {setting.name}, np {np_}: {chain} {difference or 'bit-equal'}", flush=True)
                count["chains"] += 1
                count["kills"] += chain.kills
                count["cut files"] += chain.cut_files
                count["failed"] += difference != ""
    text = (
        f"{count['kills']} kills in {count['chains']} runs, {count['cut files']} left a restart file cut short; "
        f"{count['chains'] - count['failed']} of {count['chains']} ended bit-equal"
    )
    return text, count["failed"]


def cuts(keep: Path, seed: int) -> tuple[str, int]:
    failed = tried = 0
    for np_ in (1, 2):
        folder = keep / "cut" / str(np_)
        whole = cut_restart.written(folder, np_).read_bytes()
        for length in cut_restart.lengths(len(whole), CUTS, seed + np_):
            (folder / "cut.restart").write_bytes(whole[:length])
            fault = cut_restart.fault_when_read(folder, "cut.restart", np_)
            tried += 1
            if fault:
                failed += 1
                print(f"restart file cut at {length} of {len(whole)} bytes, np {np_}: {fault}", flush=True)
    return f"{tried} cuts: {tried - failed} refused, {failed} not", failed


def row(name: str, outcomes: list[Outcome]) -> str:
    family = FAMILIES[name]
    kinds = Counter(o.kind for o in outcomes)
    reasons = Counter(o.why for o in outcomes if o.kind == "refused")
    refused = ", ".join([str(kinds["refused"])] + [f"{reason}: {n}" for reason, n in reasons.items()])
    rises = [o.energy_rise for o in outcomes if o.energy_rise > 1.001]
    silent = f"Energy rose in silence in {len(rises)} scenes, up to {max(rises):.3g} times" if rises else "–"
    found = family.found if family.found != "–" else silent
    counts = [len(outcomes), kinds["passed"], refused, kinds["failed"]]
    return "| " + " | ".join(map(str, [name, family.tried, family.holds, *counts, found])) + " |"


def versions() -> str:
    engine = subprocess.run([LMP, "-h"], capture_output=True, text=True).stdout
    lammps = next(line for line in engine.splitlines() if "Large-scale" in line).rsplit(" - ", 1)[-1].split(" - ")[0]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=HERE, capture_output=True, text=True).stdout
    return f"LAMMPS {lammps.strip()}, this project at {commit.strip()}"


def readme(seen: dict[str, list[Outcome]], seed: int, more: tuple[str, str], built: str, minutes: float) -> str:
    total = Counter(o.kind for outcomes in seen.values() for o in outcomes)
    rows = "\n".join(row(name, outcomes) for name, outcomes in seen.items())
    return (
        (HERE / "README.in")
        .read_text()
        .format(
            tried=sum(total.values()),
            passed=total["passed"],
            refused=total["refused"],
            failed=total["failed"],
            seed=seed,
            rows=rows,
            kills=more[0],
            cuts=more[1],
            date=time.strftime("%-d %b %Y"),
            versions=built,
            minutes=f"{minutes:.0f}",
        )
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="*", help="FAMILY or FAMILY:NUMBER (default: everything)")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--keep", type=Path, help="folder that keeps inputs and outputs")
    parser.add_argument("--each", type=int, metavar="N", help="the first N scenes of each family alone")
    parser.add_argument("--patience", type=float, default=1.0, help="times a scene's limit of time, for a slow engine")
    given = parser.parse_args()
    for word in given.what:
        if word.partition(":")[0] not in FAMILIES:
            parser.error(f"no family '{word}': " + ", ".join(FAMILIES))
    began = time.monotonic()
    built = versions()  # as they are now: the campaign takes a while
    print(f"seed {given.seed}, {built}", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        keep = given.keep or Path(scratch)
        seen = scenes(given.what or list(FAMILIES), given.seed, keep, given.each, given.patience)
        failed = sum(o.kind == "failed" for outcomes in seen.values() for o in outcomes)
        if not given.what and given.each is None:
            (killed, bad_kills), (cut, bad_cuts) = kills(keep, given.seed), cuts(keep, given.seed)
            failed += bad_kills + bad_cuts
            text = readme(seen, given.seed, (killed, cut), built, (time.monotonic() - began) / 60.0)
            (HERE / "README.md").write_text(text)
    print(f"{sum(map(len, seen.values()))} scenes, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
