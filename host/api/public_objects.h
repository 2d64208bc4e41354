/* What the files of the public library (pointspec/pointspec.h) know of each other's objects. */
#ifndef PS_API_PUBLIC_OBJECTS_H
#define PS_API_PUBLIC_OBJECTS_H

#include "base/log.h"
#include "base/watch.h"
#include "device/lender.h"
#include "spectra/spectrum_sums.h"
#include "tables/table.h"

struct pspec_context {
    ps_error error;
    char *selector;
    ps_device *device; /* NULL until a plan needs it */
    ps_lender *lender; /* NULL until a sampler wants it */
    uint64_t memory_limit;
    ps_watch watch; /* the progress callback */
    ps_log log;
    ps_log warnings;
};

/* A table with its verdict, "" where nothing is wrong; both are taken over even when it fails. */
pspec_status ps_public_table(pspec_table **out, ps_table *table, const char *verdict,
                             ps_error *error) PS_MUST_CHECK;

/* Opens the context's device unless it is open. */
pspec_status ps_context_open_device(pspec_context *context) PS_MUST_CHECK;

/* Of devices for samplers, opened when they are needed and kept as long as the context. */
pspec_status ps_context_lend(pspec_context *context, ps_lender **lender) PS_MUST_CHECK;

/* A spectrum of sums, which are taken over even when it fails. */
pspec_status ps_public_spectrum(pspec_spectrum **out, ps_spectrum_sums *sums, const ps_bins *bins,
                                ps_error *error) PS_MUST_CHECK;

/* What the spectrum was made of; belongs to it. */
const ps_spectrum_sums *ps_public_sums(const pspec_spectrum *spectrum);

/* The plan's realizations, all of them in the sums; out of an engine within the tolerance. */
pspec_status ps_plan_sums(pspec_plan *plan, ps_spectrum_sums *out,
                          const ps_bins **bins) PS_MUST_CHECK;
pspec_context *ps_plan_context(const pspec_plan *plan);

#endif
