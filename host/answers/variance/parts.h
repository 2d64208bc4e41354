/* What a table of variances may have besides: columns, lines of the header, and what is refused. A
 * part is a row of this list, and a file with its ps_variance_part. */
#ifndef PS_ANSWERS_VARIANCE_PARTS_H
#define PS_ANSWERS_VARIANCE_PARTS_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"
#include "fields/table.h"

/* In the order of their columns. */
#define PS_VARIANCE_PARTS(PART) PART(bounds) PART(rates) PART(rank) PART(paper)

enum { PS_MOST_PART_COLUMNS = 8 };

typedef struct ps_variance_part {
    const char *columns[PS_MOST_PART_COLUMNS + 1]; /* ended by NULL */
    /* A line near the beginning of the header; {0}: none */
    struct {
        const char *key, *text;
    } about;
    bool (*is_wanted)(const ps_request *request);
    /* Whose numbers have errors, which need several realizations; PS_NUM_OPTIONS: none */
    ps_option_id with_errors;
    /* Refuses what it cannot be asked of; NULL: nothing. */
    pspec_status (*check)(const ps_request *request, ps_error *error);
    /* A cell for each column. jobs are those of all questions, of which this is one. */
    void (*fill)(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand);
    /* Lines of the header: of a question, before its rows, and of all of them, at the end; NULL:
     * none. */
    pspec_status (*add_question)(ps_table *table, const ps_variance_job *job, ps_error *error);
    pspec_status (*add_all)(ps_table *table, const ps_request *request,
                            ps_variance_job *const *jobs, ps_error *error);
} ps_variance_part;

#define PS_DECLARE_PART(name) extern const ps_variance_part ps_variance_part_##name;
PS_VARIANCE_PARTS(PS_DECLARE_PART)
#define PS_COUNT_PART(name) +1
enum {
    PS_NUM_VARIANCE_PARTS = PS_VARIANCE_PARTS(PS_COUNT_PART),
    PS_MOST_PARTS_COLUMNS = PS_NUM_VARIANCE_PARTS * PS_MOST_PART_COLUMNS
};

/* What follows is of all parts that the request wants. */
pspec_status ps_variance_parts_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* Both write after the first num, and return how many there are then. */
size_t ps_variance_parts_columns(const char **columns, size_t num, const ps_request *request);
size_t ps_variance_parts_cells(ps_cell *cells, size_t num, const ps_request *request,
                               ps_variance_job *const *jobs, size_t question, size_t integrand);
pspec_status ps_variance_parts_add_about(ps_table *table, const ps_request *request,
                                         ps_error *error) PS_MUST_CHECK;
pspec_status ps_variance_parts_add_question(ps_table *table, const ps_request *request,
                                            const ps_variance_job *job,
                                            ps_error *error) PS_MUST_CHECK;
pspec_status ps_variance_parts_add_all(ps_table *table, const ps_request *request,
                                       ps_variance_job *const *jobs, ps_error *error) PS_MUST_CHECK;

#endif
