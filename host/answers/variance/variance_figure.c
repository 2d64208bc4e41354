/* Variances against N: a panel for each integrand, and in it a colour for each sampler. */
#include "answers/variance/variance_table.h"
#include "base/text.h"

#include <string.h>

/* The exponent that the header has of the curve, where it was asked for. */
ps_uncertain ps_variance_find_slope(const ps_table *table, const char *sampler,
                                    const char *integrand) {
    static const char block[] = "rates";
    size_t i = 0;
    ps_cell found = ps_entry_of(table, block, 0, "rate_sampler");
    while (found.kind == PS_CELL_TEXT &&
           ((sampler[0] != '\0' && strcmp(found.text, sampler) != 0) ||
            strcmp(ps_cell_text(ps_entry_of(table, block, i, "rate_integrand")), integrand) != 0)) {
        found = ps_entry_of(table, block, ++i, "rate_sampler");
    }
    return (ps_uncertain){.value = -ps_cell_number(ps_entry_of(table, block, i, "rate")),
                          .error = ps_cell_number(ps_entry_of(table, block, i, "rate_error"))};
}

/* What the axis says of the series of a look: how it is drawn, "" where nothing is. */
static const char *find_form(const ps_figure *figure, ps_look look, const char *of_one,
                             const char *of_several) {
    const char *form = "";
    for (size_t panel = 0; panel < figure->num_panels; panel++) {
        for (size_t i = 0; i < figure->panels[panel].num_series; i++) {
            const ps_series *const series = &figure->panels[panel].series[i];
            if (series->look == look && ps_series_is_drawn(series) && form != of_several) {
                form = series->num > 1 ? of_several : of_one;
            }
        }
    }
    return form;
}

/* What is drawn, and how. */
static void write_label(const ps_figure *figure, ps_text *out) {
    static const struct {
        ps_look look;
        const char *of_one, *of_several, *what;
    } parts[] = {{PS_LOOK_CURVE, "rings", "lines", "predicted"},
                 {PS_LOOK_MARKS, "marks", "marks", "measured"},
                 {PS_LOOK_BOUND, "crosses", "dots", "bounds"}};
    const char *before = ": ";
    ps_text_append(out, "variance");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const char *const form =
            find_form(figure, parts[i].look, parts[i].of_one, parts[i].of_several);
        if (form[0] != '\0') {
            ps_text_append(out, "%s%s %s", before, form, parts[i].what);
            before = ", ";
        }
    }
}

pspec_status ps_variance_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                ps_error *error) {
    ps_text label = {0};
    PS_TRY(ps_lines_figure(out, memory, chart, error));
    write_label(out, &label);
    return ps_text_keep(&out->y_label, memory, &label, error);
}

/* Of one integrand there is no panel to name it. */
void ps_variance_write_title(ps_text *out, const ps_request *request, const ps_table *table) {
    const double sets = ps_variance_num_sets(request, table, NULL);
    const double shifts = ps_cell_number(ps_table_find_meta(table, "shifts"));
    ps_text_append(out, "%s", request->num_integrands == 1 ? request->integrands[0] : "variance");
    if (request->num_sources == 1) {
        ps_text_append(out, ", %s", ps_request_source_name(request, 0));
    }
    if (sets > 0) {
        ps_text_append(out, ", M = %.0f", sets);
    } else if (request->num_sources > 1) {
        ps_variance_num_sets(request, table, out);
    }
    if (sets > 0 && shifts > 0) {
        ps_text_append(out, ", %.0f trial%s", sets * shifts, sets * shifts > 1 ? "s" : "");
    }
}
