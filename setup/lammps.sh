# The engine: our own build of LAMMPS in the cache, or the user's.
# Either way LAMMPS_SOURCE_DIR (the folder with version.h) and LAMMPS_EXE are set afterwards.
# shellcheck shell=bash

lammps_oldest=20250204
lammps_tarball=lammps_20250204+dfsg.1.orig.tar.xz   # 4 Feb 2025, in Debian 13
lammps_sha256=3671165bd52fad36734e0a9136c5bc5ecb225e03988f8c89aa13366a8b53b1c7
downloads=$cache/downloads

lammps_options=(
  -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -march=native -DNDEBUG" -DCMAKE_TUNE_FLAGS=
  -DPKG_GRANULAR=on -DPKG_PLUGIN=on -DPKG_COMPRESS=on -DBUILD_MPI=on -DBUILD_OMP=off
  -DWITH_JPEG=off -DWITH_PNG=off -DWITH_FFMPEG=off -DWITH_GZIP=off -DDOWNLOAD_POTENTIALS=off
)

lammps_sizes=smallbig    # integers of the engine and the plugin

# How an engine that watches its own memory is compiled, and the plugin with it.
export CLUSTERDEM_SANITIZERS="-fsanitize=address,undefined,float-cast-overflow -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS"

# use_lammps pinned|newest|bigbig|portable|sanitized: for this machine's processor, with 64-bit IDs (bigbig), or (portable, for
# packages) for any processor of its kind, or (sanitized) watched by the address and undefined-behaviour sanitizers
use_lammps() {
  if [[ ${LAMMPS_SOURCE_DIR:-}${LAMMPS_EXE:-} ]]; then
    check_own_lammps
    return
  fi
  local suite=trixie tarball=$lammps_tarball options=("${lammps_options[@]}") home
  case $1 in
    newest) suite=sid tarball=$(newest_tarball) ;;
    bigbig) lammps_sizes=bigbig options+=(-DLAMMPS_SIZES=bigbig) ;;
    portable) options=("${options[@]/-march=native /}") ;;
    sanitized) options=("${options[@]/-O3 -march=native -DNDEBUG/-O1 -g1 $CLUSTERDEM_SANITIZERS}") ;;
  esac
  # Whatever changes the executable is in the key: version, options, compiler, what `native` is, MPI.
  home=$cache/lammps/${tarball%.orig*}-$({
    echo "$tarball ${options[*]} ${CXX:-c++} ${CXXFLAGS:-} ${LDFLAGS:-}"
    "${CXX:-c++}" -march=native -O3 -dM -E -x c++ /dev/null
    mpicxx -show
    mpirun --version
  } 2>&1 | checksum)
  [[ -d $home ]] || with_lock "$home.lock" build_lammps "$suite" "$tarball" "$home" "${options[@]}"
  LAMMPS_SOURCE_DIR=$home/src LAMMPS_EXE=$home/lmp
}

# The newest LAMMPS of Debian's unstable suite; asked again after a week.
newest_tarball() {
  local found
  make_folder "$downloads/sid"
  found=$(find "$downloads/sid" -name 'lammps_*.orig.tar.*' -mtime -7 | sort | tail -n 1)
  if [[ $found ]]; then
    basename "$found"
  else
    need_space "$cache" 1000 "the source of LAMMPS"
    say "fetching the newest LAMMPS of Debian sid"
    debian_source sid lammps "$downloads/sid"
  fi
}

# Present and whole, or fetched now.
fetch_lammps() {
  local suite=$1 tarball=$2 folder=$downloads/$1 fetched
  if [[ -e $folder/$tarball ]]; then
    tarball_whole "$folder/$tarball" && return
    say "$folder/$tarball was corrupt: deleted."
  fi
  say "fetching LAMMPS ($tarball)"
  fetched=$(debian_source "$suite" lammps "$folder")
  [[ $fetched == "$tarball" ]] || die "Debian $suite holds another version of LAMMPS than $tarball." \
    "Give your own LAMMPS: LAMMPS_SOURCE_DIR=/path/lammps LAMMPS_EXE=/path/lmp ./run setup"
  tarball_whole "$folder/$tarball" || die \
    "the fetched $tarball has a wrong SHA-256 and was deleted." "Try again: ./run setup"
}

# A corrupt tarball is deleted. The pinned one has its checksum above; of any other apt checked the
# checksum when it came, and its own compression tells whether it still is what came.
tarball_whole() {
  case $1 in
    */"$lammps_tarball") [[ $(sha256sum <"$1") == "$lammps_sha256 "* ]] ;;
    *.xz) xz -t "$1" 2>/dev/null ;;
    *) gzip -t "$1" 2>/dev/null ;;
  esac && return
  rm -f "$1"
  return 1
}

