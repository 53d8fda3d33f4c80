# Gas fields of OpenFOAM's results beside OpenFOAM's own sampling: the table in the page of clusterdem gas.
# shellcheck shell=bash

verb_verify_gas() { # runs OpenFOAM (Debian's package), compares gas fields with its own sampling, writes the table
  (($# == 0)) || die "./run verify-gas takes no arguments"
  set_up pinned
  install_tools openfoam:blockMesh openfoam:simpleFoam openfoam:foamToVTK
  cd "$root"
  export CLUSTERDEM_LMP=$build/bin/lmp OMP_NUM_THREADS=1
  "$venv/bin/python" tests/outside/openfoam/verify_gas.py build/verify-gas
}
