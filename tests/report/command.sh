#!/bin/sh
# command.sh PROGRAM WORK: `tamis_report error` for one scene: interrupted, resumed, and refused where it must be.
set -eu
report=$1
work=$2
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
    echo "FAILED: $1"
    exit 1
}
lines() { wc -l < out/errors.csv; }

# Ctrl-C leaves what is done: a whole table and a page that says so. A shell's background jobs ignore SIGINT unless it
# says otherwise; the program asks for it itself.
"$report" error --quick --scene bi_material --out out > said 2> progress &
program=$!
while [ ! -f out/errors.csv ] || [ "$(lines)" -lt 2 ]; do
    kill -0 "$program" 2> /dev/null || break
    sleep 0.05
done
kill -INT "$program" 2> /dev/null || true
code=0
wait "$program" || code=$?
[ "$code" = 130 ] || [ "$code" = 0 ] || fail "an interrupted report exits with $code: $(cat said progress)"
if [ "$code" = 130 ]; then
    grep -q 'interrupted' said || fail "an interrupted report does not say so"
    grep -q 'This report was interrupted' out/error.html || fail "the page of an interrupted report does not say so"
fi
[ ! -f out/errors.csv.part ] || fail "a draft was left"
done_before=$(lines)
head -n "$done_before" out/errors.csv > before.csv

# Without --resume what is there is kept and the run refused.
"$report" error --quick --scene bi_material --out out > said 2>&1 && fail "measurements were about to be lost"
grep -q 'give --resume' said || fail "the refusal does not say what to do: $(cat said)"
cmp -s before.csv out/errors.csv || fail "a refused run changed the table"

# What is done is not run again: its lines stay as they are, times and all.
"$report" error --quick --scene bi_material --out out --resume > said 2>&1 || fail "--resume failed: $(cat said)"
head -n "$done_before" out/errors.csv | cmp -s before.csv - || fail "a run was made again"
[ "$(lines)" = 161 ] || fail "the table has $(lines) lines, not 160 and a head"
[ "$(sort -u out/errors.csv | wc -l)" = 161 ] || fail "a run is there twice"
awk -F, 'NF != 23 { exit 1 }' out/errors.csv || fail "a line of the table is not whole"
! grep -q 'This report was interrupted' out/error.html || fail "a complete report says that it was interrupted"

"$report" error --scene nothing --out none > said 2>&1 && fail "an unknown scene was taken"
grep -q "'nothing' is unknown; there are standing_wave" said || fail "unknown scenes are not told: $(cat said)"
[ ! -e none ] || fail "a refused command left a folder"
echo "interrupted with $done_before lines, resumed to 161"
