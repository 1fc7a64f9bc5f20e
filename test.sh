#!/usr/bin/env bash
# Builds everything with assertions on and runs every test. Installs missing Debian packages first.
#
# usage: ./test.sh [ctest options]      for instance ./test.sh -R layers
set -euo pipefail
cd "$(dirname "$0")"

tools/install_dependencies.sh build run test
cmake --preset dev
cmake --build --preset dev --parallel "$(nproc)"
ctest --preset dev --output-on-failure --parallel "$(nproc)" "$@"
