/** @file
 * Answers: named fields, read without copies, and written to files. Included by pointspec.h.
 */
#ifndef POINTSPEC_ANSWER_H
#define POINTSPEC_ANSWER_H

#include "pointspec/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Answers
 *
 * An answer is what the program prints for the same question, to the bit: columns, the entries of
 * its header, and arrays of any shape. The manual page of each command, and pspec_fields_table(),
 * say which fields there are, with units and meanings. An answer needs neither its question nor the
 * context once it exists, and any number of threads may read it.
 * @{ */

typedef struct pspec_answer pspec_answer; /**< fields, and a verdict */

/** What a field is a part of. The numbers are never reused. */
typedef enum pspec_group {
    PSPEC_COLUMN = 0, /**< a value for each row */
    PSPEC_ARRAY = 1,  /**< of a shape of its own: points, coefficients, weights, a spectrum */
    PSPEC_STATE = 2,  /**< an array that others can be made of again, such as sums */
    PSPEC_ENTRY = 3 /**< one value: what was asked, by which engine it was answered, how exactly */
} pspec_group;

/** What the elements of a field are. The numbers are never reused. */
typedef enum pspec_type {
    PSPEC_F64 = 0,  /**< double; nan where a value is missing */
    PSPEC_I64 = 1,  /**< int64_t */
    PSPEC_C128 = 2, /**< two doubles, the real part and the imaginary one */
    PSPEC_TEXT = 3  /**< const char *, in UTF-8; "" where a value is missing */
} pspec_type;

/** A field: a view of what an answer, or the caller, keeps. Members may be added at its end. */
typedef struct pspec_field {
    size_t struct_size;  /**< sizeof(pspec_field), set by who makes it */
    const char *name;    /**< as the manual page has it */
    const char *unit;    /**< "" for none */
    pspec_group group;   /**< what it is a part of */
    pspec_type type;     /**< of its elements */
    unsigned rank;       /**< number of axes; 0 of entries, 1 of columns */
    const size_t *shape; /**< [rank], in C order; NULL where rank is 0 */
    size_t num;          /**< elements in all: the product of the shape */
    const void *data;    /**< [num], of the type */
} pspec_field;

/** Number of fields. */
PSPEC_EXPORT size_t pspec_answer_num_fields(const pspec_answer *answer);
/** Field i: the columns in their order, then arrays, then entries in theirs; NULL where there is no
 * such field. It belongs to the answer. The key of an entry may come several times, as "sampler"
 * where several were asked for. */
PSPEC_EXPORT const pspec_field *pspec_answer_field(const pspec_answer *answer, size_t i);
/** The first field of that name; NULL where there is none. */
PSPEC_EXPORT const pspec_field *pspec_answer_find(const pspec_answer *answer, const char *name);

/** "", or the sentence with which the program would end in exit status 3: a check found another
 * spectrum than the saved one or sets that are not homogeneous, a record was not repeated, a device
 * is not in order, a standard error was not reached. Belongs to the answer. */
PSPEC_EXPORT const char *pspec_answer_verdict(const pspec_answer *answer);

/** Writes the answer to a file that appears when it is complete, byte for byte as the program does.
 * format: a word of the option "format", such as "json", or NULL: by the ending of path, else csv.
 * NPY is float64 [rows][columns], with a JSON file of names and header beside it; NPZ has all
 * fields, and alone of all has arrays. The context is for the sentence of an error:
 * #PSPEC_ERROR_INVALID_ARGUMENT where there is no such format, for "-" (the library writes no
 * standard output), and for NPY of a table with words; #PSPEC_ERROR_IO where the file cannot be
 * written. */
PSPEC_EXPORT pspec_status pspec_answer_write(const pspec_answer *answer, pspec_context *context,
                                             const char *path, const char *format);

/** Reads what was written as NPZ, by this library or by the program: the same fields, to the bit,
 * on every machine, but for the verdict, which is "". A file that is none, truncated, damaged or of
 * another version is #PSPEC_ERROR_INPUT. */
PSPEC_EXPORT pspec_status pspec_answer_load(pspec_answer **out, pspec_context *context,
                                            const char *path);

/** The answer of the realizations of parts[0], then those of parts[1], and so on: answers, or what
 * was loaded of them, to one question about other realizations, as of seeds that differ.
 *
 * Guaranteed: what one question would have answered for all of them, but for the last digits of
 * the sums over realizations. These have about 106 bits (48 for single frequencies in single
 * precision), so that means over bins and their standard errors are the same doubles but for rare
 * last bits. The error is the largest of theirs. #PSPEC_ERROR_INPUT with the difference, where
 * kind, dimension, frequencies, bins or normalization differ, or where answers of the kind have no
 * state.
 *
 * Ranges of the realizations of one job (option "range"), in any order, are merged to a larger
 * range, and all of them to the answer of the job, to the bit. #PSPEC_ERROR_INPUT where they
 * overlap, leave a gap, or are of different jobs; #PSPEC_ERROR_TOLERANCE where the powers of all
 * need another plan. */
PSPEC_EXPORT pspec_status pspec_answer_merge(pspec_answer **out, pspec_context *context,
                                             const pspec_answer *const *parts, size_t num);

/** NULL is allowed. */
PSPEC_EXPORT void pspec_answer_destroy(pspec_answer *answer);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
