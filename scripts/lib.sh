# Shared by the scripts of this folder; sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=$(nproc)

# The same sources give the same cache entries wherever the clone lies.
export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1

# Shows what the script says of itself at its head, when it is asked.
help_if_asked() {
  case ${1:-} in
    -h | --help)
      sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"
      exit 0
      ;;
  esac
}

say() { printf '== %s\n' "$*"; }

# step NAME: begins a step and says how long the last one took; steps_done ends the last one.
step_name='' step_began=0
steps_done() {
  if [ -n "$step_name" ]; then say "$step_name: $((SECONDS - step_began)) s"; fi
  step_name=''
}
step() {
  steps_done
  step_name=$1 step_began=$SECONDS
  say "$step_name"
}

# install_packages LIST: installs those Debian packages of the list that are missing.
install_packages() {
  local wanted missing=() sudo_prefix=()
  wanted=$(grep -v '^#' "$1")
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "no apt here; these Debian 12 packages, or their like, must be there:"
    printf '%s\n' "$wanted"
    return 0
  fi
  for package in $wanted; do
    [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) == 'install ok installed'* ]] ||
      missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "all packages of $(basename "$1") are there"
    return 0
  fi
  say "installing ${#missing[@]} packages: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then sudo_prefix=(sudo); fi
  "${sudo_prefix[@]}" apt-get update -qq
  "${sudo_prefix[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# configure PRESET: quiet unless it fails.
configure() {
  local log
  log=$(mktemp)
  say "configuring $1"
  (cd "$root" && cmake --preset "$1" >"$log" 2>&1) || {
    cat "$log"
    rm -f "$log"
    return 1
  }
  rm -f "$log"
}

# build PRESET [TARGET...]: configures and builds; quiet unless it fails.
build() {
  local preset=$1
  shift
  configure "$preset"
  say "building $preset with $jobs jobs"
  run_build "$preset" "$@" -- --quiet
}

# build_showing_progress PRESET [TARGET...]: the same, and shows how far it is: on a terminal in ninja's own line, else in
# a line for each tenth.
build_showing_progress() {
  local preset=$1
  shift
  configure "$preset"
  say "building $preset with $jobs jobs; the first time takes minutes"
  if [ -t 1 ] && [ "${TERM:-dumb}" != dumb ]; then
    NINJA_STATUS='[%f of %t, %p] ' run_build "$preset" "$@"
  else
    NINJA_STATUS='[%f/%t] ' run_build "$preset" "$@" | only_tenths
  fi
}

# run_build PRESET [TARGET...] [-- NINJA_ARGUMENT...]
run_build() {
  local preset=$1 targets=()
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    targets+=("$1")
    shift
  done
  if [ ${#targets[@]} -gt 0 ]; then targets=(--target "${targets[@]}"); fi
  (cd "$root" && cmake --build --preset "$preset" -j "$jobs" "${targets[@]}" "$@")
}

# only_tenths: of ninja's lines "[done/all] step" those with which another tenth is done, as "built 12 of 120 files"; all
# that is no such line (errors, warnings) as it is.
only_tenths() {
  awk '
    /^ninja: (Entering directory|no work to do)/ { next }
    match($0, /^\[[0-9]+\/[0-9]+\] /) {
      split(substr($0, 2, RLENGTH - 3), count, "/")
      tenth = int(10 * count[1] / count[2])
      if (tenth > shown) { printf "built %d of %d files\n", count[1], count[2]; fflush() }
      if (tenth > shown) shown = tenth
      next
    }
    { print; fflush() }'
}
