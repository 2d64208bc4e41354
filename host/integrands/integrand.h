/* Integrands F whose integral points estimate: on the torus, the sphere or the hemisphere. One file
 * per kind, one table. What is known of F exactly turns a spectrum of points into a variance
 * (docs/mathematics/integrands.md):
 *
 *     torus        Var I = (1/N) sum_{k != 0} P(k) |f_k|^2                                 (V1)
 *     sphere       Var I = (4 pi/N) sum_{l >= 1} P(l) sum_m |F_lm|^2                       (S1)
 *     hemisphere   Var I = (pi/N) sum_{l = 2,4,..} P(l) sum_m |F_lm|^2, F extended evenly  (H1)
 */
#ifndef PS_INTEGRANDS_INTEGRAND_H
#define PS_INTEGRANDS_INTEGRAND_H

#include "base/grammar.h"
#include "samplers/sampler.h"

#include <stdint.h>

/* Numbers that a kind fills: those of two points of six dimensions, and a few more. */
enum { PS_MAX_INTEGRAND_PARAMETERS = 4, PS_INTEGRAND_NUMBERS = 16 };

typedef struct ps_integrand ps_integrand;

/* Where an integrand is asked for. */
typedef struct ps_integrand_place {
    ps_sampler_domain where;
    unsigned dimension; /* of the torus; 3 elsewhere */
} ps_integrand_place;

/* Weighted points of the torus. */
typedef struct ps_integrand_points {
    size_t num;
    double *points;  /* [num][dimension] */
    double *weights; /* [num] */
} ps_integrand_points;

/* What the integrands of one name have in common. Members may be NULL where it says so. */
typedef struct ps_integrand_kind {
    const char *name;
    const char *aliases; /* separated by blanks; NULL: none */
    const char *summary; /* one line, for help */
    /* Of a lobe of reflection, which is a BRDF, too: integrands/lobes/lobe.h. NULL: it is none. */
    const struct ps_lobe *lobe;
    /* "ball": ball_value of kernels/integrands/ball.h has its values; NULL: the host has them. */
    const char *kernel;
    unsigned domains;     /* bits PS_INTEGRAND_ON(ps_sampler_domain) */
    unsigned least, most; /* dimensions of the torus that it has; 0: not on the torus */
    ps_parameter parameters[PS_MAX_INTEGRAND_PARAMETERS + 1]; /* ended by key NULL */
    bool does_without_file; /* there is such a function where its file is not named */
    /* Reads values[i] of parameters[i] and fills numbers and own. NULL: nothing to read. */
    pspec_status (*create)(ps_integrand *, const char *const *values, ps_error *);
    void (*destroy)(ps_integrand *); /* frees what own points to; NULL: nothing */

    double (*integral)(const ps_integrand *);
    /* What all modes but the constant one hold: int F^2 - (int F)^2 on the torus, see
     * ps_integrand_energy. */
    double (*energy)(const ps_integrand *);
    /* |f_k|^2 of num frequencies, [num][dimension], none of them 0. NULL: not on the torus, or by
     * points. */
    pspec_status (*powers)(const ps_integrand *, const int32_t *vectors, size_t num, double *powers,
                           ps_error *);
    /* Points that stand for it, where |f_k|^2 = factors[k] |sum_j w_j e^{-2 pi i k.x_j}|^2 is for
     * an engine to sum, of which this room has none; zeroed before, freed by the caller, also after
     * a failure. Both NULL: it has powers. */
    pspec_status (*points)(const ps_integrand *, ps_integrand_points *out, ps_error *);
    void (*factors)(const ps_integrand *, const int32_t *vectors, size_t num, double *factors);
    /* F_l0 for l = 0 .. max_degree about the axis of an F that is a function of the height above
     * it, of its even extension on the hemisphere: degrees and coefficients follow. NULL: there is
     * no axis. */
    pspec_status (*zonal)(const ps_integrand *, size_t max_degree, double *f, ps_error *);
    bool has_axis; /* the first three numbers are the axis; else it is z */
    /* sum_m |F_lm|^2 for l = 0 .. max_degree. NULL: it has zonal, or is not on the sphere. */
    pspec_status (*degrees)(const ps_integrand *, size_t max_degree, double *powers, ps_error *);
    /* F_lm of 0 <= m <= l <= max_degree: re, im at index m (2 max_degree + 1 - m)/2 + l. NULL: it
     * has zonal, or is not on the sphere. */
    pspec_status (*coefficients)(const ps_integrand *, size_t max_degree, double *out, ps_error *);
    /* F at num points, [num][dimension] coordinates in [0,1) or unit vectors. */
    void (*values)(const ps_integrand *, const double *points, size_t num, double *values);
    /* Of values that may fail, which then are nan, and are asked for by one thread: why, or status
     * PSPEC_OK. NULL: they cannot. */
    const ps_error *(*failure)(const ps_integrand *);
    /* A(x) = int F(y) F(y + x) dy; of the sphere C(cos g) = 4 pi E_R[F(Ru) F(Rv)] of points at the
     * angle g, of the hemisphere that of the even extension; x is that cosine then. NULL, or not a
     * number: no closed form, of the kind or in its place. */
    double (*correlation)(const ps_integrand *, const double *x);
    /* Do the powers depend on |k| alone? NULL: no. */
    bool (*is_isotropic)(const ps_integrand *);
    /* Beyond this |k_i| or degree lies at most PS_BEYOND_REACH of the energy, by a proof: docs of
     * the integrand. NULL, or infinite: energy falls so slowly that no cut-off has all of it. */
    double (*reach)(const ps_integrand *);
    /* Where is_isotropic: |f|^2 of the transform over all of space, at any |k| >= 0, and int F^2
     * over all of space, without images. NULL: not on the torus, or no function of |k|. */
    double (*radial)(const ps_integrand *, double k);
    double (*whole_square)(const ps_integrand *);
    /* Steps for a value that is a sum, of some 5 ns of the host each and less by a kernel. NULL: no
     * sum. */
    double (*steps)(const ps_integrand *);
    /* The pixels of the image of the sphere that it is; NULL: it is none. */
    void (*image_size)(const ps_integrand *, size_t *width, size_t *height);
    const char *(*note)(const ps_integrand *); /* what a result should say of it; may be NULL */
} ps_integrand_kind;

