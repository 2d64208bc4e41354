/* The options of all commands, which are the keys of scene files, one row per ps_option_id: parser,
 * usage and --help come from here.
 */
#ifndef PS_REQUEST_OPTIONS_H
#define PS_REQUEST_OPTIONS_H

#include "request/request.h"

/* The commands, in the order of --help (answers/kind.h has their rows): kinds of answers, what else
 * can be planned, what else has tables, and what the library has not. A new one is a name here, and
 * a bit in the rows of the options that it takes. */
#define PS_COMMANDS(KIND, PLANNED, OTHER, PROGRAM)                                                 \
    KIND(power)                                                                                    \
    KIND(angular)                                                                                  \
    KIND(pairs)                                                                                    \
    KIND(quadrature)                                                                               \
    KIND(truncation)                                                                               \
    KIND(variance)                                                                                 \
    KIND(shade)                                                                                    \
    KIND(interpolation)                                                                            \
    KIND(occlusion)                                                                                \
    KIND(measure)                                                                                  \
    KIND(light)                                                                                    \
    PLANNED(sample)                                                                                \
    PLANNED(convert)                                                                               \
    KIND(check)                                                                                    \
    OTHER(merge)                                                                                   \
    PLANNED(run)                                                                                   \
    PLANNED(report)                                                                                \
    OTHER(plan)                                                                                    \
    PROGRAM(bench)                                                                                 \
    PROGRAM(stress)                                                                                \
    OTHER(devices)                                                                                 \
    PROGRAM(doctor)

#define PS_NO_COMMAND(name)
#define PS_COMMAND_NUMBER(name) PS_COMMAND_##name,
typedef enum ps_command_id {
    PS_COMMANDS(PS_COMMAND_NUMBER, PS_COMMAND_NUMBER, PS_COMMAND_NUMBER, PS_COMMAND_NUMBER)
        PS_NUM_COMMANDS
} ps_command_id;

/* A set of commands. */
typedef uint32_t ps_command_set;
#define PS_COMMAND_BIT(name) (UINT32_C(1) << PS_COMMAND_##name)

typedef struct ps_option ps_option;

/* An option that was said. */
typedef struct ps_said {
    const ps_option *option;
    const char *shown;   /* as it was said, "-n" */
    const char *words;   /* the values that the command at hand admits, "one|two" */
    const char *text;    /* its value; NULL for a flag */
    ps_request *request; /* that takes it */
} ps_said;

/* Stores the value in the request, or says what is wrong with it. */
typedef pspec_status ps_option_setter(const ps_said *said, ps_error *error);

/* The file that a value makes a question read, a part of the value; NULL: none. */
typedef const char *ps_option_input(const char *words, const char *value);

/* The value itself; that of --weights where it is a file; that of "NAME:file=PATH". */
ps_option_input ps_input_all, ps_input_of_weights, ps_input_of_named;
/* The path alone, in an empty text, which is to be freed in either case: that of a name ends where
 * its next parameter begins. path: what find says. */
pspec_status ps_input_keep(ps_text *out, ps_option_input *find, const char *path,
                           ps_error *error) PS_MUST_CHECK;

/* What kind of points an option is about. */
typedef enum ps_option_source { PS_OF_BOTH, PS_OF_SAMPLERS, PS_OF_FILES } ps_option_source;

struct ps_option {
    const char *name;    /* without its dashes */
    const char *metavar; /* NULL: takes no value */
    const char *help;
    /* The kinds of answers to whose question it belongs: it is a key of scenes there, too */
    ps_command_set questions;
    ps_command_set
        commands; /* others that take it: how they compute, and what becomes of the results */
    ps_option_setter *set;
    size_t offset; /* of the field of ps_request, for setters that serve several options */
    /* Of the number of texts, where the option may be repeated: offset is of their array, which has
     * room for maximum of them. 0: the last one counts. */
    size_t offset_of_number;
    uint64_t minimum, maximum;
    char letter; /* 0: none */
    ps_option_source source;
    /* NULL: no value of it names a file that is read. Else offset is of the field with the text or
     * of the array of texts */
    ps_option_input *input;
    /* It compares samplers or numbers of points: a scene asks all of them in one question */
    bool is_of_all;
    bool is_output; /* its value names a file that is written; offset is of that text */
};

extern const ps_option ps_options[PS_NUM_OPTIONS];

/* An option as it was said, "-n", "--points" or the key "points"; the long form of one that was
 * not. */
typedef struct ps_shown_option {
    char text[32];
} ps_shown_option;
ps_shown_option ps_option_show(const ps_request *request, ps_option_id id);

/* Refuses two options that were given and do not go together for that taker. */
pspec_status ps_option_pairs_check(const ps_request *request, ps_command_id taker,
                                   ps_error *error) PS_MUST_CHECK;
/* Is there a row that says that a does not go with b? */
bool ps_option_is_refused(ps_option_id a, ps_option_id b);
/* Refuses options of the other one of torus and sphere. */
pspec_status ps_option_domains_check(const ps_request *request, bool on_sphere,
                                     ps_error *error) PS_MUST_CHECK;

/* Calls the setter of the option, whose form the request has already. */
pspec_status ps_option_set(ps_request *request, ps_option_id id, const char *words,
                           const char *value, ps_error *error) PS_MUST_CHECK;

/* A file that a request reads or writes. */
typedef struct ps_request_file {
    ps_shown_option option; /* that names it */
    const char *path;       /* "-" is standard input; borrowed */
} ps_request_file;
/* Every file that is read, in the order of options, then those of points: visit is called for each
 * until it fails. The only list: caches, records and checks of outputs ask it. */
typedef pspec_status ps_request_visit_input(void *payload, const ps_request_file *input,
                                            ps_error *error);
pspec_status ps_request_visit_inputs(const ps_request *request, ps_request_visit_input *visit,
                                     void *payload, ps_error *error) PS_MUST_CHECK;

/* Those of options alone. */
pspec_status ps_request_visit_option_inputs(const ps_request *request,
                                            ps_request_visit_input *visit, void *payload,
                                            ps_error *error) PS_MUST_CHECK;

/* Is it a stream, as standard input and pipes are, which nobody reads twice? */
bool ps_request_file_comes_once(const ps_request_file *input);

/* The files that options name to be written, that of --output first: how many. */
size_t ps_request_outputs(ps_request_file out[PS_NUM_OPTIONS], const ps_request *request);

/* What a value of --weights is where these words are admitted, "equal|column|FILE": the name of a
 * file where it is none of the others and FILE is admitted; PS_WEIGHTS_GIVEN: nothing. */
ps_weights_kind ps_weights_find(const char *words, const char *value);

/* How far a name that somebody typed is from a known one. 0: that very name; a beginning of it
 * counts as one letter. */
size_t ps_name_distance(const char *typed, const char *known);

#endif
