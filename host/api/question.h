/* What a question of the library keeps: the request that its options make, what that borrows, and
 * the caller's patterns. */
#ifndef PS_API_QUESTION_H
#define PS_API_QUESTION_H

#include "api/public_objects.h"
#include "base/memory.h"
#include "base/text.h"

/* Patterns of one average: kept ones, or those that a function of the caller gives. */
typedef struct ps_caller_set {
    ps_text name; /* PS_CALLER_POINTS: they are the points of the question, as files are */
    ps_text word; /* NAME=NAME, as --set has it, of the first of its name */
    size_t count; /* sets of its name before it: which number of points it has */
    size_t num_kept, capacity;
    pspec_pattern *kept; /* with copies of their numbers in memory */
    ps_pool memory;
    size_t num_numbers; /* in it */
    uint64_t num;       /* that give is asked for at most */
    pspec_give give;    /* NULL: none */
    void *payload;
} ps_caller_set;

typedef struct ps_caller_integrand {
    pspec_values values;
    void *payload;
} ps_caller_integrand;

struct pspec_question {
    pspec_context *context;
    const ps_command *row;
    ps_request request; /* of the options; files are those below */
    ps_text words;      /* the same as a command line has them */
    size_t num_texts, texts_capacity;
    char **texts; /* owned values, which the request borrows */
    size_t num_files, files_capacity;
    const char **files; /* of the texts */
    size_t num_arrays, arrays_capacity;
    FILE **arrays; /* numbers of the caller in files without a name */
    size_t num_sets, sets_capacity;
    ps_caller_set *sets;
    size_t num_integrands; /* of the caller */
    ps_caller_integrand integrands[PS_MAX_INTEGRANDS];
    ps_given_integrand given[PS_MAX_INTEGRANDS]; /* which the request names */
    void *kept; /* what the last answer was computed with (ps_answer_hooks); NULL: nothing */
    uint64_t kept_limit; /* of memory, at the last answer */
};

/* Options change, and what was computed with others is of no use. */
void ps_public_forget(pspec_question *question);

/* The path that stands for points of the caller without a set of their own. */
#define PS_CALLER_POINTS "memory"

#endif
