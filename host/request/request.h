/* What is asked for, by a command line or in a scene file, after parsing. One struct for all kinds
 * of results (answers/kind.h), each of which lists the options that belong to it.
 */
#ifndef PS_REQUEST_REQUEST_H
#define PS_REQUEST_REQUEST_H

#include "base/status.h"
#include "frequencies/frequencies_spec.h"
#include "integrands/integrand.h"
#include "plan/replan.h"
#include "plan/specs.h"
#include "plots/plot.h"
#include "points/points.h"
#include "points/weights_spec.h"
#include "samplers/sampler.h"
#include "spectra/normalization.h"
#include "spectra/shape/bound.h"
#include "fields/table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The doubles of 1 up to the largest N are 34 numbers. */
enum {
    PS_MAX_SAMPLERS = 16,
    PS_MAX_COUNTS = 64,
    PS_MAX_INTEGRANDS = 16,
    PS_MOST_CAMERA = 10,
    PS_MAX_SMOOTHNESS = 8,
    PS_SET_NAME_BYTES = 64
};

typedef enum ps_option_id {
    PS_OPTION_POINTS,             /* -n, --points N,..|N..M */
    PS_OPTION_REALIZATIONS,       /* -m, --realizations M */
    PS_OPTION_RANGE,              /* --range A:B */
    PS_OPTION_STANDARD_ERROR,     /* --standard-error X */
    PS_OPTION_DIMENSION,          /* -d, --dimension D */
    PS_OPTION_SEED,               /* -s, --seed S */
    PS_OPTION_SAMPLER,            /* --sampler NAME[:key=value,...], repeatable */
    PS_OPTION_SET,                /* --set NAME=FILES, repeatable */
    PS_OPTION_INTEGRAND,          /* --integrand NAME[:key=value,...] */
    PS_OPTION_SHIFTS,             /* --shifts S */
    PS_OPTION_IN_PLACE,           /* --in-place */
    PS_OPTION_TAIL,               /* --tail X */
    PS_OPTION_PAPER_FORMULA,      /* --paper-formula */
    PS_OPTION_BOUNDS,             /* --bounds auto|G,A,B..G,A,B, one or one for each sampler */
    PS_OPTION_RATES,              /* --rates auto|A..B */
    PS_OPTION_RANK,               /* --rank */
    PS_OPTION_AGAINST,            /* --against FILE */
    PS_OPTION_HOMOGENEOUS,        /* --homogeneous */
    PS_OPTION_FALSE_ALARM_RATE,   /* --false-alarm-rate P */
    PS_OPTION_BRDF,               /* --brdf NAME[:key=value,...] */
    PS_OPTION_VIEW,               /* --view DEGREES */
    PS_OPTION_SMOOTHNESS,         /* --smoothness S */
    PS_OPTION_MESH,               /* --mesh FILE */
    PS_OPTION_CAMERA,             /* --camera X,Y,Z,X,Y,Z[,ANGLE[,X,Y,Z]] */
    PS_OPTION_IMAGE,              /* --image WxH */
    PS_OPTION_RADIUS,             /* --radius R */
    PS_OPTION_MEASURES,           /* --measures NAME,... */
    PS_OPTION_REFERENCE,          /* --reference R */
    PS_OPTION_IMAGE_OUT,          /* --image-out FILE */
    PS_OPTION_MAX_FREQUENCY,      /* -k, --max-frequency K */
    PS_OPTION_MAX_DEGREE,         /* -l, --max-degree L */
    PS_OPTION_HEMISPHERE,         /* --hemisphere */
    PS_OPTION_COEFFICIENTS,       /* --coefficients FILE.npy */
    PS_OPTION_HARMONICS,          /* --harmonics spherical|hemispherical */
    PS_OPTION_FREQUENCIES,        /* --frequencies FILE */
    PS_OPTION_BINS,               /* --bins round|floor|width=P/Q|relative=P/Q|shells */
    PS_OPTION_PER_RING,           /* --per-ring S */
    PS_OPTION_FIT,                /* --fit auto|B */
    PS_OPTION_SCATTER,            /* --scatter K1,..,KD */
    PS_OPTION_FULL,               /* --full FILE.npy */
    PS_OPTION_NORMALIZE,          /* --normalize power|effective|integral */
    PS_OPTION_HOMOGENIZE,         /* --homogenize */
    PS_OPTION_WEIGHTS,            /* --weights equal|column|FILE */
    PS_OPTION_WEIGHT_SUM,         /* --weight-sum free|one */
    PS_OPTION_WEIGHTS_OUT,        /* --weights-out FILE */
    PS_OPTION_INPUT_FORMAT,       /* --input-format NAME */
    PS_OPTION_COLUMNS,            /* --columns NAME */
    PS_OPTION_SELECT,             /* --select NAME=VALUE */
    PS_OPTION_HEADER,             /* --header yes|no */
    PS_OPTION_TRANSPOSE,          /* --transpose */
    PS_OPTION_DOMAIN,             /* --domain torus|sphere */
    PS_OPTION_WRAP,               /* --wrap */
    PS_OPTION_BOX,                /* --box X0,X1[,Y0,Y1,...] */
    PS_OPTION_NORMALIZE_VECTORS,  /* --normalize-vectors */
    PS_OPTION_LIFT,               /* --lift sphere|hemisphere */
    PS_OPTION_MORPH,              /* --morph none|diffuse|glossy:n=N|phong:n=N */
    PS_OPTION_DROP_BELOW,         /* --drop-below-horizon */
    PS_OPTION_SELECT_SETS,        /* --select-sets A..B */
    PS_OPTION_SELECT_POINTS,      /* --select-points A..B */
    PS_OPTION_MERGE,              /* --merge */
    PS_OPTION_TO_COLUMNS,         /* --to-columns NAME */
    PS_OPTION_TOLERANCE,          /* --tol T */
    PS_OPTION_FLOOR,              /* --floor P */
    PS_OPTION_PRECISION,          /* --precision auto|single|double|extended */
    PS_OPTION_ENGINE,             /* --engine NAME */
    PS_OPTION_CASE,               /* --case NAME */
    PS_OPTION_CALIBRATE,          /* --calibrate */
    PS_OPTION_DEVICE,             /* --device SELECTOR */
    PS_OPTION_MIXED,              /* --mixed */
    PS_OPTION_MEMORY,             /* --memory SIZE */
    PS_OPTION_CACHE,              /* --cache BYTES */
    PS_OPTION_KEPT_SETS,          /* --kept-sets BYTES */
    PS_OPTION_CHECKPOINT,         /* --checkpoint FILE */
    PS_OPTION_CHECKPOINT_SECONDS, /* --checkpoint-interval SECONDS */
    PS_OPTION_PREFETCH,           /* --prefetch */
    PS_OPTION_ALLOW_EXEC,         /* --allow-exec */
    PS_OPTION_RECORDED_ENGINES,   /* --recorded-engines */
    PS_OPTION_NO_SKIP,            /* --no-skip */
    PS_OPTION_NO_SELF_CHECK,      /* --no-self-check */
    PS_OPTION_OUTPUT,             /* -o, --output FILE */
    PS_OPTION_FORMAT,             /* --format of a table or of points */
    PS_OPTION_PLOT,               /* --plot FILE */
    PS_OPTION_PLOT_LOG,           /* --plot-log x|y|xy|none */
    PS_OPTION_PLOT_RANGE,         /* --plot-range X0..X1,Y0..Y1 */
    PS_OPTION_PLOT_POINTS,        /* --plot-points yes|no */
    PS_OPTION_PROFILE,            /* --profile */
    PS_OPTION_QUIET,              /* --quiet */
    PS_OPTION_QUICK,              /* --quick */
    PS_OPTION_SCENES,             /* --scenes */
    PS_OPTION_VERBOSE,            /* --verbose */
    PS_OPTION_HELP,               /* -h, --help */
    PS_NUM_OPTIONS
} ps_option_id;

