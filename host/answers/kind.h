/* The interface of every command, and of every kind of answer, and the tables that name them.
 *
 * A command is what program and library can be asked to do: one row says which options it takes, in
 * which words people read of it, and how it is run and planned. A kind of answer is a command that
 * prints one, which scenes have several of; both go the same way: check -> compute -> tabulate,
 * with pictures and other files made of the table. Its row says also what
 * its tables mean to who draws or compares them. A new one is a new file, a name and the rows of
 * its options in request/options.h and .c.
 */
#ifndef PS_ANSWERS_KIND_H
#define PS_ANSWERS_KIND_H

#include "answers/field.h"
#include "answers/figure.h"
#include "answers/plan_table.h"
#include "base/process/team.h"
#include "base/text.h"
#include "base/watch.h"
#include "device/device.h"
#include "plan/choose.h"
#include "request/options.h"
#include "fields/table.h"

/* Who is told of the work, and what there is already; {0}: nobody, and nothing. Each of the calls
 * may be NULL. */
typedef struct ps_answer_hooks {
    ps_watch watch;
    ps_device
        *device; /* borrowed; NULL: the one that the request names is opened where it is needed */
    /* Where kinds that `renew` leave what they computed with, for the same question of other sets
     * of the caller, to be given to `discard`: NULL there before the first. NULL: nowhere */
    void **kept;
    void *payload; /* of the calls */
    /* The work for the next sampler, for files, or for a scene begins. */
    void (*next)(void *payload);
    /* Question `number` (from 1) of num, which is one of that result of a scene, begins. */
    void (*begin_question)(void *payload, const char *result, size_t number, size_t num);
    /* The work is over, or has failed; what was made of it is written next. */
    void (*end)(void *payload);
    /* A whole sentence that is no error. */
    void (*warn)(void *payload, const char *sentence);
    /* The same, of a file that was asked for and is not there. */
    void (*tell_missing)(void *payload, const char *sentence);
    /* A finding of the doctor: "ok", "note" or "WRONG", what it is about, and the sentence. */
    void (*tell_finding)(void *payload, const char *word, const char *topic, const char *sentence);
    /* Asked between two questions of a scene, and after a failure: was it an interrupt? */
    bool (*is_interrupted)(void *payload);
    const ps_team *team; /* of a row that has `look_at_shares`; NULL: nobody else */
    bool is_shared; /* the range is that of one of several ranks, not one that somebody merges */
    /* Before the work for one sampler, and after it. */
    void (*tell_plan)(void *payload, const ps_plan *plan);
    void (*tell_profile)(void *payload, const ps_profile_row *rows, size_t num_rows);
} ps_answer_hooks;

/* Call the hooks `next` and `end`, if there are such. */
void ps_answer_begin_next(const ps_answer_hooks *hooks);
void ps_answer_end(const ps_answer_hooks *hooks);
/* Begins the work of a job, whose question gets who hears of it, and the device that is open. */
void ps_answer_begin_job(const ps_answer_hooks *hooks, ps_watch *watch, ps_device **open_device);
/* false where nobody can say. */
bool ps_answer_is_interrupted(const ps_answer_hooks *hooks);
/* Calls the hook `warn` with a sentence, if there is somebody to hear it. */
void ps_answer_warn(const ps_answer_hooks *hooks, const char *format, ...) PS_PRINTF(2, 3);
/* The same with a sentence that may be empty: then nobody hears it. */
void ps_answer_warn_of(const ps_answer_hooks *hooks, const char *sentence);
void ps_answer_tell_missing(const ps_answer_hooks *hooks, const char *format, ...) PS_PRINTF(2, 3);
/* Calls the hook `tell_profile`; device NULL: the work needed none. */
void ps_answer_tell_profile(const ps_answer_hooks *hooks, const ps_device *device);

