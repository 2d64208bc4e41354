/* The progress line. It appears on terminals only, and only for work that takes a while. */
#include "cli/command.h"

#include "base/clock.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* Seconds before the first line, and between two: short work shows nothing, long work does not
 * flicker. */
static const double FIRST_DELAY = 0.5, DELAY = 0.1;

enum {
    LINE_BYTES = 256,
    PART_BYTES = 64
}; /* two numbers of 20 digits; what occurs fits 80 columns */

struct ps_progress {
    const char *what;
    double start, last;    /* last: when the line was last written, or when it may first be */
    int width;             /* of the line that stands there now */
    char part[PART_BYTES]; /* what the line begins with */
};

ps_progress *ps_progress_begin(const ps_request *arguments, const char *what) {
    if (arguments->quiet || !isatty(STDERR_FILENO)) {
        return NULL;
    }
    ps_progress *const progress = malloc(sizeof *progress);
    if (progress != NULL) { /* without memory for it there is no progress line */
        const double start = ps_clock_seconds();
        *progress = (ps_progress){what, start, start + FIRST_DELAY - DELAY, 0, ""};
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

void ps_progress_update(ps_progress *progress, uint64_t done, uint64_t total) {
    const double time = progress != NULL ? ps_clock_seconds() : 0;
    if (progress == NULL || time < progress->last + DELAY) {
        return;
    }
    const double rate = (double)done / (time - progress->start);
    char line[LINE_BYTES];
    if (total == 0 || done == 0 || done > total) {
        snprintf(line, sizeof line, "%s%" PRIu64 " %s, %.3g/s", progress->part, done,
                 progress->what, rate);
    } else {
        char left[32];
        format_duration(left, sizeof left, (double)(total - done) / rate);
        snprintf(line, sizeof line, "%s%" PRIu64 " of %" PRIu64 " %s, %.3g/s, %s left",
                 progress->part, done, total, progress->what, rate, left);
    }
    replace_line(progress, line);
    progress->last = time;
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

int ps_progress_tell(uint64_t done, uint64_t total, void *progress) {
    ps_progress_update(progress, done, total);
    return ps_interrupted;
}
