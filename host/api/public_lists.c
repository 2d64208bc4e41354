/* The public library: which kinds of answers there are, what they take, and what they have. */
#include "answers/figure.h"
#include "api/public_objects.h"
#include "base/text.h"
#include "commands/plan.h"
#include "request/option_help.h"

/* ---- what can be asked ------------------------------------------------------------------- */

const ps_command *const ps_public_commands[] = {
    PS_COMMANDS(PS_KIND_OF, PS_COMMAND_OF, PS_NO_COMMAND, PS_NO_COMMAND) & ps_command_devices,
    &ps_command_doctor, NULL};

/* ---- names ------------------------------------------------------------------------------- */

const char *pspec_answer_kind(size_t i) {
    size_t num = 0;
    while (ps_kinds[num] != NULL) {
        num++;
    }
    return i < num ? ps_kinds[i]->name : NULL;
}

pspec_status ps_public_find(const ps_command **out, const ps_command *const *table,
                            const char *name, const char *what, ps_error *error) {
    size_t distance = 0;
    if (name == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no name of a %s", what);
    }
    *out = ps_command_nearest(table, name, &distance);
    return distance == 0
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no %s \"%s\"%s", what, name,
                     ps_text_suggest(name, (*out)->name, distance, "; did you mean ", "?").text);
}

bool ps_public_takes(const ps_command *row, ps_option_id id) {
    static const ps_option_id of_program[] = {PS_OPTION_DEVICE, PS_OPTION_PROFILE, PS_OPTION_QUIET,
                                              PS_OPTION_VERBOSE, PS_OPTION_HELP};
    bool is_of_program = false;
    for (size_t i = 0; i < sizeof of_program / sizeof of_program[0]; i++) {
        is_of_program = is_of_program || of_program[i] == id;
    }
    return !is_of_program && ps_command_takes(row, id);
}

/* ---- tables ------------------------------------------------------------------------------ */

typedef pspec_status fill_table(const ps_command *row, ps_table *table, ps_error *error);

/* A table about one of the rows: what it is called, its columns, and who fills it. */
typedef struct listed {
    const char *name;
    const ps_command *const *rows;
    const char *what; /* a row is, in sentences */
    fill_table *fill;
    const char *columns[12]; /* NULL ends them, where there are fewer */
} listed;

static pspec_status fill(const listed *self, const ps_command *row, ps_table **out,
                         ps_error *error) {
    enum { MOST = sizeof self->columns / sizeof self->columns[0] };
    size_t num = 0;
    while (num < MOST && self->columns[num] != NULL) {
        num++;
    }
    PS_TRY(ps_table_create(out, self->name, self->columns, num, error));
    return self->fill(row, *out, error);
}

static pspec_status tell(pspec_answer **out, pspec_context *context, const listed *self,
                         const char *name) {
    const ps_command *row = NULL;
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(ps_public_find(&row, self->rows, name, self->what, error));
    const pspec_status status = fill(self, row, &made.table, error);
    if (status != PSPEC_OK) {
        ps_answer_free(&made);
        return status;
    }
    return ps_public_answer(out, &made, NULL, error);
}

static ps_cell text_or_missing(const char *text) {
    return text != NULL && text[0] != '\0' ? PS_TEXT(text) : PS_MISSING;
}

/* Kinds of answers that take the option, with commas. */
static void list_kinds(ps_text *out, ps_option_id id) {
    for (size_t i = 0; ps_kinds[i] != NULL; i++) {
        if (ps_command_takes(ps_kinds[i], id)) {
            ps_text_append(out, "%s%s", out->length > 0 ? "," : "", ps_kinds[i]->name);
        }
    }
}

static pspec_status add_option(ps_table *table, const ps_command *row, ps_option_id id,
                               ps_error *error) {
    const char *const words = ps_command_words(row, id);
    char help[PS_OPTION_HELP_BYTES];
    ps_option_facts facts;
    ps_text kinds = {0};
    ps_option_help(help, ps_options[id].help, row->name);
    ps_option_find_facts(&facts, id, words, help);
    list_kinds(&kinds, id);
    pspec_status status = ps_text_check(&kinds, error);
    const ps_cell cells[] = {PS_TEXT(ps_options[id].name),
                             text_or_missing(words),
                             PS_TEXT(facts.type),
                             text_or_missing(facts.unit),
                             text_or_missing(facts.initial),
                             PS_TEXT(facts.is_repeatable ? "yes" : "no"),
                             text_or_missing(facts.file),
                             text_or_missing(ps_text_string(&kinds)),
                             PS_TEXT(help)};
    if (status == PSPEC_OK) {
        status = ps_table_add_row(table, cells, error);
    }
    ps_text_free(&kinds);
    return status;
}

