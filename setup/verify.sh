# The verification cases: analytic solutions and published data beside the engine's results.
# shellcheck shell=bash

verb_verify() { # every verification case in full, its figures, and the table tests/verification/README.md
  (($# == 0)) || die "./run verify takes no arguments; one case in its short form: ./run test tests/verification/CASE"
  set_up pinned
  cd "$root"
  export CLUSTERDEM_LMP=$build/bin/lmp CLUSTERDEM_VERIFY=$build/verification
  rm -rf "$CLUSTERDEM_VERIFY"
  mkdir "$CLUSTERDEM_VERIFY"
  run_pytest "$CLUSTERDEM_VERIFY/pytest.xml" tests/verification
  PYTHONPATH=tests/engine "$venv/bin/python" tests/verification/results_table.py "$CLUSTERDEM_VERIFY" ||
    say "going on to the count of passed and failed tests"
  count_results "$CLUSTERDEM_VERIFY/pytest.xml" || exit 1
}