typedef struct ps_answer {
    /* Its arrays are those that the request asks for: "full", the averaged periodogram on the whole
     * box, [2K+1]^d, where request->wants_array, or wants_picture in the plane, and there is one,
     * and by --full; "full_standard_error", by --full or where request->wants_errors, too;
     * "coefficients", where request->wants_coefficients or by --coefficients; "scatter", a row of
     * them of every set, [M][2K+1], by --scatter; "weights" of the only rule; "coordinates" of the
     * points of a sampler */
    ps_table *table;
    /* PSPEC_ERROR_CHECK where differences were found, PSPEC_ERROR_TOLERANCE where a table that is
     * there all the same misses what was asked; else status PSPEC_OK */
    ps_error verdict;
} ps_answer;

/* Tables of two answers to the same question, made with other engines, or of other realizations, at
 * a row; modes: of all rows. */
typedef struct ps_both_tables {
    const ps_table *a, *b;
    size_t row;
    double modes;
} ps_both_tables;

/* A value that is compared in every row, or that of the header. */
typedef struct ps_compared_field {
    const char *value, *error; /* its name, and that of its standard error */
    bool is_of_header;         /* rows may be others then */
    /* By how much both sides' headers allow it to differ; NULL: it is a text, and does not */
    double (*bound)(const ps_both_tables *both, const char *value);
} ps_compared_field;
double ps_compared_power_bound(const ps_both_tables *both, const char *value);
double ps_compared_predicted_bound(const ps_both_tables *both, const char *value);
double ps_compared_rule_bound(const ps_both_tables *both, const char *value);
double ps_compared_variance_bound(const ps_both_tables *both, const char *value);

/* A job before it runs, for ranks that share its realizations. */
typedef struct ps_outlook {
    bool counts;               /* asked: how many realizations there are in files, too */
    uint64_t num_realizations; /* 0: unknown */
    unsigned num_jobs;         /* one after the other, of so many realizations each */
    const char *alone;         /* why ranks do not share them; NULL: they may */
    ps_text alike; /* lines "thing: value" that ranks have alike: devices and plans; freed by who
                      asked, also after an error */
} ps_outlook;

/* Answers to one question, in the order of their realizations. */
typedef struct ps_parts {
    const ps_table *const *tables; /* [num], with their state */
    const char *const *names;      /* [num], in sentences: a file in quotes, or "answer 2" */
    size_t num;                    /* at least 1 */
    const char *command_line;      /* of who merges, for the header */
    const char *device;            /* a selector of theirs; NULL: the default */
    const char *cache_folder;      /* of sets that are kept; NULL: none */
    const ps_answer_hooks *hooks;  /* who hears of work that merging is; NULL: nobody */
    const ps_kind *kind;           /* set by ps_answer_merge */
    /* NULL, or what ranges of a job are answers to together: the answer is that of the job then, as
     * one process would have it, and does not tell of the parts */
    const ps_request *request;
} ps_parts;

