#include "points/columns.h"

#include "math/unit_vector.h"

#include <string.h>

typedef struct named_layout {
    const char *name;
    unsigned columns;
    ps_angle_order angles;
    bool has_weight, in_degrees;
} named_layout;

/* In the order of PS_POINT_COLUMNS. */
static const named_layout named[] = {
    {"xy", 2, PS_NO_ANGLES, false, false},
    {"xyw", 3, PS_NO_ANGLES, true, false},
    {"xyz", 3, PS_NO_ANGLES, false, false},
    {"xyzw", 4, PS_NO_ANGLES, true, false},
    {"theta-phi", 2, PS_THETA_PHI, false, false},
    {"theta-phi-w", 3, PS_THETA_PHI, true, false},
    {"phi-theta", 2, PS_PHI_THETA, false, false},
    {"phi-theta-w", 3, PS_PHI_THETA, true, false},
    {"lon-lat", 2, PS_LON_LAT, false, true},
    {"lon-lat-w", 3, PS_LON_LAT, true, true},
    {"theta-phi:degrees", 2, PS_THETA_PHI, false, true},
    {"theta-phi-w:degrees", 3, PS_THETA_PHI, true, true},
    {"phi-theta:degrees", 2, PS_PHI_THETA, false, true},
    {"phi-theta-w:degrees", 3, PS_PHI_THETA, true, true},
};
enum { NUM_NAMED = sizeof named / sizeof named[0] };

static const named_layout *find_named(const char *name) {
    for (size_t i = 0; i < NUM_NAMED; i++) {
        if (strcmp(named[i].name, name) == 0) {
            return &named[i];
        }
    }
    return NULL;
}

/* The first layout without angles is that of the plane. */
const char *ps_columns_name(ps_angle_order angles, bool has_weight, bool in_degrees) {
    for (size_t i = 0; i < NUM_NAMED; i++) {
        if (named[i].angles == angles && named[i].in_degrees == in_degrees &&
            named[i].has_weight == has_weight) {
            return named[i].name;
        }
    }
    return NULL;
}

unsigned ps_layout_columns(const ps_layout *layout) {
    const bool are_pairs = layout->angles != PS_NO_ANGLES || layout->lift != PS_NO_LIFT;
    const unsigned numbers = are_pairs ? 2 : layout->dimension;
    return numbers + layout->has_weight_column;
}

const char *ps_layout_name(const ps_layout *layout) {
    static const char *const torus[2][PS_MAX_DIMENSION] = {
        {"x", "xy", "xyz", "x1..x4", "x1..x5", "x1..x6"},
        {"xw", "xyw", "xyzw", "x1..x4 w", "x1..x5 w", "x1..x6 w"}};
    if (layout->coordinates == PS_TORUS_COORDINATES) {
        return torus[layout->has_weight_column][layout->dimension - 1];
    }
    if (layout->lift != PS_NO_LIFT) {
        return layout->has_weight_column ? "xyw" : "xy";
    }
    if (layout->angles == PS_NO_ANGLES) {
        return layout->has_weight_column ? "xyzw, unit vectors" : "xyz, unit vectors";
    }
    return ps_columns_name(layout->angles, layout->has_weight_column, layout->in_degrees);
}

bool ps_layout_is_plain(const ps_layout *layout) {
    return !layout->has_weight_column && layout->lift == PS_NO_LIFT &&
           (layout->angles == PS_NO_ANGLES ||
            (layout->coordinates == PS_ANGLES && layout->angles == PS_THETA_PHI &&
             !layout->in_degrees));
}

const char *ps_columns_meaning(const char *names) {
    const char *const last = names != NULL ? strrchr(names, '=') : NULL;
    return last != NULL ? last + 1 : NULL;
}

