#!/bin/sh
# sh cmake/build.sh <preset> [target...]: configures build/<preset> and builds it, by Ninja where that is installed.
set -eu
cd "$(dirname "$0")/.."

preset=$1
shift
generator=
if command -v ninja > /dev/null && [ ! -f "build/$preset/CMakeCache.txt" ]; then
    generator="-G Ninja"
fi
cmake --preset "$preset" $generator
cmake --build "build/$preset" --parallel "$(getconf _NPROCESSORS_ONLN)" ${1:+--target "$@"}
