/* Runs gnuplot: the script is its standard input, the picture its standard output, both files, so
 * that no name needs quoting, nothing blocks and nothing is left behind. */
#include "io/plot.h"

#include "io/input_file.h"
#include "io/output_file.h"
#include "io/plot_script.h"

#include <errno.h>
#include <spawn.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX wants it declared by whoever uses it */

static const struct {
    const char *ending, *terminal;
} terminals[] = {{".png", "pngcairo"}, {".svg", "svg"}, {".pdf", "pdfcairo"}};
enum { NUM_TERMINALS = sizeof terminals / sizeof terminals[0] };

static const char *find_terminal(const char *path) {
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < NUM_TERMINALS; i++) {
        if (strcasecmp(dot, terminals[i].ending) == 0) {
            return terminals[i].terminal;
        }
    }
    return NULL;
}

bool ps_plot_is_supported(const char *path) {
    return find_terminal(path) != NULL;
}

/* 0, or the errno of what failed. */
static int spawn_gnuplot(FILE *script, FILE *picture, FILE *complaints, pid_t *child) {
    /* --default-settings: the user's own gnuplot start-up file must not change the picture. */
    char program[] = "gnuplot";
    char option[] = "--default-settings";
    char *const arguments[] = {program, option, NULL};
    posix_spawn_file_actions_t actions;
    int reason = posix_spawn_file_actions_init(&actions);
    if (reason != 0) {
        return reason;
    }
    FILE *const streams[] = {script, picture, complaints};
    for (int i = 0; i < 3 && reason == 0; i++) {
        reason = posix_spawn_file_actions_adddup2(&actions, fileno(streams[i]), i);
    }
    if (reason == 0) {
        reason = posix_spawnp(child, program, &actions, NULL, arguments, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

/* The line of gnuplot's standard error that tells most: the last but for empty ones. */
static void read_complaint(FILE *complaints, char shown[PS_TOKEN_BYTES]) {
    char line[256];
    shown[0] = '\0';
    rewind(complaints);
    while (fgets(line, sizeof line, complaints) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        const char *const text = line + strspn(line, " \t^");
        if (*text != '\0') {
            snprintf(shown, PS_TOKEN_BYTES, "%.*s", PS_TOKEN_BYTES - 1, text);
        }
    }
}

static pspec_status wait_for(pid_t child, FILE *picture, FILE *complaints, ps_error *error) {
    int state = 0;
    pid_t waited = 0;
    do {
        waited = waitpid(child, &state, 0);
    } while (waited < 0 && errno == EINTR); /* an interrupt from the keyboard reaches gnuplot too */
    struct stat facts;
    const bool has_picture =
        fstat(fileno(picture), &facts) == 0 && (facts.st_size > 0 || !S_ISREG(facts.st_mode));
    /* Where the program ignores SIGCHLD the state is lost, and the picture alone can tell. */
    const bool is_good = waited == child ? WIFEXITED(state) && WEXITSTATUS(state) == 0 : true;
    if (is_good && has_picture) {
        return PSPEC_OK;
    }
    char shown[PS_TOKEN_BYTES];
    read_complaint(complaints, shown);
    return ps_fail(error, PSPEC_ERROR_IO, "gnuplot could not draw the picture: %s",
                   shown[0] != '\0' ? shown : "it says nothing more");
}

static pspec_status run_gnuplot(FILE *script, FILE *picture, ps_error *error) {
    FILE *const complaints = tmpfile();
    if (complaints == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot create a temporary file: %s",
                       strerror(errno));
    }
    pid_t child = 0;
    const int reason = spawn_gnuplot(script, picture, complaints, &child);
    const pspec_status status =
        reason == 0 ? wait_for(child, picture, complaints, error)
        : reason == ENOENT
            ? ps_fail(error, PSPEC_ERROR_IO,
                      "plots need the program gnuplot, which is not installed (Debian package "
                      "gnuplot-nox) or not in PATH")
            : ps_fail(error, PSPEC_ERROR_IO, "cannot run gnuplot: %s", strerror(reason));
    fclose(complaints);
    return status;
}

/* Writes the script to a file without a name, and goes back to its start. */
static pspec_status make_script(FILE *script, const ps_plot *plot, const char *terminal,
                                ps_error *error) {
    if (script == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot create a temporary file: %s",
                       strerror(errno));
    }
    PS_TRY(ps_plot_write_script(plot, terminal, script, error));
    errno = 0;
    if (fflush(script) != 0 || ferror(script) || fseeko(script, 0, SEEK_SET) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    return PSPEC_OK;
}

static pspec_status check_plot(const char *path, const ps_plot *plot, ps_error *error) {
    if (!ps_plot_is_supported(path)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: pictures end in .png, .svg or .pdf", path);
    }
    size_t num_bins = 0;
    for (size_t i = 0; i < plot->num_curves; i++) {
        num_bins += plot->curves[i].num_bins;
    }
    if (num_bins == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is nothing to plot", path);
    }
    return PSPEC_OK;
}

pspec_status ps_plot_write(const char *path, const ps_plot *plot, ps_error *error) {
    ps_output_file *picture = NULL;
    FILE *script = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_plot(path, plot, error));
    PS_TRY(ps_output_open(&picture, path, error));
    script = tmpfile();
    PS_TRY_OUT(status, make_script(script, plot, find_terminal(path), error));
    PS_TRY_OUT(status, run_gnuplot(script, ps_output_stream(picture), error));
    PS_TRY_OUT(status, ps_output_commit(&picture, error));
out:
    ps_output_discard(&picture);
    if (script != NULL) {
        fclose(script);
    }
    return status;
}
