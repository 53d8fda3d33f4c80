# All tests, closed by one line of counts.
# shellcheck shell=bash

verb_test() { # all tests, or those of pytest's arguments: [--lammps newest|bigbig] [pytest arguments]
  local engine=pinned arguments=()
  while (($#)); do
    case $1 in
      --lammps) engine=${2:-}; shift 2 || die "say --lammps newest or bigbig" ;;
      *) arguments+=("$1"); shift ;;
    esac
  done
  set_up "$engine"
  # The report is opened in a real browser, the film is a real film; without these tools those tests skip.
  (install_tools chromium:chromium ffmpeg:ffmpeg patch:patch) || say "going on without them: the tests that need them skip"
  [[ $engine != pinned ]] || (set_up_liggghts) || say "going on without LIGGGHTS: the tests that compare with it skip"
  cd "$root"
  export CLUSTERDEM_LMP=$build/bin/lmp CLUSTERDEM_BUILD=$build
  export PATH=$venv/bin:$PATH
  local results=$build/test-results
  rm -rf "$results"
  mkdir "$results"
  # Every runner leaves one file of results; one that leaves none counts as a failure.
  local expected=("$results/pytest.xml")
  if [[ $engine != pinned ]]; then
    run_pytest "$results/pytest.xml" "${arguments[@]:-tests/engine}"
  elif ((${#arguments[@]})); then
    run_pytest "$results/pytest.xml" "${arguments[@]}"
  else
    expected+=("$results/model.xml")
    run_unit_tests "$results/model.xml"
    run_pytest "$results/pytest.xml" tests
  fi
  count_results "${expected[@]}" || exit 1
}

run_unit_tests() {
  local log=$build/unit-tests.log
  cmake --build "$build" >"$log" 2>&1 </dev/null || { tail -n 20 "$log" >&2; return 0; }
  "$build/model_tests" --gtest_brief=1 --gtest_output="xml:$1" || true
}

run_pytest() {
  local file=$1
  shift
  "$venv/bin/python" -m pytest -q --junitxml="$file" "$@" </dev/null || true
}

# Sums the test cases of JUnit files, prints `N passed, N failed`; fails when any failed or none passed.
count_results() {
  "$venv/bin/python" - "$@" <<'PYTHON'
import sys
import xml.etree.ElementTree as ET

count = {"passed": 0, "failed": 0, "skipped": 0}
for file in sys.argv[1:]:
    try:
        cases = ET.parse(file).iter("testcase")
    except (OSError, ET.ParseError):
        print(f"no results in {file}: its tests did not run to the end")
        count["failed"] += 1
        continue
    for case in cases:
        found = {child.tag for child in case}
        if found & {"failure", "error"}:
            count["failed"] += 1
        elif "skipped" in found or case.get("status") == "notrun":
            count["skipped"] += 1
        else:
            count["passed"] += 1
if not count["skipped"]:
    del count["skipped"]
print(", ".join(f"{n} {what}" for what, n in count.items()))
sys.exit(count["failed"] > 0 or count["passed"] == 0)
PYTHON
}