#define PS_INTEGRAND_ON(where) (1U << (where))
/* Rounding of the energy. */
#define PS_BEYOND_REACH 1e-16

struct ps_integrand {
    const ps_integrand_kind *kind;
    ps_integrand_place place;
    uint64_t most_bytes; /* that the pixels of an image may take; 0: what is free */
    /* What its values are made of: kernels/integrands/NAME.h says which is which. */
    double numbers[PS_INTEGRAND_NUMBERS];
    void *own; /* of the kind */

    /* What else a kernel may need to know of one that is from a file */
    const char *kernel;  /* instead of that of the kind; NULL: none */
    const double *table; /* [num_table], a part of own, which NAME_has_table takes; NULL: none */
    size_t num_table;
    /* [num_bytes], the same of a table that is bytes to hosts and devices alike; NULL: none */
    const unsigned char *bytes;
    size_t num_bytes;
    bool needs_doubles; /* there is no kernel in single precision */
};

/* Bytes of its table on the host. */
static inline size_t ps_integrand_table_bytes(const ps_integrand *integrand) {
    return integrand->num_table * sizeof *integrand->table + integrand->num_bytes;
}

/* An integrand of a caller of the library, by its values: it is measured, and not predicted. */
typedef struct ps_given_integrand {
    const char *name;
    double integral; /* over the torus, the sphere, of area 4 pi, or the hemisphere, of 2 pi */
    /* Fills values [num] at points [num][dimension], some hundred at a time, for the thread that
     * measures; alike for the same points. A failure goes to who measures, with its sentence. */
    pspec_status (*values)(void *payload, size_t num, unsigned dimension, const double *points,
                           double *values, ps_error *error);
    void *payload;
} ps_given_integrand;

typedef struct ps_given_integrands {
    const ps_given_integrand *all;
    size_t num;
} ps_given_integrands;

/* Integrands of several questions, which have each of them once, however large its file is. {0}:
 * none yet. */
typedef struct ps_made_integrands {
    struct ps_made_integrand *all;
    size_t num, capacity;
} ps_made_integrands;

/* NULL: a text is that of an integrand of the table. */
const ps_given_integrand *ps_given_integrands_find(const ps_given_integrands *list,
                                                   const char *text);

/* All of the table, ended by NULL. */
extern const ps_integrand_kind *const ps_integrand_kinds[];

/* The kind that a text names. */
pspec_status ps_integrand_find(const ps_integrand_kind **kind, const char *text,
                               ps_error *error) PS_MUST_CHECK;
/* Parses "NAME[:key=value,...]"; *out is freed by ps_integrand_destroy. An integrand that there is
 * not in such a place, and radii and the like that make none, are errors with a sentence. */
pspec_status ps_integrand_parse(ps_integrand **out, const char *text, ps_integrand_place place,
                                ps_error *error) PS_MUST_CHECK;
/* The same with a limit of memory, of images that may have many pixels; 0: what is free. */
pspec_status ps_integrand_parse_within(ps_integrand **out, const char *text,
                                       ps_integrand_place place, uint64_t most_bytes,
                                       ps_error *error) PS_MUST_CHECK;
