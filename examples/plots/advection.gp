# What advection carried once through the domain, against the exact answer; one or several runs, lines through particles.
#     gnuplot -e "csv='FILE...'; names='NAME...'; out='PREFIX'" examples/plots/advection.gp
# FILE: what advection wrote with --csv, NAME: what to call it. Makes PREFIX.png and PREFIX.svg.
if (!exists("csv") || !exists("out") || !exists("names")) {
    print "usage: gnuplot -e \"csv='FILE...'; names='NAME...'; out='PREFIX'\" examples/plots/advection.gp"
    exit status 2
}
set datafile separator comma
set datafile columnheaders
array colour[6] = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9"]
do for [kind in "png svg"] {
    if (kind eq "png") { set terminal pngcairo size 1000,520 font "sans,13" } else { set terminal svg size 1000,520 font "sans,16" }
    set output out . "." . kind
    set title "Two-step Taylor-Galerkin: carried once through the domain" font ",16"
    set grid lt 1 lw 0.6 lc rgb "#d0d0d0"
    set xrange [0:1]
    set offsets 0, 0, graph 0.05, graph 0.05
    set key top right
    set xlabel "x (m)"
    set ylabel "u"
    plot word(csv, 1) using "x":"exact_u" with lines lw 1.5 lc rgb "#000000" title "exact", \
         for [k = 1:words(csv)] word(csv, k) using "x":"u" with linespoints pt 7 ps 0.3 lw 1.2 lc rgb colour[k] title word(names, k)
    set output
}
