#include "answers/ranges/ranges.h"

#include "answers/arguments.h"

#include <string.h>

/* ---- header entries -------------------------------------------------------------------------- */

ps_cell ps_entry_find(const ps_table *table, const char *key, size_t index) {
    const char *name = NULL;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const ps_cell cell = ps_table_meta(table, i, &name);
        if (strcmp(name, key) == 0 && index-- == 0) {
            return cell;
        }
    }
    return PS_MISSING;
}

size_t ps_entry_count(const ps_table *table, const char *key) {
    size_t num = 0;
    const char *name = NULL;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        ps_table_meta(table, i, &name);
        num += strcmp(name, key) == 0;
    }
    return num;
}

bool ps_cells_are_same(const ps_cell *a, const ps_cell *b) {
    return a->kind == b->kind && a->integer == b->integer && a->number == b->number &&
           (a->kind != PS_CELL_TEXT || strcmp(a->text, b->text) == 0);
}

/* ---- the same job? --------------------------------------------------------------------------- */

/* Entries that every range of a job has alike. */
static const char *const common[] = {"pointspec_version", "seed",         "homogenize", "sampler",
                                     "sampler_note",      "input_format", "input",      "box",
                                     "input_columns",     "lift",         "morph",      "device",
                                     "precision",         "tolerance",    "engine",     NULL};

/* The option that the word names, and whether its value is in the word, too. */
static const ps_option *find_option(const char *word, size_t length, bool *has_value) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const ps_option *const option = &ps_options[id];
        const size_t name = strlen(option->name);
        if (length >= 2 && word[0] == '-' && option->letter != 0 && word[1] == option->letter) {
            *has_value = length > 2;
            return option;
        }
        if (length >= name + 2 && strncmp(word, "--", 2) == 0 &&
            strncmp(word + 2, option->name, name) == 0 &&
            (length == name + 2 || word[name + 2] == '=')) {
            *has_value = length > name + 2;
            return option;
        }
    }
    return NULL;
}

/* The next word that is of the question, and not of the range, or of what becomes of the answer. */
static bool next_of_question(const char **at, const char **word, size_t *length) {
    while (ps_command_next_word(at, word, length)) {
        bool has_value = false;
        const ps_option *const option = find_option(*word, *length, &has_value);
        if (option == NULL || option->questions != 0) {
            return true;
        }
        if (option->metavar != NULL && !has_value) {
            ps_command_next_word(at, word, length);
        }
    }
    return false;
}

static bool are_same_commands(const char *a, const char *b) {
    const char *words[2];
    size_t lengths[2];
    for (;;) {
        const bool has_a = next_of_question(&a, &words[0], &lengths[0]);
        const bool has_b = next_of_question(&b, &words[1], &lengths[1]);
        if (!has_a || !has_b) {
            return has_a == has_b;
        }
        if (lengths[0] != lengths[1] || memcmp(words[0], words[1], lengths[0]) != 0) {
            return false;
        }
    }
}

const char *ps_ranges_command(const ps_table *table) {
    const ps_cell merged = ps_entry_find(table, "merged", 0);
    const ps_cell command = ps_entry_find(table, "command", 0);
    return merged.kind == PS_CELL_TEXT    ? merged.text
           : command.kind == PS_CELL_TEXT ? command.text
                                          : "";
}

static void append_cell(ps_text *text, const ps_cell *cell) {
    if (cell->kind == PS_CELL_TEXT) {
        ps_text_append(text, "%s", cell->text);
    } else if (cell->kind == PS_CELL_MISSING) {
        ps_text_append(text, "none");
    } else {
        ps_text_append(text, "%.17g",
                       cell->kind == PS_CELL_INTEGER ? (double)cell->integer : cell->number);
    }
}

static pspec_status refuse(const char *name, const char *key, const ps_cell *is,
                           const ps_cell *should_be, ps_error *error) {
    ps_text cells[2] = {{0}};
    append_cell(&cells[0], is);
    append_cell(&cells[1], should_be);
    const pspec_status status =
        ps_fail(error, PSPEC_ERROR_INPUT,
                "%s is a range of another job: its %s is %.200s instead of %.200s", name, key,
                ps_text_string(&cells[0]), ps_text_string(&cells[1]));
    ps_text_free(&cells[0]);
    ps_text_free(&cells[1]);
    return status;
}

/* Words of how many realizations there are at once, which no bit depends on: of most engines, and
 * of torus_direct. */
static bool are_batches(const char *a, const char *b) {
    static const char *const names[] = {"at_once=", "group="};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const size_t length = strlen(names[i]);
        if (strncmp(a, names[i], length) == 0 && strncmp(b, names[i], length) == 0) {
            return true;
        }
    }
    return false;
}

