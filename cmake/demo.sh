#!/bin/sh
# sh cmake/demo.sh: installs what is missing (Debian, Ubuntu), builds and runs the three scenes of the bar, then builds
# the other examples, runs two scenes of gases, and makes the reports of error against run time and of stability. Tables,
# CSV files, plots and reports are left in out/, the bar's after a few minutes.
set -eu
cd "$(dirname "$0")/.."

sh cmake/setup.sh libcli11-dev nlohmann-json3-dev gnuplot-nox
sh cmake/build.sh demo standing_wave reflection shock

mkdir -p out
for scene in standing_wave reflection shock; do
    echo "== $scene"
    rm -rf "out/$scene"
    mkdir "out/$scene"
    # Not piped into tee: a pipe would hide that the program failed.
    "build/demo/examples/$scene" --summary "out/$scene.json" --csv "out/$scene" --every 20 > "out/$scene.txt" || {
        cat "out/$scene.txt"
        echo "The scene $scene failed; its output is above." >&2
        exit 1
    }
    cat "out/$scene.txt"
    if command -v gnuplot > /dev/null; then
        gnuplot -e "csv='out/$scene'; out='out/$scene'" "examples/plots/$scene.gp"
    else
        echo "gnuplot is not installed, so $scene is not plotted."
    fi
done
echo "== The bar's tables and plots are in out/. Now the other examples and the reports: some minutes more"
sh cmake/build.sh demo
for scene in gas_wave shock_tube; do
    echo "== $scene"
    "build/demo/examples/$scene" --summary "out/$scene.json" --csv "out/$scene.csv"
    if command -v gnuplot > /dev/null; then
        gnuplot -e "csv='out/$scene.csv'; out='out/$scene'" "examples/plots/$scene.gp"
    fi
done
echo "== Reports: error against run time, stability (two to four minutes)"
if command -v gnuplot > /dev/null; then
    rm -rf out/report
    build/demo/examples/report/tamis_report error --quick --out out/report
    build/demo/examples/report/tamis_report stability --quick --out out/report
else
    echo "gnuplot is not installed, so the reports, whose pictures it draws, are not made."
fi
echo "== Written to out/:"
ls out
