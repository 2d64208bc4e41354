#include "points/file_estimate.h"

#include "files/input_file.h"

#include <stdint.h>
#include <string.h>
#include <sys/stat.h>

enum { BEGINNING = 1 << 14 };

/* Bytes of the file; of a gzip file as many as texts usually come to. Arrays of an archive are
 * taken to be stored. */
static double size_of(const char *path, ps_file_estimate *out, ps_input *input) {
    const double usual = 3; /* of text compressed by gzip */
    struct stat found;
    if (strcmp(path, "-") == 0 || stat(path, &found) != 0 || !S_ISREG(found.st_mode)) {
        return 0;
    }
    out->is_compressed = input->gzip != NULL;
    return (double)found.st_size * (out->is_compressed ? usual : 1);
}

static bool is_text(const unsigned char *bytes, size_t num) {
    for (size_t i = 0; i < num; i++) {
        const bool is_blank = bytes[i] == '\n' || bytes[i] == '\r' || bytes[i] == '\t';
        if (bytes[i] >= 0x7f || (bytes[i] < ' ' && !is_blank)) {
            return false;
        }
    }
    return true;
}

static double mean_line(const unsigned char *bytes, size_t num) {
    size_t lines = 0;
    size_t end = 0;
    for (size_t i = 0; i < num; i++) {
        if (bytes[i] == '\n') {
            lines++;
            end = i + 1;
        }
    }
    return lines > 0 ? (double)end / (double)lines : (double)num;
}

static bool has_ending(const char *path, const char *ending) {
    const size_t length = strlen(path);
    const size_t wanted = strlen(ending);
    return length >= wanted && strcmp(path + length - wanted, ending) == 0;
}

ps_file_estimate ps_file_estimate_of(const char *path, const char *format) {
    ps_file_estimate out = {.bytes_of_number = sizeof(double)};
    unsigned char beginning[BEGINNING];
    size_t num = 0;
    ps_input input = {0};
    if (strcmp(path, "-") == 0) { /* what is read of it is gone */
        return out;
    }
    if (ps_input_open(&input, path, NULL) == PSPEC_OK) {
        out.bytes = size_of(path, &out, &input);
        if (out.bytes > 0 &&
            ps_input_read(&input, beginning, sizeof beginning, &num, NULL) == PSPEC_OK) {
            out.is_text = is_text(beginning, num);
            out.line_bytes = mean_line(beginning, num);
        }
    }
    ps_input_close(&input);
    if (format != NULL ? strcmp(format, "rps") == 0 : has_ending(path, ".rps")) {
        out.bytes_of_number = sizeof(float);
    }
    return out;
}

double ps_file_estimate_points(const ps_file_estimate *estimate, unsigned columns) {
    if (estimate->bytes <= 0) {
        return 0;
    }
    return estimate->is_text
               ? estimate->bytes / (estimate->line_bytes > 0 ? estimate->line_bytes : 1)
               : estimate->bytes / (columns * estimate->bytes_of_number);
}
