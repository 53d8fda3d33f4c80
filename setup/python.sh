# The Python package in its own environment, build/venv, with the command build/bin/clusterdem.
# shellcheck shell=bash

# The first Python that is new enough and can make an environment with pip.
find_python() {
  local python
  for python in python3 /usr/bin/python3 python3.{14..11}; do
    have "$python" && "$python" -c '
import ensurepip, sys, venv
sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo "$python" && return
  done
  return 1
}

# Installed again only when the package's metadata, the pinned versions or this file change.
build_python() {
  local pins=("$root"/python/requirements*.txt) stamp=$venv/.installed log=$root/build/python.log now
  [[ -e ${pins[0]} ]] || pins=()
  now=$(cat "$root/python/pyproject.toml" "${pins[@]}" "$root/setup/python.sh" <(echo "$root") | checksum)
  if [[ $(cat "$stamp" 2>/dev/null) != "$now" ]]; then
    need_space "$root" 2500 "the Python environment"
    say "installing the Python package into build/venv"
    local python
    python=$(find_python) || die \
      "no Python 3.11 or later that can make an environment (venv, pip)." "Type: sudo apt-get install python3-venv"
    rm -rf "$venv"
    "$python" -m venv "$venv" >"$log" 2>&1 || die_with_log "$log" "cannot make the Python environment $venv."
    pip_install "$log" || die_with_log "$log" \
      "the Python packages could not be installed: no network, or a proxy in the way? Try again: ./run setup"
    echo "$now" >"$stamp"
  fi
  make_folder "$root/build/bin"
  ln -sfn ../venv/bin/clusterdem "$root/build/bin/clusterdem"
}

# requirements.txt pins versions (a constraint); requirements-test.txt names what the tests need.
pip_install() {
  local python=$root/python arguments=(-e "$root/python[mpi,gas]")
  [[ ! -e $python/requirements.txt ]] || arguments+=(-c "$python/requirements.txt")
  if [[ -e $python/requirements-test.txt ]]; then
    arguments+=(-r "$python/requirements-test.txt")
  else
    arguments+=(pytest)
  fi
  "$venv/bin/python" -m pip install -q --disable-pip-version-check "${arguments[@]}" >"$1" 2>&1 </dev/null
}
