#include "answers/picture.h"

#include "base/text.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Does the table go where nobody reads it? */
static bool is_discarded(const char *output) {
    struct stat facts;
    struct stat nothing;
    const bool is_standard = strcmp(output, "-") == 0;
    const int found = is_standard ? fstat(STDOUT_FILENO, &facts) : stat(output, &facts);
    return found == 0 && stat("/dev/null", &nothing) == 0 && S_ISCHR(facts.st_mode) &&
           facts.st_rdev == nothing.st_rdev;
}

/* Files besides the table and the picture. */
static bool has_other_files(const ps_request *request) {
    ps_request_file files[PS_NUM_OPTIONS];
    const int num_known = (request->output != NULL) + (request->plot != NULL);
    return ps_request_outputs(files, request) > (size_t)num_known;
}

bool ps_picture_is_all(const ps_request *request, bool keeps_answer) {
    return !has_other_files(request) &&
           (request->output != NULL ? is_discarded(request->output) : !keeps_answer);
}

/* gnuplot would say it at the end of the work. */
static pspec_status check_range(const char *axis, bool is_log, bool has_range, const double *range,
                                ps_error *error) {
    return !is_log || !has_range || range[0] > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--plot-range: the %s axis is logarithmic by --plot-log, and cannot begin "
                         "at %g",
                         axis, range[0]);
}

pspec_status ps_picture_check_axes(const ps_plot_axes *axes, ps_error *error) {
    PS_TRY(check_range("x", axes->is_log_x, axes->has_x, axes->x, error));
    return check_range("y", axes->is_log_y, axes->has_y, axes->y, error);
}

pspec_status ps_picture_check(const ps_request *request, bool is_all, const ps_answer_hooks *hooks,
                              ps_error *error) {
    ps_text path = {0};
    ps_error reason = {0};
    const ps_plot_axes *const axes = &request->plot_axes;
    const bool has_words =
        axes->has_log || axes->has_x || axes->has_y || request->plot_points != NULL;
    if (request->plot == NULL && has_words) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--plot-log, --plot-range and --plot-points are about --plot, which was not "
                       "given");
    }
    if (request->plot == NULL) {
        return PSPEC_OK;
    }
    if (!ps_plot_is_supported(request->plot)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--plot draws .png, .svg and .pdf, not \"%s\"", request->plot);
    }
    PS_TRY(ps_picture_check_axes(axes, error));
    pspec_status status = ps_plot_find_gnuplot(&path, &reason);
    if (status == PSPEC_ERROR_MEMORY || (status != PSPEC_OK && is_all)) {
        *error = reason;
    } else if (status != PSPEC_OK) {
        status = PSPEC_OK;
        ps_answer_warn(hooks, "\"%s\" will not be drawn: %s", request->plot, reason.message);
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_picture_settle(const ps_request *request, bool is_all, const ps_answer_hooks *hooks,
                               pspec_status drawn, ps_error *error) {
    if (drawn == PSPEC_OK || drawn == PSPEC_ERROR_CANCELLED || ps_answer_is_interrupted(hooks) ||
        is_all) {
        return drawn;
    }
    ps_answer_tell_missing(hooks, "\"%s\" was not drawn: %s", request->plot, error->message);
    *error = (ps_error){0};
    return PSPEC_OK;
}

/* ---- what a command draws -------------------------------------------------------------------- */

static void append_sources(ps_text *title, const ps_request *request) {
    if (request->num_sources > 1) {
        ps_text_append(title, "%zu %s", request->num_sources,
                       ps_request_has_files(request) ? "sets of points" : "samplers");
    } else if (request->num_sources == 1) {
        ps_text_append(title, "%s", ps_request_source_name(request, 0));
    } else if (request->num_files == 1) {
        ps_text_append(title, "%s", request->files[0]);
    } else {
        ps_text_append(title, "%zu files", request->num_files);
    }
}

/* The smallest and the largest number that entries of this name have; nan: there are none. */
static void find_range(const ps_table *table, const char *name, double range[2]) {
    range[0] = range[1] = NAN;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const char *key = NULL;
        const ps_cell value = ps_table_meta(table, i, &key);
        if (strcmp(key, name) == 0) {
            range[0] = fmin(range[0], ps_cell_number(value));
            range[1] = fmax(range[1], ps_cell_number(value));
        }
    }
}

/* Samplers choose N themselves where nside or the like says it; of sets with different N it is a
 * mean, and which they have is said. */
static void append_points(ps_text *title, const ps_table *table) {
    double means[2];
    double smallest[2];
    double largest[2];
    find_range(table, "points", means);
    find_range(table, "points_smallest", smallest);
    find_range(table, "points_largest", largest);
    const bool varies = isfinite(smallest[0]);
    ps_text_append(title, ", %sN = %.6g", varies ? "mean " : "", means[0]);
    if (means[1] > means[0]) {
        ps_text_append(title, " to %.6g", means[1]);
    }
    if (varies) {
        ps_text_append(title, " (sets of %.0f to %.0f)", smallest[0], largest[1]);
    }
}

/* Where a standard error was asked for, each has as many as that takes. */
static void append_realizations(ps_text *title, const ps_table *table) {
    double range[2];
    find_range(table, "realizations", range);
    ps_text_append(title, ", %.0f", range[0]);
    if (range[1] > range[0]) {
        ps_text_append(title, " to %.0f", range[1]);
    }
    ps_text_append(title, " realization%s", range[1] == 1 ? "" : "s");
}

static void write_title(ps_text *title, const ps_request *request, const ps_table *table) {
    const ps_cell harmonics = ps_table_find_meta(table, "harmonics");
    if (request->brdf == NULL) {
        append_sources(title, request);
    } else {
        ps_text_append(title, "%s", request->brdf);
        if (harmonics.kind == PS_CELL_TEXT) {
            ps_text_append(title, ", %s harmonics", harmonics.text);
        }
        ps_text_append(title, ", smoothness %g", request->smoothness[0]);
    }
    if (ps_table_find_meta(table, "points").kind != PS_CELL_MISSING) {
        append_points(title, table);
        append_realizations(title, table);
    }
}

static bool is_asked(const ps_picture_kind *picture, const ps_request *request) {
    return (picture->by & PS_BY_COMMAND) != 0 &&
           (picture->needs != PS_NEEDS_COUNTS || request->num_counts > 1) &&
           (picture->needs != PS_NEEDS_DEGREE || request->max_degree > 0) &&
           (picture->needs != PS_NEEDS_SCATTER || request->frequencies.num_shown > 0);
}

pspec_status ps_picture_draw(const ps_picture_kind *pictures, const ps_request *request,
                             const ps_table *table, ps_error *error) {
    ps_text title = {0};
    ps_pool memory = {0};
    ps_figure figure;
    ps_chart_part part = {.table = table, .request = request, .label = ""};
    ps_chart chart = {.what = pictures,
                      .axes = request->plot_axes,
                      .num_parts = 1,
                      .parts = &part,
                      .num_panels = 1};
    pspec_status status = PSPEC_OK;
    for (const ps_picture_kind *own = pictures; own->make != NULL; own++) {
        chart.what = is_asked(own, request) ? own : chart.what;
    }
    (chart.what->write_title != NULL ? chart.what->write_title : write_title)(&title, request,
                                                                              table);
    PS_TRY_OUT(status, ps_text_keep(&chart.title, &memory, &title, error));
    PS_TRY_OUT(status, chart.what->make(&figure, &memory, &chart, error));
    PS_TRY_OUT(status, ps_figure_write(request->plot, &figure, error));
out:
    ps_pool_free(&memory);
    return status;
}
