# The lines of demo_facts.awk as a table for the terminal.
BEGIN {
    printf "%-24s %8s %8s %8s %6s %6s  %s\n", "", "power", "power", "below .1", "", "", ""
    printf "%-24s %8s %8s %8s %6s %6s  %s\n", "set", "at 0.1", "at 0.5", "up to", "peak", "at",
        "what to look at"
}
{ printf "%-24s %8s %8s %8s %6s %6s  %s\n", $1, $2, $3, ($4 > 0 ? $4 : "-"), $5, $6, $7 }