bool ps_columns_numbers(const char *names, unsigned numbers[], unsigned most, unsigned *num) {
    enum { LARGEST = 1000000, BASE = 10 };
    const char *const meaning = ps_columns_meaning(names);
    const char *const end = meaning != NULL ? meaning - 1 : names + strlen(names);
    *num = 0;
    while (names < end) {
        unsigned value = 0;
        const char *const first = names;
        for (; *names >= '0' && *names <= '9' && value < LARGEST; names++) {
            value = value * BASE + (unsigned)(*names - '0');
        }
        if (value == 0 || *first == '0' || (names < end && *names != ',')) {
            return false;
        }
        if (*num < most) {
            numbers[*num] = value;
        }
        ++*num;
        names += names < end;
    }
    return *num > 0;
}

bool ps_columns_are_numbers(const char *names) {
    unsigned num = 0;
    return names != NULL && ps_columns_numbers(names, NULL, 0, &num);
}

unsigned ps_columns_told(const ps_point_options *options) {
    enum { PLANE = 2 };
    const char *const meaning =
        options->columns != NULL ? options->columns : ps_columns_meaning(options->column_names);
    const named_layout *const layout = meaning != NULL ? find_named(meaning) : NULL;
    if (layout != NULL) {
        return layout->columns;
    }
    const unsigned dimension = options->lift != PS_NO_LIFT ? PLANE : options->dimension;
    return dimension > 0 ? dimension + options->weight_column : 0;
}

bool ps_columns_agree(const ps_point_options *options, size_t columns) {
    const unsigned told = ps_columns_told(options);
    if (told > 0) {
        return columns == told;
    }
    return options->domain == PS_DOMAIN_SPHERE
               ? columns == 3U + options->weight_column || columns == 4
               : columns > options->weight_column &&
                     columns <= (size_t)PS_MAX_DIMENSION + options->weight_column;
}

/* ---- which columns mean what ------------------------------------------------------------- */

static pspec_status set_torus(ps_layout *out, const ps_columns_question *question, bool has_weight,
                              ps_error *error) {
    const unsigned asked = question->options->dimension;
    const unsigned columns = question->columns;
    if (columns <= has_weight) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: 1 column; with a weight column there must be at least 2",
                       question->where);
    }
    if (columns - has_weight > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %u columns%s; at most %d dimensions are read",
                       question->where, columns, has_weight ? ", one of them the weight" : "",
                       PS_MAX_DIMENSION);
    }
    *out = (ps_layout){.dimension = columns - has_weight, .has_weight_column = has_weight};
    if (asked != 0 && out->dimension != asked) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %u column%s%s, but the dimension asked for is %u%s", question->where,
                       columns, columns > 1 ? "s" : "",
                       has_weight ? ", one of them the weight" : "", asked,
                       columns == asked + 1 && !has_weight ? " (is the last one a weight?)" : "");
    }
    return PSPEC_OK;
}

static void set_sphere(ps_layout *out, ps_angle_order angles, bool has_weight, bool keep_angles) {
    const bool are_angles = angles != PS_NO_ANGLES && keep_angles;
    *out = (ps_layout){.coordinates = are_angles ? PS_ANGLES : PS_UNIT_VECTORS,
                       .dimension = are_angles ? 2 : 3,
                       .angles = angles,
                       .has_weight_column = has_weight};
}

static pspec_status check_named(const ps_columns_question *question, const named_layout *layout,
                                ps_error *error) {
    const ps_point_options *options = question->options;
    if (layout->columns != question->columns) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %u column%s, but %s means %u",
                       question->where, question->columns, question->columns == 1 ? "" : "s",
                       layout->name, layout->columns);
    }
    if (options->weight_column && !layout->has_weight) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: columns %s have no weight column",
                       question->where, layout->name);
    }
    if (layout->angles != PS_NO_ANGLES && options->domain == PS_DOMAIN_TORUS) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: columns %s are points of the sphere; this is about the torus",
                       question->where, layout->name);
    }
    if (layout->columns - layout->has_weight == 2 && layout->angles == PS_NO_ANGLES &&
        options->domain == PS_DOMAIN_SPHERE) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: columns %s are points of the torus; this is about the sphere",
                       question->where, layout->name);
    }
    return PSPEC_OK;
}

