# FOLDER/NAME.csv of every name in curves -> one picture, FOLDER/comparison.png. The first
# num_samplers of them have standard errors, the published sets after them are one realization each.
set terminal pngcairo size 1200,700 font "DejaVu Sans,11"
set output folder."/comparison.png"
set datafile separator ","
set title "Radially averaged power, N = 1024; bars: one standard error"
set xlabel "normalized frequency |k| / sqrt(N)"
set ylabel "power (white noise: 1)"
set xrange [0:3]
set yrange [0:*]
set grid linecolor "#dddddd"
set key outside right noenhanced
file(i) = folder."/".word(curves, i).".csv"
plot for [i=1:num_samplers] file(i) \
        using "normalized_frequency":"power":"standard_error" \
        with yerrorbars linecolor i pointtype 7 pointsize 0.3 notitle, \
    for [i=1:words(curves)] file(i) using "normalized_frequency":"power" \
        with lines linecolor i linewidth 1.5 title word(curves, i)
