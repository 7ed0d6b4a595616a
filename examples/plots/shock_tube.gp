# Density, velocity and pressure of a shock tube over x, particles against the exact answer.
#     gnuplot -e "csv='FILE'; out='PREFIX'" examples/plots/shock_tube.gp
# FILE: what shock_tube wrote with --csv. Makes PREFIX.png and PREFIX.svg.
if (!exists("csv") || !exists("out")) {
    print "usage: gnuplot -e \"csv='FILE'; out='PREFIX'\" examples/plots/shock_tube.gp"
    exit status 2
}
set datafile separator comma
set datafile columnheaders
do for [kind in "png svg"] {
    if (kind eq "png") { set terminal pngcairo size 1200,1000 font "sans,13" } else { set terminal svg size 1200,1000 font "sans,16" }
    set output out . "." . kind
    set multiplot layout 3,1 title "Shock tube: two gases at rest meet at 1/2" font ",17" margins 0.10,0.97,0.07,0.93 spacing 0.06
    set grid lt 1 lw 0.6 lc rgb "#d0d0d0"
    set offsets 0, 0, graph 0.05, graph 0.05
    set xrange [0:1]
    set format x ""
    set key top right
    set ylabel "density (kg/m)"
    plot csv using "x":"exact_density" with lines lc rgb "#000000" title "exact", \
         csv using "x":"density" with points pt 7 ps 0.3 lc rgb "#0072b2" title "particles"
    set key off
    set ylabel "velocity (m/s)"
    plot csv using "x":"exact_velocity" with lines lc rgb "#000000", \
         csv using "x":"velocity" with points pt 7 ps 0.3 lc rgb "#0072b2"
    set format x "%g"
    set xlabel "x (m)"
    set ylabel "pressure (Pa)"
    plot csv using "x":"exact_pressure" with lines lc rgb "#000000", \
         csv using "x":"pressure" with points pt 7 ps 0.3 lc rgb "#0072b2"
    unset multiplot
    unset xlabel
    set output
}
