/* A plan of the public library: a question and what runs it. Private to public_plan.c, which makes
 * it, and public_plan_run.c, which runs it. */
#ifndef PS_API_PUBLIC_PLAN_H
#define PS_API_PUBLIC_PLAN_H

#include "api/gather.h"
#include "api/public_objects.h"
#include "api/public_request.h"
#include "base/text.h"
#include "api/kept_patterns.h"
#include "jobs/runner.h"
#include "plan/needs.h"

struct pspec_plan {
    pspec_context *context;
    ps_public_request request; /* checked; its frequencies are the plan's, its texts the caller's */
    ps_text engine_name;       /* what the request pointed to; "" is any */
    ps_problem problem;
    ps_plan choice;
    ps_needs needs;
    ps_runner runner;
    ps_gather *gather;
    ps_kept_patterns kept; /* for a second plan */
    size_t num_again;      /* of them, that the second plan has had */
    ps_text text;
    bool has_failed;   /* its sums may hold a part of a batch */
    bool has_begun;    /* patterns were run */
    double last_asked; /* seconds: when progress was called last */
};

/* The plan for powers that nobody has measured, as if nothing had been run. has_weights: do
 * patterns have some? */
pspec_status ps_public_plan_begin_anew(pspec_plan *plan, bool has_weights) PS_MUST_CHECK;

#endif