static pspec_status resolve_named(ps_layout *out, const ps_columns_question *question,
                                  const named_layout *layout, ps_error *error) {
    const ps_point_options *options = question->options;
    PS_TRY(check_named(question, layout, error));
    const bool may_be_vectors = layout->columns - layout->has_weight == 3 &&
                                (options->domain == PS_DOMAIN_SPHERE ||
                                 (options->domain == PS_DOMAIN_ANY && options->dimension == 0));
    const bool are_vectors =
        may_be_vectors && (options->domain == PS_DOMAIN_SPHERE || options->normalize_vectors ||
                           ps_is_unit_vector(question->first));
    if (layout->angles == PS_NO_ANGLES && !are_vectors) {
        return set_torus(out, question, layout->has_weight, error);
    }
    set_sphere(out, layout->angles, layout->has_weight, options->keep_angles);
    out->in_degrees = layout->in_degrees;
    return PSPEC_OK;
}

/* Three columns are a vector, four a vector and its weight. */
static pspec_status resolve_sphere(ps_layout *out, const ps_columns_question *question,
                                   ps_error *error) {
    const unsigned columns = question->columns;
    if (columns == 3U + question->options->weight_column || columns == 4) {
        set_sphere(out, PS_NO_ANGLES, columns == 4, false);
        return PSPEC_OK;
    }
    if (columns == 2 || columns == 3) {
        const char *const weight = columns == 3 ? "-w" : "";
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %u columns; which angles are they? --columns theta-phi%s, phi-theta%s "
                       "or lon-lat%s; --lift takes "
                       "points of the plane to the sphere",
                       question->where, columns, weight, weight, weight);
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %u column%s; points of the sphere have 2 to 4%s",
                   question->where, columns, columns == 1 ? "" : "s",
                   columns == 1 ? " (one number a line? --columns xyz)" : "");
}

/* Rows of three or four numbers that begin with a unit vector (a random point of the torus does so
 * once in a million). */
static bool looks_like_sphere(const ps_columns_question *question) {
    const ps_point_options *options = question->options;
    const bool has_vector =
        question->columns == 3 + (unsigned)options->weight_column || question->columns == 4;
    return options->dimension == 0 && has_vector && !options->wrap &&
           (options->normalize_vectors || ps_is_unit_vector(question->first));
}

/* The columns of an array (3, N), or (4, N) with weights. */
static pspec_status resolve_by_shape(ps_layout *out, const ps_columns_question *question,
                                     ps_error *error) {
    const ps_point_options *const options = question->options;
    if (!options->normalize_vectors && !ps_is_unit_vector(question->first)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: columns of an array that are no unit vectors; are they points, or its "
                       "rows angles? --transpose or --columns theta-phi-w",
                       question->where);
    }
    PS_TRY(resolve_sphere(out, question, error));
    out->by_shape = true;
    return PSPEC_OK;
}

/* Directions taken mod 1 would be points of no meaning. */
static pspec_status check_wrap(const ps_columns_question *question, ps_error *error) {
    const ps_point_options *options = question->options;
    const double *const first = question->first;
    bool is_inside = true;
    for (unsigned j = 0; j < question->columns && j < 3; j++) {
        is_inside = is_inside && first[j] >= 0 && first[j] < 1;
    }
    return options->wrap && options->dimension == 0 && question->columns >= 3 && !is_inside &&
                   ps_is_unit_vector(first)
               ? ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: a unit vector? --wrap is about points of the torus; -d %u says that "
                         "this is one",
                         question->where, question->columns - options->weight_column)
               : PSPEC_OK;
}

