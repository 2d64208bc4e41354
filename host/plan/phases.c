#include "plan/phases.h"

#include "base/workers.h"

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

/* The machine of all seconds of the host's work: one core of 2 of a Zen 5 EPYC (AVX-512) at a
 * nominal 2.6 GHz, Debian 12, 2026-11; the machine is shared. `pointspec bench --calibrate`
 * measures how many times longer samplers take on the machine at hand, and the rest of the host's
 * work is taken to be as much slower as they are in the mean. */
void ps_phases_add(ps_phases *phases, const char *name, double seconds) {
    ps_phases_add_seconds(phases, name, seconds * ps_figures_host_scale(phases->host, NULL));
}

void ps_phases_share(ps_phases *phases, const char *name, double things, double each, double sets) {
    const double threads = ps_workers_most();
    const bool is_shared = threads > 1 && things >= PS_WORKERS_LEAST;
    ps_phases_add(phases, name, sets * things * each / (is_shared ? threads : 1));
    ps_phases_add_seconds(phases, name, is_shared ? sets * PS_WORKERS_SECONDS : 0);
}

void ps_phases_touch(ps_phases *phases, double bytes) {
    static const char name[] = "memory";
    const double byte_seconds = 0.5e-9;
    ps_phases_add(phases, name, bytes * byte_seconds);
    ps_phases_say(phases, name, "%.3g bytes, which the system clears", bytes);
}

void ps_phases_tabulate(ps_phases *phases, double rows) {
    static const char name[] = "results";
    const double row_seconds = 3e-6;
    ps_phases_add(phases, name, rows * row_seconds);
    ps_phases_say(phases, name, "a table");
}

void ps_phases_draw(ps_phases *phases, const char *name, size_t num) {
    const double picture_seconds = 0.15;
    ps_phases_add(phases, name, (double)num * picture_seconds);
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