static pspec_status fill_options(const ps_command *row, ps_table *table, ps_error *error) {
    for (int i = 0; i < PS_NUM_OPTIONS; i++) {
        if (ps_public_takes(row, (ps_option_id)i)) {
            PS_TRY(add_option(table, row, (ps_option_id)i, error));
        }
    }
    return PSPEC_OK;
}

pspec_status pspec_options_table(pspec_answer **out, pspec_context *context, const char *command) {
    static const listed table = {
        "options",
        ps_public_commands,
        "command",
        fill_options,
        {"option", "values", "type", "unit", "default", "repeated", "file", "kinds", "help"}};
    return tell(out, context, &table, command);
}

static pspec_status add_field(const ps_field_row *row, void *table, ps_error *error) {
    const ps_cell cells[] = {PS_TEXT(row->name),         PS_TEXT(ps_field_groups[row->group]),
                             text_or_missing(row->unit), PS_TEXT(row->is_repeated ? "yes" : "no"),
                             text_or_missing(row->when), PS_TEXT(row->meaning)};
    return ps_table_add_row(table, cells, error);
}

static pspec_status fill_fields(const ps_command *row, ps_table *table, ps_error *error) {
    return ps_kind_visit_fields(row, add_field, table, error);
}

pspec_status pspec_fields_table(pspec_answer **out, pspec_context *context, const char *kind) {
    static const listed table = {"fields",
                                 ps_with_fields,
                                 "kind of answer",
                                 fill_fields,
                                 {"field", "group", "unit", "repeated", "when", "meaning"}};
    return tell(out, context, &table, kind);
}

/* ---- pictures ---------------------------------------------------------------------------- */

/* As ps_look has them; those behind are of painters. */
static const char *const looks[] = {"line",  "line",  "curve",     "marks", "signs",
                                    "bound", "cloud", "reference", "front"};
enum { NUM_LOOKS = sizeof looks / sizeof looks[0] };

static pspec_status add_line(ps_table *table, const ps_picture_kind *picture, size_t number,
                             const ps_picture_line *line, const char *look, ps_error *error) {
    const ps_cell cells[] = {PS_INTEGER(number),
                             text_or_missing(picture->panels),
                             text_or_missing(picture->x),
                             PS_TEXT(line->y),
                             text_or_missing(line->error),
                             text_or_missing(line->low),
                             text_or_missing(line->high),
                             PS_TEXT(look),
                             text_or_missing(line->name),
                             PS_TEXT(picture->is_of_entries ? "yes" : "no"),
                             PS_TEXT(picture->is_log_x ? "yes" : "no"),
                             PS_TEXT(picture->is_log_y ? "yes" : "no")};
    return ps_table_add_row(table, cells, error);
}

/* By ps_frame_form. */
static const char *const forms[] = {[PS_FRAME_PLANE] = "plane",
                                    [PS_FRAME_SQUARE] = "points",
                                    [PS_FRAME_PIXELS] = "pixels",
                                    [PS_FRAME_LIGHT] = "light"};

static pspec_status add_drawn_array(ps_table *table, size_t number, const ps_drawn_array *array,
                                    ps_error *error) {
    const ps_picture_kind no_axes = {.x = NULL};
    const ps_picture_line line = {.y = array->name};
    return add_line(table, &no_axes, number, &line, forms[array->form], error);
}

/* Pictures of lines and arrays; those of a scene have more. */
static pspec_status fill_pictures(const ps_command *row, ps_table *table, ps_error *error) {
    for (size_t i = 0; row->pictures != NULL && row->pictures[i].make != NULL; i++) {
        const ps_picture_kind *const picture = &row->pictures[i];
        for (size_t k = 0; picture->x != NULL && picture->lines[k].y != NULL; k++) {
            const ps_picture_line *const line = &picture->lines[k];
            const char *const look = looks[(size_t)line->look < NUM_LOOKS ? line->look : 0];
            PS_TRY(add_line(table, picture, i, line, look, error));
        }
        for (size_t k = 0; picture->arrays[k].name != NULL; k++) {
            PS_TRY(add_drawn_array(table, i, &picture->arrays[k], error));
        }
    }
    return PSPEC_OK;
}

pspec_status pspec_pictures_table(pspec_answer **out, pspec_context *context, const char *kind) {
    static const listed table = {"pictures",
                                 ps_with_fields,
                                 "kind of answer",
                                 fill_pictures,
                                 {"picture", "panels", "x", "y", "error", "low", "high", "look",
                                  "name", "entries", "log_x", "log_y"}};
    return tell(out, context, &table, kind);
}
