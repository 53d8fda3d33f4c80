"""How a scene may end: passed, refused for a known reason that is right for it, or failed."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from drawn_scene import HELD, REFUSED, Scene
from invariants import energy_rise, fault_of, frames_of
from lammps_run import run

# What the engine and our styles say when they stop a run before anything is lost.
REFUSALS = {
    "lost": r"Lost atoms: original \d+ current \d+",
    "too soft": r"the contact spring is too soft",
    "creates energy": r"contacts create energy",
    "smallest step": r"at the smallest step",
    "not a number": r"(is|are) not finite",
    "non-numeric": r"Non-numeric (positions|atom coords) - simulation unstable",
    "gas variable": r"variable \w+ gave -?(nan|inf) at step \d+: the gas velocity must be finite",
    "formula": r"in variable formula",
    "relaxation": r"the time step \S+ is above twice the relaxation time",
    "K": r"K (emms U_p )?value: \S+ \(must be a number > 0",
    "K emms": r"K emms \S+ gives K = ",
    "short box": r"below four times the claim .*: an event would meet its own image",
    "thin rank": r"a rank's part of the box is .* below the claim",
    "pair cutoff": r"the pair cutoff of types .* is .*, below",
    "whole number": r"does not fit its \d+ primary particles|not a whole number within 1e-6",
    "ghost cutoff": r"the ghost cutoff .* is below .* twice the claim",
    "small claim": r"claim .* is below .*: the largest could never break",
    "too large": r"holds \d+ primary particles, above the upper limit",
    "many cells": r"grid value: \d+ \(must be at most",
    "many sites": r"sites of a lattice for fragments",
    "atom ID": r"Newborn clusters would need the atom ID",
    "neighbor page": r"Neighbor list overflow, boost neigh_modify one",
}


@dataclass
class Outcome:
    """kind is passed, refused or failed; `why` names the refusal, or tells the fault."""

    kind: str
    why: str
    seconds: float = 0.0
    energy_rise: float = 1.0  # largest energy over that of the start, where it is not bounded


def ran(scene: Scene, folder: Path) -> Outcome:
    """Run the scene in the folder and judge it."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in {"start.data": scene.data_file(), **scene.files}.items():
        (folder / name).write_text(text)
    try:
        result = run(folder, scene.script(), scene.np_, check=False, timeout=scene.time_limit)
        if scene.resumed_np and result.code == 0:
            result = run(folder, scene.script(again=True), scene.resumed_np, check=False, timeout=scene.time_limit)
    except subprocess.TimeoutExpired:
        return Outcome("failed", f"not finished after {scene.time_limit} s")
    except AssertionError as finding:  # of a sanitizer (./run sanitize), whatever the scene expects
        return Outcome("failed", str(finding))
    (folder / "output.txt").write_text(result.output)
    if result.code == 0:
        frames = frames_of(result)
        fault = fault_of(scene, result, frames)
        if fault:
            return Outcome("failed", fault)
        if scene.expect == REFUSED:
            return Outcome("failed", f"finished, but should have been refused: {', '.join(scene.refusals)}")
        return Outcome("passed", "", energy_rise=energy_rise(scene, frames))
    message = error_line(result.output)
    if not message:
        return Outcome("failed", f"ended with code {result.code} and no ERROR line")
    reasons = [name for name, pattern in REFUSALS.items() if re.search(pattern, message)]
    if not reasons:
        return Outcome("failed", f"an error that is not a known refusal: {message}")
    right = [reason for reason in reasons if reason in scene.refusals]
    if scene.expect == HELD or not right:
        return Outcome("failed", f"refused ({', '.join(reasons)}), which is not right here: {message}")
    return Outcome("refused", right[0])


def error_line(output: str) -> str:
    """The first error; of several requirements that are told together, all."""
    match = re.search(r"^ERROR.*(?:\n  .*)*", output, re.M)
    return match[0] if match else ""
