# FOLDER/NAME.csv of every name in curves -> one picture, FOLDER/comparison.png. The first
# num_samplers of them have standard errors, the published sets after them are one realization each.
set terminal pngcairo size 1200,700 background "#ffffff" font "DejaVu Sans,11"
set output folder."/comparison.png"
set datafile separator ","
set title "Radially averaged power; bars: one standard error"
set xlabel "normalized frequency |k| / sqrt(N)"
set ylabel "power (white noise: 1)"
set xrange [0:3]
set yrange [0:*]
set grid linetype 1 linecolor "#d8d8d8" linewidth 0.8
set key outside right Left reverse noenhanced samplen 2
# As in host/plots/plot_look.c: Okabe and Ito's colours, which the colour-blind can tell apart, without
# their yellow, which is hard to see on white; beyond them dashes change.
array colours = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
colour(i) = colours[(i - 1) % |colours| + 1]
dash(i) = (i - 1) / |colours| % 4 + 1
file(i) = folder."/".word(curves, i).".csv"
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead back linecolor "#707070" linewidth 1
plot for [i=1:num_samplers] file(i) \
        using "normalized_frequency":"power":"standard_error" \
        with yerrorbars linecolor rgb colour(i) pointtype 7 pointsize 0.3 notitle, \
    for [i=1:words(curves)] file(i) using "normalized_frequency":"power" \
        with lines linecolor rgb colour(i) dashtype dash(i) linewidth 1.6 \
        title word(curves, i)
