# Messages, and the few questions that every other file asks. ($root, $cache, $build: see run.)
# shellcheck shell=bash

say() { printf '%s\n' "$*" >&2; }
die() { printf 'error: %s\n' "$@" >&2; exit 2; }
have() { command -v "$1" >/dev/null 2>&1; }
checksum() { sha256sum | cut -c1-12; }

# When a command failed: its errors (or else its last lines), the message, and where the whole log is.
die_with_log() {
  local log=$1; shift
  { grep -m 8 -E '[Ee]rror|ERROR|^E:' "$log" || tail -n 8 "$log"; } | sed 's/^/  | /' >&2
  die "$@" "the whole log: $log"
}

# need_space FOLDER MEGABYTES WHAT: stop before a full disk does.
need_space() {
  local folder=$1 megabytes=$2 what=$3 free
  while [[ ! -d $folder ]]; do folder=$(dirname "$folder"); done
  free=$(($(df -Pk "$folder" | awk 'NR == 2 { print $4 }') / 1024))
  ((free >= megabytes)) || die \
    "disk full: $what needs $megabytes MB in $folder, where $free MB are free." \
    "Make room there, or choose another disk: XDG_CACHE_HOME=/other/disk ./run setup"
}

make_folder() {
  mkdir -p "$1" 2>/dev/null || die "cannot create the folder $1: make it writable, or set XDG_CACHE_HOME."
}

# with_lock FILE COMMAND…: run COMMAND while no other process holds FILE.
with_lock() {
  local file=$1; shift
  make_folder "$(dirname "$file")"
  (
    flock -n 9 || { say "waiting for another ./run that holds $file"; flock 9; }
    "$@"
  ) 9>"$file"
}

interrupted() {
  trap - INT TERM
  say "interrupted: nothing half-made will be used; the same command goes on from here."
  exit 130
}

# No command fails in silence. (What has been explained already ends with 2, or 130.)
failed() {
  local status=$1 command=$2
  case $status in
    2 | 130) exit "$status" ;;
    *) die "this failed with status $status: $command" ;;
  esac
}

# Open MPI refuses root unless told twice, and more ranks than cores unless told.
mpi_environment() {
  ((EUID != 0)) || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1
}
