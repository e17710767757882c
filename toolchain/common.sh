# Shared by the commands of this folder; sourced, never run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
logs=$root/build/logs
cores=$(nproc)

# One line for a person on standard error, then the end.
die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Stops what step runs when a person stops the command: its processes have a group of their own.
running=
stop_running() {
  [ -z "$running" ] || kill -TERM -- "-$running" 2>/dev/null || true
  exit 130
}
trap stop_running INT TERM

# step TITLE LOG COMMAND...: runs a command with its output in build/logs/LOG.log, shows the title, the time and,
# on a terminal, the last line of that output while it runs. On failure shows the end of the log.
step() {
  local title=$1 log=$logs/$2.log started=$SECONDS
  shift 2
  mkdir -p "$logs"
  set -m
  "$@" >"$log" 2>&1 </dev/null &
  running=$!
  set +m
  local last width failed=0
  if [ -t 1 ]; then
    width=$(tput cols 2>/dev/null || echo 80)
    while kill -0 "$running" 2>/dev/null; do
      last=$(tail -c 300 "$log" | tr '\r' '\n' | tail -n 1 | tr -cd '[:print:]')
      printf '\r\033[K%.*s' "$((width - 1))" "  $title  $((SECONDS - started)) s  $last"
      sleep 0.2
    done
    printf '\r\033[K'
  else
    printf '  %s ...\n' "$title"
  fi
  wait "$running" || failed=$?
  running=
  if [ "$failed" -eq 0 ]; then
    printf '  %s: done in %d s\n' "$title" "$((SECONDS - started))"
  else
    printf '  %s: FAILED after %d s; the end of %s:\n' "$title" "$((SECONDS - started))" "$log" >&2
    tail -n 40 "$log" >&2
    return 1
  fi
}

# Compiles through ccache when the machine has it: paths are relative to this folder, so that clones share results, and
# a miss costs no extra run of the preprocessor.
use_ccache() {
  if command -v ccache >/dev/null; then
    export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
    export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
  fi
}

# build_preset PRESET OPTION...: configures and builds. A unit of several sources that does not compile says little about
# them, because a name of one may have met a name of another in a way that units.awk does not see: what counts is
# whether each source compiles by itself.
build_preset() {
  local preset=$1
  shift
  step "Configuring $preset" "configure-$preset" cmake --preset "$preset" || return 1
  step "Building $preset" "build-$preset" cmake --build --preset "$preset" --parallel "$cores" "$@" && return
  step "Configuring $preset, source by source" "configure-$preset" cmake --preset "$preset" -DGRASPD_UNITS=OFF || return 1
  step "Building $preset, source by source" "build-$preset" cmake --build --preset "$preset" --parallel "$cores" "$@"
}
