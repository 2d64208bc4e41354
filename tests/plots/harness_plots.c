#include "harness_plots.h"

#include "plots/plot_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

char *test_script(const ps_figure *plot) {
    ps_text script = {0};
    ps_error error = {0};
    assert_int_equal(ps_script_print_figure(&script, plot, "svg", &error), PSPEC_OK);
    return script.data;
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