/* How an option was said, for sentences that name it. */
typedef enum ps_option_form {
    PS_FORM_LONG,   /* --points */
    PS_FORM_LETTER, /* -n */
    PS_FORM_KEY     /* points, in a scene */
} ps_option_form;

/* Where the points of a curve, or of a group of rows, come from: a sampler, a program, or files
 * under a name. In the command of a program numbers take the place of these words, and of {d} and
 * {seed}; without the last it is run once for each realization. */
#define PS_PROGRAM_POINTS "{n}"
#define PS_PROGRAM_REALIZATION "{realization}"
#define PS_PROGRAM_REALIZATIONS "{realizations}"
typedef struct ps_source_words {
    const char *sampler;          /* as --sampler has it; NULL: */
    const char *files;            /* those of --set, a list with commas, or one program */
    char name[PS_SET_NAME_BYTES]; /* of these; "": a program's own words */
} ps_source_words;

typedef struct ps_request {
    bool is_given[PS_NUM_OPTIONS];        /* which options were said */
    ps_option_form forms[PS_NUM_OPTIONS]; /* of those */
    const char *said[PS_NUM_OPTIONS];     /* their values, of several the last; borrowed */
    size_t num_counts;                    /* numbers of points that were asked for, */
    uint64_t counts[PS_MAX_COUNTS];       /* 1024 alone unless given */
    uint64_t num_realizations;            /* 1 unless given */
    ps_realization_range range;           /* of them; {0} unless given: all */
    const ps_replan *replans; /* of a range: of each question; NULL: first plans, as options have */
    unsigned dimension;       /* 2 unless given, 1..6 */
    uint64_t seed;            /* 1 unless given */
    size_t num_sources; /* samplers and sets, as they were said; 0: the points are those of files */
    ps_source_words sources[PS_MAX_SAMPLERS];
    size_t num_integrands;
    const char *integrands[PS_MAX_INTEGRANDS];
    ps_given_integrands integrands_given; /* by a caller, which they may name; borrowed */
    ps_made_integrands *integrands_made;  /* that requests share; borrowed; NULL: it has its own */
    uint64_t num_shifts;                  /* 1 unless given */
    bool in_place;                        /* sets are not moved */
    double tail;                          /* 0 unless given */
    bool paper_formula;
    /* Zeros unless given: the defaults of docs/user/conventions.md. */
    ps_weights_spec weights;
    ps_frequencies_spec frequencies;
    uint64_t max_degree;
    ps_accuracy_spec accuracy; /* tolerance 1e-6 unless given */
    /* Precision -1 unless given, which is auto. The memory may be that of POINTSPEC_MEMORY. */
    ps_limits_spec limits;
    bool is_memory_of_environment; /* it stands in POINTSPEC_MEMORY */
    uint64_t cache_bytes;          /* 1e9 unless given */
    bool prefetch;
    const char *against;     /* NULL unless given */
    double false_alarm_rate; /* 1e-3 unless given */
    const char *brdf, *coefficients, *harmonics, *full, *weights_out, *to_columns, *case_name,
        *output, *format, *plot, *plot_points; /* NULL unless given */
    ps_text_view view;                         /* of a table on a terminal; {0} elsewhere */
    double view_angle;                         /* degrees from the normal; 0 unless given */
    /* How point files are read. What is of samplers or engines, too (dimension, number of points,
     * memory), stands in it no sooner than ps_point_options_make hands it on. */
    ps_point_options reading;
    ps_point_range points; /* of each set; {0} unless given */
    ps_plot_axes plot_axes;
    const char *mesh, *image_out;  /* NULL unless given */
    unsigned num_camera;           /* 0 unless given, else 6, 7 or 10 */
    double camera[PS_MOST_CAMERA]; /* position, what it looks at, angle in degrees, up */
    size_t image[2];               /* width and height in pixels; 256 x 256 unless given */
    double radius;                 /* 0 unless given */
    const char *measures;          /* names with commas; NULL unless given */
    uint64_t num_reference;        /* 4096 unless given */
    bool recorded_engines, homogenize, homogeneous, hemisphere, drop_below_horizon, merge,
        calibrate, quick, scenes, quiet, verbose;
    /* The picture shows the averaged periodogram on the whole square; no option asks for it. */
    bool wants_picture;
    /* The answer has its array, the standard errors of that array, its coefficients
     * (answers/kind.h), or state by which it is merged; no option asks for them. */
    bool wants_array, wants_errors, wants_coefficients, wants_state;
    pspec_normalization normalization;    /* never that of pairs */
    size_t num_smoothness;                /* 1, more of interpolation */
    double smoothness[PS_MAX_SMOOTHNESS]; /* 1.5 unless given */
    bool wants_fit;
    double fit_exponent; /* of profiles; nan: the one that is found */
    size_t num_bounds;   /* 0; 1 of all samplers, or one of each, in their order */
    ps_bounds_spec bounds[PS_MAX_SAMPLERS];
    bool wants_rates, wants_ranking;
    double rates[2]; /* the smallest N and the largest */
    size_t num_files;
    const char **files;       /* the remaining words; "-" is standard input */
    const char *command_line; /* the whole line, for headers */
} ps_request;

