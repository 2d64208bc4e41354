#include "harness_plots.h"

#include "plots/plot_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

char *test_script(const ps_figure *plot) {
    char *script = NULL;
    size_t length = 0;
    ps_error error = {0};
    FILE *const stream = open_memstream(&script, &length);
    assert_non_null(stream);
    assert_int_equal(ps_script_print_figure(plot, "svg", stream, &error), PSPEC_OK);
    assert_int_equal(fclose(stream), 0);
    return script;
}

size_t test_script_count(const ps_figure *plot, const char *what) {
    char *const script = test_script(plot);
    size_t num = 0;
    for (const char *at = script; (at = strstr(at, what)) != NULL; at += strlen(what)) {
        num++;
    }
    free(script);
    return num;
}

bool test_script_contains(const ps_figure *plot, const char *what) {
    return test_script_count(plot, what) > 0;
}

bool test_has_gnuplot(void) {
    return system("gnuplot --version >/dev/null 2>&1") == 0;
}
