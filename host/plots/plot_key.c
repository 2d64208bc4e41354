/* The key of panels: entries in rows below them. */
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

/* Pixels, measured in SVG, where letters are largest: of a letter of a label on the average, of
 * the sample before it, and of a row; and of a letter as gnuplot takes it, which is wider. Formulas
 * have higher rows, for something is raised in them. */
static const double LETTER = 9.3, SAMPLE = 57, ROW = 23.8, TAKEN_LETTER = 11.2;
static const double LABEL_ROWS = 1.05, FORMULA_ROWS = 1.32;

enum { MOST_COLUMNS = 4, BELOW = 7 /* pixels, between the key and where its place ends */ };

static double find_width(const ps_script_key *key, size_t columns) {
    return (key->where.right - key->where.left) / (double)columns;
}

/* Of labels, that a column has room for. */
static double count_letters(const ps_script_key *key, size_t columns) {
    return floor((find_width(key, columns) - SAMPLE) / LETTER);
}

/* What raises and lowers takes no place. */
static double count_formula(const char *formula) {
    size_t num = 0;
    for (; formula != NULL && *formula != '\0'; formula++) {
        num += strchr("_^{}", *formula) == NULL;
    }
    return PS_SCRIPT_FORMULA_SIZE * (double)num;
}

static bool is_named(const ps_series *series) {
    return series->label != NULL || series->formula != NULL;
}

ps_script_key ps_script_key_of(const ps_panel *panel, ps_script_box where) {
    ps_script_key key = {.where = where};
    for (size_t i = 0; i < panel->num_series; i++) {
        const ps_series *const own = &panel->series[i];
        const double comma = own->formula != NULL && own->label != NULL ? 2 : 0;
        const double num =
            count_formula(own->formula) + comma + (double)ps_script_count_characters(own->label);
        key.longest = fmin(fmax(key.longest, num), count_letters(&key, 1));
        key.has_formula = key.has_formula || own->formula != NULL;
        key.num += is_named(own);
    }
    return key;
}

/* Short labels stand beside each other. */
static size_t count_columns(const ps_script_key *key) {
    size_t columns = MOST_COLUMNS;
    while (columns > 1 && key->longest > count_letters(key, columns)) {
        columns--;
    }
    return columns;
}

static double find_spacing(const ps_script_key *key) {
    return key->has_formula ? FORMULA_ROWS : LABEL_ROWS;
}

double ps_script_key_height(const ps_script_key *key) {
    const size_t columns = count_columns(key);
    return ROW * find_spacing(key) * (double)((key->num + columns - 1) / columns);
}

/* gnuplot makes as many columns as it takes to have room. */
void ps_script_print_key(ps_text *out, const ps_script_key *key) {
    const ps_script_box *const where = &key->where;
    const size_t columns = count_columns(key);
    const double sample = 5.2; /* of its letters */
    const double room = find_width(key, columns) / TAKEN_LETTER - sample;
    if (key->num == 0) {
        ps_text_append(out, "unset key\n");
        return;
    }
    ps_text_append(out,
                   "set key at screen %.4g,%.4g center top horizontal Left reverse maxcols %zu "
                   "samplen 2 spacing %g width %.3g\n",
                   (where->left + where->right) / 2 / where->page_width,
                   1 - (where->bottom - BELOW - ps_script_key_height(key)) / where->page_height,
                   columns, find_spacing(key), fmin(room - key->longest, 0));
}

void ps_script_print_entry(ps_text *out, const ps_script_key *key, const ps_series *series) {
    char cut[PS_SCRIPT_CUT_BYTES];
    const double room = count_letters(key, 1) - count_formula(series->formula);
    if (key->num == 0 || !is_named(series)) {
        ps_text_append(out, " notitle");
        return;
    }
    ps_text_append(out, " title ");
    ps_script_print_formula(out, series->formula, ps_script_cut(cut, series->label, (size_t)room));
}
