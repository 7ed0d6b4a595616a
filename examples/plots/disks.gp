# The two disks at four times, coloured by the pressure in the plane.
#     gnuplot -e "csv='DIR'; out='PREFIX'" examples/plots/disks.gp
# DIR: where the example disks wrote its tables. Makes PREFIX.png.
if (!exists("csv") || !exists("out")) {
    print "usage: gnuplot -e \"csv='DIR'; out='PREFIX'\" examples/plots/disks.gp"
    exit status 2
}
set datafile separator comma
set datafile columnheaders
files = system("ls '" . csv . "'/particles_*.csv")
if (words(files) < 6) {
    print "there are fewer than six particles_*.csv in " . csv
    exit status 2
}
# Records: as the disks begin to feel each other, while they are pressed together, and as they part.
array file[4]
array time[4]
record = "2 3 4 6"
do for [k = 1:4] {
    file[k] = word(files, int(word(record, k)))
    stats file[k] using 2 every ::0::0 nooutput
    time[k] = STATS_min
}

set terminal pngcairo size 1200,760 font "sans,13"
set output out . ".png"
set multiplot layout 2,2 title "Two neo-Hookean disks collide: -({/Symbol s}_{xx} + {/Symbol s}_{yy})/2 in MPa" font ",17" margins 0.06,0.89,0.085,0.885 spacing 0.06,0.13
set size ratio -1
set xrange [3:47]
set yrange [0:24]
set xlabel "x (mm)" offset 0,0.6
set ylabel "y (mm)" offset 1.2,0
set cbrange [-15:15]
set palette defined (-1 "#0072b2", -0.5 "#7fc3e8", 0 "#e8e8e8", 0.5 "#f0a868", 1 "#b03a00")
unset key
do for [k = 1:4] {
    if (k == 2) { set colorbox user origin 0.915,0.13 size 0.02,0.7 } else { unset colorbox }
    set title sprintf("t = %.0f {/Symbol m}s", 1e6 * time[k]) offset 0,-0.6
    plot file[k] using (1e3 * $3):(1e3 * $4):(-($8 + $9) / 2e6) with points pt 5 ps 0.3 lc palette
}
unset multiplot
