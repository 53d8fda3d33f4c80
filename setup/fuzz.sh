# Right and wrong lines of the plugin's commands, by the thousand.
# shellcheck shell=bash

verb_fuzz() { # right and wrong lines of every command, new ones each time: [how many, 6000]
  local lines=${1:-6000}
  [[ $lines =~ ^[1-9][0-9]*$ ]] || die "./run fuzz wants the number of lines, as in: ./run fuzz 20000"
  set_up pinned
  cd "$root"
  export CLUSTERDEM_LMP=$build/bin/lmp CLUSTERDEM_BUILD=$build CLUSTERDEM_FUZZ_LINES=$lines
  # a line that fails is shrunk, and printed with what brings it back
  run_pytest "$build/fuzz.xml" tests/fuzz --hypothesis-show-statistics
  count_results "$build/fuzz.xml" || exit 1
}
