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
  [[ $name =~ ^(riser|feed|box3d|two_densities|jet|duct)$ ]] || die "./run scene wants one of: riser feed box3d two_densities jet duct"
  map_grid=(20 40) # cells must be wider than the clusters, and box3d is 20 mm wide
  run_case "$@"
}

case_usage() {
  cat <<EOF
usage: ./run $1 [--np N] [--engine lammps|liggghts] [-var NAME VALUE …] [switches of the engine: -sf -pk -k …]
Runs inputs/$1.in, draws its maps and writes a report, all into results/$1 (or -var outdir FOLDER). An earlier run there
is kept aside in earlier-1, earlier-2 and so on. The variables of -var are explained at the top of inputs/$1.in.
EOF
}

# check_words NAME INPUTS WORD…: refuse what neither ./run nor the engine knows, before anything is touched.
check_words() {
  local name=$1 inputs=$2 switch=''
  shift 2
  while (($#)); do
    case $1 in
      -var | -v)
        [[ ${2:-} =~ ^[A-Za-z_][A-Za-z0-9_]*$ && ${3+given} ]] ||
          die "-var wants a name and a value, as in: ./run $name -var seed 7"
        # a variable that some line of the inputs defines, asks for or uses
        grep -qE "(variable +$2 |is_defined\(variable,$2\)|\\$\{$2\}|v_$2\b)" "$inputs"/*.in ||
          die "the inputs know no variable '$2', so that it would change nothing; the top of inputs/$name.in explains theirs."
        switch=$1
        shift 3
        continue
        ;;
      -np | -n) die "say --np N for the number of ranks, as in: ./run $name --np 2" ;;
      -sf | -suffix | -pk | -package | -k | -kokkos | -nb | -nonbuf | -nc | -nocite | -e | -echo | -sc | -screen) switch=$1 ;;
      -*) die "unknown argument '$1'" "$(case_usage "$name" | head -n 1)" ;;
      *) [[ $switch ]] || die "unknown argument '$1'" "$(case_usage "$name" | head -n 1)" ;;
    esac
    shift
  done
}

# quoted WORD…: a command as it can be typed again, quotes where they are needed.
quoted() {
  local word words=()
  for word in "$@"; do
    [[ $word =~ ^[A-Za-z0-9_./:=,+-]+$ ]] || word=${word@Q}
    words+=("$word")
  done
  echo "${words[*]}"
}

# keep_aside FOLDER NAME: what an earlier run left there goes into a folder of its own, so that no two runs mix.
keep_aside() {
  local folder=$1 name=$2 number=1 file files=()
  for file in "$folder/$name".*.{dump,dump.gz,dump.zst,dump.bin,maps,txt,mol} "$folder/$name".{N.txt,log,restart} \
    "$folder"/{command.txt,report.html,start.data,nonuniformity.csv} "$folder"/map.*.{npz,csv} "$folder"/{fraction,number_density,mean_diameter,velocity_?,temperature}.png; do
    [[ ! -e $file || " ${files[*]} " == *" $file "* ]] || files+=("$file")
  done
  ((${#files[@]})) || return 0
  while [[ -e $folder/earlier-$number ]]; do ((number += 1)); done
  mkdir "$folder/earlier-$number"
  mv -- "${files[@]}" "$folder/earlier-$number/"
  say "the run that was there is now in $folder/earlier-$number"
}

# run_case NAME [--np N] [--engine liggghts] [arguments of the engine…]: all that it writes goes to results/NAME (or -var
# outdir).
run_case() {
  local name=$1 out='' launch=() arguments=() engine=lmp inputs=inputs start=''
  shift
  local given=("$@")
  while (($#)); do
    if [[ $1 =~ ^(-h|-help|--help)$ ]]; then
      case_usage "$name"
      return
    elif [[ $1 == --np ]]; then
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || die "--np wants the number of ranks, as in: ./run $name --np 2"
      launch=(mpirun -np "$2")
      shift 2
    elif [[ $1 == --engine ]]; then
      [[ ${2:-} =~ ^(lammps|liggghts)$ ]] || die "--engine wants lammps or liggghts"
      [[ $2 == lammps ]] || engine=liggghts-cluster inputs=inputs/liggghts
      shift 2
    elif [[ $1 =~ ^-v(ar)?$ && ${2:-} == outdir ]]; then
      [[ ${3:-} ]] || die "-var outdir wants a folder"
      out=$(realpath -m "$3")
      shift 3
    else
      [[ $1 != start_file ]] || start=given
      arguments+=("$1")
      shift
    fi
  done
  [[ -e $root/$inputs/$name.in ]] || die "there is no $name for LIGGGHTS: inputs/liggghts holds case1, case2, case3."
  check_words "$name" "$root/$inputs" "${arguments[@]}"
  set_up pinned
  cd "$root"
  [[ $engine == lmp ]] || set_up_liggghts
  out=${out:-$root/results/$name}
  make_folder "$out"
  (
    flock -n 9 || die "another ./run writes into $out: wait for it, or say -var outdir FOLDER."
    run_here
  ) 9>"$out/.lock"
}

# The run of run_case, whose variables it sees, in a folder that no other run writes into.
run_here() {
  keep_aside "$out" "$name"
  if [[ $engine == liggghts-cluster && ! $start ]]; then
    build/bin/clusterdem start --case "$name" --out "$out/start.data"
    arguments+=(-var start_file "$out/start.data")
  fi
  quoted ./run "$name" "${given[@]}" >"$out/command.txt" # shown by the report
  # Of a variable given twice LAMMPS keeps the first value: the user's come first.
  "${launch[@]}" "build/bin/$engine" "${arguments[@]}" -in "$inputs/$name.in" -log "$out/$name.log" \
    -var outdir "$out" </dev/null
  local frames=() made=() dt=()
  mapfile -t frames < <(compgen -G "$out/$name.*.dump*")
  mapfile -t made < <(compgen -G "$out/$name.*.maps")
  # frames of LIGGGHTS hold no time: the last row of the table knows both
  [[ $engine == lmp ]] || dt=(--dt "$(awk '$1 > 0 { dt = $2 / $1 } END { print dt }' "$out/$name.N.txt")")
  if ((${#frames[@]})); then
    build/bin/clusterdem map "${frames[@]}" --grid "${map_grid[@]}" --out "$out" "${dt[@]}"
    [[ $name != case* ]] || build/bin/clusterdem compare "${frames[@]}" --case "$name" "${dt[@]}" # what was published
  elif ((${#made[@]})); then
    build/bin/clusterdem map "${made[@]}" --out "$out"
  fi
  build/bin/clusterdem report "$out" --name "$name" --grid "${map_grid[@]}" "${dt[@]}"
}
