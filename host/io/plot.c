/* Runs gnuplot: the script is its standard input, a file without a name; the picture its standard
 * output, a pipe that is read here to its end. So no name needs quoting, nothing blocks, nothing is
 * left behind, and it is we who write the picture: gnuplot does not notice a disk that is full. */
#include "io/plot.h"

#include "base/text.h"
#include "io/text_lines.h"
#include "io/output_file.h"
#include "io/plot_script.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX wants it declared by whoever uses it */

/* last: the bytes that a whole picture ends in, but for empty lines. */
typedef struct terminal {
    const char *ending, *name, *last;
} terminal;
static const terminal terminals[] = {{".png", "pngcairo", "IEND\xae\x42\x60\x82"},
                                     {".svg", "svg", "</svg>"},
                                     {".pdf", "pdfcairo", "%%EOF"}};
enum { NUM_TERMINALS = sizeof terminals / sizeof terminals[0] };

static const terminal *find_terminal(const char *path) {
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < NUM_TERMINALS; i++) {
        if (strcasecmp(dot, terminals[i].ending) == 0) {
            return &terminals[i];
        }
    }
    return NULL;
}

bool ps_plot_is_supported(const char *path) {
    return find_terminal(path) != NULL;
}

/* 0, or the errno of what failed. Descriptors: of the child's standard streams. */
static int spawn_gnuplot(const int descriptors[3], pid_t *child) {
    /* --default-settings: the user's own gnuplot start-up file must not change the picture. */
    char program[] = "gnuplot";
    char option[] = "--default-settings";
    char *const arguments[] = {program, option, NULL};
    posix_spawn_file_actions_t actions;
    int reason = posix_spawn_file_actions_init(&actions);
    if (reason != 0) {
        return reason;
    }
    for (int i = 0; i < 3 && reason == 0; i++) {
        reason = posix_spawn_file_actions_adddup2(&actions, descriptors[i], i);
    }
    if (reason == 0) {
        reason = posix_spawnp(child, program, &actions, NULL, arguments, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

/* gnuplot gets the writing end as its standard output and must not hold any other. */
static bool close_on_exec(const int ends[2]) {
    return fcntl(ends[0], F_SETFD, FD_CLOEXEC) == 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) == 0;
}

/* Starts gnuplot; *source is where its picture can be read. 0, or the errno of what failed. */
static int start_gnuplot(FILE *script, FILE *complaints, int *source, pid_t *child) {
    int ends[2] = {-1, -1};
    if (pipe(ends) != 0) {
        return errno;
    }
    const int descriptors[] = {fileno(script), ends[1], fileno(complaints)};
    const int reason = close_on_exec(ends) ? spawn_gnuplot(descriptors, child) : errno;
    close(ends[1]); /* the end of the picture comes when gnuplot closes the only other one */
    if (reason != 0) {
        close(ends[0]);
        return reason;
    }
    *source = ends[0];
    return 0;
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

/* Reads to the end, even without memory to keep it: gnuplot must not wait for us. 0, or the errno of a
 * read that failed. */
static int read_picture(int source, ps_text *picture) {
    char block[1 << 14];
    ssize_t got = 0;
    do {
        got = read(source, block, sizeof block);
        if (got > 0) {
            ps_text_append_bytes(picture, block, (size_t)got);
        }
    } while (got > 0 || (got < 0 && errno == EINTR)); /* the keyboard interrupts gnuplot, too */
    return got < 0 ? errno : 0;
}

static bool is_complete(const ps_text *picture, const char *last) {
    const size_t last_length = strlen(last);
    size_t length = picture->length;
    while (length > 0 && picture->data[length - 1] == '\n') {
        length--;
    }
    return length >= last_length &&
           memcmp(picture->data + length - last_length, last, last_length) == 0;
}

static bool ended_well(pid_t child) {
    int state = 0;
    pid_t waited = 0;
    do {
        waited = waitpid(child, &state, 0);
    } while (waited < 0 && errno == EINTR);
    /* Where the program ignores SIGCHLD the state is lost, and the picture alone can tell. */
    return waited == child ? WIFEXITED(state) && WEXITSTATUS(state) == 0 : true;
}

/* Takes the picture and the child; closes source. */
static pspec_status collect(int source, pid_t child, FILE *complaints, const char *last,
                            ps_text *picture, ps_error *error) {
    const int reason = read_picture(source, picture);
    close(source); /* before waiting: after a read that failed, gnuplot's writes must fail, too */
    const bool is_good = ended_well(child);
    if (picture->failed) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a picture");
    }
    if (reason != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot read the picture from gnuplot: %s",
                       strerror(reason));
    }
    if (is_good && is_complete(picture, last)) {
        return PSPEC_OK;
    }
    char shown[PS_TOKEN_BYTES];
    read_complaint(complaints, shown);
    return ps_fail(error, PSPEC_ERROR_IO, "gnuplot could not draw the picture: %s",
                   shown[0] != '\0' ? shown
                   : is_good        ? "the picture is not complete"
                                    : "it says nothing more");
}

static pspec_status run_gnuplot(FILE *script, const char *last, ps_text *picture, ps_error *error) {
    FILE *const complaints = tmpfile();
    if (complaints == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot create a temporary file: %s",
                       strerror(errno));
    }
    pspec_status status = PSPEC_OK;
    pid_t child = 0;
    int source = -1;
    const int reason = start_gnuplot(script, complaints, &source, &child);
    if (reason == 0) {
        status = collect(source, child, complaints, last, picture, error);
    } else if (reason == ENOENT) {
        status = ps_fail(error, PSPEC_ERROR_IO,
                         "plots need the program gnuplot, which is not installed (Debian package "
                         "gnuplot-nox) or not in PATH");
    } else {
        status = ps_fail(error, PSPEC_ERROR_IO, "cannot run gnuplot: %s", strerror(reason));
    }
    fclose(complaints);
    return status;
}

