#!/bin/sh
# sh compile_time.sh SOURCE COMPILER [OPTION...]: how long SOURCE takes to compile at each level of optimisation, the
# median of three; with the options that come last.
set -eu
source=$1
shift
object=$(mktemp)
trap 'rm -f "$object"' EXIT

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

printf '%-44s %10s\n' 'to compile' seconds
for level in -O0 -O1 -O2 -O3; do
    for run in 1 2 3; do
        start=$(milliseconds)
        "$@" "$level" -c "$source" -o "$object"
        echo $(($(milliseconds) - start))
    done | sort -n | awk -v level="$level" 'NR == 2 { printf "%-44s %10.1f\n", "tamis.hpp and one 3D solver, " level, $1 / 1000 }'
done
