# A source tarball of any Debian suite, by the ordinary apt client and a private configuration:
# no root needed, and the system's own lists and sources stay as they are.
# shellcheck shell=bash

# The machine's own Debian archives, one address a line (security and other suites left out).
# Two formats: `deb [options] URI SUITE COMPONENT…` in *.list, paragraphs of fields in *.sources.
debian_archives() {
  local etc=${APT_ETC:-/etc/apt}
  {
    { cat "$etc"/sources.list "$etc"/sources.list.d/*.list || true; } 2>/dev/null |
      sed -nE 's/\[[^]]*\]//; s/^deb(-src)?[[:space:]]+//p' |
      awk '{ suite = $2; uri = $1; $1 = $2 = ""; print uri, suite, $0 }'
    { sed -s '$G' "$etc"/sources.list.d/*.sources || true; } 2>/dev/null |
      awk -v RS= -F'\n' '{
      uris = suites = parts = ""
      for (i = 1; i <= NF; i++) {
        if (sub(/^URIs:[ \t]*/, "", $i)) uris = $i
        if (sub(/^Suites:[ \t]*/, "", $i)) suites = $i
        if (sub(/^Components:[ \t]*/, "", $i)) parts = $i
      }
      nu = split(uris, u, " "); ns = split(suites, s, " ")
      for (i = 1; i <= nu; i++) for (j = 1; j <= ns; j++) print u[i], s[j], parts
    }'
  } | awk '$1 ~ /debian/ && $2 !~ /-|\// && / main( |$)/ && !seen[$1]++ { print $1 }'
}

# debian_source SUITE PACKAGE FOLDER: put the newest upstream tarball of PACKAGE into FOLDER,
# print its name. apt checks it against the suite's signed index.
debian_source() (
  suite=$1 package=$2 folder=$3
  for keyring in "${APT_KEYRING:-}" /usr/share/keyrings/debian-archive-keyring.{gpg,pgp}; do
    [[ ! -e $keyring ]] || break
  done
  mapfile -t archives < <(debian_archives)
  { have apt-get && [[ -e $keyring ]] && ((${#archives[@]})); } || die \
    "this is no Debian system, so the source of $package cannot be fetched by apt." \
    "Give your own LAMMPS: LAMMPS_SOURCE_DIR=/path/lammps LAMMPS_EXE=/path/lmp ./run setup"

  make_folder "$folder"
  work=$(mktemp -d "$folder/apt.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  mkdir -p "$work"/{parts,new} "$work"/lists/partial "$work"/cache/archives/partial
  options=(-q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$work/parts"
    -o "Dir::State::Lists=$work/lists" -o "Dir::Cache=$work/cache"
    -o APT::Update::Error-Mode=any -o Acquire::Retries=2)
  ((EUID != 0)) || options+=(-o APT::Sandbox::User=root)
  for archive in "${archives[@]}"; do
    printf '%s\n' 'Types: deb-src' "URIs: $archive" "Suites: $suite" 'Components: main' \
      "Signed-By: $keyring" >"$work/parts/$suite.sources"
    ! apt-get "${options[@]}" update || break
  done >"$folder/apt.log" 2>&1
  (cd "$work/new" && apt-get "${options[@]}" source --download-only --tar-only "$package") \
    >>"$folder/apt.log" 2>&1 || die_with_log "$folder/apt.log" \
    "the source of $package (Debian $suite) could not be fetched: no network, or a proxy in the way?" \
    "Try again, or give your own LAMMPS: LAMMPS_SOURCE_DIR=/path/lammps LAMMPS_EXE=/path/lmp ./run setup"
  tarball=$(basename "$work"/new/*.orig.tar.*)
  mv "$work/new/$tarball" "$folder/$tarball"
  touch "$folder/$tarball" # fetched now, whatever date the archive gave it
  echo "$tarball"
)
