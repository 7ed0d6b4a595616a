#!/bin/sh
# sh benchmarks/count_instructions.sh <program>: instructions per particle and step of FLIP, by callgrind: a bar, held and
# moving, and a block of 12^3 cells with 8 particles each.
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
# tell MOTION SHAPE PARTICLES STEPS
tell() {
    short=$(count "$1" "$2" 20)
    long=$(count "$1" "$2" $((20 + $4)))
    awk -v s="$short" -v l="$long" -v n="$1 $2" -v particles="$3" -v steps="$4" \
        'BEGIN { printf "%-18s %6.1f instructions per particle and step\n", n, (l - s) / (steps * particles) }'
}
for shape in linear quadratic; do
    for motion in held moving; do
        tell $motion $shape 800 100
    done
    tell block $shape 13824 10
done
