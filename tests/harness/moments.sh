# shellcheck shell=bash
# To be sourced by tests that interrupt the program: moments that are events, not times, and times by a yardstick.

# Waits until the process catches SIGTERM, or is gone: before that a signal ends it as any program.
wait_until_it_catches() { # PROCESS
    local term=0x4000 caught # bit 14 is SIGTERM, 15
    while caught=$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status" 2>/dev/null); do
        ((((16#${caught:-0}) & term) == 0)) || return 0
        sleep 0.02
    done
}

# Waits until the command succeeds, or the process is gone.
wait_until() { # PROCESS COMMAND...
    local pid=$1
    shift
    until "$@" >/dev/null 2>&1 || [[ ! -e /proc/$pid ]]; do sleep 0.05; done
}

# How many times as long as on a machine with nothing else to do a process takes now that only computes, at least 1:
# its seconds of the clock for each of its own.
yardstick() {
    local TIMEFORMAT='%R %U %S'
    { time awk 'BEGIN { for (i = 0; i < 1e7; i++) sum += i }'; } 2>&1 |
        awk '{ factor = $1 / ($2 + $3 + 1e-3); print (factor > 1 ? factor : 1) }'
}

now() { date +%s.%N; }
# Is that later than LIMIT seconds of a machine with nothing else to do?
took_longer() { # BEGIN END LIMIT
    awk -v begin="$1" -v end="$2" -v limit="$3" 'BEGIN { exit !(end - begin > limit) }' || return 1
    awk -v begin="$1" -v end="$2" -v limit="$3" -v factor="$(yardstick)" \
        'BEGIN { exit !(end - begin > limit * factor) }'
}