# Built beside its place and renamed when finished: the folder's presence is the stamp.
# An interrupted build goes on from where it stopped.
build_lammps() {
  local suite=$1 tarball=$2 home=$3 part=$3.part log=$3.log
  shift 3
  [[ ! -d $home ]] || return 0
  need_space "$cache" 1500 "the build of LAMMPS"
  if [[ ! -e $part/unpacked ]]; then
    fetch_lammps "$suite" "$tarball"
    unpack_lammps "$downloads/$suite/$tarball" "$part/source"
    touch "$part/unpacked"
  fi
  local version
  version=$(lammps_date "$part/source/src/version.h")
  say "building LAMMPS $version (once; about 10 minutes on two cores)"
  compile_lammps "$part/source" "$part/build" "$log" "$@"
  # cmake leaves out a package whose library it does not find, and says so in its log alone.
  grep -qw custom/zstd <("$part/build/lmp" -h 2>&1 </dev/null) || die_with_log "$log" \
    "LAMMPS was built without compressed dumps: zlib, libzstd or pkg-config were not found."
  rm "$part/unpacked"
  mv "$part/build/lmp" "$part/lmp"
  mv "$part/source/src" "$part/src"
  mv "$log" "$part/build.log"
  rm -rf "$part/source" "$part/build"
  mv "$part" "$home"
}

# unpack_lammps TARBALL FOLDER: what the build needs (src and cmake), whether or not the tarball has a top folder.
unpack_lammps() {
  local tarball=$1 folder=$2 skip skipped=() top
  for skip in doc examples bench potentials unittest fortran tools lib python; do
    skipped+=("--exclude=$skip" "--exclude=*/$skip")
  done
  rm -rf "$folder" "$folder.top"
  make_folder "$folder.top"
  tar -xf "$tarball" -C "$folder.top" --anchored --no-wildcards-match-slash "${skipped[@]}" || die \
    "cannot unpack $tarball. Disk full? If not, delete $downloads and try again."
  top=$(find "$folder.top" -maxdepth 3 -path '*/src/version.h')
  mv "${top%/src/version.h}" "$folder"
  rm -rf "$folder.top"
}

# compile_lammps SOURCE BUILD LOG options
compile_lammps() {
  local source=$1 build=$2 log=$3
  shift 3
  cmake -S "$source/cmake" -B "$build" -G Ninja "$@" >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "LAMMPS could not be configured."
  nice cmake --build "$build" --target lmp 2>&1 </dev/null | tee -a "$log" | show_progress ||
    die_with_log "$log" "LAMMPS could not be built. Try again: it goes on from here."
}

# `[n/N] …` lines become a counter on a terminal, a line every tenth elsewhere.
show_progress() {
  local line tenth=0
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    local n=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    if [[ -t 2 ]]; then
      printf '\r  %d of %d files' "$n" "$all" >&2
    elif ((n * 10 / all > tenth)); then
      tenth=$((n * 10 / all))
      say "  $n of $all files"
    fi
  done
  [[ ! -t 2 ]] || echo >&2
}

# 20250204 from a version.h that says "4 Feb 2025".
lammps_date() {
  date -d "$(sed -nE 's/.*LAMMPS_VERSION "([0-9]+ [A-Za-z]+ [0-9]+).*/\1/p' "$1")" +%Y%m%d
}

# The user's LAMMPS: source and executable must both be there, new enough, and of one version.
check_own_lammps() {
  local how="Give both: LAMMPS_SOURCE_DIR=/path/lammps LAMMPS_EXE=/path/lmp ./run setup"
  [[ ${LAMMPS_SOURCE_DIR:-} ]] || die "LAMMPS_EXE is given but LAMMPS_SOURCE_DIR is not." "$how"
  [[ ${LAMMPS_EXE:-} ]] || die "LAMMPS_SOURCE_DIR is given but LAMMPS_EXE is not." "$how"
  local source=$LAMMPS_SOURCE_DIR exe help date engine
  [[ -e $source/version.h ]] || source=$source/src
  [[ -e $source/version.h ]] || die "LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR holds neither version.h nor src/version.h." "$how"
  date=$(lammps_date "$source/version.h")
  ((date >= lammps_oldest)) || die "LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR is LAMMPS of $date; 4 Feb 2025 or later is needed."

  exe=$(command -v "$LAMMPS_EXE") || die "LAMMPS_EXE=$LAMMPS_EXE is not an executable file." "$how"
  help=$("$exe" -h 2>&1 </dev/null) || die "LAMMPS_EXE=$LAMMPS_EXE does not run: $(tail -n 1 <<<"$help")"
  engine=$(sed -nE 's/^Large-scale.* - ([0-9]+ [A-Za-z]+ [0-9]+).*/\1/p' <<<"$help")
  [[ $engine && $(date -d "$engine" +%Y%m%d) == "$date" ]] || die \
    "LAMMPS_EXE=$LAMMPS_EXE is version '$engine', LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR is of $date: they must be one version."
  local package
  for package in GRANULAR PLUGIN; do
    grep -qw "$package" <<<"${help#*Installed packages}" || die \
      "LAMMPS_EXE=$LAMMPS_EXE has no package $package: build it with -DPKG_GRANULAR=on -DPKG_PLUGIN=on -DBUILD_MPI=on."
  done
  ! grep -qi '^MPI.*STUBS' <<<"$help" || die \
    "LAMMPS_EXE=$LAMMPS_EXE was built without MPI: build it with -DBUILD_MPI=on."
  LAMMPS_SOURCE_DIR=$(readlink -f "$source")
  LAMMPS_EXE=$(readlink -f "$exe")
}
