# printed.awk PAGE OUTPUT: do both have the same words, wherever lines end? Numbers may differ by one of the last digit that
# the page shows, or by 1e-4 of themselves: other devices have other last digits. Two lines of headers, which say how exact
# a device was, are left out.
function is_number(text) { return text ~ /^[-+]?[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?$/ }
# One of the last digit of 1.25e-3 is 1e-5.
function last_digit(text,   exponent, point) {
    if (match(text, /[eE][-+]?[0-9]+$/)) {
        exponent = substr(text, RSTART + 1) + 0
        text = substr(text, 1, RSTART - 1)
    }
    point = index(text, ".")
    return 10 ^ (exponent - (point ? length(text) - point : 0))
}
function size(number) { return number < 0 ? -number : number }
function is_same(page, here) {
    if (page == here) return 1
    if (!is_number(page) || !is_number(here)) return 0
    return size(page - here) <= 1.01 * last_digit(page) || size(page - here) <= 1e-4 * size(page)
}
/^# (predicted_error|self_check):/ { next }
{
    line = $0
    gsub(/[,;:=|()]/, " & ", line)
    num = split(line, words, " ")
    for (i = 1; i <= num; i++)
        if (NR == FNR) page[++num_page] = words[i]
        else here[++num_here] = words[i]
}
END {
    for (i = 1; i <= num_page || i <= num_here; i++)
        if (!is_same(page[i], here[i])) {
            for (j = i > 4 ? i - 4 : 1; j <= i + 4; j++) { on_page = on_page " " page[j]; in_program = in_program " " here[j] }
            print "word " i " differs, on the page:" on_page "\nwhere the program prints:" in_program
            exit 1
        }
}
