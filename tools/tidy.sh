#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy: names, and checks that find mistakes) over the library and the programs.
#
# usage: tools/tidy.sh [BUILD [FOLDER...]]
#   BUILD   a configured build folder with compile_commands.json; build/dev when left out
#   FOLDER  which of its sources to look at: those below these folders; src and apps when left out
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:-build/dev}
shift $(($# > 0 ? 1 : 0))
command -v clang-tidy >/dev/null || { echo "skipped: no clang-tidy here"; exit 77; }
[ -e "$build/compile_commands.json" ] || { echo "tidy: $build is not configured: cmake --preset dev" >&2; exit 1; }

[ $# -gt 0 ] || set -- src apps
folders=$(IFS='|'; echo "$*")
grep -o '"file": "[^"]*"' "$build/compile_commands.json" | cut -d'"' -f4 | grep -E "^$PWD/($folders)/" | sort -u \
    | xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "$build" 2> >(grep -v 'warnings\? \(generated\|treated\)' >&2)