/* Points of the torus, of two coordinates, that leave it. */
static pspec_status resolve_lifted(ps_layout *out, const ps_columns_question *question,
                                   ps_error *error) {
    enum { PLANE = 2, VECTOR = 3 };
    ps_columns_question own = *question;
    ps_point_options options = *question->options;
    own.options = &options;
    if (options.domain == PS_DOMAIN_TORUS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--lift makes points of the sphere; this is about the torus");
    }
    options.domain = PS_DOMAIN_TORUS;
    options.dimension = 0;
    options.lift = PS_NO_LIFT;
    PS_TRY(ps_columns_resolve(out, &own, error));
    if (out->dimension != PLANE) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: --lift is for points (x, y) of the plane, and these have %u "
                       "coordinate%s%s",
                       question->where, out->dimension, out->dimension == 1 ? "" : "s",
                       out->dimension == VECTOR ? " (is the last one a weight? --columns xyw)"
                                                : "");
    }
    out->lift = question->options->lift;
    out->coordinates = PS_UNIT_VECTORS;
    out->dimension = VECTOR;
    return PSPEC_OK;
}

/* A box is of the torus, and has an interval for all axes or one for each. */
static pspec_status check_box(const ps_layout *layout, const ps_columns_question *question,
                              ps_error *error) {
    const unsigned num = question->options->box.num_axes;
    if (layout->coordinates != PS_TORUS_COORDINATES) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: --box is for points of the torus, and these are of the sphere",
                       question->where);
    }
    return num == 1 || num == layout->dimension
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: --box has %u intervals, and points of %u coordinate%s need one of "
                         "all axes, or %u",
                         question->where, num, layout->dimension, layout->dimension == 1 ? "" : "s",
                         layout->dimension);
}

pspec_status ps_columns_resolve(ps_layout *out, const ps_columns_question *question,
                                ps_error *error) {
    if (question->options->lift != PS_NO_LIFT) {
        return resolve_lifted(out, question, error);
    }
    const ps_point_options *options = question->options;
    const char *name = options->columns != NULL ? options->columns : question->own;
    if (name != NULL) {
        const named_layout *layout = find_named(name);
        if (layout == NULL) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "columns \"%s\" are none of " PS_POINT_COLUMNS, name);
        }
        PS_TRY(resolve_named(out, question, layout, error));
    } else if (question->by_shape) {
        PS_TRY(resolve_by_shape(out, question, error));
    } else if (options->domain == PS_DOMAIN_SPHERE ||
               (options->domain == PS_DOMAIN_ANY && looks_like_sphere(question))) {
        PS_TRY(resolve_sphere(out, question, error));
    } else {
        PS_TRY(check_wrap(question, error));
        PS_TRY(set_torus(out, question, options->weight_column, error));
    }
    out->drops_weight = options->ignore_weights;
    return options->box.num_axes > 0 ? check_box(out, question, error) : PSPEC_OK;
}

pspec_status ps_columns_for_writing(ps_layout *out, const ps_point_shape *shape, ps_error *error) {
    *out = (ps_layout){.coordinates = shape->coordinates,
                       .dimension = shape->dimension,
                       .angles = shape->coordinates == PS_ANGLES ? PS_THETA_PHI : PS_NO_ANGLES,
                       .has_weight_column = shape->has_weights};
    if (shape->columns == NULL) {
        return PSPEC_OK;
    }
    const named_layout *layout = find_named(shape->columns);
    if (layout == NULL || layout->columns - layout->has_weight + (layout->angles != 0) != 3) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "columns \"%s\" are not a way to write points of the sphere",
                       shape->columns);
    }
    if (shape->coordinates == PS_TORUS_COORDINATES) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "columns %s are for points of the sphere; these are of the torus",
                       shape->columns);
    }
    if (layout->has_weight && !shape->has_weights) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "columns %s need weights, and these points have none", shape->columns);
    }
    set_sphere(out, layout->angles, shape->has_weights, true);
    out->in_degrees = layout->in_degrees;
    return PSPEC_OK;
}
