#include "store/figures_file.h"

#include "base/memory.h"
#include "files/digest.h"
#include "files/descriptor.h"
#include "files/output_file.h"
#include "store/cache_folder.h"
#include "store/cache_trust.h"
#include "store/figures_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_BYTES = 1 << 16 }; /* of a file; ours have about one thousand */

/* ---- names --------------------------------------------------------------------------------- */

pspec_status ps_figures_path(ps_text *path, const char *folder, const ps_device_limits *limits,
                             ps_error *error) {
    char digest[PS_DIGEST_BYTES];
    ps_text device = {0};
    ps_figures_append_device(&device, limits);
    const pspec_status status = ps_text_check(&device, error);
    if (status == PSPEC_OK) {
        ps_digest_bytes(device.data, device.length, digest);
        ps_text_append(path, "%s/devices/%s.txt", folder, digest);
    }
    ps_text_free(&device);
    PS_TRY(status);
    return ps_text_check(path, error);
}

/* ---- writing ------------------------------------------------------------------------------- */

/* Neither the folder nor the one in it may be another user's. */
static pspec_status check_folders(const char *folder, ps_error *error) {
    ps_text path = {0};
    ps_text_append(&path, "%s/devices", folder);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_cache_check_folder(folder, error);
    }
    if (status == PSPEC_OK) {
        status = ps_cache_check_folder(path.data, error);
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_figures_make_folder(const char *folder, ps_error *error) {
    ps_text path = {0};
    ps_text_append(&path, "%s/devices", folder);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_cache_folder_make(ps_text_string(&path), error);
    }
    ps_text_free(&path);
    PS_TRY(status);
    return check_folders(folder, error);
}

pspec_status ps_figures_write(const char *folder, const ps_figures *figures,
                              const ps_device_limits *limits, ps_error *error) {
    ps_text text = {0};
    ps_text path = {0};
    ps_output_file *file = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_figures_make_folder(folder, error));
    PS_TRY_OUT(status, ps_figures_path(&path, folder, limits, error));
    PS_TRY_OUT(status, ps_figures_format(&text, figures, limits, error));
    PS_TRY_OUT(status, ps_cache_clear_way(ps_text_string(&path), error));
    PS_TRY_OUT(status, ps_output_open(&file, ps_text_string(&path), error));
    ps_output_write(file, text.data, 1, text.length);
    status = ps_output_commit(&file, error);
out:
    ps_output_discard(&file);
    ps_text_free(&text);
    ps_text_free(&path);
    return status;
}

/* ---- reading ------------------------------------------------------------------------------- */

static pspec_status read_all(int descriptor, const char *path, char *out, size_t *length,
                             ps_error *error) {
    ssize_t step = 1;
    for (*length = 0; *length < MOST_BYTES && step > 0; *length += (size_t)step) {
        step = read(descriptor, out + *length, MOST_BYTES - *length);
        if (step < 0) {
            return ps_read_fail(path, error);
        }
    }
    return PSPEC_OK;
}

static pspec_status parse_file(ps_figures *figures, const char *path, const char *text,
                               size_t length, const ps_device_limits *limits, ps_error *error) {
    ps_error why = {0};
    const pspec_status status = length == 0 ? ps_fail(&why, PSPEC_ERROR_INPUT, "it is empty")
                                : length == MOST_BYTES
                                    ? ps_fail(&why, PSPEC_ERROR_INPUT, "it is too long")
                                    : ps_figures_parse(figures, text, length, limits, &why);
    return status == PSPEC_OK ? PSPEC_OK : ps_fail(error, status, "%s: %s", path, why.message);
}

/* *is_there: false, and PSPEC_OK, where there is no file. */
static pspec_status read_file(ps_figures *figures, const char *path, bool *is_there,
                              const ps_device_limits *limits, ps_error *error) {
    int descriptor = -1;
    uint64_t num_bytes = 0;
    ps_cache_file_kind kind = PS_CACHE_FILE_ABSENT;
    char *text = NULL;
    size_t length = 0;
    PS_TRY(ps_cache_file_open(path, &descriptor, &num_bytes, &kind, error));
    *is_there = kind != PS_CACHE_FILE_ABSENT;
    if (kind != PS_CACHE_FILE_OWN) {
        return *is_there ? ps_fail(error, PSPEC_ERROR_IO, "%s is no file", path) : PSPEC_OK;
    }
    pspec_status status = PS_NEW(&text, MOST_BYTES, "figures of a device", error);
    if (status == PSPEC_OK) {
        status = read_all(descriptor, path, text, &length, error);
    }
    if (status == PSPEC_OK) {
        status = parse_file(figures, path, text, length, limits, error);
    }
    free(text);
    close(descriptor);
    return status;
}

static void say_builtin(ps_figures *figures, const char *why) {
    *figures = (ps_figures){0};
    snprintf(figures->note, sizeof figures->note, "built-in: %.*s", (int)sizeof figures->note - 16,
             why);
}

pspec_status ps_figures_read(ps_figures *figures, const char *folder,
                             const ps_device_limits *limits, ps_error *error) {
    ps_error own = {0};
    ps_text path = {0};
    bool is_there = true;
    say_builtin(figures, "none were looked for");
    if (folder == NULL) {
        return PSPEC_OK;
    }
    pspec_status status = check_folders(folder, &own);
    if (status == PSPEC_OK) {
        status = ps_figures_path(&path, folder, limits, &own);
    }
    if (status == PSPEC_OK) {
        status = read_file(figures, path.data, &is_there, limits, &own);
    }
    if (status != PSPEC_OK) {
        say_builtin(figures, own.message);
    } else if (!is_there) {
        say_builtin(figures, "this device was not measured (pointspec bench --calibrate)");
    }
    ps_text_free(&path);
    return status == PSPEC_ERROR_MEMORY || status == PSPEC_ERROR_CANCELLED
               ? ps_fail(error, status, "%s", own.message)
               : PSPEC_OK;
}

pspec_status ps_figures_open_device(ps_device **out, const char *selector, bool with_profile,
                                    const char *folder, ps_error *error) {
    ps_figures figures;
    PS_TRY(ps_device_open(out, selector, with_profile, error));
    pspec_status status = ps_figures_read(&figures, folder, ps_device_get_limits(*out), error);
    if (status == PSPEC_OK) {
        status = ps_device_set_figures(*out, &figures, error);
    }
    if (status != PSPEC_OK) {
        ps_device_close(*out);
        *out = NULL;
    }
    return status;
}