/* A picture of one kind; the others are NULL. */
typedef struct drawing {
    const ps_plot *spectra;
    const ps_line_plot *lines;
    const ps_panel_plot *panels;
} drawing;

/* Writes the script to a file without a name, and goes back to its start. */
static pspec_status make_script(FILE *script, const drawing *what, const char *terminal_name,
                                ps_error *error) {
    if (script == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot create a temporary file: %s",
                       strerror(errno));
    }
    if (what->spectra != NULL) {
        PS_TRY(ps_plot_write_script(what->spectra, terminal_name, script, error));
    } else if (what->lines != NULL) {
        ps_line_plot_write_script(what->lines, terminal_name, script);
    } else {
        ps_panel_plot_write_script(what->panels, terminal_name, script);
    }
    errno = 0;
    if (fflush(script) != 0 || ferror(script) || fseeko(script, 0, SEEK_SET) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    return PSPEC_OK;
}

/* num: of places in all curves together. */
static pspec_status check_plot(const char *name, size_t num, ps_error *error) {
    return num > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is nothing to plot", name);
}

static pspec_status draw(ps_text *picture, const terminal *kind, const drawing *what,
                         ps_error *error) {
    FILE *const script = tmpfile();
    pspec_status status = make_script(script, what, kind->name, error);
    if (status == PSPEC_OK) {
        status = run_gnuplot(script, kind->last, picture, error);
    }
    if (script != NULL) {
        fclose(script);
    }
    return status;
}

/* The file is opened first: what cannot be written is not drawn. */
static pspec_status draw_file(const char *path, const drawing *what, ps_error *error) {
    ps_output_file *file = NULL;
    ps_text picture = {0};
    pspec_status status = PSPEC_OK;
    const terminal *const kind = find_terminal(path);
    if (kind == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: pictures end in .png, .svg or .pdf", path);
    }
    PS_TRY(ps_output_open(&file, path, error));
    PS_TRY_OUT(status, draw(&picture, kind, what, error));
    ps_output_write(file, picture.data, 1, picture.length);
    PS_TRY_OUT(status, ps_output_commit(&file, error));
out:
    ps_output_discard(&file);
    ps_text_free(&picture);
    return status;
}

static size_t count_bins(const ps_plot *plot) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_curves; i++) {
        num += plot->curves[i].num_bins;
    }
    return num;
}

static size_t count_places(const ps_line_plot *plot) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_lines; i++) {
        num += plot->lines[i].num;
    }
    return num;
}

pspec_status ps_plot_write(const char *path, const ps_plot *plot, ps_error *error) {
    PS_TRY(check_plot(path, count_bins(plot), error));
    return draw_file(path, &(drawing){.spectra = plot}, error);
}

pspec_status ps_line_plot_write(const char *path, const ps_line_plot *plot, ps_error *error) {
    PS_TRY(check_plot(path, count_places(plot), error));
    return draw_file(path, &(drawing){.lines = plot}, error);
}

pspec_status ps_plot_draw_svg(ps_text *svg, const ps_plot *plot, ps_error *error) {
    PS_TRY(check_plot(plot->title, count_bins(plot), error));
    return draw(svg, find_terminal(".svg"), &(drawing){.spectra = plot}, error);
}

pspec_status ps_line_plot_draw_svg(ps_text *svg, const ps_line_plot *plot, ps_error *error) {
    PS_TRY(check_plot(plot->title, count_places(plot), error));
    return draw(svg, find_terminal(".svg"), &(drawing){.lines = plot}, error);
}

pspec_status ps_panel_plot_write(const char *path, const ps_panel_plot *plot, ps_error *error) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_panels; i++) {
        for (size_t j = 0; j < plot->panels[i].num_series; j++) {
            num += plot->panels[i].series[j].num;
        }
    }
    PS_TRY(check_plot(path, num, error));
    return draw_file(path, &(drawing){.panels = plot}, error);
}
