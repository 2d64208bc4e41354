/* Light as the option --integrand names it, for shade and truncation, and what tables say of it. */
#ifndef PS_ANSWERS_QUADRATURE_LIGHT_HEADER_H
#define PS_ANSWERS_QUADRATURE_LIGHT_HEADER_H

#include "answers/field.h"
#include "jobs/shade/light.h"
#include "request/request.h"
#include "fields/table.h"

/* One integrand, or none where it is not needed; not one of the caller, whose coefficients nobody
 * knows. */
pspec_status ps_light_check(const ps_request *request, bool is_needed,
                            ps_error *error) PS_MUST_CHECK;
pspec_status ps_light_add_header(ps_table *table, const ps_request *request, const ps_light *light,
                                 ps_error *error) PS_MUST_CHECK;
/* The rows that declare that. */
extern const ps_field_row ps_fields_light[];

#endif
