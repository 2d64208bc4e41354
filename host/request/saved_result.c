#include "request/file_list.h"

#include "base/text.h"
#include "files/input_file.h"
#include "fields/table.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* What a header has that matters here stands in so many bytes. */
enum { HEADER_BYTES = 8192, VALUE_BYTES = 128 };

typedef struct header {
    char text[HEADER_BYTES + 1];
    size_t length;
} header;

/* Nothing of what is no regular file: a pipe would lose what is read of it. */
static pspec_status read_header(header *out, const char *path, ps_error *error) {
    struct stat facts;
    ps_input input = {0};
    out->length = 0;
    out->text[0] = '\0';
    if (strcmp(path, "-") == 0 || stat(path, &facts) != 0 || !S_ISREG(facts.st_mode)) {
        return PSPEC_OK;
    }
    pspec_status status = ps_input_open(&input, path, error);
    if (status == PSPEC_OK) {
        status = ps_input_read(&input, out->text, HEADER_BYTES, &out->length, error);
    }
    ps_input_close(&input);
    out->text[status == PSPEC_OK ? out->length : 0] = '\0';
    return status;
}

/* Of an array the facts are in a table beside it that has no rows; one that has is of its own. */
static pspec_status read_beside(header *out, const char *path, ps_error *error) {
    static const char ending[] = ".npy";
    const size_t length = strlen(path);
    const size_t stem = length > sizeof ending - 1 ? length - (sizeof ending - 1) : 0;
    ps_text text = {0};
    out->text[0] = '\0';
    if (stem == 0 || strcmp(path + stem, ending) != 0) {
        return PSPEC_OK;
    }
    ps_text_append(&text, "%.*s.json", (int)stem, path);
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK) {
        status = read_header(out, ps_text_string(&text), error);
    }
    ps_text_free(&text);
    if (out->length == HEADER_BYTES || strstr(out->text, "\"rows\"") != NULL) {
        out->text[0] = '\0';
    }
    return status == PSPEC_ERROR_INPUT ? PSPEC_OK : status; /* such as an empty file */
}

/* The first value of a key of CSV, "# key: value", or of the header in JSON, "key": "value", "key":
 * ["value", ..]. */
static bool find_value(const header *self, const char *key, char value[VALUE_BYTES]) {
    char of_csv[VALUE_BYTES];
    char of_json[VALUE_BYTES];
    snprintf(of_csv, sizeof of_csv, "# %s: ", key);
    snprintf(of_json, sizeof of_json, "\"%s\": ", key);
    const char *const meta = strstr(self->text, "\"meta\": ");
    const char *at = strstr(self->text, of_csv);
    const char *end = "\n";
    if (at != NULL) {
        at += strlen(of_csv);
    } else if (meta != NULL && (at = strstr(meta, of_json)) != NULL) {
        at += strlen(of_json);
        at += *at == '[' ? 1 : 0;
        end = *at == '"' ? "\"" : ",]}\n";
        at += *at == '"' ? 1 : 0;
    }
    const size_t length = at != NULL ? strcspn(at, end) : 0;
    snprintf(value, VALUE_BYTES, "%.*s", (int)(length < VALUE_BYTES ? length : VALUE_BYTES - 1),
             at != NULL ? at : "");
    return length > 0;
}

/* Every table has its command. Outputs of `sample` that are points have none. */
static bool find_command(const header *self, char command[VALUE_BYTES]) {
    static const char program[] = "pointspec ";
    char version[VALUE_BYTES];
    char line[VALUE_BYTES];
    if (!find_value(self, "pointspec_version", version) || !find_value(self, "command", line) ||
        strncmp(line, program, sizeof program - 1) != 0) {
        return false;
    }
    const char *const word = line + sizeof program - 1;
    snprintf(command, VALUE_BYTES, "%.*s", (int)strcspn(word, " "), word);
    return true;
}

/* Of what command, "" where the file is none. */
static pspec_status find_maker(header *out, char command[VALUE_BYTES], const char *path,
                               ps_error *error) {
    PS_TRY(read_header(out, path, error));
    if (!find_command(out, command)) {
        PS_TRY(read_beside(out, path, error));
        if (!find_command(out, command)) {
            command[0] = '\0';
        }
    }
    return PSPEC_OK;
}

pspec_status ps_saved_result_find(bool *is_one, const char *path, ps_error *error) {
    header head;
    char made_by[VALUE_BYTES] = "";
    const pspec_status status = find_maker(&head, made_by, path, error);
    *is_one = made_by[0] != '\0';
    return status;
}

pspec_status ps_saved_result_refuse(const char *path, ps_error *error) {
    header head;
    char made_by[VALUE_BYTES];
    char sampler[VALUE_BYTES];
    char points[VALUE_BYTES];
    PS_TRY(find_maker(&head, made_by, path, error));
    if (made_by[0] == '\0') {
        return PSPEC_OK;
    }
    /* what `sampler` names may be a set of files, and no sampler to be asked again */
    const bool has_sampler =
        strstr(head.text, " --set ") == NULL && find_value(&head, "sampler", sampler);
    const bool has_points = find_value(&head, "points", points);
    return ps_fail(
        error, PSPEC_ERROR_INPUT,
        "\"%s\" holds no points: pointspec %s saved it%s%s%s%s, and variances are formed "
        "from sums of each set, which it has not; use pointspec variance%s%s%s%s",
        path, made_by, has_sampler ? ", of sampler " : "", has_sampler ? sampler : "",
        has_points ? ", N = " : "", has_points ? points : "",
        has_sampler ? " --sampler " : " on the point files", has_sampler ? sampler : "",
        has_sampler && has_points ? " -n " : "", has_sampler && has_points ? points : "");
}
