# Microseconds a rod and step against the aspect ratio, from speed.csv (csv, out: set by bench/run).
set datafile separator ","
set logscale xy
set xlabel "aspect ratio"
set ylabel "µs per rod and step, one core"
set xrange [2.5:120]
set xtics (3, 10, 20, 30, 100)
set grid
set key outside right top
# Rows of a scene, a number of rods (0: any) and a code on one rank. Spheres a rod: a lambda - b.
plugin(scene, rods) = (strcol(1) eq scene && (rods == 0 || $3 == rods) && $4 == 1 && strcol(6) eq "plugin") ? $7 : NaN
glued(scene, a, b) = (strcol(1) eq scene && $3 <= 2000 && $4 == 1 && strcol(6) eq sprintf("multisphere n=%d", a * $2 - b)) ? $7 : NaN
do for [kind in "svg png"] {
  if (kind eq "svg") { set terminal svg size 900,520 font "sans,12" background "white" } \
  else { set terminal pngcairo size 1350,780 font "sans,16" }
  set output out . "." . kind
  set datafile missing NaN
  plot csv using 2:(plugin("bed", 0)) every ::1 with linespoints lw 2 lc 1 pt 7 title "settled bed: plug-in", \
    csv using 2:(glued("bed", 1, 0)) every ::1 with linespoints lw 2 lc 1 dt 2 pt 6 title "settled bed: {/Symbol l} spheres", \
    csv using 2:(glued("bed", 2, 1)) every ::1 with linespoints lw 2 lc 1 dt 3 pt 4 title "settled bed: 2{/Symbol l}-1 spheres", \
    csv using 2:(plugin("gas", 2000)) every ::1 with linespoints lw 2 lc 2 pt 7 title "gas of 2,000: plug-in", \
    csv using 2:(plugin("gas", 20000)) every ::1 with linespoints lw 2 lc 3 pt 7 title "gas of 20,000: plug-in", \
    csv using 2:(plugin("gas", 200000)) every ::1 with linespoints lw 2 lc 4 pt 7 title "gas of 200,000: plug-in", \
    csv using 2:(glued("gas", 1, 0)) every ::1 with linespoints lw 2 lc 2 dt 2 pt 6 title "gas of 2,000: {/Symbol l} spheres", \
    csv using 2:(glued("gas", 2, 1)) every ::1 with linespoints lw 2 lc 2 dt 3 pt 4 title "gas of 2,000: 2{/Symbol l}-1 spheres"
}
