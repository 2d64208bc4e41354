/* Tables on a terminal. */
#include "base/text.h"
#include "cli/command.h"
#include "request/options.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* What people see of a header, the first of these that there are: what the answer is in a sentence,
 * what makes it doubtful, what it is of, and how right it is. */
static const char *const seen_first[] = {
    "verdict", "different", "tail_verdict", "ranking", "crossing", "rates", "convergence", "fit",
    "features", "worst_case_error",
    /* doubts */
    "empty", "different_points", "dropped_below_horizon", "duplicates", "vectors", "planned_twice",
    "relative_standard_error", "standard_error",
    /* of what */
    "seconds", "input", "sampler", "input_columns", "integrand", "brdf", "points", "realizations",
    /* how right */
    "self_check", "predicted_error", "device", NULL};

enum { MOST_LINES = 4, USUAL_WIDTH = 80, LEAST_WIDTH = 40, MOST_WIDTH = 10000 };

/* Columns of the terminal: COLUMNS, what the terminal says, or those that most have. */
static size_t find_width(void) {
    const char *const said = getenv("COLUMNS");
    char *end = NULL;
    const long columns = said != NULL ? strtol(said, &end, 10) : 0;
    struct winsize size = {0};
    size_t width = USUAL_WIDTH;
    if (columns > 0 && columns <= MOST_WIDTH && *end == '\0') {
        width = (size_t)columns;
    } else if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        width = size.ws_col;
    }
    return width > LEAST_WIDTH ? width : LEAST_WIDTH;
}

void ps_terminal_settle(const ps_command *command, ps_request *arguments) {
    static const char text[] = "text";
    const bool is_terminal =
        arguments->output != NULL && strcmp(arguments->output, "-") == 0 && isatty(STDOUT_FILENO);
    const bool is_brief = ps_command_takes(command, PS_OPTION_VERBOSE) && !arguments->verbose;
    const char *const words = ps_command_takes(command, PS_OPTION_FORMAT)
                                  ? ps_command_words(command, PS_OPTION_FORMAT)
                                  : "";
    if (!is_terminal) {
        return;
    }
    if (arguments->format == NULL && ps_text_find_word(text, strlen(text), words) >= 0) {
        arguments->format = text;
    }
    arguments->view = (ps_text_view){.width = find_width(),
                                     .most_lines = is_brief ? MOST_LINES : 0,
                                     .keys = seen_first,
                                     .rest = "--verbose"};
}
