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

# build PRESET [TARGET...]: configures and builds.
build() {
  local preset=$1
  shift
  configure "$preset"
  say "building $preset with $jobs jobs"
  local targets=()
  if [ $# -gt 0 ]; then targets=(--target "$@"); fi
  (cd "$root" && cmake --build --preset "$preset" -j "$jobs" "${targets[@]}" -- --quiet)
}
