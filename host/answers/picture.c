#include "answers/picture.h"

#include "base/text.h"
#include "plots/plot.h"

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
