#!/bin/sh
# sh cmake/test.sh: installs what is missing (Debian, Ubuntu), builds the tests with warnings as errors, and runs them all.
# Those that compile longest are not among them: .ci/run adds them.
set -eu
cd "$(dirname "$0")/.."

sh cmake/setup.sh catch2 libcli11-dev nlohmann-json3-dev gnuplot-nox
sh cmake/build.sh test
ctest --test-dir build/test -j2 --output-on-failure