typedef struct ps_command {
    const char *name;

    /* Its words. */
    const char *purpose;     /* one line */
    const char *usage;       /* after "pointspec ", for example "power [options] [FILE...]" */
    const char *description; /* a paragraph for --help */
    const char *examples[2]; /* complete command lines, run by the tests */

    /* What it takes, and how it is run. */
    ps_command_set takes; /* whose options: its bit in their table; those that belong to a question
                             are the same on every device */
    /* Words of --format of points, the default first, and of --weights; NULL: formats of tables,
     * and words of the table of options */
    const char *formats, *weights;
    bool has_words;      /* its rows always have some, so that its tables are no NPY */
    bool has_late_rows;  /* they come over minutes, so that its tables are no text */
    ps_domain samples;   /* which samplers it takes */
    const char *counted; /* what its work counts: "realizations" */
    const char *speaker; /* who says its warnings; NULL: "pointspec" */
    bool makes_points;   /* output and format are of points, not of a table */
    bool makes_folder;   /* which --output names: it has no default */
    /* All of it; NULL: ps_answer_produce does it. *out is {0} before, and freed by ps_answer_free,
     * also after an error */
    pspec_status (*run)(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error);
    /* May a team of processes share the work? In `run` they keep what each made on the disk until
     * they meet, and the first goes on with all of it; without one `compute` is that of a team,
     * whose members give each other rows of realizations (jobs/rows). *num: how many could have
     * some. Why not is left as the end of a sentence in *why, {0} before. NULL: it may not */
    pspec_status (*look_at_shares)(uint64_t *num, ps_error *why, const ps_request *request,
                                   ps_error *error);
    /* Adds what it would come to; NULL: it is not planned. */
    pspec_status (*plan)(ps_planner *planner, const ps_request *request, ps_error *error);
    const ps_field_row *const *fields; /* lists of all that its tables have, ended by NULL */

    /* The question of a kind of answer. */
    bool is_of_host;      /* no device is needed, whatever is asked */
    bool may_lack_device; /* without any the host does the same work */
    bool has_decibels;    /* its pictures may be in dB, too */
    bool has_images; /* its answers may have a picture, which scenes ask for by the key pictures */
    bool has_arrays; /* its answers may have an array, which scenes ask for by the key arrays, */
    bool has_coefficients; /* or coefficients, by arrays: coefficients */

    /* Does a scene's default of this option say nothing to it? NULL: all are taken. */
    bool (*leaves_default)(ps_option_id id);
    /* What a command refuses before it looks at its outputs; NULL: nothing. */
    pspec_status (*check_arguments)(const ps_request *request, ps_error *error);
    /* What can be refused is refused before the first hour of work: do the options fit together? */
    pspec_status (*check_question)(const ps_request *request, ps_error *error);

    /* How many jobs with a checkpoint each it is; NULL: one for each of its questions. */
    size_t (*count_jobs)(const ps_request *request);

    /* The answer. All the work: *out is what the following are made of, given to discard, also
     * after an error. It borrows from the request. *out is NULL before, or of a row that renews
     * what it was before of a request that differs in sets of the caller alone. */
    pspec_status (*compute)(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error);
    /* *out is {0} before, and freed by ps_answer_free, also after an error. */
    pspec_status (*tabulate)(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error);
    /* The answer of all realizations of the parts, which are of the kind; NULL: its answers have no
     * state. *out is as that of tabulate. */
    pspec_status (*merge)(ps_answer *out, const ps_parts *parts, ps_error *error);
    /* What ranks that share the realizations of a job know before it begins; NULL: nothing. */
    pspec_status (*look_ahead)(ps_outlook *out, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error);
    void (*discard)(void *computed); /* NULL is allowed */
    bool renews;

    /* What the tables mean. */
    const char *const *summary; /* header entries that are columns of a summary, ended by NULL */
    const ps_picture_kind *pictures; /* one at least; ended by one that nothing makes */
    const char *const *sentences;    /* header entries that pages show; ended by NULL, NULL: none */
    bool has_few_rows;               /* pages show all of them, before the summary */
    const char *row_name; /* the column that names a row, whose `value` and `standard_error` pages
                             show side by side for all questions; NULL: rows have no names */
    const ps_compared_field
        *compared; /* of two answers to the same question; ended by .value = NULL */
} ps_command;

/* A command that has an answer, and all that is below its question. */
typedef ps_command ps_kind;

/* ps_kind_power, .., and ps_command_run, .. */
#define PS_DECLARE_KIND(name) extern const ps_kind ps_kind_##name;
#define PS_DECLARE_COMMAND(name) extern const ps_command ps_command_##name;
PS_COMMANDS(PS_DECLARE_KIND, PS_DECLARE_COMMAND, PS_DECLARE_COMMAND, PS_DECLARE_COMMAND)
/* The same in tables. */
#define PS_KIND_OF(name) &ps_kind_##name,
#define PS_COMMAND_OF(name) &ps_command_##name,

/* Names of all kinds of answers in sentences, "power, angular, .., check, ", and in usages,
 * "power|angular|..|check|". */
#define PS_COMMA_AFTER(name) #name ", "
#define PS_BAR_AFTER(name) #name "|"
#define PS_KINDS_IN_SENTENCE                                                                       \
    PS_COMMANDS(PS_COMMA_AFTER, PS_NO_COMMAND, PS_NO_COMMAND, PS_NO_COMMAND)
#define PS_KINDS_IN_USAGE PS_COMMANDS(PS_BAR_AFTER, PS_NO_COMMAND, PS_NO_COMMAND, PS_NO_COMMAND)

/* All kinds that are commands; ended by NULL. */
extern const ps_kind *const ps_kinds[];

