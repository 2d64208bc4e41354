/* bench --scenes: what skipping is worth, scene by scene. */
#ifndef PS_CLI_COMMANDS_BENCH_SCENES_H
#define PS_CLI_COMMANDS_BENCH_SCENES_H

#include "request/request.h"
#include "tables/table.h"

/* Answers the scenes arguments->files with and without skips, in turn, without the cache, and
 * compares the answers of every question. A row for each result; PSPEC_ERROR_CHECK, after the table
 * is made, when answers differ by more than both sides announce. *out may be there after an error,
 * too. */
pspec_status ps_bench_scenes(ps_table **out, const ps_request *arguments,
                             ps_error *error) PS_MUST_CHECK;

#endif