/* The same of one that is given, else of the text. The list must outlive *out. */
pspec_status ps_integrand_make(ps_integrand **out, const ps_given_integrands *list,
                               const char *text, ps_integrand_place place, uint64_t most_bytes,
                               ps_error *error) PS_MUST_CHECK;
/* The same of the one that was made of this text in this place before, if there is one. *out
 * belongs to made, and goes with it; the text must outlive it. */
pspec_status ps_integrand_take(ps_integrand **out, ps_made_integrands *made,
                               const ps_given_integrands *list, const char *text,
                               ps_integrand_place place, uint64_t most_bytes,
                               ps_error *error) PS_MUST_CHECK;
void ps_made_integrands_free(ps_made_integrands *made);
void ps_integrand_destroy(ps_integrand *integrand); /* NULL is allowed */

/* The name of its kernel, as the member of the kind; NULL: there is none in that precision. */
const char *ps_integrand_kernel(const ps_integrand *integrand, bool in_doubles);

/* int F over the torus, the sphere or the hemisphere. */
double ps_integrand_integral(const ps_integrand *integrand);
/* E, so that N Var I = E, 4 pi E, pi E for white noise: torus int F^2 - (int F)^2; sphere int F^2 -
 * (int F)^2/(4 pi); hemisphere 2 int F^2 - (int F)^2/pi. */
double ps_integrand_energy(const ps_integrand *integrand);
/* Is E known? Else nothing is of powers, nor of variances ahead. */
bool ps_integrand_is_predicted(const ps_integrand *integrand);
/* The factor of E in N Var I: 1, 4 pi, pi. */
double ps_integrand_factor(const ps_integrand *integrand);
/* powers[num]; PSPEC_ERROR_INVALID_ARGUMENT where they are by points. */
pspec_status ps_integrand_powers(const ps_integrand *integrand, const int32_t *vectors, size_t num,
                                 double *powers, ps_error *error) PS_MUST_CHECK;
/* Is it by points, with factors of the powers of their sums? Then *out has them, freed by
 * ps_integrand_points_free, and factors[num] are the member's. */
bool ps_integrand_has_points(const ps_integrand *integrand);
pspec_status ps_integrand_make_points(const ps_integrand *integrand, ps_integrand_points *out,
                                      ps_error *error) PS_MUST_CHECK;
void ps_integrand_points_free(ps_integrand_points *points);
void ps_integrand_factors(const ps_integrand *integrand, const int32_t *vectors, size_t num,
                          double *factors);
/* powers[max_degree + 1]; odd degrees of the hemisphere are 0. */
pspec_status ps_integrand_degrees(const ps_integrand *integrand, size_t max_degree, double *powers,
                                  ps_error *error) PS_MUST_CHECK;
/* F_lm on the sphere of 0 <= m <= l <= max_degree: re, im at index m (2 max_degree + 1 - m)/2 + l.
 */
pspec_status ps_integrand_harmonics(const ps_integrand *integrand, size_t max_degree, double *out,
                                    ps_error *error) PS_MUST_CHECK;
/* values[num] */
void ps_integrand_values(const ps_integrand *integrand, const double *points, size_t num,
                         double *values);
/* The member: NULL where values cannot fail, and any number of threads may ask for them. */
const ps_error *ps_integrand_failure(const ps_integrand *integrand);
/* (V2), (S1'), (H1'): the variance of (1/W) sum_j w_j F of one set under a random shift, of (4
 * pi/W) sum under a random rotation, of (2 pi/W) sum. weights NULL: 1 each. N^2 steps on the host:
 * the check of the others. PSPEC_ERROR_INVALID_ARGUMENT where there is no closed form. */
pspec_status ps_integrand_pairwise(const ps_integrand *integrand, const double *points,
                                   const double *weights, size_t num, double *variance,
                                   ps_error *error) PS_MUST_CHECK;
/* Has it the closed form that ps_integrand_pairwise needs? */
bool ps_integrand_has_pairs(const ps_integrand *integrand);
bool ps_integrand_is_isotropic(const ps_integrand *integrand);
/* The largest |k_i| or degree that matters, infinite where all do. */
double ps_integrand_reach(const ps_integrand *integrand);
/* Has it a transform that is a function of |k|, for the two below? */
bool ps_integrand_is_radial(const ps_integrand *integrand);
double ps_integrand_radial(const ps_integrand *integrand, double k);
double ps_integrand_whole_square(const ps_integrand *integrand);
/* Steps of some 5 ns of the host for a value that is a sum; 0: no sum. */
double ps_integrand_steps(const ps_integrand *integrand);
/* Is it an image of the sphere? Then of so many pixels. */
bool ps_integrand_image_size(const ps_integrand *integrand, size_t *width, size_t *height);
const char *ps_integrand_note(const ps_integrand *integrand); /* or NULL */

#endif
