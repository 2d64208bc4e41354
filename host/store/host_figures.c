#include "store/host_figures.h"

#include "base/workers.h"

#include <stdio.h>
#include <string.h>

/* "model name : AMD EPYC ..." of the first processor; "unknown" where the system does not say. */
static void find_name(char *out, size_t size) {
    static const char key[] = "model name";
    char line[256];
    FILE *const file = fopen("/proc/cpuinfo", "r");
    snprintf(out, size, "unknown");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *const value = strchr(line, ':');
        if (strncmp(line, key, sizeof key - 1) == 0 && value != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(out, size, "%s", value + 1 + strspn(value + 1, " "));
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

void ps_host_describe(ps_device_limits *out) {
    *out = (ps_device_limits){0};
    find_name(out->name, sizeof out->name);
    snprintf(out->platform, sizeof out->platform, "host");
    snprintf(out->driver, sizeof out->driver, "%u threads", ps_workers_most());
}

pspec_status ps_host_figures_read(ps_figures *figures, const char *folder, ps_error *error) {
    ps_device_limits host;
    ps_host_describe(&host);
    return ps_figures_read(figures, folder, &host, error);
}

pspec_status ps_host_figures_write(const char *folder, const ps_figures *figures, ps_error *error) {
    ps_device_limits host;
    ps_host_describe(&host);
    return ps_figures_write(folder, figures, &host, error);
}
