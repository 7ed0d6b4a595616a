#!/bin/sh
# sh benchmarks/count_operations.sh <program>: loads and stores per particle and step by valgrind, beside the multiplications
# and additions that the program counts itself. The program is build/*/benchmarks/operations.
set -eu
program=$1
"$program"
count() {
    valgrind --tool=callgrind --cache-sim=yes --callgrind-out-file=/dev/null "$program" "$1" "$2" 2>&1 |
        awk '/Collected/ { print $5, $6; found = 1 } END { exit !found }' || {
        echo "valgrind could not run $program; is it installed, and the program compiled for AVX2 at most?" >&2
        return 1
    }
}
particles=$("$program" flip 1 | awk '{ print $1 }')
echo "| update | loads | stores |, per particle and step"
for update in pic flip 'xpic(2)' 'xpic(4)' 'fmpm(2)' 'fmpm(4)'; do
    short=$(count "$update" 5)
    long=$(count "$update" 25)
    echo "$short $long" | awk -v n="$particles" -v u="$update" \
        '{ printf "| %-8s | %6.1f | %6.1f |\n", u, ($3 - $1) / (20 * n), ($4 - $2) / (20 * n) }'
done
