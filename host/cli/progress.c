/* The progress line. It appears on terminals only, and only for work that takes a while. */
#include "cli/command.h"

#include "base/clock.h"
#include "base/text.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Seconds before the first line, and between two: short work shows nothing, long work does not
 * flicker. */
static const double FIRST_DELAY = 0.5, DELAY = 0.1;

enum { PART_BYTES = 64, PHASE_BYTES = 128, DURATION_BYTES = 32 };

struct ps_progress {
    const char *what;
    double start, last;      /* last: when the line was last written, or when it may first be */
    int width;               /* of the line that stands there now */
    char phase[PHASE_BYTES]; /* the last one that was not `what` */
    double phase_start;
    char part[PART_BYTES]; /* what the line begins with */
};

ps_progress *ps_progress_begin(const ps_request *arguments, const char *what) {
    if (arguments->quiet || !isatty(STDERR_FILENO)) {
        return NULL;
    }
    ps_progress *const progress = malloc(sizeof *progress);
    if (progress != NULL) { /* without memory for it there is no progress line */
        const double start = ps_clock_seconds();
        *progress =
            (ps_progress){.what = what, .start = start, .last = start + FIRST_DELAY - DELAY};
    }
    return progress;
}

/* Writes line over the one before. Blanks erase what is left of it: terminals that know no escape
 * sequences can do that. */
static void replace_line(ps_progress *progress, const char *line) {
    const int width = (int)fprintf(stderr, "\r%s", line) - 1;
    if (width < progress->width) {
        fprintf(stderr, "%*s", progress->width - width, "");
    }
    fflush(stderr);
    progress->width = width;
}

static void format_duration(char *text, size_t bytes, double seconds) {
    const double minute = 60;
    const double hour = 60 * minute;
    if (seconds < minute) {
        snprintf(text, bytes, "%.0f s", seconds);
    } else if (seconds < hour) {
        snprintf(text, bytes, "%.0f min", seconds / minute);
    } else {
        snprintf(text, bytes, "%.1f h", seconds / hour);
    }
}

/* While the first thing is not done there is no rate: the line has the time that passed. */
static void append_first(ps_text *line, const char *things, uint64_t total, double seconds) {
    char passed[DURATION_BYTES];
    format_duration(passed, sizeof passed, seconds);
    if (total > 0) {
        ps_text_append(line, "the first of %" PRIu64 " %s, %s", total, things, passed);
    } else {
        ps_text_append(line, "the first %s, %s", things, passed);
    }
}

static void append_rate(ps_text *line, uint64_t done, uint64_t total, double rate) {
    char left[DURATION_BYTES];
    ps_text_append(line, ", %.3g/s", rate);
    if (total > 0 && done <= total) {
        format_duration(left, sizeof left, (double)(total - done) / rate);
        ps_text_append(line, ", %s left", left);
    }
}

static void append_state(ps_text *line, const ps_watch_report *report, double seconds) {
    const char *const things = ps_watch_things(report->phase);
    ps_text_append(line, "%.*s", (int)(things - report->phase), report->phase);
    if (report->done == 0) {
        append_first(line, things, report->total, seconds);
    } else {
        ps_text_append(line, "%" PRIu64, report->done);
        if (report->total > 0) {
            ps_text_append(line, " of %" PRIu64, report->total);
        }
        ps_text_append(line, " %s", things);
    }
    if (report->detail != NULL) {
        ps_text_append(line, ", %s", report->detail);
    } else if (report->done > 0) {
        append_rate(line, report->done, report->total, (double)report->done / seconds);
    }
}

/* The time of the main phase goes on while others come in between; each of them begins anew. */
static double phase_start(ps_progress *progress, const char *phase, double time) {
    if (strcmp(phase, progress->what) == 0) {
        return progress->start;
    }
    if (strcmp(phase, progress->phase) != 0) {
        snprintf(progress->phase, sizeof progress->phase, "%s", phase);
        progress->phase_start = time;
    }
    return progress->phase_start;
}

static void show(ps_progress *progress, const ps_watch_report *report) {
    const double least = 1e-3; /* seconds: a phase may begin at this moment */
    const double time = ps_clock_seconds();
    const double passed = time - phase_start(progress, report->phase, time);
    if (time < progress->last + DELAY) {
        return;
    }
    ps_text line = {0};
    ps_text_append(&line, "%s", progress->part);
    append_state(&line, report, passed > least ? passed : least);
    if (!line.failed) {
        replace_line(progress, line.data);
    }
    ps_text_free(&line);
    progress->last = time;
}

void ps_progress_update(ps_progress *progress, uint64_t done, uint64_t total) {
    if (progress != NULL) {
        show(progress, &(ps_watch_report){progress->what, done, total, NULL});
    }
}

void ps_progress_part(ps_progress *progress, const char *format, ...) {
    va_list arguments;
    if (progress == NULL) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(progress->part, sizeof progress->part, format, arguments);
    va_end(arguments);
    progress->start = ps_clock_seconds();
}

void ps_progress_hide(ps_progress *progress) {
    if (progress != NULL && progress->width > 0) {
        replace_line(progress, "");
        fputc('\r', stderr);
        fflush(stderr);
    }
}

void ps_progress_end(ps_progress *progress) {
    ps_progress_hide(progress);
    free(progress);
}

int ps_progress_tell(const ps_watch_report *report, void *progress) {
    if (progress != NULL) {
        show(progress, report);
    }
    return ps_interrupted;
}
