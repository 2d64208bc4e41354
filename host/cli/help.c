/* --help: everything comes from the tables of commands, options and samplers. */
#include "cli/command.h"
#include "integrands/integrand.h"
#include "request/option_help.h"
#include "request/options.h"
#include "samplers/sampler.h"
#include "fields/table_cells.h"

#include <stdio.h>
#include <string.h>

enum { TEXT_WIDTH = 79, HELP_COLUMN = 30 }; /* fits a terminal of 80 columns */

/* "  term      text", the text in a column of its own. */
static void print_item(FILE *stream, const char *term, const char *text) {
    int column = fprintf(stream, "  %s", term);
    if (column > HELP_COLUMN - 2) {
        putc('\n', stream);
        column = 0;
    }
    fprintf(stream, "%*s", HELP_COLUMN - column, "");
    ps_places_wrap(text, HELP_COLUMN, HELP_COLUMN, TEXT_WIDTH, SIZE_MAX, stream);
}

enum { TEXT_BYTES = PS_OPTION_HELP_BYTES };

/* The values that NAME stands for, behind what is in text. */
static void append_names(char text[TEXT_BYTES], const char *words, const char *metavar) {
    size_t used = strlen(text);
    if (words == metavar) {
        return;
    }
    for (const char *separator = ": "; *words != '\0' && used < TEXT_BYTES; separator = ", ") {
        const size_t length = strcspn(words, "|");
        used += (size_t)snprintf(text + used, TEXT_BYTES - used, "%s%.*s", separator, (int)length,
                                 words);
        words += length + (words[length] == '|');
    }
}

/* A command of the torus refuses columns of the sphere, by a sentence of its own. */
static const char *find_words(const ps_command *command, ps_option_id id) {
    return id == PS_OPTION_COLUMNS && command->samples == PS_DOMAIN_TORUS
               ? PS_TORUS_COLUMNS
               : ps_command_words(command, id);
}

static void print_option(FILE *stream, const ps_command *command, ps_option_id id) {
    const ps_option *const option = &ps_options[id];
    const char *const metavar = ps_command_metavar(command, id);
    char term[128];
    const char letter[] = {'-', option->letter, ',', ' ', '\0'};
    snprintf(term, sizeof term, "%s--%s%s%s", option->letter != 0 ? letter : "    ", option->name,
             metavar != NULL ? " " : "", metavar != NULL ? metavar : "");
    char text[TEXT_BYTES];
    ps_option_help(text, option->help, command->name);
    append_names(text, find_words(command, id), metavar);
    print_item(stream, term, text);
}

/* ---- samplers ------------------------------------------------------------------------------ */

static void print_sampler(FILE *stream, const ps_sampler *sampler) {
    char text[TEXT_BYTES];
    int length = snprintf(text, sizeof text, "%s", sampler->summary);
    for (size_t i = 0; sampler->aliases[i] != NULL && length < (int)sizeof text; i++) {
        length += snprintf(text + length, sizeof text - (size_t)length, "%s%s",
                           i == 0 ? "; also called " : ", ", sampler->aliases[i]);
    }
    if (length < (int)sizeof text && sampler->domain == PS_SAMPLES_TORUS &&
        sampler->minimum_dimension == sampler->maximum_dimension) {
        snprintf(text + length, sizeof text - (size_t)length, "; dimension %u only",
                 sampler->maximum_dimension);
    }
    print_item(stream, sampler->name, text);
    for (const ps_sampler_parameter *p = sampler->parameters; p->key != NULL; p++) {
        char term[128];
        snprintf(term, sizeof term, "  :%s=%s", p->key, p->default_value);
        print_item(stream, term, p->meaning);
    }
}

static void print_samplers_of(FILE *stream, ps_sampler_domain domain, const char *title) {
    fprintf(stream, "\nSamplers of the %s, with the defaults of their parameters:\n", title);
    for (size_t i = 0; ps_samplers[i] != NULL; i++) {
        if (ps_samplers[i]->domain == domain) {
            print_sampler(stream, ps_samplers[i]);
        }
    }
}

static void print_samplers(FILE *stream, ps_domain domain) {
    if (domain != PS_DOMAIN_TORUS) {
        print_samplers_of(stream, PS_SAMPLES_SPHERE, "sphere");
        print_samplers_of(stream, PS_SAMPLES_HEMISPHERE, "hemisphere");
    }
    print_samplers_of(stream, PS_SAMPLES_TORUS, "torus");
    if (domain != PS_DOMAIN_TORUS) {
        print_item(stream, "  :" PS_LIFT_KEY "=" PS_LIFT_DEFAULT,
                   "of all samplers of the torus: " PS_LIFT_MEANING);
        print_item(stream, "  :" PS_MORPH_KEY "=" PS_MORPH_DEFAULT, PS_MORPH_MEANING);
        print_item(stream, "  :" PS_EXPONENT_KEY "=", PS_EXPONENT_MEANING);
    }
}

/* ---- integrands ---------------------------------------------------------------------------- */

static void print_parameters(FILE *stream, const ps_parameter *parameters) {
    for (const ps_parameter *p = parameters; p->key != NULL; p++) {
        char term[128];
        snprintf(term, sizeof term, "  :%s=%s", p->key, p->default_value);
        print_item(stream, term, p->meaning);
    }
}

