#!/bin/sh
# sh cmake/demo.sh [all]: installs what is missing (Debian, Ubuntu), builds and runs the three scenes of the bar, and
# reports their errors against run time. all: then the other examples, two scenes of gases, and the reports of all scenes
# and of stability too. Tables, CSV files, plots and reports are left in out/.
set -eu
cd "$(dirname "$0")/.."

case "$#${1:-}" in
    0) all=no ;;
    1all) all=yes ;;
    *)
        echo "demo.sh: '$*' is not known; give nothing, or 'all'" >&2
        exit 2
        ;;
esac

# run SCENE [OPTION...]: tables to out/SCENE.txt and out/SCENE.json.
run() {
    scene=$1
    shift
    echo "== $scene"
    # Not piped into tee: a pipe would hide that the program failed.
    "build/demo/examples/$scene" --summary "out/$scene.json" "$@" > "out/$scene.txt" || {
        cat "out/$scene.txt"
        echo "The scene $scene failed; its output is above." >&2
        exit 1
    }
    cat "out/$scene.txt"
}
# draw SCENE CSV: a folder or a file.
draw() {
    if command -v gnuplot > /dev/null; then
        gnuplot -e "csv='$2'; out='out/$1'" "examples/plots/$1.gp"
    else
        echo "gnuplot is not installed, so $1 is not plotted."
    fi
}
# report PROGRAM KIND FOLDER: its pictures are gnuplot's.
report() {
    if command -v gnuplot > /dev/null; then
        "build/demo/examples/report/$1" "$2" --quick --out "$3"
    else
        echo "gnuplot is not installed, so the report of $2 is not made."
    fi
}

sh cmake/setup.sh libcli11-dev nlohmann-json3-dev gnuplot-nox
sh cmake/build.sh demo standing_wave reflection shock tamis_bar_report
mkdir -p out
for scene in standing_wave reflection shock; do
    rm -rf "out/$scene"
    mkdir "out/$scene"
    run "$scene" --csv "out/$scene" --every 20
    draw "$scene" "out/$scene"
done
echo "== Report: error against run time, the bar's scenes"
rm -rf out/bar_report
report tamis_bar_report error out/bar_report

if [ "$all" = yes ]; then
    sh cmake/build.sh demo
    for scene in gas_wave shock_tube; do
        run "$scene" --csv "out/$scene.csv"
        draw "$scene" "out/$scene.csv"
    done
    echo "== Reports: error against run time of all scenes, stability"
    rm -rf out/report
    report tamis_report error out/report
    report tamis_report stability out/report
fi
echo "== Written to out/:"
ls out
