/* Files of coefficients of real functions: an NPY array, or lines of text. Whatever they are of, a
 * coefficient and its opposite, that of -k or -m, are conjugates up to a sign. What is not in a
 * file is 0. */
#ifndef PS_INTEGRANDS_FILES_COEFFICIENT_FILE_H
#define PS_INTEGRANDS_FILES_COEFFICIENT_FILE_H

#include "files/npy_array.h"
#include "integrands/integrand.h"

/* Sizes above that are refused: squares of sums of them are numbers. */
#define PS_LARGEST_COEFFICIENT 1e100

/* Are sums of products of these numbers numbers in single precision? */
bool ps_fit_single(const double *numbers, size_t num);

/* What was read: array, or rows where there is none. */
typedef struct ps_coefficient_file {
    bool is_array;
    ps_npy_array array;
    double *rows; /* [num_rows][columns + 1], the last of each its line */
    size_t num_rows;
} ps_coefficient_file;

/* columns: of a text. The file is a regular one, for it is read more than once. */
pspec_status ps_coefficient_file_read(ps_coefficient_file *out, const char *path, unsigned columns,
                                      ps_error *error) PS_MUST_CHECK;
void ps_coefficient_file_free(ps_coefficient_file *file);

/* A coefficient, or what its opposite says that it is. */
typedef struct ps_coefficient {
    int32_t key[PS_MAX_DIMENSION]; /* k, or l and m, of the one that stands for both; then zeros */
    bool is_opposite;              /* it was said of the other one */
    bool is_its_own;               /* opposite, and so a real number */
    double re, im;
    size_t line; /* 0: of an array */
} ps_coefficient;

typedef struct ps_coefficient_list {
    const char *path;  /* for messages, */
    unsigned num_keys; /* and what keys are: "k = (1, -2)" where this is a dimension, */
    bool on_sphere;    /* or "l = 2, m = 1" */
    bool is_half;      /* one of both is given, and says what the other is */
    size_t num;
    ps_coefficient *all;
} ps_coefficient_list;

/* Sorts by key, and makes one of each two that stand for the same; zeros are left out. What is
 * given twice, and what is of no real function, is PSPEC_ERROR_INPUT. */
pspec_status ps_coefficients_merge(ps_coefficient_list *list, ps_error *error) PS_MUST_CHECK;

/* A whole number of a row, or an error that says what it should be. */
pspec_status ps_coefficient_key(const ps_coefficient_list *list, const double *row, unsigned column,
                                unsigned num_columns, const char *name, int32_t least, int32_t most,
                                int32_t *out, ps_error *error) PS_MUST_CHECK;

/* Copies the path that a user gave; "" and standard input are errors. */
pspec_status ps_integrand_copy_path(const ps_integrand *integrand, const char *text, char **path,
                                    ps_error *error) PS_MUST_CHECK;

#endif
