# One result table of "pointspec power" -> one tab-separated line: name, power near frequency 0.1 and
# 0.5, frequency up to which the power stays below 0.1, highest power and its frequency, what to look
# at with one number to go with it. Variables: name, fact, look.
BEGIN { FS = ","; below = 1; peak = -1 }

/^# noise_level_db:/ { sub(/^[^:]*: */, ""); noise = $0 + 0; next }
/^#/ { next }
!columns { for (columns = 1; columns <= NF; ++columns) at[$columns] = columns; next }
{
    f = $at["normalized_frequency"] + 0
    p = $at["power"] + 0
    note_nearest(0.1); note_nearest(0.2); note_nearest(0.5)
    if (p >= 0.1) below = 0
    if (below) dark = f
    if (p > peak) { peak = p; peak_at = f }
    if ($at["standard_error"] + 0 > 0) {
        ++rings
        squares += ((p - 1) / $at["standard_error"]) ^ 2
    }
    if ($at["anisotropy_db"] != "" && (!seen++ || $at["anisotropy_db"] - noise > excess)) {
        excess = $at["anisotropy_db"] - noise
        excess_at = f
    }
}

function note_nearest(target,   distance) {
    distance = f > target ? f - target : target - f
    if (!(target in power) || distance < off[target]) {
        off[target] = distance; power[target] = p; frequency[target] = f
    }
}

function number_for_look() {
    if (fact == "flat" && rings)
        return sprintf("rings differ from 1 by %.1f standard errors rms", sqrt(squares / rings))
    if (fact == "slope" && power[0.1] > 0 && power[0.2] > 0)
        return sprintf("power grows as frequency^%.1f there",
            log(power[0.2] / power[0.1]) / log(frequency[0.2] / frequency[0.1]))
    if (fact == "anisotropy" && seen)
        return sprintf("anisotropy up to %.0f dB above noise, at %.2f", excess, excess_at)
    if (fact == "ring")
        return sprintf("mean power %.2g at 0.1, peak %.2g", power[0.1], peak)
    return ""
}

END {
    if (!columns) { print "demo: no table for " name > "/dev/stderr"; exit 1 }
    more = number_for_look()
    printf "%s\t%.4f\t%.4f\t%.2f\t%.2f\t%.2f\t%s%s%s\n", name, power[0.1], power[0.5], dark, peak,
        peak_at, look, more ? "; " : "", more
}
