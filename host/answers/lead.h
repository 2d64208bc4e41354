/* What tables begin with: header lines, and the columns that say which of several questions a row
 * is of. */
#ifndef PS_ANSWERS_LEAD_H
#define PS_ANSWERS_LEAD_H

#include "request/request.h"
#include "fields/table.h"

/* Variances may have 9 columns and those of all parts, others have fewer. */
enum { PS_MOST_COLUMNS_AFTER_LEAD = 48 };

/* {0}: none. */
typedef struct ps_lead {
    size_t num;
    const char *names[2];
    ps_cell cells[2]; /* texts borrowed */
} ps_lead;

/* Of a question of a request: `sampler` where it has several samplers or sets,
 * `points` where it has several numbers
 * of points, of which this is the one that was asked for. */
ps_lead ps_lead_make(const ps_request *request, size_t question);

/* The first header lines of any table: version, number of the format, and the command line; NULL:
 * there is none. */
pspec_status ps_lead_add_origin(ps_table *table, const char *command_line,
                                ps_error *error) PS_MUST_CHECK;

/* The header line `sampler` of a question: the sampler, or the name of the set; none of files
 * alone. */
pspec_status ps_lead_add_source(ps_table *table, const ps_request *request, size_t question,
                                ps_error *error) PS_MUST_CHECK;

/* A table with these columns, then others [num]. */
pspec_status ps_lead_create_table(ps_table **out, const char *command, const ps_lead *lead,
                                  const char *const *columns, size_t num,
                                  ps_error *error) PS_MUST_CHECK;
/* A row of it: the cells of the lead, then others [num]. */
pspec_status ps_lead_add_row(ps_table *table, const ps_lead *lead, const ps_cell *cells, size_t num,
                             ps_error *error) PS_MUST_CHECK;

#endif
