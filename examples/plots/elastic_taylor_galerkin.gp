# Stress and velocity of the elastic bar against the exact answer; one or several runs.
#     gnuplot -e "csv='FILE...'; names='NAME...'; out='PREFIX'" examples/plots/elastic_taylor_galerkin.gp
# FILE: what elastic_taylor_galerkin wrote with --csv, NAME: what to call it. Makes PREFIX.png and PREFIX.svg.
if (!exists("csv") || !exists("out") || !exists("names")) {
    print "usage: gnuplot -e \"csv='FILE...'; names='NAME...'; out='PREFIX'\" examples/plots/elastic_taylor_galerkin.gp"
    exit status 2
}
set datafile separator comma
set datafile columnheaders
array colour[6] = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9"]
do for [kind in "png svg"] {
    if (kind eq "png") { set terminal pngcairo size 1000,760 font "sans,13" } else { set terminal svg size 1000,760 font "sans,16" }
    set output out . "." . kind
    set multiplot layout 2,1 title "Two-step Taylor-Galerkin: a small shock in ({/Symbol s}, v)" font ",16" margins 0.12,0.97,0.09,0.92 spacing 0.05
    set grid lt 1 lw 0.6 lc rgb "#d0d0d0"
    set xrange [0:1]
    set offsets 0, 0, graph 0.05, graph 0.05
    set format x ""
    set format y "%.4f"
    set key top left
    set ylabel "stress (Pa)"
    plot word(csv, 1) using "x":"exact_stress" with lines lw 1.5 lc rgb "#000000" title "exact", \
         for [k = 1:words(csv)] word(csv, k) using "x":"stress" with lines lw 1.2 lc rgb colour[k] title word(names, k)
    set format x "%g"
    set key off
    set xlabel "x (m)"
    set ylabel "velocity (m/s)"
    plot word(csv, 1) using "x":"exact_velocity" with lines lw 1.5 lc rgb "#000000", \
         for [k = 1:words(csv)] word(csv, k) using "x":"velocity" with lines lw 1.2 lc rgb colour[k]
    unset multiplot
    unset xlabel
    set output
}
