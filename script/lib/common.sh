# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts beside it. Sets `root`, the top of the tree.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
jobs=${INCISE_JOBS:-$(nproc)}
# Lets clones in other folders share ccache's results. Not those in folders with a space in their names: ccache leaves such names
# as they are in its lists of what a source includes, and another clone would build what it has anew each time.
case $root in *' '*) ;; *) export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 ;; esac

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

# with_progress COMMAND...: runs a build by Ninja. On a terminal Ninja keeps one line up to date; elsewhere about twenty
# lines tell how far it is and how long it takes yet, beside whatever the compiler has to say.
with_progress() {
  export NINJA_STATUS='[%f/%t, %e s] '
  if [ -t 2 ]; then
    "$@" >&2
    return
  fi
  "$@" 2>&1 | awk '
    match($0, /^\[[0-9]+\/[0-9]+, [0-9.]+ s\] /) {
      split(substr($0, 2), part, /[\/, ]+/)
      done = part[1]; total = part[2]; seconds = part[3]
      if (done * 20 >= (shown + 1) * total || done == total) {
        shown = int(done * 20 / total)
        printf "built %d of %d, %d s, about %d s left\n", done, total, seconds, seconds * (total - done) / done
        fflush()
      }
      next
    }
    /^ninja: no work to do/ {next}
    {print; fflush()}' >&2
}

# build_preset PRESET [CMAKE-ARGUMENT...]: configures, and builds the array `targets`, or all where there is none. Two scripts
# that build one preset at once wait for each other. Where INCISE_BUILT names a folder, nothing changes while it lasts: a
# preset that is built whole is marked there and left as it is from then on, so that no test loses its program to a linker.
build_preset() {
  local preset=$1 status=0 turn
  shift
  cd "$root"
  mkdir -p "build/$preset"
  exec {turn}<"build/$preset"
  flock "$turn"
  if [ -z "${INCISE_BUILT:-}" ] || [ ! -e "$INCISE_BUILT/$preset" ]; then
    quietly "configuring the preset $preset" cmake --preset "$preset" "$@"
    with_progress cmake --build --preset "$preset" -j "$jobs" ${targets:+--target "${targets[@]}"} || status=$?
    if [ -n "${INCISE_BUILT:-}" ] && [ -z "${targets:-}" ] && [ "$status" = 0 ]; then touch "$INCISE_BUILT/$preset"; fi
  fi
  exec {turn}<&-
  return "$status"
}

# branch_point: the commit where this branch left origin/main; the last commit where there is none, or nothing since.
branch_point() {
  local base
  base=$(git -C "$root" merge-base HEAD origin/main 2>/dev/null) || base=$(git -C "$root" rev-parse HEAD)
  printf '%s\n' "$base"
}

# changed_files PATTERN...: files of the tree that differ from the branch point, those that git does not know included.
changed_files() {
  {
    git -C "$root" diff --name-only --diff-filter=d "$(branch_point)" -- "$@"
    git -C "$root" ls-files --others --exclude-standard -- "$@"
  } | sort -u
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

# What the command and the window are built from; and, with it, what else is built and what tests need.
program_packages=(
  cmake ninja-build g++ ccache git ca-certificates
  libeigen3-dev libtbb-dev libhwy-dev libpugixml-dev zlib1g-dev libfmt-dev nlohmann-json3-dev libcli11-dev
  libepoxy-dev libegl-dev libstb-dev libegl1 libgl1-mesa-dri libglfw3-dev libimgui-dev fonts-dejavu-core
  python3:python3
)
# shellcheck disable=SC2034  # read by the scripts
build_packages=(
  "${program_packages[@]}"
  libboost-dev libgtest-dev libgmock-dev librapidcheck-dev xvfb xdotool pkg-config
  python3-numpy python3-pytest python3-meshio mypy python3-pip
)
# shellcheck disable=SC2034
quality_packages=(clang-format-14 clang-tidy-14 clang-14 universal-ctags doxygen python3:python3 python3-nibabel)
# shellcheck disable=SC2034
model_packages=(tetgen python3:python3)
# shellcheck disable=SC2034
wasm_packages=(emscripten node:nodejs clang-14)
# shellcheck disable=SC2034
web_packages=(emscripten node:nodejs npm:npm chromium)
# shellcheck disable=SC2034
package_packages=(dpkg-dev lintian file)
# shellcheck disable=SC2034
python_packages=(python3-distributed python3-mpi4py openmpi-bin python3-matplotlib)
# shellcheck disable=SC2034
slurm_packages=(slurmctld slurmd slurm-client munge)
# shellcheck disable=SC2034
example_packages=(libbullet-dev cargo:cargo npm:npm node:nodejs)
