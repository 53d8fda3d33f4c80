"""What decides a run's result: scripts, includes, data files, variables, seed, ranks, engine."""

from __future__ import annotations

import os
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from clusterdem import ArgumentError, InputError
from clusterdem.io.enginelog import read_log
from clusterdem.studies.engine import Engine, find_engine
from clusterdem.studies.runs import plan
from clusterdem.studies.script import read_script
from clusterdem.studies.trade.frames import keeping_of
from clusterdem.studies.trade.settings import settings_of
from clusterdem.studies.trade.study import read_study

INPUTS = Path(__file__).parents[2] / "inputs"
ENGINE = Engine("/opt/lmp", "LAMMPS (4 Feb 2025)", "plugin as it is", ())
STUDY = 'input = "inputs/case1.in"\nseeds = 3\n[switches]\ncontact = ["hooke", "md"]\n'


@pytest.fixture
def study(tmp_path):
    shutil.copytree(INPUTS, tmp_path / "inputs")
    (tmp_path / "study.toml").write_text(STUDY)
    return read_study(tmp_path / "study.toml")


def keys(study, engine=ENGINE):
    return [run.key for run in plan(study, settings_of(study), engine, Path("runs"), keeping_of(("clusters",)))]


def edit(path):
    path.write_text(path.read_text() + "# another line\n")


def read(name, **variables):
    return [file.name for file in read_script(INPUTS / name, {"inputs": str(INPUTS), **variables}).files]


def test_includes_follow_the_variables():
    read_by_case1 = ["case1.in", "common.in", "setting_standard.in", "reading_A.in", "contact_linear.in"]
    assert read("case1.in")[: len(read_by_case1)] == read_by_case1
    assert "contact_md.in" in read("case1.in", contact="md") and "contact_linear.in" not in read(
        "case1.in", contact="md"
    )
    assert "step_controlled.in" in read("case1.in", step="controlled")
    assert "case3.profile" in read("case3.in")  # a data file


def test_variables_that_a_script_knows():
    names = read_script(INPUTS / "case1.in", {"inputs": str(INPUTS)}).names
    assert {"seed", "dt", "every", "u_g", "gusts", "ncc"} <= names and "dtt" not in names


def test_continued_lines_comments_and_quotes(tmp_path):
    (tmp_path / "more.in").write_text("")
    (tmp_path / "data.txt").write_text("")
    text = "variable name index 'more'\nif 1 then &\n  \"include ${inputs}/${name}.in\"\n# include gone.in\n"
    (tmp_path / "in.run").write_text(text + "read_data ${inputs}/data.txt\n")
    script = read_script(tmp_path / "in.run", {"inputs": str(tmp_path)})
    assert [file.name for file in script.files] == ["in.run", "more.in", "data.txt"]


def test_a_pattern_names_every_file_that_matches(tmp_path):
    for number in (0, 1, 10):
        (tmp_path / f"gas.{number}.vtk").write_text("")
    (tmp_path / "in.run").write_text('fix drag all drag/cluster 1 1 field "${inputs}/gas.*.vtk loop 0.1"\n')
    script = read_script(tmp_path / "in.run", {"inputs": str(tmp_path)})
    assert [file.name for file in script.files] == ["in.run", "gas.0.vtk", "gas.1.vtk", "gas.10.vtk"]


def test_a_changed_file_of_a_pattern_changes_the_key(study):
    common = study.input.parent / "common.in"
    common.write_text(common.read_text() + "variable g index ${inputs}/gas.*.vtk\n")
    gas = study.input.parent / "gas.1.vtk"
    gas.write_text("3")
    before = keys(study)
    gas.write_text("9")
    changed = keys(study)
    assert not set(before) & set(changed)
    (study.input.parent / "gas.2.vtk").write_text("")  # one more frame of the series
    assert not set(changed) & set(keys(study))


def test_what_a_wrapper_starts_belongs_to_the_engine(tmp_path):
    """A script that starts a copy of an executable: another copy is another engine, though the script is the same."""
    real = Path(os.environ.get("CLUSTERDEM_LMP") or Path(__file__).parents[2] / "build/bin/lmp")
    if not real.exists():
        pytest.skip("no engine: build/bin/lmp is missing")
    behind = find_engine(str(real)).files[1]
    copy = shutil.copy(behind, tmp_path / "copy")
    (tmp_path / "lmp").write_text(f'#!/bin/sh\nexec "${{OTHER:-{copy}}}" "$@"\n')
    (tmp_path / "lmp").chmod(0o755)
    engine = find_engine(str(tmp_path / "lmp"))
    assert Path(copy) in engine.files and not engine.changed
    with open(copy, "ab") as file:
        file.write(b"built anew")
    assert engine.changed and find_engine(str(tmp_path / "lmp")).identity != engine.identity


