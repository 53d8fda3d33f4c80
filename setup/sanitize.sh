# Memory and undefined behaviour: the tests with an engine and a plugin that watch themselves by the compiler's
# sanitizers, a busy run under valgrind.
# shellcheck shell=bash

verb_sanitize() { # unit, engine, fuzz tests and extremes under sanitizers, valgrind: [--each N, 8 scenes of each family] [some engine tests alone]
  local each=8
  [[ ${1:-} != --each ]] || { each=${2:-}; shift 2 || die "say --each N"; }
  [[ $each =~ ^[0-9]+$ ]] || die "--each wants a number of scenes, as in: ./run sanitize --each 20"
  set_up pinned
  install_tools valgrind:valgrind
  cd "$root"
  local failed=()
  (run_sanitized "$each" "$@") || failed+=("the sanitizers")
  (($#)) || (run_valgrind) || failed+=(valgrind)
  ((${#failed[@]} == 0)) || { say "FAILED: ${failed[*]}"; exit 1; }
  say "passed: nothing found"
}

# Every finding stops its process, and a test that expects a refusal cannot hide it: the address sanitizer
# leaves a file, and the tests look for the words of the other (GCC's takes no log_path beside the first).
run_sanitized() {
  local each=$1
  shift
  local home=$root/build/sanitize
  local found=$home/findings verdict=0
  unset LAMMPS_SOURCE_DIR LAMMPS_EXE # an engine of the user's own does not watch itself
  use_lammps sanitized
  checked_build sanitize "$LAMMPS_EXE"
  rm -rf "$found" "$home"/{model,pytest}.xml
  mkdir "$found"
  # Leaks are valgrind's task, which knows whose they are: Open MPI and LAMMPS leave memory behind at exit.
  # bench/messages.py loads its counter of messages before all else: verify_asan_link_order=0 lets it.
  local options=detect_leaks=0:detect_stack_use_after_return=1:strict_string_checks=1:verify_asan_link_order=0
  export ASAN_OPTIONS=$options:log_path=$found/address
  export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
  export CLUSTERDEM_LMP=$home/bin/lmp CLUSTERDEM_BUILD=$home CLUSTERDEM_FUZZ_LINES=2000
  if (($#)); then
    say "$* under the address and undefined-behaviour sanitizers"
    run_pytest "$home/pytest.xml" "$@"
    count_results "$home/pytest.xml" || verdict=1
  else
    say "the unit tests, the engine tests, the fuzz and $each extreme scenes of each family under the sanitizers"
    "$home/model_tests" --gtest_brief=1 --gtest_output="xml:$home/model.xml" || true
    run_pytest "$home/pytest.xml" tests/engine tests/fuzz
    count_results "$home/model.xml" "$home/pytest.xml" || verdict=1
    # each step costs more here: longer limits of time
    "$venv/bin/python" tests/extremes/campaign.py --each "$each" --patience 10 </dev/null || verdict=1
  fi
  local file
  for file in "$found"/*; do
    # Open MPI's own daemon, started by a run without mpirun, has findings of its own
    grep -qs LAMMPS_NS "$file" || continue
    say "finding: $file"
    head -n 25 "$file" >&2
    verdict=1
  done
  return "$verdict"
}

# Breaks, merges and a restart on one rank and on two. Errors and leaks count if our code is on their stack;
# those of LAMMPS and MPI alone do not.
run_valgrind() {
  unset LAMMPS_SOURCE_DIR LAMMPS_EXE
  use_lammps portable # valgrind knows older processors only
  local home=$root/build/valgrind
  local logs=$home/logs launcher=$home/lmp
  make_folder "$home"
  printf '#!/bin/sh\nexec valgrind %s "%s" "$@"\n' "--log-file='$logs/%p.log' --suppressions='$root/tests/valgrind.supp' \
--leak-check=full --keep-debuginfo=yes --num-callers=40 --fullpath-after=" "$LAMMPS_EXE" >"$launcher"
  chmod +x "$launcher"
  checked_build valgrind "$launcher"
  rm -rf "$logs" "$home/pytest.xml"
  mkdir "$logs"
  say "a busy run and its continuation from a restart file under valgrind"
  CLUSTERDEM_LMP=$home/bin/lmp run_pytest "$home/pytest.xml" tests/engine/test_short_run.py
  count_results "$home/pytest.xml" || return 1
  # a paragraph of a log is one error
  ! awk 'BEGIN { RS = "==[0-9]+== *\n" } /src\/CLUSTER\// { print; found = 1 } END { exit !found }' "$logs"/*.log >&2
}

# checked_build PRESET ENGINE: the plugin and unit tests in build/PRESET, whose bin/lmp starts ENGINE
checked_build() {
  local preset=$1 engine=$2
  local home=$root/build/$preset
  local log=$home/build.log
  make_folder "$home"
  { LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR LAMMPS_EXE=$engine cmake --preset "$preset" &&
    cmake --build "$home"; } >"$log" 2>&1 </dev/null || die_with_log "$log" "the build for $preset failed."
}
