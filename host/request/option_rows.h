/* How the rows of options.c are written: fields of their setters, limits, and sets of commands.
 * Private to host/request. */
#ifndef PS_REQUEST_OPTION_ROWS_H
#define PS_REQUEST_OPTION_ROWS_H

#include "request/option_setters.h"

#include <stddef.h>

#define NAMED(dashed, shortened, value) .name = dashed, .letter = shortened, .metavar = value
#define OF(kinds, others) .questions = kinds, .commands = others
#define FLAG(field) .set = ps_set_flag, .offset = offsetof(ps_request, field)
#define TEXT(field) .set = ps_set_text, .offset = offsetof(ps_request, field)
#define FILE_OUT(field) TEXT(field), .is_output = true
#define TEXTS(field, most)                                                                         \
    .set = ps_add_text, .offset = offsetof(ps_request, field),                                     \
    .offset_of_number = offsetof(ps_request, num_##field), .maximum = most
#define WORD(field) .set = ps_set_word, .offset = offsetof(ps_request, field)
#define RANGE(field) .set = ps_set_range, .offset = offsetof(ps_request, field)
#define POSITIVE(field) .set = ps_set_positive, .offset = offsetof(ps_request, field)
#define SHARE(field) .set = ps_set_share, .offset = offsetof(ps_request, field)
#define COUNT(field) .set = ps_set_count, .offset = offsetof(ps_request, field)

#define QUARTER_TURN(field) .set = ps_set_quarter_turn, .offset = offsetof(ps_request, field)

/* 10^10 points of the plane are 160 GB. */
#define MOST_POINTS UINT64_C(10000000000)
/* A set has so many trials at most: their moves are in memory. */
#define MOST_SHIFTS UINT64_C(1000000)
#define MOST_REALIZATIONS UINT64_C(1000000000000)
/* Of a pixel: a quarter of these points is in memory. */
#define MOST_REFERENCE UINT64_C(4000000)

/* Sets of commands that many options have: kinds of spectra, those of them on the sphere, kinds
 * that look at point sets, those that have engines, all that read sets from files, kinds without
 * sets, those that have a lobe, those that have a curve for each of several, and those that may
 * have points of the torus, and of the sphere; those that have checkpoints; commands that are no
 * kinds and read points, those that make pages, those that try engines, and those whose output is
 * a table. */
#define BIT PS_COMMAND_BIT
#define SPHERES (BIT(angular) | BIT(pairs))
#define SPECTRA (BIT(power) | SPHERES)
#define RULES (BIT(quadrature) | BIT(shade))
#define SETS (SPECTRA | RULES | BIT(check))
#define ENGINES (SETS | BIT(variance))
#define READERS (ENGINES | BIT(interpolation) | BIT(occlusion) | BIT(measure))
#define SETLESS (BIT(truncation) | BIT(light))
#define LOBES (RULES | BIT(truncation))
#define SERIES                                                                                     \
    (SPECTRA | RULES | BIT(variance) | BIT(interpolation) | BIT(occlusion) | BIT(measure))
#define PICTURES                                                                                   \
    (SPECTRA | LOBES | BIT(variance) | BIT(interpolation) | BIT(occlusion) | BIT(measure) |        \
     BIT(light))
#define PLANE (BIT(power) | BIT(check) | BIT(variance) | BIT(measure))
#define ROUND                                                                                      \
    (SPHERES | RULES | BIT(check) | BIT(variance) | BIT(interpolation) | BIT(occlusion) |          \
     BIT(measure))
#define LONG (READERS | BIT(run))
#define READS (BIT(convert) | BIT(report))
#define PAGES (BIT(run) | BIT(report))
#define SUITES (BIT(bench) | BIT(stress))
#define TABLES (READERS | SUITES | SETLESS | BIT(merge) | BIT(devices))

#endif