def test_an_include_that_is_not_found_names_its_line(tmp_path):
    (tmp_path / "in.run").write_text("units si\ninclude more.in\n")
    with pytest.raises(InputError, match=r"in.run:2: include more.in: no such file.*\$\{inputs\}/FILE"):
        read_script(tmp_path / "in.run", {"inputs": str(tmp_path)})


def test_a_file_that_includes_itself_ends(tmp_path):
    (tmp_path / "in.run").write_text("include ${inputs}/in.run\n")
    assert len(read_script(tmp_path / "in.run", {"inputs": str(tmp_path)}).files) == 1


def test_every_run_has_its_own_key(study):
    assert len(set(keys(study))) == 6 and keys(study) == keys(study)


def test_what_changes_a_key(study):
    before = keys(study)
    assert not set(before) & set(keys(study, replace(ENGINE, identity="plugin built anew")))
    assert not set(before) & set(keys(replace(study, ranks=2)))
    assert not set(before) & set(keys(replace(study, variables={"tend": "1e-4"})))
    assert keys(replace(study, seeds=(3, 2, 1)))[0] == before[2]
    edit(study.input.parent / "case2.in")  # not read
    assert keys(study) == before
    edit(study.input.parent / "contact_md.in")  # read by half of the runs
    assert keys(study)[:3] == before[:3] and not set(before) & set(keys(study)[3:])
    edit(study.input.parent / "common.in")
    assert not set(before) & set(keys(study))


def test_a_key_does_not_depend_on_the_place(study, tmp_path):
    before = keys(study)
    shutil.copytree(tmp_path / "inputs", tmp_path / "elsewhere/inputs")
    (tmp_path / "elsewhere/study.toml").write_text(STUDY)
    assert keys(read_study(tmp_path / "elsewhere/study.toml")) == before


def test_the_command(study):
    """The limit is that of the engine's own processes, not of what starts them."""
    settings, keeping = settings_of(study), keeping_of(("clusters",))
    run = plan(replace(study, ranks=2), settings, ENGINE, Path("runs"), keeping, limit=5)[4]
    case = str(study.input)
    assert run.command[:11] == (
        "mpirun", "-np", "2", "prlimit", "--cpu=5:6", "--core=0", "/opt/lmp", "-in", case, "-log", "log.lammps",
    )  # fmt: skip
    pairs = list(zip(run.command[12::3], run.command[13::3]))
    assert run.command[11::3] == ("-var",) * len(pairs)
    assert {("contact", "md"), ("seed", "2"), ("inputs", str(study.input.parent)), ("outdir", ".")} <= set(pairs)
    alone = plan(study, settings, ENGINE, Path("runs"), keeping)[4]
    assert alone.command[:2] == ("/opt/lmp", "-in") and alone.launcher == () and alone.limit is None


def test_a_variable_that_the_script_does_not_know(study):
    with pytest.raises(InputError, match="case1.in knows no variable 'tendd': it would change nothing"):
        keys(replace(study, variables={"tendd": "1e-4"}))


def test_a_script_without_seed(study):
    (study.input.parent / "plain.in").write_text("variable contact index md\n")
    with pytest.raises(InputError, match="plain.in knows no variable 'seed'"):
        keys(replace(study, input=study.input.parent / "plain.in"))


def test_an_engine_that_is_none(tmp_path):
    with pytest.raises(ArgumentError, match="executable: .*gone is no executable"):
        find_engine(str(tmp_path / "gone"))
    (tmp_path / "lmp").write_text("#!/bin/sh\necho something else\n")
    (tmp_path / "lmp").chmod(0o755)
    with pytest.raises(InputError, match="is not LAMMPS, or does not start: something else"):
        find_engine(str(tmp_path / "lmp"))


def test_core_seconds_of_a_log(tmp_path):
    """Two runs on two ranks, one while the machine did other work half of the time; a log that does not say counts full."""
    loop = "Loop time of {} on 2 procs for 10 steps with 5 atoms\n"
    use = "{}% CPU use with 2 MPI tasks x no OpenMP threads\n"
    (tmp_path / "log").write_text(loop.format(3.0) + "\n" + use.format("99.0") + loop.format(4.0) + use.format("50.0"))
    log = read_log(tmp_path / "log")
    assert log.loop == 7.0 and log.core_seconds == pytest.approx(2 * 3 * 0.99 + 2 * 4 * 0.5)
    (tmp_path / "log").write_text(loop.format(3.0))
    assert read_log(tmp_path / "log").core_seconds == 6.0
