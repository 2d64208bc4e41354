/* The program gnuplot: where it is, and a script that it turns into a picture.
 *
 * The script is its standard input, a file without a name; the picture its standard output, a pipe
 * that is read here to its end. So no name needs quoting, nothing blocks, nothing is left behind,
 * and it is we who write the picture: gnuplot does not notice a disk that is full. */
#include "plots/plot_script.h"

#include "base/process/program.h"
#include "files/temporary_file.h"
#include "files/text_lines.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- where it is --------------------------------------------------------------------------- */

static const char program_name[] = "gnuplot";

/* Where programs are looked for without PATH, as the C library does it. */
static const char usual_folders[] = "/bin:/usr/bin";

static bool is_program(const char *path) {
    struct stat facts;
    return stat(path, &facts) == 0 && S_ISREG(facts.st_mode) && access(path, X_OK) == 0;
}

/* An empty folder of the list is the current one. */
static void join(ps_text *out, const char *folder, size_t length) {
    ps_text_free(out);
    *out = (ps_text){0};
    ps_text_append_bytes(out, length > 0 ? folder : ".", length > 0 ? length : 1);
    ps_text_append(out, "/%s", program_name);
}

pspec_status ps_plot_find_gnuplot(ps_text *path, ps_error *error) {
    const char *const folders = getenv("PATH");
    const char *rest = folders != NULL ? folders : usual_folders;
    for (bool is_last = false; !is_last;) {
        const size_t length = strcspn(rest, ":");
        join(path, rest, length);
        PS_TRY(ps_text_check(path, error));
        if (is_program(ps_text_string(path))) {
            return PSPEC_OK;
        }
        is_last = rest[length] == '\0';
        rest += length + 1;
    }
    return ps_fail(error, PSPEC_ERROR_IO,
                   "plots need the program gnuplot, which is not installed (Debian package "
                   "gnuplot-nox) or not in PATH");
}

/* ---- a picture ----------------------------------------------------------------------------- */

/* Starts gnuplot; *source is where its picture can be read. 0, or the errno of what failed. */
static int start_gnuplot(const char *path, FILE *script, FILE *complaints, int *source,
                         pid_t *child) {
    /* --default-settings: the user's own gnuplot start-up file must not change the picture. */
    char program[] = "gnuplot";
    char option[] = "--default-settings";
    char *const arguments[] = {program, option, NULL};
    int ends[2];
    int reason = ps_pipe_open(ends);
    if (reason != 0) {
        return reason;
    }
    const int descriptors[] = {fileno(script), ends[1], fileno(complaints)};
    reason = ps_child_start(child, path, arguments, descriptors, false);
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

/* Reads to the end, even without memory to keep it: gnuplot must not wait for us. 0, or the errno
 * of a read that failed. */
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

/* *out: at its start; to be closed, also after an error, unless it is NULL. */
static pspec_status make_file(FILE **out, const ps_text *script, ps_error *error) {
    PS_TRY(ps_temporary_open(out, error));
    errno = 0;
    return fwrite(script->data, 1, script->length, *out) == script->length && fflush(*out) == 0 &&
                   fseeko(*out, 0, SEEK_SET) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot write a temporary file: %s",
                         strerror(errno));
}

static void close_file(FILE *file) {
    if (file != NULL) {
        fclose(file);
    }
}

pspec_status ps_gnuplot_run(const ps_text *script, const char *last, ps_text *picture,
                            ps_error *error) {
    ps_text path = {0};
    FILE *file = NULL;
    FILE *complaints = NULL;
    pspec_status status = PSPEC_OK;
    pid_t child = 0;
    int source = -1;
    PS_TRY_OUT(status, make_file(&file, script, error));
    PS_TRY_OUT(status, ps_plot_find_gnuplot(&path, error));
    PS_TRY_OUT(status, ps_temporary_open(&complaints, error));
    const int reason = start_gnuplot(ps_text_string(&path), file, complaints, &source, &child);
    status = reason == 0
                 ? collect(source, child, complaints, last, picture, error)
                 : ps_fail(error, PSPEC_ERROR_IO, "cannot run gnuplot: %s", strerror(reason));
out:
    close_file(file);
    close_file(complaints);
    ps_text_free(&path);
    return status;
}