/* Points of a sampler, as a result of a scene. None of these: the command sample writes point
 * files, not a table. */
extern const ps_kind ps_kind_points;

/* Does the option belong to the question? */
static inline bool ps_kind_asks(const ps_kind *kind, ps_option_id id) {
    return (ps_options[id].questions & kind->takes) != 0;
}
/* What opening a device for it comes to: kinds that may lack one begin without, and fail themselves
 * where that one was named. */
static inline pspec_status ps_kind_without_device(const ps_kind *kind, pspec_status opened) {
    return opened == PSPEC_ERROR_NO_DEVICE && kind->may_lack_device ? PSPEC_OK : opened;
}
/* Every command takes --help, also when the table of options does not say so. */
static inline bool ps_command_takes(const ps_command *command, ps_option_id id) {
    return id == PS_OPTION_HELP ||
           ((ps_options[id].questions | ps_options[id].commands) & command->takes) != 0;
}
/* The values that the command admits for the option, "one|two|FILE"; NULL for a flag. */
const char *ps_command_words(const ps_command *command, ps_option_id id);
/* The command of a table, which NULL ends, whose name is nearest, by *distance: 0 for that very
 * name. */
const ps_command *ps_command_nearest(const ps_command *const *table, const char *name,
                                     size_t *distance);

/* Why inputs may not be read by several, who share the work: they come once, or are of a caller,
 * who is asked by one thread. */
pspec_status ps_answer_look_at_inputs(const ps_request *request, ps_error *why) PS_MUST_CHECK;
/* `look_at_shares` of kinds whose realizations are rows: *num of them, UINT64_MAX where nobody has
 * counted. */
pspec_status ps_answer_look_at_rows(uint64_t *num, ps_error *why, const ps_request *request,
                                    ps_error *error) PS_MUST_CHECK;

/* Computes and tabulates, and keeps nothing else; in a team (hooks->team) the table is that of the
 * member that leads. *out is freed by ps_answer_free, also after an error. A check that found
 * differences is no error: the answer has the verdict. */
pspec_status ps_answer_make(ps_answer *out, const ps_kind *kind, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
void ps_answer_free(ps_answer *answer);

/* How far the tables are apart, in units of what their headers announce, so that 1 is what is
 * allowed. Infinite where one has rows that the other lacks. */
double ps_answer_compare(const ps_kind *kind, const ps_table *a, const ps_table *b);

/* The answer of the realizations of the first part, then those of the second, and so on. What one
 * job would have answered, but for the last digits of the sums over realizations, which have about
 * 106 bits (48 for single frequencies in single precision): means over bins and their standard
 * errors are the same doubles but for rare last bits; powers of single frequencies in single
 * precision agree to 1e-13. The numerical error is the largest of theirs. Parts without state, and
 * answers to different questions (kind, dimension, frequencies, bins, normalization), are
 * PSPEC_ERROR_INPUT; numbers of points, engines, precisions and tolerances may differ. Ranges of
 * the realizations of one job (--range), in any order, are merged to a larger one, and all of them
 * to the answer of the job, to the bit; PSPEC_ERROR_TOLERANCE where its powers need another plan.
 * *out is freed by ps_answer_free, also after an error. */
pspec_status ps_answer_merge(ps_answer *out, const ps_parts *parts, ps_error *error) PS_MUST_CHECK;

/* What a command that prints the kind does: whatever can be refused is refused before hours of
 * work, then it is computed, and the files are written that the request names: table (an output
 * NULL is none), others, picture. *out is freed by ps_answer_free, also after an error; differences
 * that a check found are its verdict, and no error. */
pspec_status ps_answer_produce(ps_answer *out, const ps_kind *kind, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* Its parts before and after the work, for who computes the answer in another way. */
pspec_status ps_answer_check_outputs(ps_table_format *format, const ps_kind *kind,
                                     const ps_request *request, const ps_answer_hooks *hooks,
                                     ps_error *error) PS_MUST_CHECK;
pspec_status ps_answer_write(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             ps_table_format format, const ps_answer_hooks *hooks,
                             ps_error *error) PS_MUST_CHECK;

#endif
