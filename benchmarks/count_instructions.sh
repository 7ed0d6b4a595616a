#!/bin/sh
# sh benchmarks/count_instructions.sh <program>: instructions per particle and step of a FLIP bar, held and moving, by callgrind.
# Two runs of different length: their difference leaves out the set-up. The program is build/*/benchmarks/instructions.
set -eu
program=$1
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$1" "$2" "$3" 2>&1 |
        awk '/Collected/ { print $4; found = 1 } END { exit !found }' || {
        echo "valgrind could not run $program; is it installed, and the program compiled for AVX2 at most?" >&2
        return 1
    }
}
for shape in linear quadratic; do
    for motion in held moving; do
        short=$(count $motion $shape 20)
        long=$(count $motion $shape 120)
        awk -v s="$short" -v l="$long" -v n="$motion $shape" \
            'BEGIN { printf "%-18s %6.1f instructions per particle and step\n", n, (l - s) / (100 * 800) }'
    done
done
