# Velocity and strain of the standing wave over x against the exact answer, and its energy over time.
#     gnuplot -e "csv='DIR'; out='PREFIX'" examples/plots/standing_wave.gp
# DIR: what the scene wrote with --csv. Makes PREFIX.png and PREFIX.svg. Other than default amplitudes: amplitude=... after out.
if (!exists("csv") || !exists("out")) {
    print "usage: gnuplot -e \"csv='DIR'; out='PREFIX'\" examples/plots/standing_wave.gp"
    exit status 2
}
if (!exists("amplitude")) amplitude = 0.01

# The exact answer, L = c = 1.
v(x, t) = amplitude * sin(pi * x) * cos(pi * t)
e(x, t) = amplitude * cos(pi * x) * sin(pi * t)

set datafile separator comma
set datafile columnheaders
files = system("ls '" . csv . "'/particles_*.csv")
count = words(files)
if (count == 0) {
    print "there is no particles_*.csv in " . csv
    exit status 2
}
# Records at these parts of the run.
parts = "0 0.06 0.12 0.18 0.25"
array file[words(parts)]
array time[words(parts)]
do for [k = 1:words(parts)] {
    file[k] = word(files, 1 + int(real(word(parts, k)) * (count - 1) + 0.5))
    stats file[k] using 1 every ::0::0 nooutput
    time[k] = STATS_min
}
array colour[6] = ["#000000", "#0072b2", "#009e73", "#e69f00", "#d55e00", "#cc79a7"]

do for [kind in "png svg"] {
    if (kind eq "png") { set terminal pngcairo size 1200,1300 font "sans,13" } else { set terminal svg size 1200,1300 font "sans,16" }
    set output out . "." . kind
    set multiplot layout 3,1 title "Standing wave: v = v_0 sin {/Symbol p}x cos {/Symbol p}t" font ",17" margins 0.115,0.80,0.055,0.945 spacing 0.07
    set grid lt 1 lw 0.6 lc rgb "#d0d0d0"
    set offsets 0, 0, graph 0.05, graph 0.05
    set samples 401
    set key outside right top Left reverse spacing 1.3 samplen 1.5
    set xlabel "x (m)" offset 0,0.4
    set xrange [0:1]
    set format y "%.3f"
    set ylabel "velocity (m/s)"
    plot for [k = 1:|file|] v(x, time[k]) with lines lw 1.5 lc rgb colour[k] notitle, \
         for [k = 1:|file|] file[k] using 2:4 with points pt 7 ps 0.6 lc rgb colour[k] title sprintf("t = %.3g s", time[k]), \
         NaN with lines lw 1.5 lc rgb "#555555" title "line: exact", NaN with points pt 7 ps 0.6 lc rgb "#555555" title "point: particle"
    set ylabel "strain"
    plot for [k = 1:|file|] e(x, time[k]) with lines lw 1.5 lc rgb colour[k] notitle, \
         for [k = 1:|file|] file[k] using 2:6 with points pt 7 ps 0.6 lc rgb colour[k] title sprintf("t = %.3g s", time[k])
    set xlabel "t (s)" offset 0,0.4
    set ylabel "energy (J)"
    set xrange [0:*]
    set format y "%.1e"
    set yrange [0:*]
    plot csv . "/energy.csv" using 1:4 with points pt 7 ps 0.9 lc rgb colour[1] title "total", \
         "" using 1:2 with points pt 6 ps 0.7 lc rgb colour[2] title "kinetic", \
         "" using 1:3 with points pt 4 ps 0.7 lc rgb colour[5] title "elastic", \
         "" using 1:6 with lines lw 2 lc rgb "#999999" title "total, exact"
    set yrange [*:*]
    unset multiplot
    unset output
}
