/* Names of columns that say what these are, as catalogues and data frames have them. */
#include "points/columns.h"

#include <string.h>
#include <strings.h>

typedef struct slice {
    const char *text;
    size_t length;
} slice;

/* Two names and the layouts of their columns: without and with a weight, then both in degrees. */
typedef struct named_pair {
    const char *first, *second;
    const char *const *layouts;
    bool are_swapped; /* names of the layout in the other order */
} named_pair;

static const char *const plane[] = {"xy", "xyw", NULL, NULL};
static const char *const theta_phi[] = {"theta-phi", "theta-phi-w", "theta-phi:degrees",
                                        "theta-phi-w:degrees"};
static const char *const phi_theta[] = {"phi-theta", "phi-theta-w", "phi-theta:degrees",
                                        "phi-theta-w:degrees"};
static const char *const lon_lat[] = {"lon-lat", "lon-lat-w", "lon-lat", "lon-lat-w"};

/* Azimuths count from the first axis to the second: where they do the other way, the mirror image
 * of the points is read, whose spectra are the same. */
static const named_pair pairs[] = {
    {"x", "y", plane, false},
    {"theta", "phi", theta_phi, false},
    {"phi", "theta", phi_theta, false},
    {"lon", "lat", lon_lat, false},
    {"lng", "lat", lon_lat, false},
    {"long", "lat", lon_lat, false},
    {"longitude", "latitude", lon_lat, false},
    {"ra", "dec", lon_lat, false},
    {"ra", "de", lon_lat, false},
    {"raj2000", "dej2000", lon_lat, false},
    {"glon", "glat", lon_lat, false},
    {"l", "b", lon_lat, false},
    {"az", "alt", lon_lat, false},
    {"az", "el", lon_lat, false},
    {"azimuth", "altitude", lon_lat, false},
    {"azimuth", "elevation", lon_lat, false},
    {"lat", "lon", lon_lat, true},
    {"lat", "lng", lon_lat, true},
    {"lat", "long", lon_lat, true},
    {"latitude", "longitude", lon_lat, true},
    {"dec", "ra", lon_lat, true},
    {"glat", "glon", lon_lat, true},
    {"alt", "az", lon_lat, true},
};
enum { NUM_PAIRS = sizeof pairs / sizeof pairs[0] };

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
    const bool first_in_degrees = drop_degrees(&found[0]);
    if (drop_degrees(&found[1]) != first_in_degrees) {
        return NULL;
    }
    for (size_t i = 0; i < NUM_PAIRS; i++) {
        if (is_same(found[0], pairs[i].first) && is_same(found[1], pairs[i].second)) {
            *are_swapped = pairs[i].are_swapped;
            return pairs[i].layouts[PAIR * first_in_degrees + has_weight];
        }
    }
    return NULL;
}
