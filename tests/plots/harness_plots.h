/* Scripts of figures, as gnuplot would read them. Needs cmocka.h. */
#ifndef PS_TESTS_HARNESS_PLOTS_H
#define PS_TESTS_HARNESS_PLOTS_H

#include "plots/plot.h"

/* For SVG; to be freed. */
char *test_script(const ps_figure *plot);
bool test_script_contains(const ps_figure *plot, const char *what);
/* How often it has this. */
size_t test_script_count(const ps_figure *plot, const char *what);

bool test_has_gnuplot(void);

#endif
