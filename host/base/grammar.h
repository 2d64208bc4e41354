/* "NAME[:key=value,...]": how samplers, BRDFs and their like are written on a command line. */
#ifndef PS_BASE_GRAMMAR_H
#define PS_BASE_GRAMMAR_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    PS_GRAMMAR_WORD = 64,
    PS_MOST_OWN_PARAMETERS = 8, /* of a thing that ps_grammar_texts reads */
}; /* bytes of a name or key with its NUL: no known one has half as many */

/* One key that a thing understands. */
typedef struct ps_parameter {
    const char *key;
    const char *default_value;
    const char *meaning; /* one line, for help */
} ps_parameter;

/* A piece of the parsed text; text is NULL where nothing was given. */
typedef struct ps_slice {
    const char *text;
    size_t length;
} ps_slice;

/* What may be said of the thing `name` of a kind ("sampler", "BRDF"). */
typedef struct ps_grammar {
    const char *kind, *name;
    const ps_parameter *const *parameters; /* ended by NULL */
    size_t num_own; /* the first of them: its own; the others are those of many things */
    /* Keys of other things, ended by key NULL: meaning says why not here; or NULL */
    const ps_parameter *others;
    size_t most_letters; /* of a value */
} ps_grammar;

/* Copies the name at the beginning of text, cut to what fits (a cut one is unknown anyway), and
 * returns what follows it: "" or ":key=value,...". */
const char *ps_grammar_name(const char *text, char name[PS_GRAMMAR_WORD]);

/* Copies a slice to text, which has room for its length and a NUL. */
void ps_slice_copy(char *text, ps_slice slice);

/* Reads rest, what follows the name: values[i] belongs to parameters[i]. Unknown keys name the
 * nearest known one; empty and repeated values are errors. Slices are of rest. */
pspec_status ps_grammar_values(const ps_grammar *grammar, const char *rest, ps_slice *values,
                               ps_error *error) PS_MUST_CHECK;

/* The values of a thing that has parameters of its own alone, own[] ended by key NULL, in their
 * order, as texts that may be paths; presets where nothing was given. *texts is one block, freed by
 * free. */
pspec_status ps_grammar_texts(char ***texts, const char *kind, const char *name,
                              const ps_parameter *own, const char *rest,
                              ps_error *error) PS_MUST_CHECK;

#endif
