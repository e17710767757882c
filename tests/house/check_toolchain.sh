#!/bin/bash
# Runs toolchain/test and toolchain/dependencies in a folder of their own, with other programs in place of those that
# they call, and looks at what they call and leave.
#   tests/house/check_toolchain.sh SOURCES FOLDER
set -euo pipefail
sources=$1 place=$2

fail() {
  echo "$*" >&2
  exit 1
}

rm -rf "$place"
mkdir -p "$place/programs"
cp -r "$sources/toolchain" "$place/"
export CALLS=$place/calls XDG_CACHE_HOME=$place/cache

# stand_in FILE [LINE...]: a program that writes down how it is called, then does what the lines say.
stand_in() {
  local file=$1
  shift
  printf '%s\n' '#!/bin/bash' 'echo "${0##*/} $*" >>"$CALLS"' "$@" >"$file"
  chmod +x "$file"
}
export PATH=$place/programs:$PATH
dependencies=$place/toolchain/dependencies

# What was configured for other libraries goes, and only then.
digest=$({ cat "$dependencies" "$place/toolchain/sources.txt"; "${CC:-cc}" -dumpfullversion -dumpmachine; } |
  sha256sum | cut -c 1-16)
prefix=$XDG_CACHE_HOME/graspd/dependencies-$digest
mkdir -p "$prefix" "$place/build/release"
touch "$prefix/complete" "$place/build/release/CMakeCache.txt"
ln -s "$place/older" "$place/build/dependencies"
"$dependencies"
[ "$(readlink "$place/build/dependencies")" = "$prefix" ] || fail "the link does not lead to the libraries"
[ ! -e "$place/build/release/CMakeCache.txt" ] || fail "release stays configured for the older libraries"
touch "$place/build/release/CMakeCache.txt"
"$dependencies"
[ -e "$place/build/release/CMakeCache.txt" ] || fail "release must be configured again, though the libraries are the same"

# A refresh that comes to nothing leaves what there is.
stand_in "$place/programs/apt-get" 'case "$*" in' \
  '  "indextargets --format \$(REPO_URI)"*) . /etc/os-release && echo "http://nowhere $VERSION_CODENAME main" ;;' \
  '  *) exit 100 ;;' 'esac'
if "$dependencies" --refresh >"$place/refresh.log" 2>&1; then fail "fetched from nowhere"; fi
grep -q 'Fetching sources from Debian: FAILED' "$place/refresh.log" || fail "did not come to fetch: $(cat "$place/refresh.log")"
[ -e "$prefix/complete" ] || fail "a refresh without a network takes the libraries away"

# --all runs what it says, also after presets that count their tests.
for program in install dependencies build demo lint; do stand_in "$place/toolchain/$program"; done
for program in cmake clang-format git; do stand_in "$place/programs/$program"; done
stand_in "$place/programs/ctest" 'echo "100% tests passed, 0 tests failed out of 3"'
"$place/toolchain/test" --all >"$place/test.log" 2>&1 || fail "$(cat "$place/test.log")"
for call in 'ctest --preset tsan' 'cmake --preset dev' lint; do
  grep -q "^$call" "$CALLS" || fail "toolchain/test --all does not call $call"
done
# Three presets of three tests, and the checks: format, binary, two demos, the configuration, clang-tidy.
grep -qx '15 passed, 0 failed' "$place/test.log" || fail "$(tail -n 1 "$place/test.log")"
