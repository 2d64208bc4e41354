#include "device/drivers.h"

#include "base/memory.h"
#include "base/text.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char system_place[] = "/etc/OpenCL/vendors";

enum { LINE_BYTES = 4096 }; /* of a file that names a library: Linux has no longer path */

static pspec_status copy(char **out, const char *text, ps_error *error) {
    *out = strdup(text);
    return *out != NULL ? PSPEC_OK
                        : ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for the name of a driver");
}

/* ---- one driver ----------------------------------------------------------------------------- */

/* The first line of the file, without blanks at its end; false: there is none, for the reason in
 * errno. */
static bool read_line(const char *path, char line[LINE_BYTES]) {
    FILE *const file = fopen(path, "re");
    if (file == NULL) {
        return false;
    }
    errno = 0;
    const bool has_line = fgets(line, LINE_BYTES, file) != NULL;
    const int reason = errno != 0 ? errno : ENODATA;
    fclose(file);
    if (has_line) {
        line[strcspn(line, " \t\r\n")] = '\0';
    }
    errno = reason;
    return has_line;
}

/* It stays loaded: drivers do not like to be unloaded, and the loader has them anyway. */
static pspec_status load(ps_driver *driver, ps_error *error) {
    if (dlopen(driver->library, RTLD_LAZY | RTLD_LOCAL) != NULL) {
        return PSPEC_OK;
    }
    const char *const reason = dlerror();
    return copy(&driver->problem, reason != NULL ? reason : "it does not load", error);
}

static pspec_status add(ps_drivers *out, const char *file, ps_error *error) {
    char line[LINE_BYTES];
    if (out->num == PS_MOST_DRIVERS) {
        return PSPEC_OK;
    }
    ps_driver *const driver = &out->drivers[out->num++];
    PS_TRY(copy(&driver->file, file, error));
    if (!ps_text_ends_in(file, ".icd")) { /* the library itself */
        PS_TRY(copy(&driver->library, file, error));
        return load(driver, error);
    }
    if (!read_line(file, line)) {
        return copy(&driver->problem, strerror(errno), error);
    }
    PS_TRY(copy(&driver->library, line, error));
    return load(driver, error);
}

/* ---- all of them ---------------------------------------------------------------------------- */

static pspec_status add_folder(ps_drivers *out, DIR *folder, ps_error *error) {
    const struct dirent *found = NULL;
    while ((found = readdir(folder)) != NULL) {
        ps_text path = {0};
        pspec_status status = PSPEC_OK;
        if (ps_text_ends_in(found->d_name, ".icd")) {
            ps_text_append(&path, "%s/%s", out->place, found->d_name);
            status = ps_text_check(&path, error);
            if (status == PSPEC_OK) {
                status = add(out, ps_text_string(&path), error);
            }
        }
        ps_text_free(&path);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static const char *find_place(const char **variable) {
    static const char *const variables[] = {"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH"};
    for (size_t i = 0; i < sizeof variables / sizeof variables[0]; i++) {
        const char *const value = getenv(variables[i]);
        if (value != NULL && value[0] != '\0') {
            *variable = variables[i];
            return value;
        }
    }
    *variable = NULL;
    return system_place;
}

pspec_status ps_drivers_look(ps_drivers *out, ps_error *error) {
    struct stat facts;
    *out = (ps_drivers){0};
    PS_TRY(copy(&out->place, find_place(&out->variable), error));
    if (out->variable != NULL && stat(out->place, &facts) == 0 && !S_ISDIR(facts.st_mode)) {
        return add(out, out->place, error);
    }
    DIR *const folder = opendir(out->place);
    if (folder == NULL) {
        out->is_missing = errno == ENOENT || errno == ENOTDIR;
        return copy(&out->problem, strerror(errno), error);
    }
    const pspec_status status = add_folder(out, folder, error);
    closedir(folder);
    return status;
}

void ps_drivers_free(ps_drivers *drivers) {
    for (size_t i = 0; i < drivers->num; i++) {
        free(drivers->drivers[i].file);
        free(drivers->drivers[i].library);
        free(drivers->drivers[i].problem);
    }
    free(drivers->place);
    free(drivers->problem);
    *drivers = (ps_drivers){0};
}