/* Lobes are BRDFs, and integrands where they are divided by their integrals. */
static void print_integrands(FILE *stream, bool are_brdfs, ps_domain domain) {
    const unsigned sphere = PS_INTEGRAND_ON(PS_SAMPLES_SPHERE);
    fprintf(stream, "\n%s, with the defaults of their parameters:\n",
            are_brdfs ? "BRDFs" : "Integrands");
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        const ps_integrand_kind *const kind = ps_integrand_kinds[i];
        char text[TEXT_BYTES];
        snprintf(text, sizeof text, "%s%s", kind->summary,
                 kind->lobe != NULL && !are_brdfs ? "; divided by its integral" : "");
        if ((kind->lobe != NULL || !are_brdfs) &&
            (domain != PS_DOMAIN_SPHERE || (kind->domains & sphere) != 0)) {
            print_item(stream, kind->name, text);
            print_parameters(stream, kind->parameters);
        }
    }
}

/* ---- commands ------------------------------------------------------------------------------ */

void ps_help_command(FILE *stream, const ps_command *command) {
    fprintf(stream, "Usage: pointspec %s\n\n", command->usage);
    ps_places_wrap(command->description, 0, 0, TEXT_WIDTH, SIZE_MAX, stream);
    fputs("\nOptions:\n", stream);
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (ps_command_takes(command, (ps_option_id)id)) {
            print_option(stream, command, (ps_option_id)id);
        }
    }
    if (ps_command_takes(command, PS_OPTION_SAMPLER)) {
        print_samplers(stream, command->samples);
    }
    if (ps_command_takes(command, PS_OPTION_BRDF)) {
        print_integrands(stream, true, command->samples);
    }
    if (ps_command_takes(command, PS_OPTION_INTEGRAND)) {
        print_integrands(stream, false, command->samples);
    }
    fputs("\nExamples:\n", stream);
    for (size_t i = 0; i < sizeof command->examples / sizeof command->examples[0]; i++) {
        fprintf(stream, "  %s\n", command->examples[i]);
    }
}

/* ---- fields ------------------------------------------------------------------------------ */

typedef struct field_list {
    FILE *stream;
    ps_field_group group;
    bool is_begun;
} field_list;

/* "points ...", whose key may come several times; its meaning, unit, and when it is there. */
static pspec_status print_field(const ps_field_row *row, void *payload, ps_error *error) {
    static const char *const titles[] = {[PS_FIELD_ENTRY] = "Header",
                                         [PS_FIELD_COLUMN] = "Columns",
                                         [PS_FIELD_ARRAY] = "Arrays",
                                         [PS_FIELD_STATE] = "State"};
    field_list *const list = payload;
    (void)error;
    if (row->group != list->group) {
        return PSPEC_OK;
    }
    if (!list->is_begun) {
        fprintf(list->stream, "\n%s:\n", titles[row->group]);
        list->is_begun = true;
    }
    char term[TEXT_BYTES];
    char text[TEXT_BYTES];
    snprintf(term, sizeof term, "%s%s", row->name, row->is_repeated ? " ..." : "");
    snprintf(text, sizeof text, "%s%s%s%s%s%s", row->meaning, row->unit[0] != '\0' ? ", in " : "",
             row->unit, row->when[0] != '\0' ? " (" : "", row->when,
             row->when[0] != '\0' ? ")" : "");
    print_item(list->stream, term, text);
    return PSPEC_OK;
}

pspec_status ps_help_fields(FILE *stream, const ps_command *command, ps_error *error) {
    static const ps_field_group order[] = {PS_FIELD_COLUMN, PS_FIELD_ENTRY, PS_FIELD_ARRAY,
                                           PS_FIELD_STATE};
    if (command->fields == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "fields are those of tables, and %s gives none: " PS_KINDS_IN_SENTENCE
                       "plan, bench, stress and devices do",
                       command->name);
    }
    fprintf(stream,
            "What tables of pointspec %s have; keys of the header with ... may come\n"
            "several times, as for several samplers.\n",
            command->name);
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        field_list list = {stream, order[i], false};
        PS_TRY(ps_kind_visit_fields(command, print_field, &list, error));
    }
    return PSPEC_OK;
}

void ps_help_program(FILE *stream) {
    fputs("Usage: pointspec COMMAND [options] [FILE...]\n\n"
          "Power spectra of sampling patterns, with standard errors and error bounds.\n"
          "\nCommands:\n",
          stream);
    for (size_t i = 0; ps_commands[i] != NULL; i++) {
        fprintf(stream, "  %-15s%s\n", ps_commands[i]->name, ps_commands[i]->purpose);
    }
    fputs("\n"
          "pointspec COMMAND --help explains a command, its options and samplers.\n"
          "pointspec help COMMAND fields explains the columns and the header of its tables.\n"
          "pointspec -V, --version prints the version.\n"
          "\n"
          "FILE may be - for standard input. Where an option is repeated the last one\n"
          "counts, but --sampler, --set, --integrand and --bounds add; -- ends the options.\n"
          "Numbers may be written 1e6.\n"
          "\n"
          "Exit status: 0 done, 1 failed, 2 usage or bad input, 3 tolerance unreachable or\n"
          "check failed, 130 interrupted, 141 nobody reads the output.\n"
          "\nExamples:\n",
          stream);
    fprintf(stream, "  %s\n  %s\n", ps_commands[0]->examples[0], ps_commands[1]->examples[0]);
}
