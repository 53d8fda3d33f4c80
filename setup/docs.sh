# The documents as a site under build/docs, made from the texts where they stand; it needs no network to be read.
# shellcheck shell=bash

verb_docs() { # the documents as a site, build/docs/index.html
  (($# == 0)) || die "./run docs takes no arguments"
  set_up pinned
  with_lock "$root/build/.lock" install_docs_tools
  with_lock "$root/build/.docs.lock" build_docs
  say "open $root/build/docs/index.html"
}

install_docs_tools() {
  local home=$root/build/docs-tools pins=$root/python/requirements-docs.txt log=$root/build/docs-tools.log
  [[ $home/.installed -nt $pins ]] && return
  say "installing the tools of ./run docs into build/docs-tools"
  rm -rf "$home"
  { "$venv/bin/python" -m venv "$home" &&
    "$home/bin/pip" install -q --disable-pip-version-check -r "$pins"; } >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the tools of ./run docs could not be installed: no network?"
  touch "$home/.installed"
}

# Warnings are errors, among them a link that leads nowhere (-n). The whole site each time: it takes seconds.
build_docs() {
  local log=$root/build/docs.log
  cd "$root"
  rm -rf "$root/build/docs"
  CLUSTERDEM_PACKAGES=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))') \
    "$root/build/docs-tools/bin/sphinx-build" -q -W -n --keep-going -E -c doc -d "$root/build/docs-cache" . "$root/build/docs" \
    >"$log" 2>&1 </dev/null || { grep -E 'WARNING|ERROR|rror' "$log" | head -n 40 >&2; die "the site could not be built." "the whole log: $log"; }
}
