# Form and habits of the sources: clang-format, ruff, mypy, shellcheck, clang-tidy; how much of them the tests run.
# shellcheck shell=bash

verb_lint() { # what every source must keep to: [--fix: format the files] [--tidy: clang-tidy too, some minutes]
  local fix='' tidy=''
  while (($#)); do
    case $1 in
      --fix) fix=yes ;;
      --tidy) tidy=yes ;;
      *) die "./run lint: unknown argument $1: say --fix, --tidy, or nothing" ;;
    esac
    shift
  done
  set_up pinned
  local tools=$root/build/lint/bin
  with_lock "$root/build/.lock" install_lint_tools
  cd "$root"
  # run takes along all that it sources
  local cpp shell=(run .ci/run src/CLUSTER/Install.sh) rule=python/pyproject.toml format=(--dry-run --Werror) ruff_format=(--check)
  mapfile -t cpp < <(list_sources '*.cpp' '*.h')
  local failed=()
  if [[ $fix ]]; then
    format=(-i) ruff_format=()
    "$tools/ruff" check --quiet --config "$rule" --fix-only .
  fi
  "$tools/clang-format" "${format[@]}" "${cpp[@]}" || failed+=(clang-format)
  "$tools/ruff" format --quiet --config "$rule" "${ruff_format[@]}" . || failed+=("ruff format")
  "$tools/ruff" check --quiet --config "$rule" . || failed+=("ruff check")
  (cd python && ../build/lint/bin/mypy --python-executable "$venv/bin/python" --no-error-summary) || failed+=(mypy)
  "$tools/shellcheck" -x "${shell[@]}" || failed+=(shellcheck)
  [[ ! $tidy ]] || tidy_sources || failed+=(clang-tidy)
  ((${#failed[@]} == 0)) || { say "FAILED: ${failed[*]} (./run lint --fix puts the form right)"; exit 1; }
  say "clean: ${#cpp[@]} files of C++, $(list_sources '*.py' | wc -l) of Python; run and setup/"
}

# Files of the checkout that match the patterns, also those not yet added.
list_sources() {
  git ls-files --cached --others --exclude-standard --deduplicate -- "$@" | while read -r file; do
    [[ ! -e $file ]] || echo "$file"
  done
}

install_lint_tools() {
  local home=$root/build/lint pins=$root/python/requirements-lint.txt log=$root/build/lint.log
  [[ $home/.installed -nt $pins ]] && return
  say "installing the tools of ./run lint into build/lint"
  rm -rf "$home"
  { "$venv/bin/python" -m venv "$home" &&
    "$home/bin/pip" install -q --disable-pip-version-check -r "$pins"; } >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the tools of ./run lint could not be installed: no network?"
  touch "$home/.installed"
}

# The styles' files with all they include, each as it is compiled.
tidy_sources() {
  install_tools clang-tidy:clang-tidy
  local log=$root/build/tidy.log
  list_sources 'src/CLUSTER/*.cpp' | xargs -P "$(nproc)" -n 2 clang-tidy -p "$build" --quiet >"$log" 2>&1 && return
  grep -A 4 -E 'error:' "$log" | head -n 60 >&2
  return 1
}

verb_coverage() { # lines that the tests run: of model/ by the unit tests, of python/ by tests/python; pages in build/coverage
  set_up pinned
  cd "$root"
  local home=$root/build/coverage log=$root/build/coverage.log
  rm -rf "$home"
  mkdir -p "$home"
  with_lock "$root/build/.lock" install_lint_tools
  say "the unit tests, compiled to count"
  { LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR LAMMPS_EXE=$LAMMPS_EXE cmake --preset coverage &&
    cmake --build "$home" --target model_tests; } >"$log" 2>&1 </dev/null || die_with_log "$log" "the build for coverage failed."
  "$home/model_tests" --gtest_brief=1
  "$root/build/lint/bin/gcovr" --root "$root" --filter 'src/CLUSTER/model/' "$home" \
    --html-details "$home/model.html" --txt - --fail-under-line 95 || die "model/ is below 95 % of lines."
  say "the tests of the Python package"
  export CLUSTERDEM_LMP=$build/bin/lmp CLUSTERDEM_BUILD=$build COVERAGE_FILE=$home/python.data PATH=$venv/bin:$PATH
  "$venv/bin/python" -m pytest -q --cov=clusterdem --cov-report="html:$home/python" \
    --cov-report=term:skip-covered tests/python </dev/null
}
