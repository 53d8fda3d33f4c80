# The paper's cases and one of our own: run, map, compare.
# shellcheck shell=bash

verb_case1() { # the paper's case 1 with its maps: [--np N] [-var NAME VALUE …]
  run_case case1 "$@"
}
verb_case2() { # the paper's case 2, the same way
  run_case case2 "$@"
}
verb_case3() { # the paper's case 3, the same way
  run_case case3 "$@"
}

verb_shear() { # a sheared crowd, where contacts decide breakups, the same way
  run_case shear "$@"
}

# run_case NAME [--np N] [arguments of lmp…]: all that it writes goes to results/NAME (or -var outdir).
run_case() {
  local name=$1 out=$root/results/$1 launch=() arguments=()
  shift
  local given=("$@")
  while (($#)); do
    if [[ $1 == --np ]]; then
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || die "--np wants the number of ranks, as in: ./run $name --np 2"
      launch=(mpirun -np "$2")
      shift 2
    elif [[ $1 =~ ^--?v(ar)?$ && ${2:-} == outdir ]]; then
      out=$(realpath -m "${3:?-var outdir wants a folder}")
      shift 3
    else
      arguments+=("$1")
      shift
    fi
  done
  set_up pinned
  cd "$root"
  make_folder "$out"
  rm -f "$out/$name".*.dump # frames of an earlier run
  echo "./run $name ${given[*]}" >"$out/command.txt" # quoted by the report
  # Of a variable given twice LAMMPS keeps the first value: the user's come first.
  "${launch[@]}" build/bin/lmp "${arguments[@]}" -in "inputs/$name.in" -log "$out/$name.log" \
    -var outdir "$out" </dev/null
  build/bin/clusterdem map "$out/$name".*.dump --grid 30 30 --out "$out"
  [[ $name != case* ]] || build/bin/clusterdem compare "$out/$name".*.dump --case "$name" # what was published
  build/bin/clusterdem report "$out" --name "$name"
}
