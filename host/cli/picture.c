#include "cli/picture.h"

#include "base/text.h"
#include "cli/command.h"
#include "plots/plot.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Does the table go where nobody reads it? */
static bool is_discarded(const char *output) {
    struct stat facts;
    struct stat nothing;
    const bool is_standard = output == NULL || strcmp(output, "-") == 0;
    const int found = is_standard ? fstat(STDOUT_FILENO, &facts) : stat(output, &facts);
    return found == 0 && stat("/dev/null", &nothing) == 0 && S_ISCHR(facts.st_mode) &&
           facts.st_rdev == nothing.st_rdev;
}

static bool is_all(const ps_request *arguments) {
    return arguments->full == NULL && arguments->coefficients == NULL &&
           is_discarded(arguments->output);
}

pspec_status ps_picture_check(const ps_request *arguments, ps_error *error) {
    ps_text path = {0};
    ps_error reason = {0};
    if (arguments->plot == NULL) {
        return PSPEC_OK;
    }
    if (!ps_plot_is_supported(arguments->plot)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--plot draws .png, .svg and .pdf, not \"%s\"", arguments->plot);
    }
    pspec_status status = ps_plot_find_gnuplot(&path, &reason);
    if (status == PSPEC_ERROR_MEMORY || (status != PSPEC_OK && is_all(arguments))) {
        *error = reason;
    } else if (status != PSPEC_OK) {
        status = PSPEC_OK;
        if (!arguments->quiet) {
            fprintf(stderr, "pointspec: \"%s\" will not be drawn: %s\n", arguments->plot,
                    reason.message);
        }
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_picture_settle(const ps_request *arguments, pspec_status drawn, ps_error *error) {
    if (drawn == PSPEC_OK || drawn == PSPEC_ERROR_CANCELLED || ps_interrupted ||
        is_all(arguments)) {
        return drawn;
    }
    fprintf(stderr, "pointspec: \"%s\" was not drawn: %s\n", arguments->plot, error->message);
    *error = (ps_error){0};
    return PSPEC_OK;
}
