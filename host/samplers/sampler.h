/* Samplers of the unit torus [0,1)^d, of the sphere and of the hemisphere z >= 0: one table, one
 * file per sampler. Every sampler of the torus makes points of the other two, too, by lift=.
 *
 * A sampler writes one realization at a time. Realization r depends on nothing but
 * (sampler, parameters, number of points, dimension, seed, r), through the counter-based generator
 * of math/random/random.h; so any batch, thread or rank makes the same points.
 *
 * A request is parsed, gets its number of points, dimension and seed, is resolved (what was left
 * open is filled in, and all of it is checked), and then makes points. This layer is a leaf: it may
 * use math/ and base/ only, and samplers/forces device/, too.
 */
#ifndef PS_SAMPLERS_SAMPLER_H
#define PS_SAMPLERS_SAMPLER_H

#include "base/grammar.h"
#include "base/status.h"
#include "base/text.h"
#include "base/watch.h"
#include "math/dimension.h"
#include "math/lift.h"
#include "math/morph.h"
#include "samplers/numbers.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_MAX_SAMPLER_PARAMETERS = 4, PS_MAX_SAMPLER_VALUE = 64 };

/* What costs of samplers are in. */
#define PS_NANOSECOND 1e-9

/* What ps_sampler_resolve takes for what is 0 in a request, unless the sampler says more. */
enum { PS_DEFAULT_POINTS = 1024, PS_DEFAULT_DIMENSION = 2 };

/* Where points lie. */
typedef enum ps_sampler_domain {
    PS_SAMPLES_TORUS = 0,
    PS_SAMPLES_SPHERE,
    PS_SAMPLES_HEMISPHERE /* z >= 0 */
} ps_sampler_domain;

/* The parameter that every sampler of the torus has besides its own, and what it says. */
#define PS_LIFT_KEY "lift"
#define PS_LIFT_DEFAULT "none"
#define PS_LIFT_MEANING                                                                            \
    "none|sphere|hemisphere, points (x,y) of the plane by Lambert's map to z = 2x - 1 or z = x, "  \
    "phi = 2 pi y"

/* The parameters of all samplers of the hemisphere, lifted ones included: points of equal areas
 * take the density of a lobe, keeping their azimuths (docs/mathematics/quadrature.md#morphing). */
#define PS_MORPH_KEY "morph"
#define PS_MORPH_DEFAULT "none"
#define PS_MORPH_MEANING                                                                           \
    "none|diffuse|glossy|phong, on the hemisphere: heights with the density z, e^{n(z-1)} or z^n"
#define PS_EXPONENT_KEY "n"
#define PS_EXPONENT_MEANING "exponent of the glossy or Phong lobe, 0.001 to 1e6"
#define PS_LEAST_EXPONENT 1e-3
#define PS_MOST_EXPONENT 1e6

/* One key that a sampler understands in NAME:key=value. */
typedef ps_parameter ps_sampler_parameter;

/* What a parameter that is a number may be; most 0: the sampler reads it by itself. */
typedef struct ps_sampler_range {
    double least, most;
    bool is_whole;
} ps_sampler_range;

typedef struct ps_sampler ps_sampler;
typedef struct ps_lender ps_lender;               /* device/lender.h */
typedef struct ps_distance_kind ps_distance_kind; /* samplers/darts/distance.h */
typedef struct ps_digital_net ps_digital_net;     /* samplers/torus/digital_net.h */

/* What to sample. values[i] belongs to sampler->parameters[i]. */
typedef struct ps_sampler_request {
    const ps_sampler *sampler;
    ps_sampler_domain lift; /* of a torus sampler; PS_SAMPLES_TORUS: points stay where they are */
    ps_morph morph;         /* of points of the hemisphere, after homogenize */
    bool has_morph;         /* morph= was given: who knows a better default leaves it alone */
    size_t num_points;      /* 0: left open until the request is resolved */
    unsigned dimension;     /* numbers per point: d, on the sphere 3; 0: left open */
    uint64_t seed;
    bool homogenize; /* torus: add one uniform random vector mod 1 to every point of a realization;
                        sphere: one uniform random rotation; hemisphere: the same, u with z < 0
                        becoming -u */
    char values[PS_MAX_SAMPLER_PARAMETERS][PS_MAX_SAMPLER_VALUE];
    const ps_watch *watch; /* of ps_sampler_generate while it works, for samplers/pace.h */
    /* Of devices, for samplers that have work for one, borrowed; NULL: each set opens the first.
     * The same points on any. */
    ps_lender *lender;
} ps_sampler_request;

/* What makes points by their index (kernels/samplers/numbers.h), of a request that was resolved. */
typedef struct ps_sampler_places {
    sampler_numbers numbers;
    uint32_t table[SAMPLER_AXES][SAMPLER_DIGITS];
} ps_sampler_places;