/* Nothing was said. */
extern const ps_request ps_request_default;

/* A request asks a question of each source, or of its files, with each number of points. */
size_t ps_request_num_questions(const ps_request *request);
/* The sampler of a question; NULL: files. */
const char *ps_request_sampler(const ps_request *request, size_t question);
/* What tables and pictures call a source: the sampler as it was said, or the name of the set. */
const char *ps_request_source_name(const ps_request *request, size_t source);
/* That of the source of a question; NULL: the files of the request. */
const char *ps_request_name(const ps_request *request, size_t question);
/* The command of a source that is a program, with its placeholders; NULL: it is none. */
const char *ps_request_program(const ps_request *request, size_t source);
bool ps_request_has_programs(const ps_request *request);
/* Are there samplers; are there samplers or programs, which are told what to make; are there files,
 * or programs, in sets or alone? */
bool ps_request_has_samplers(const ps_request *request);
bool ps_request_has_told(const ps_request *request);
bool ps_request_has_files(const ps_request *request);
uint64_t ps_request_points(const ps_request *request, size_t question);
/* {0} where none are wanted. */
ps_bounds_spec ps_request_bounds(const ps_request *request, size_t question);
/* Refuses several numbers of points; why: "and one output holds sets of one". */
pspec_status ps_request_check_one_count(const ps_request *request, const char *why,
                                        ps_error *error) PS_MUST_CHECK;
/* Refuses files; instead: "; -o FILE names the output", or "". */
pspec_status ps_request_check_no_files(const ps_request *request, const char *instead,
                                       ps_error *error) PS_MUST_CHECK;
/* Of commands whose output is points: there is a picture, and nobody said where the points go, or
 * how they are written. Then they are drawn, and that is all. */
bool ps_request_only_draws(const ps_request *request);

#endif
