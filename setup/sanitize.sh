# Memory and undefined behaviour: the tests under the compiler's sanitizers, a busy run under valgrind.
# LAMMPS itself runs as it is; what counts is what our own code does, also to the engine's memory.
# shellcheck shell=bash

verb_sanitize() { # unit tests, engine tests and fuzz under sanitizers, valgrind: [pytest arguments for the engine tests]
  set_up pinned
  install_tools valgrind:valgrind
  cd "$root"
  (($#)) || set -- tests/engine
  local failed=()
  run_sanitized "$@" || failed+=("the sanitizers")
  run_valgrind || failed+=(valgrind)
  ((${#failed[@]} == 0)) || { say "FAILED: ${failed[*]}"; exit 1; }
  say "passed: nothing found by the sanitizers or by valgrind"
}

# Every finding stops its process, and a test that expects a refusal cannot hide it: the address sanitizer
# leaves a file, and the tests look for the words of the other (GCC's takes no log_path beside the first).
run_sanitized() {
  local home=$root/build/sanitize
  local found=$home/findings runtime verdict=0
  runtime=$("${CXX:-c++}" -print-file-name=libasan.so)
  [[ -e $runtime ]] || die "no address sanitizer beside the compiler ${CXX:-c++}: use g++ (CXX=g++ ./run sanitize)."
  # The plugin is loaded long after malloc was first called: its sanitizer must have been there before all
  # else to see the engine's arrays. Only lmp itself gets it, not the shells and mpirun on the way.
  checked_build sanitize "LD_PRELOAD='$runtime' exec"
  rm -rf "$found"
  mkdir "$found"
  say "the unit tests, the engine tests and the fuzz under the address and undefined-behaviour sanitizers"
  (
    # Open MPI and LAMMPS leave memory behind at exit: leaks are valgrind's task, which knows whose they are.
    export ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1:strict_string_checks=1:log_path=$found/address
    export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
    export CLUSTERDEM_LMP=$home/bin/lmp CLUSTERDEM_BUILD=$home CLUSTERDEM_FUZZ_LINES=2000
    rm -f "$home"/{model,pytest}.xml
    "$home/model_tests" --gtest_brief=1 --gtest_output="xml:$home/model.xml" || true
    run_pytest "$home/pytest.xml" "$@" tests/fuzz
  )
  count_results "$home/model.xml" "$home/pytest.xml" || verdict=1
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
  local home=$root/build/valgrind
  local logs=$home/logs
  checked_build valgrind "exec valgrind --log-file='$logs/%p.log' --suppressions='$root/tests/valgrind.supp' \
--leak-check=full --keep-debuginfo=yes --num-callers=40 --fullpath-after="
  rm -rf "$logs" "$home/pytest.xml"
  mkdir "$logs"
  say "a busy run and its continuation from a restart file under valgrind"
  CLUSTERDEM_LMP=$home/bin/lmp run_pytest "$home/pytest.xml" tests/engine/test_short_run.py
  count_results "$home/pytest.xml" || return 1
  # a paragraph of a log is one error
  ! awk 'BEGIN { RS = "==[0-9]+== *\n" } /src\/CLUSTER\// { print; found = 1 } END { exit !found }' "$logs"/*.log >&2
}

# checked_build PRESET LAUNCH: the plugin and unit tests in build/PRESET, whose bin/lmp starts LAMMPS by LAUNCH
checked_build() {
  local preset=$1 launch=$2
  local home=$root/build/$preset
  local launcher=$home/lmp log=$home/build.log
  make_folder "$home"
  printf '#!/bin/sh\n%s "%s" "$@"\n' "$launch" "$LAMMPS_EXE" >"$launcher"
  chmod +x "$launcher"
  { LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR LAMMPS_EXE=$launcher cmake --preset "$preset" &&
    cmake --build "$home"; } >"$log" 2>&1 </dev/null || die_with_log "$log" "the build for $preset failed."
}