/* Points that are known by their index, without those before, so that devices can make them. */
typedef struct ps_sampler_by_index {
    const char *name;   /* of NAME_places in kernels/samplers/; NULL: only one after the other */
    bool needs_doubles; /* of a device */
    /* Adds to seed and number of points what is the sampler's own; NULL: nothing. */
    pspec_status (*fill)(const ps_sampler_request *, ps_sampler_places *, ps_error *);
    /* The same function, for the host. */
    void (*places)(const sampler_numbers *, const uint32_t *table, uint32_t dimension,
                   uint64_t realization, uint64_t j, uint64_t *places);
    /* NAME_point: those of the sphere, and of lifts, exactly; NULL: the host makes them. */
    void (*point)(const sampler_numbers *, bool on_hemisphere, uint64_t realization, uint64_t j,
                  double *point);
} ps_sampler_by_index;

struct ps_sampler {
    const char *name;
    const char *summary;        /* one line, for help */
    const char *aliases[4];     /* names that other tools use, NULL-terminated */
    ps_sampler_domain domain;   /* where its own points lie, without a lift */
    bool stands_beside;         /* others in a report, since everybody knows its sets */
    unsigned maximum_dimension; /* of the torus only; the plane is always among them */
    unsigned minimum_dimension; /* 1 unless it says more */
    size_t minimum_points;      /* 1 unless it says more */
    uint64_t maximum_points;    /* 0: as many as any sampler makes */
    ps_sampler_parameter parameters[PS_MAX_SAMPLER_PARAMETERS + 1]; /* ended by key == NULL */
    ps_sampler_range
        ranges[PS_MAX_SAMPLER_PARAMETERS]; /* of these; then ps_sampler_number has it */

    /* What a realization costs on one core of the machine of plan/phases.c: nanoseconds of a
     * coordinate, on the sphere of a point; or, where it is not so simple, seconds. */
    double nanoseconds;
    double (*seconds)(const ps_sampler_request *);
    /* Bytes that are taken while a realization is made, besides its points, of the host and of a
     * device. The member may be NULL: none worth counting. */
    double (*work_bytes)(const ps_sampler_request *);

    /* Of the algorithm, raised by whoever changes the bits of a set, where sets are expensive
     * enough to be kept on the disk; 0: they are made anew in less time. */
    unsigned version;

    /* Where the number of points changes from realization to realization, about the request's; the
     * member may be NULL: never. */
    bool (*varies)(const ps_sampler_request *);
    /* Points that there must be room for; NULL: the request's number. */
    size_t (*most_points)(const ps_sampler_request *);

    /* Every realization the same points, before homogenize (may depend on the parameters). */
    bool (*is_deterministic)(const ps_sampler_request *);
    /* A bound of the expected power <P> at every frequency but 0, on the sphere at every degree but
     * 0, where the expectation is known (docs/mathematics/samplers.md#spectra-on-the-torus), of the
     * points where they are, lifted or not. 0, or NULL: none is. */
    double (*most_power)(const ps_sampler_request *);
    /* What the header of a result should say of this request, or NULL. The member may be NULL. */
    const char *(*note)(const ps_sampler_request *);
    /* The number of points that parameters alone ask for, for requests that leave it open. The
     * member may be NULL: PS_DEFAULT_POINTS. */
    pspec_status (*open_points)(const ps_sampler_request *, size_t *num_points, ps_error *);
    /* Are number of points, dimension and parameter values admissible? NULL: always. */
    pspec_status (*check)(const ps_sampler_request *, ps_error *);
    /* Can the device that selector means make the sets, where one is to? NULL: none is. */
    pspec_status (*check_device)(const ps_sampler_request *, const char *selector, ps_error *);
    /* Writes realization r: points [num_points][dimension], each in [0,1), or unit vectors. Work
     * that takes long tells the watch of the request, and ends where it asks to (samplers/pace.h).
     */
    pspec_status (*generate)(const ps_sampler_request *, uint64_t realization, double *points,
                             ps_error *);
    /* Instead of it where most_points is there: *num_points is how many were written. */
    pspec_status (*generate_some)(const ps_sampler_request *, uint64_t realization, double *points,
                                  size_t *num_points, ps_error *);
    /* The points of `generate`, rounded to multiples of 2^-64; {0}: not by index. */
    ps_sampler_by_index by_index;
    /* Of samplers that keep a least distance; NULL: it keeps none. */
    const ps_distance_kind *distance;
    /* Of digital nets, whose first parameter is the scramble: makes the axes. NULL: it is none. */
    pspec_status (*build_net)(const ps_sampler_request *, ps_digital_net *, ps_error *);
};

/* All samplers, ended by NULL. */
extern const ps_sampler *const ps_samplers[];