/* There may be fewer at once where memory is refused. */
static bool are_same_engines(const char *a, const char *b) {
    const char *words[2];
    size_t lengths[2];
    bool is_same = true;
    while (is_same) {
        const bool has_a = ps_command_next_word(&a, &words[0], &lengths[0]);
        const bool has_b = ps_command_next_word(&b, &words[1], &lengths[1]);
        if (!has_a || !has_b) {
            return has_a == has_b;
        }
        is_same = are_batches(words[0], words[1]) ||
                  (lengths[0] == lengths[1] && memcmp(words[0], words[1], lengths[0]) == 0);
    }
    return false;
}

static bool are_same_entries(const char *key, const ps_cell *a, const ps_cell *b) {
    return ps_cells_are_same(a, b) ||
           (strcmp(key, "engine") == 0 && a->kind == PS_CELL_TEXT && b->kind == PS_CELL_TEXT &&
            are_same_engines(a->text, b->text));
}

/* Devices of different kinds may have different engines. */
static bool may_differ(const char *key, const ps_request *request) {
    return request != NULL && request->limits.mixed &&
           (strcmp(key, "precision") == 0 || strcmp(key, "engine") == 0);
}

pspec_status ps_ranges_compare(const ps_table *a, const ps_table *b, const char *name,
                               const ps_request *request, ps_error *error) {
    for (const char *const *key = common; *key != NULL; key++) {
        const size_t num_a = ps_entry_count(a, *key);
        const size_t num_b = ps_entry_count(b, *key);
        for (size_t i = 0; i < num_a || i < num_b; i++) {
            const ps_cell cells[] = {ps_entry_find(a, *key, i), ps_entry_find(b, *key, i)};
            if (!are_same_entries(*key, &cells[0], &cells[1]) && !may_differ(*key, request)) {
                return refuse(name, *key, &cells[1], &cells[0], error);
            }
        }
    }
    const ps_cell commands[] = {PS_TEXT(ps_ranges_command(a)), PS_TEXT(ps_ranges_command(b))};
    return are_same_commands(commands[0].text, commands[1].text)
               ? PSPEC_OK
               : refuse(name, "command", &commands[1], &commands[0], error);
}

/* How every part came about; of those that were merged before, how theirs did. */
pspec_status ps_ranges_tell(ps_table *table, const ps_parts *parts, ps_error *error) {
    static const char key[] = "merged";
    for (size_t p = 0; p < parts->num; p++) {
        const ps_table *const part = parts->tables[p];
        const size_t num = ps_entry_count(part, key);
        for (size_t i = 0; i < num; i++) {
            PS_TRY(ps_table_add_meta(table, key, ps_entry_find(part, key, i), error));
        }
        if (num == 0) {
            PS_TRY(ps_table_add_meta(table, key, ps_entry_find(part, "command", 0), error));
        }
    }
    return PSPEC_OK;
}

/* ---- order ----------------------------------------------------------------------------------- */

/* The first realization; -1: it is no range. */
static double find_first(const ps_table *table) {
    const ps_npy_array *const range = ps_table_find_array(table, "state_range");
    return range != NULL && range->num > 0 && range->data[0] >= 0 ? range->data[0] : -1;
}

pspec_status ps_ranges_sort(ps_parts *out, ps_pool *memory, const ps_parts *parts,
                            ps_error *error) {
    const ps_table **tables = NULL;
    const char **names = NULL;
    PS_TRY(PS_POOL_NEW(memory, &tables, parts->num, "answers", error));
    PS_TRY(PS_POOL_NEW(memory, &names, parts->num, "answers", error));
    *out = *parts;
    out->tables = tables;
    out->names = names;
    memcpy(tables, parts->tables, parts->num * sizeof *tables);
    memcpy(names, parts->names, parts->num * sizeof *names);
    for (size_t p = 0; p < parts->num; p++) {
        if (find_first(tables[p]) < 0) {
            return PSPEC_OK;
        }
    }
    for (size_t p = 1; p < parts->num; p++) {
        PS_TRY(ps_ranges_compare(parts->tables[0], parts->tables[p], parts->names[p],
                                 parts->request, error));
        for (size_t i = p; i > 0 && find_first(tables[i]) < find_first(tables[i - 1]); i--) {
            const ps_table *const table = tables[i];
            const char *const name = names[i];
            tables[i] = tables[i - 1];
            names[i] = names[i - 1];
            tables[i - 1] = table;
            names[i - 1] = name;
        }
    }
    return PSPEC_OK;
}
