# shellcheck shell=bash
# shellcheck disable=SC2034 # for those who source it
# What comparisons of two runs leave out: times, and what no result depends on.
same=(-I '^# engine: ' # tells the realizations at a time, on which no result depends
    # the time that questions of a scene took, in its table, record and page
    -I '^# seconds: ' -I '^[a-z0-9-]*,[a-z]*,[0-9]*,[0-9]*,[0-9.e-]*$' -I '"seconds": "' -I '^    "folder": "' -I '^<p class="facts">pointspec '
    -I '</td><td class="text">\(cache\|computed\)</td></tr>$'
    # which figures of the device there are, and why not
    -I 'built-in: '
    # what a record says it was computed with: less where the program or the figures could not be read
    -I '^    "identity": "'
    # what the doctor finds free at the moment, and of the machine
    -I '^[a-zA-Z]* *\(memory\|cache\|kernels\|threads\) '
    # estimates of a plan: points of a file that cannot be looked into are guessed by its length, or left out
    -I '^# phase: ' -I '^[a-z_]*:[a-z]*,chosen,'
    # digests of files with such lines
    -I '^      "\(-\|[0-9a-f]\{32\}\) [A-Za-z0-9_.-]*",\{0,1\}$')
