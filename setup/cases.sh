# The paper's cases and one of our own: run, map, compare.
# shellcheck shell=bash

map_grid=(30 30)

verb_case1() { # the paper's case 1 with its maps: [--np N] [--engine liggghts] [-var NAME VALUE …]
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

verb_scene() { # a scene of doc/scenes.md, the same way: NAME [--np N] [-var NAME VALUE …]
  local name=${1:-}
  [[ $name =~ ^(riser|feed|box3d|two_densities|jet)$ ]] || die "./run scene wants one of: riser feed box3d two_densities jet"
  map_grid=(20 40) # cells must be wider than the clusters, and box3d is 20 mm wide
  run_case "$@"
}

# run_case NAME [--np N] [--engine liggghts] [arguments of the engine…]: all that it writes goes to results/NAME (or -var
# outdir).
run_case() {
  local name=$1 out='' launch=() arguments=() engine=lmp input=inputs/$1.in start='' dt=()
  shift
  local given=("$@")
  while (($#)); do
    if [[ $1 == --np ]]; then
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || die "--np wants the number of ranks, as in: ./run $name --np 2"
      launch=(mpirun -np "$2")
      shift 2
    elif [[ $1 == --engine ]]; then
      [[ ${2:-} =~ ^(lammps|liggghts)$ ]] || die "--engine wants lammps or liggghts"
      [[ $2 == lammps ]] || engine=liggghts-cluster input=inputs/liggghts/$name.in
      shift 2
    elif [[ $1 =~ ^--?v(ar)?$ && ${2:-} == outdir ]]; then
      out=$(realpath -m "${3:?-var outdir wants a folder}")
      shift 3
    else
      [[ $1 != start_file ]] || start=given
      arguments+=("$1")
      shift
    fi
  done
  set_up pinned
  cd "$root"
  out=${out:-$root/results/$name}
  make_folder "$out"
  rm -f "$out/$name".*.dump # frames of an earlier run
  if [[ $engine == liggghts-cluster ]]; then
    [[ -e $input ]] || die "there is no $name for LIGGGHTS: inputs/liggghts holds case1, case2, case3."
    set_up_liggghts
    if [[ ! $start ]]; then
      build/bin/clusterdem start --case "$name" --out "$out/start.data"
      arguments+=(-var start_file "$out/start.data")
    fi
  fi
  echo "./run $name ${given[*]}" >"$out/command.txt" # quoted by the report
  # Of a variable given twice LAMMPS keeps the first value: the user's come first.
  "${launch[@]}" "build/bin/$engine" "${arguments[@]}" -in "$input" -log "$out/$name.log" \
    -var outdir "$out" </dev/null
  # frames of LIGGGHTS hold no time: the last row of the table knows both
  [[ $engine == lmp ]] || dt=(--dt "$(awk '$1 > 0 { dt = $2 / $1 } END { print dt }' "$out/$name.N.txt")")
  build/bin/clusterdem map "$out/$name".*.dump --grid "${map_grid[@]}" --out "$out" "${dt[@]}"
  [[ $name != case* ]] || build/bin/clusterdem compare "$out/$name".*.dump --case "$name" "${dt[@]}" # what was published
  build/bin/clusterdem report "$out" --name "$name" --grid "${map_grid[@]}" "${dt[@]}"
}
