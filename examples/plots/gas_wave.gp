# Velocity and pressure of a driven gas over x, particles against the acoustic answer.
#     gnuplot -e "csv='FILE'; out='PREFIX'" examples/plots/gas_wave.gp
# FILE: what gas_wave wrote with --csv. Makes PREFIX.png and PREFIX.svg.
if (!exists("csv") || !exists("out")) {
    print "usage: gnuplot -e \"csv='FILE'; out='PREFIX'\" examples/plots/gas_wave.gp"
    exit status 2
}
set datafile separator comma
set datafile columnheaders
do for [kind in "png svg"] {
    if (kind eq "png") { set terminal pngcairo size 900,620 font "sans,12" } else { set terminal svg size 1200,800 font "sans,16" }
    set output out . "." . kind
    set multiplot layout 2,1 title "Gas whose right end is driven" font ",15" margins 0.12,0.97,0.10,0.92 spacing 0.05
    set grid lt 1 lw 0.6 lc rgb "#d0d0d0"
    set offsets 0, 0, graph 0.05, graph 0.05
    set xrange [0:1]
    set format x ""
    set key top left
    set ylabel "velocity (m/s)"
    plot csv using "x":"exact_velocity" with lines lc rgb "#000000" title "acoustic", \
         csv using "x":"velocity" with points pt 7 ps 0.4 lc rgb "#0072b2" title "particles"
    set key off
    set format x "%g"
    set xlabel "x (m)"
    set ylabel "pressure (Pa)"
    plot csv using "x":"exact_pressure" with lines lc rgb "#000000", \
         csv using "x":"pressure" with points pt 7 ps 0.4 lc rgb "#0072b2"
    unset multiplot
    unset xlabel
    set output
}
