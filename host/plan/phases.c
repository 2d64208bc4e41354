#include "plan/phases.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static ps_phase_cost *find(ps_phases *phases, const char *name) {
    for (size_t i = 0; i < phases->num; i++) {
        if (strcmp(phases->list[i].name, name) == 0) {
            return &phases->list[i];
        }
    }
    return NULL;
}

void ps_phases_add_seconds(ps_phases *phases, const char *name, double seconds) {
    ps_phase_cost *phase = find(phases, name);
    if (phase == NULL && seconds > 0 && phases->num < PS_MAX_PHASES) {
        phase = &phases->list[phases->num++];
        *phase = (ps_phase_cost){.name = name};
    }
    if (phase != NULL && seconds > 0) {
        phase->seconds += seconds;
    }
}

void ps_phases_add(ps_phases *phases, const char *name, ps_host_kind kind, double seconds) {
    ps_phases_add_seconds(phases, name, ps_host_seconds(phases->host, kind, seconds));
}

void ps_phases_add_sets(ps_phases *phases, const char *name, ps_host_kind kind, double things,
                        double each, double sets) {
    ps_phases_add_seconds(phases, name,
                          ps_host_seconds_of_sets(phases->host, kind, things, each, sets));
}

void ps_phases_touch(ps_phases *phases, double bytes) {
    static const char name[] = "memory";
    const double byte_seconds = 0.5e-9;
    ps_phases_add(phases, name, PS_HOST_MEMORY, bytes * byte_seconds);
    ps_phases_say(phases, name, "%.3g bytes, which the system clears", bytes);
}

void ps_phases_tabulate(ps_phases *phases, double rows) {
    static const char name[] = "results";
    const double row_seconds = 3e-6;
    ps_phases_add(phases, name, PS_HOST_TEXT, rows * row_seconds);
    ps_phases_say(phases, name, "a table");
}

void ps_phases_draw(ps_phases *phases, const char *name, size_t num) {
    const double picture_seconds = 0.15;
    ps_phases_add(phases, name, PS_HOST_START, (double)num * picture_seconds);
}

void ps_phases_say(ps_phases *phases, const char *name, const char *format, ...) {
    ps_phase_cost *const phase = find(phases, name);
    va_list arguments;
    va_start(arguments, format);
    if (phase != NULL) {
        vsnprintf(phase->what, sizeof phase->what, format, arguments);
    }
    va_end(arguments);
}

void ps_phases_limit(ps_phases *phases, const char *name) {
    ps_phase_cost *const phase = find(phases, name);
    if (phase != NULL) {
        phase->is_at_most = true;
    }
}

double ps_phases_seconds(const ps_phases *phases) {
    double sum = 0;
    for (size_t i = 0; i < phases->num; i++) {
        sum += phases->list[i].seconds;
    }
    return sum;
}

bool ps_phases_are_at_most(const ps_phases *phases) {
    for (size_t i = 0; i < phases->num; i++) {
        if (phases->list[i].is_at_most) {
            return true;
        }
    }
    return false;
}
