/* Morphs (math/morph.h) as samplers and --morph name them: none, diffuse, glossy or phong, the last
 * two with an exponent n. */
#ifndef PS_SAMPLERS_MORPH_WORDS_H
#define PS_SAMPLERS_MORPH_WORDS_H

#include "base/grammar.h"
#include "math/morph.h"

/* What was said, and of whom, for sentences: "sampler", "sobol". */
typedef struct ps_morph_words {
    const char *whose, *name;
    ps_slice kind, exponent; /* text NULL: not said; without a kind there is no morph */
} ps_morph_words;

pspec_status ps_morph_parse(ps_morph *out, const ps_morph_words *words,
                            ps_error *error) PS_MUST_CHECK;

/* "none", "diffuse", "glossy,n=30": as after morph= of a sampler. */
typedef struct ps_morph_text {
    char text[48];
} ps_morph_text;
ps_morph_text ps_morph_write(const ps_morph *morph);

#endif
