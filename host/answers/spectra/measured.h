/* What a table of spectra is made of, whether jobs have just run or answers are merged. */
#ifndef PS_ANSWERS_SPECTRA_MEASURED_H
#define PS_ANSWERS_SPECTRA_MEASURED_H

#include "answers/lead.h"
#include "answers/spectra/question.h"
#include "fields/table.h"

/* Of one question. All is borrowed. */
typedef struct ps_measured {
    ps_lead lead;
    const ps_spectrum *spectrum;
    const ps_mean *c2; /* of pair sums; else NULL */
    bool are_pair_sums;
    bool is_one_for_all;                    /* realizations are equal, and one was computed */
    double error, self_check, length_error; /* as ps_spectrum_sums has them */
    const ps_sequential_look *look;         /* NULL: nobody looked */
    ps_realization_range range;             /* of the realizations of a job; {0}: all of them */
    uint64_t num_all;                       /* of that job */
    /* Header entries, of ps_told_keys, that do not follow from numbers: of points, of the device */
    ps_table *told;
    const ps_power_job *job; /* NULL: of a merged answer */
} ps_measured;

/* In the order of headers; ended by NULL. */
extern const char *const ps_told_keys[];

/* Of jobs that have run: *out is [num], and freed by ps_measured_free, also after an error. */
pspec_status ps_measured_of_jobs(ps_measured **out, const ps_request *arguments,
                                 const ps_power_job *const *jobs, size_t num,
                                 ps_error *error) PS_MUST_CHECK;
void ps_measured_free(ps_measured *all, size_t num);

/* Header lines of the only job, which has run: those it begins with, or the others
 * (spectrum_header.h). */
pspec_status ps_header_add_job(ps_table *table, const ps_request *arguments,
                               const ps_power_job *job, bool begins, ps_error *error) PS_MUST_CHECK;

/* What the tables of a kind have: header lines, and the rows of one question after the other. */
typedef struct ps_spectra_table {
    const char *name; /* of the command */
    /* Writes those behind the columns of the lead, and returns how many there are. */
    size_t (*choose_columns)(const char *names[PS_MOST_COLUMNS_AFTER_LEAD], const ps_request *,
                             const ps_measured *first);
    /* The rows of a question, which begin with the cells of its lead. */
    pspec_status (*add_rows)(ps_table *, const ps_request *, const ps_measured *, ps_error *);
    /* Arrays of the first question; NULL: none. */
    pspec_status (*add_arrays)(ps_table *, const ps_request *, const ps_measured *, ps_error *);
} ps_spectra_table;

/* *out, which is NULL before, is the caller's, also after an error. */
pspec_status ps_spectra_make_table(ps_table **out, const ps_spectra_table *kind,
                                   const ps_request *request, const ps_measured *all, size_t num,
                                   ps_error *error) PS_MUST_CHECK;

#endif
