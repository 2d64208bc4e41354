/* Names of columns that say what these are, as catalogues and data frames have them. */
#include "points/columns.h"

#include <string.h>
#include <strings.h>

typedef struct slice {
    const char *text;
    size_t length;
} slice;

/* Two names and what their columns are. */
typedef struct named_pair {
    const char *first, *second;
    ps_angle_order angles;
    bool may_be_swapped; /* the names may also come in the other order */
} named_pair;

/* Azimuths count from the first axis to the second: where they do the other way, the mirror image
 * of the points is read, whose spectra are the same. */
static const named_pair pairs[] = {
    {"x", "y", PS_NO_ANGLES, false},
    {"theta", "phi", PS_THETA_PHI, false},
    {"phi", "theta", PS_PHI_THETA, false},
    {"lon", "lat", PS_LON_LAT, true},
    {"lng", "lat", PS_LON_LAT, true},
    {"long", "lat", PS_LON_LAT, true},
    {"longitude", "latitude", PS_LON_LAT, true},
    {"ra", "dec", PS_LON_LAT, true},
    {"ra", "de", PS_LON_LAT, false},
    {"raj2000", "dej2000", PS_LON_LAT, false},
    {"glon", "glat", PS_LON_LAT, true},
    {"l", "b", PS_LON_LAT, false},
    {"az", "alt", PS_LON_LAT, true},
    {"az", "el", PS_LON_LAT, false},
    {"azimuth", "altitude", PS_LON_LAT, false},
    {"azimuth", "elevation", PS_LON_LAT, false},
};
enum { NUM_PAIRS = sizeof pairs / sizeof pairs[0] };

/* Letters of either case are the same. */
static bool is_same(slice name, const char *word) {
    return name.length == strlen(word) && strncasecmp(name.text, word, name.length) == 0;
}

static bool is_weight(slice name) {
    return is_same(name, "w") || is_same(name, "weight") || is_same(name, "weights");
}

/* Takes "_deg" off the end of the name. */
static bool drop_degrees(slice *name) {
    static const char *const ends[] = {"_deg", "_degrees"};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const size_t length = strlen(ends[i]);
        if (name->length > length &&
            strncasecmp(name->text + name->length - length, ends[i], length) == 0) {
            name->length -= length;
            return true;
        }
    }
    return false;
}

/* "x,y,z" and "x,y,z,w". */
static const char *layout_of_space(const slice *names, unsigned num) {
    enum { VECTOR = 3 };
    const bool is_space =
        num >= VECTOR && is_same(names[0], "x") && is_same(names[1], "y") && is_same(names[2], "z");
    if (is_space && num == VECTOR) {
        return "xyz";
    }
    return is_space && num == VECTOR + 1 && is_weight(names[VECTOR]) ? "xyzw" : NULL;
}

static unsigned split(const char *names, slice *out, unsigned most) {
    unsigned num = 0;
    for (bool is_more = true; is_more && num < most; num++) {
        out[num] = (slice){names, strcspn(names, ",")};
        is_more = names[out[num].length] == ',';
        names += out[num].length + is_more;
    }
    return num;
}

const char *ps_columns_of_names(const char *names, bool *are_swapped) {
    enum { PAIR = 2, MOST = 5 };
    slice found[MOST];
    const unsigned num = split(names, found, MOST);
    const bool has_weight = num == PAIR + 1 && is_weight(found[PAIR]);
    *are_swapped = false;
    if (num != PAIR && !has_weight) {
        return layout_of_space(found, num);
    }
    const bool in_degrees = drop_degrees(&found[0]);
    if (drop_degrees(&found[1]) != in_degrees) {
        return NULL;
    }
    for (size_t i = 0; i < NUM_PAIRS; i++) {
        const named_pair *const pair = &pairs[i];
        *are_swapped = pair->may_be_swapped && is_same(found[0], pair->second) &&
                       is_same(found[1], pair->first);
        if (*are_swapped || (is_same(found[0], pair->first) && is_same(found[1], pair->second))) {
            return ps_columns_name(pair->angles, has_weight,
                                   in_degrees || pair->angles == PS_LON_LAT);
        }
    }
    return NULL;
}
