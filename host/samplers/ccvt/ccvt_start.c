/* The first owners of background points: sites in bands of equal numbers, in every band by their
 * place along it, and points in the same bands, each M of them for a site. Points at random would
 * need many times the exchanges. */
#include "samplers/ccvt/ccvt.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Numbers that are merged between two words to the watch. */
enum { MERGED_AT_A_TIME = 1 << 16 };

typedef struct ranked {
    double key;
    uint32_t number;
} ranked;

/* Of sites or of background points. */
typedef struct sorting {
    ps_ccvt *ccvt;
    double **at;
    size_t num, per_site;
    ranked *order, *spare;
    double *spare_numbers;
} sorting;

/* One of two sorted runs that end at middle and end, whole or a part of it. */
typedef struct merging {
    size_t a, middle, b, end, out;
} merging;

static void merge_some(const ranked *from, ranked *to, merging *m, size_t most) {
    for (size_t k = 0; k < most && m->out < m->end; k++) {
        const bool takes_first =
            m->b == m->end || (m->a < m->middle && from[m->a].key <= from[m->b].key);
        to[m->out++] = from[takes_first ? m->a++ : m->b++];
    }
}

static pspec_status merge(ps_ccvt *c, const ranked *from, ranked *to, merging m, ps_error *error) {
    while (m.out < m.end) {
        const size_t before = m.out;
        merge_some(from, to, &m, MERGED_AT_A_TIME);
        PS_TRY(ps_ccvt_go_on(c, m.out - before, error));
    }
    return PSPEC_OK;
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

/* order[first .. end - 1] by their keys, equal ones as they are. */
static pspec_status sort(sorting *s, size_t first, size_t end, ps_error *error) {
    ranked *from = s->order;
    ranked *to = s->spare;
    for (size_t width = 1; width < end - first; width *= 2) {
        for (size_t run = first; run < end; run += 2 * width) {
            const size_t middle = least(run + width, end);
            const merging m = {run, middle, middle, least(run + 2 * width, end), run};
            PS_TRY(merge(s->ccvt, from, to, m, error));
        }
        ranked *const kept = from;
        from = to;
        to = kept;
    }
    for (size_t k = first; k < end && from != s->order; k++) {
        s->order[k] = from[k];
    }
    return PSPEC_OK;
}

static pspec_status set_keys(sorting *s, size_t first, size_t end, double (*key)(const double *),
                             ps_error *error) {
    double place[PS_CCVT_AXES] = {0};
    for (size_t k = first; k < end; k++) {
        ps_ccvt_place(s->at, s->order[k].number, s->ccvt->space->room.axes, place);
        s->order[k].key = key(place);
        PS_TRY(ps_ccvt_go_on(s->ccvt, 1, error));
    }
    return PSPEC_OK;
}

static size_t num_bands(const ps_ccvt *c) {
    const double bands = rint(sqrt(c->space->aspect * (double)c->num));
    return bands < 1 ? 1 : (size_t)bands;
}

static pspec_status sort_bands(sorting *s, ps_error *error) {
    const ps_ccvt_space *const space = s->ccvt->space;
    const size_t bands = num_bands(s->ccvt);
    for (size_t k = 0; k < s->num; k++) {
        s->order[k].number = (uint32_t)k;
        PS_TRY(ps_ccvt_go_on(s->ccvt, 1, error));
    }
    PS_TRY(set_keys(s, 0, s->num, space->height, error));
    PS_TRY(sort(s, 0, s->num, error));
    for (size_t b = 0; b < bands; b++) {
        const size_t first = b * s->ccvt->num / bands * s->per_site;
        const size_t end = (b + 1) * s->ccvt->num / bands * s->per_site;
        PS_TRY(set_keys(s, first, end, space->along, error));
        PS_TRY(sort(s, first, end, error));
    }
    return PSPEC_OK;
}

static pspec_status apply_order(sorting *s, ps_error *error) {
    for (unsigned a = 0; a < s->ccvt->space->room.axes; a++) {
        for (size_t k = 0; k < s->num; k++) {
            s->spare_numbers[k] = s->at[a][s->order[k].number];
            PS_TRY(ps_ccvt_go_on(s->ccvt, 1, error));
        }
        double *const kept = s->at[a];
        for (size_t k = 0; k < s->num; k++) {
            kept[k] = s->spare_numbers[k];
        }
    }
    return PSPEC_OK;
}

static pspec_status put_in_bands(ps_ccvt *c, double **at, size_t per_site, ps_error *error) {
    sorting s = {.ccvt = c, .at = at, .num = c->num * per_site, .per_site = per_site};
    s.spare_numbers = c->own; /* there are no distances yet */
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&s.order, s.num, "the order of points", error));
    PS_TRY_OUT(status, PS_NEW(&s.spare, s.num, "the order of points", error));
    PS_TRY_OUT(status, sort_bands(&s, error));
    status = apply_order(&s, error);
out:
    free(s.order);
    free(s.spare);
    return status;
}

pspec_status ps_ccvt_start(ps_ccvt *c, ps_error *error) {
    PS_TRY(put_in_bands(c, c->site, 1, error));
    return put_in_bands(c, c->at, c->capacity, error);
}
