# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts beside it. Sets `root`, the top of the tree.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
jobs=${INCISE_JOBS:-$(nproc)}
# Lets clones in other folders share ccache's results.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

say() { printf '%s\n' "$*" >&2; }
die() {
  say "${0##*/}: $*"
  exit 1
}

# as_root COMMAND...: runs it as root, through sudo where this is an ordinary user.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "this needs root and there is no sudo; run as root: $*"
  fi
}

# missing_packages PACKAGE...: prints those that are not installed. `command:PACKAGE` counts as there when the
# command is, whoever brought it.
missing_packages() {
  local wanted
  for wanted in "$@"; do
    case $wanted in
      *:*) command -v "${wanted%%:*}" >/dev/null || printf '%s\n' "${wanted#*:}" ;;
      *)
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$wanted" 2>/dev/null)" = installed ] ||
          printf '%s\n' "$wanted"
        ;;
    esac
  done
}

apt_quiet() { # apt_quiet ARGUMENT...: apt-get without questions; its output only when it fails
  local log
  log=$(mktemp)
  if ! as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 \
    "$@" >"$log" 2>&1 </dev/null; then
    tail -n 25 "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}

# install_packages PURPOSE PACKAGE...: installs what is missing with apt-get, and says so. Silent when all is there.
install_packages() {
  local purpose=$1 missing
  shift
  mapfile -t missing < <(missing_packages "$@" | sort -u)
  [ "${#missing[@]}" -gt 0 ] || return 0
  command -v apt-get >/dev/null ||
    die "needed for $purpose, and there is no apt-get to install it with: ${missing[*]}"
  say "Installing for $purpose: ${missing[*]}"
  if ! apt-cache show --no-all-versions "${missing[@]}" >/dev/null 2>&1; then
    apt_quiet update || die "'apt-get update' failed; is the network there?"
  fi
  apt_quiet install --no-install-recommends "${missing[@]}" && return 0
  # The package lists may be older than what the mirror still holds.
  { apt_quiet update && apt_quiet install --no-install-recommends "${missing[@]}"; } ||
    die "apt-get could not install: ${missing[*]}"
}

# quietly MESSAGE COMMAND...: runs it with its output kept back unless it fails.
quietly() {
  local message=$1 log status=0
  shift
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  if [ "$status" -ne 0 ]; then
    cat "$log" >&2
    rm -f "$log"
    die "$message failed"
  fi
  rm -f "$log"
}

# build_preset PRESET [CMAKE-ARGUMENT...]: configures and builds, quiet where nothing has to be done.
build_preset() {
  local preset=$1
  shift
  cd "$root"
  quietly "configuring the preset $preset" cmake --preset "$preset" "$@"
  cmake --build --preset "$preset" -j "$jobs" -- --quiet >&2
}

# use_corpus: tells the programs where the real meshes are; leaves INCISE_CORPUS unset where there are none.
use_corpus() {
  if [ -z "${INCISE_CORPUS:-}" ] && [ -d "$root/../shared/data" ]; then
    INCISE_CORPUS=$(cd -- "$root/../shared/data" && pwd)
  fi
  if [ -n "${INCISE_CORPUS:-}" ]; then
    export INCISE_CORPUS
  else
    unset INCISE_CORPUS
  fi
}

# shellcheck disable=SC2034  # read by the scripts
build_packages=(
  cmake ninja-build g++ ccache git ca-certificates
  libeigen3-dev libtbb-dev libhwy-dev libpugixml-dev zlib1g-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libcli11-dev
  libgtest-dev libgmock-dev librapidcheck-dev
  libepoxy-dev libegl-dev libstb-dev libegl1 libgl1-mesa-dri libglfw3-dev libimgui-dev fonts-dejavu-core
  xvfb xdotool
)
# shellcheck disable=SC2034
quality_packages=(clang-format-14 clang-tidy-14 clang-14 universal-ctags python3:python3 python3-nibabel)
# shellcheck disable=SC2034
model_packages=(tetgen python3:python3)
# shellcheck disable=SC2034
wasm_packages=(emscripten node:nodejs clang-14)