/* Appends the names of all samplers, "white, regular, ...". */
void ps_sampler_names(ps_text *names);

/* Parses "NAME[:key=value,...]" into request->sampler, ->lift and ->values (defaults filled in).
 * Unknown names and keys are PSPEC_ERROR_INVALID_ARGUMENT and name the nearest known one. */
pspec_status ps_sampler_parse(ps_sampler_request *request, const char *text,
                              ps_error *error) PS_MUST_CHECK;

/* Fills in dimension and number of points where they are 0, then checks the whole request. The
 * number of points is final afterwards. */
pspec_status ps_sampler_resolve(ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;

/* Checks the whole request (dimension, number of points, values), in which nothing may be left
 * open; a request must have passed it, or have been resolved, before sampling. */
pspec_status ps_sampler_check(const ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;

/* Has the sampler work for a device? */
bool ps_sampler_uses_device(const ps_sampler_request *request);
/* Refuses a device that cannot make sets of the request, before any is made; selector as
 * ps_device_choose has it. */
pspec_status ps_sampler_check_device(const ps_sampler_request *request, const char *selector,
                                     ps_error *error) PS_MUST_CHECK;

/* Writes realization r of the request, points [*num_points][dimension] with room for
 * ps_sampler_most_points, random shift or rotation included when it is homogenized, then morphed.
 * num_points may be NULL where their number does not vary. watch, which may be NULL, is told of
 * long work; when it asks to stop, that is PSPEC_ERROR_CANCELLED. */
pspec_status ps_sampler_generate(const ps_sampler_request *request, uint64_t realization,
                                 double *points, size_t *num_points, const ps_watch *watch,
                                 ps_error *error) PS_MUST_CHECK;

/* What makes the points of ps_sampler_generate by their index; the sampler has by_index.name. */
pspec_status ps_sampler_fill_places(const ps_sampler_request *request, ps_sampler_places *out,
                                    ps_error *error) PS_MUST_CHECK;

/* The two halves of it: the sampler's own points, which are the same whatever lift, homogenize and
 * morph say, with room for points of the request's dimension; and what becomes of these. */
pspec_status ps_sampler_make(const ps_sampler_request *request, uint64_t realization,
                             double *points, size_t *num_points, const ps_watch *watch,
                             ps_error *error) PS_MUST_CHECK;
pspec_status ps_sampler_place(const ps_sampler_request *request, uint64_t realization,
                              double *points, size_t num_points, const ps_watch *watch,
                              ps_error *error) PS_MUST_CHECK;
/* Appends all that the sampler's own points depend on, but for the realization: name, version,
 * number of points, dimension, seed, parameters. */
void ps_sampler_identify(const ps_sampler_request *request, ps_text *out);
/* Numbers of one of the sampler's own points, before a lift. */
unsigned ps_sampler_own_dimension(const ps_sampler_request *request);

/* Room that a realization needs, in points: those of the request unless their number varies. */
size_t ps_sampler_most_points(const ps_sampler_request *request);
/* Does the number of points change from realization to realization? */
bool ps_sampler_varies(const ps_sampler_request *request);
/* Numbers of a realization as costs count them: coordinates, on the sphere points. */
double ps_sampler_numbers(const ps_sampler_request *request);
/* Seconds of a realization on one core of the machine of plan/phases.c, without what lift,
 * homogenize and morph add. */
double ps_sampler_seconds(const ps_sampler_request *request);
/* Bytes that are taken while it is made, besides its points; 0: none worth counting. */
double ps_sampler_work_bytes(const ps_sampler_request *request);

/* A bound of the expected power of the request's points at every frequency but 0; 0: none is known
 * but N. */
double ps_sampler_most_power(const ps_sampler_request *request);

/* The sampler's note on this request, NULL when there is nothing to say. Static storage. */
const char *ps_sampler_note(const ps_sampler_request *request);

/* Where the points of the request lie, lift included. */
ps_sampler_domain ps_sampler_where(const ps_sampler_request *request);
/* Unit vectors, of the sphere or the hemisphere? */
bool ps_sampler_is_on_sphere(const ps_sampler_request *request);
bool ps_sampler_is_on_hemisphere(const ps_sampler_request *request);

/* True when all realizations have the same power spectrum: deterministic points, homogenized or
 * not. A shift of the torus and a rotation of the sphere leave P unchanged
 * (docs/mathematics/torus.md#sums-and-powers, docs/mathematics/sphere.md#coefficients-and-power),
 * and so does a rotation of the hemisphere with folding for even degrees, the only ones that it has
 * as the projective plane. Its odd degrees, taken as points of the sphere, do change. Morphed
 * points change with the rotation before. */
bool ps_sampler_has_constant_power(const ps_sampler_request *request);

#endif
