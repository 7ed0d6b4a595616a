#!/bin/sh
# sh compile_time.sh SOURCE COMPILER [OPTION...]: how long SOURCE takes to compile at each level of optimisation, and the
# same in a program of many files (of_many.cpp beside it, with and without a precompiled header; by g++); the median of
# three, with the options that come last.
set -eu
source=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

milliseconds() { echo $(($(date +%s%N) / 1000000)); }
# tell NAME COMMAND...
tell() {
    name=$1
    shift
    for run in 1 2 3; do
        start=$(milliseconds)
        "$@"
        echo $(($(milliseconds) - start))
    done | sort -n | awk -v name="$name" 'NR == 2 { printf "%-44s %10.1f\n", name, $1 / 1000 }'
}

printf '%-44s %10s\n' 'to compile' seconds
for level in -O0 -O1 -O2 -O3; do
    tell "tamis.hpp and one 3D solver, $level" "$@" "$level" -c "$source" -o "$work/object"
done
many=$(dirname "$source")/of_many.cpp
tell "-O2, the step in another file" "$@" -O2 -c "$many" -o "$work/object"
echo '#include <tamis/tamis.hpp>' > "$work/all.hpp"
"$@" -O2 -x c++-header "$work/all.hpp" -o "$work/all.hpp.gch"
tell "-O2, precompiled header" "$@" -O2 -include "$work/all.hpp" -c "$source" -o "$work/object"
tell "-O2, both" "$@" -O2 -include "$work/all.hpp" -c "$many" -o "$work/object"
