#include "answers/points/points.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

/* ---- where points are shown ------------------------------------------------------------------ */

/* What a panel shows of a set: two of its coordinates, of the sphere on one side alone. */
typedef struct view {
    unsigned first, second; /* coordinates; the same one: there is no other */
    int side;               /* 1: z >= 0, -1: z < 0, 0: all points */
} view;

enum { MOST_VIEWS = PS_MAX_DIMENSION * (PS_MAX_DIMENSION - 1) / 2 };

static size_t list_views(view views[MOST_VIEWS], const ps_drawn_set *set, bool is_one) {
    size_t num = 0;
    if (set->where != PS_SAMPLES_TORUS) {
        views[num++] = (view){0, 1, 1};
        if (set->where == PS_SAMPLES_SPHERE) {
            views[num++] = (view){0, 1, -1};
        }
        return num;
    }
    if (set->dimension == 1) {
        views[num++] = (view){0, 0, 0};
        return num;
    }
    for (unsigned i = 0; i + 1 < set->dimension; i++) {
        for (unsigned j = i + 1; j < set->dimension; j++) {
            if (num == 0 || is_one) {
                views[num++] = (view){i, j, 0};
            }
        }
    }
    return num;
}

/* Parts of the axes: from 0 to 2^-k, of the sphere to both sides; 0: all. */
enum { MOST_HALVINGS = 20 };

/* The smallest part that a point is in; -1: it is on the other side of the sphere. */
static int find_part(const view *how, const double *point) {
    const double reach = fmax(fabs(point[how->first]), fabs(point[how->second]));
    int exponent = 0;
    if (how->side != 0 && (point[2] >= 0) != (how->side > 0)) {
        return -1;
    }
    frexp(reach, &exponent); /* below 2^exponent */
    return reach == 0 || exponent < -MOST_HALVINGS ? MOST_HALVINGS : exponent < 0 ? -exponent : 0;
}

/* A set, how it is looked at, and how many points each part of each view has. */
typedef struct survey {
    const ps_drawn_set *set;
    size_t num_views;
    view views[MOST_VIEWS];
    size_t counts[MOST_VIEWS][MOST_HALVINGS + 1];
    int part; /* that is shown */
} survey;

/* Points between two calls of the watch: milliseconds. */
enum { BLOCK = 1 << 18 };

static pspec_status tell(const survey *self, size_t i, const ps_watch *watch, ps_error *error) {
    return i % BLOCK == 0 && i > 0
               ? ps_watch_tell(watch, "points looked at", i, self->set->num_points, NULL, error)
               : PSPEC_OK;
}

static pspec_status count_parts(survey *self, const ps_watch *watch, ps_error *error) {
    const ps_drawn_set *const set = self->set;
    for (size_t i = 0; i < set->num_points; i++) {
        PS_TRY(tell(self, i, watch, error));
        for (size_t v = 0; v < self->num_views; v++) {
            const int part = find_part(&self->views[v], set->points + i * set->dimension);
            if (part >= 0) {
                self->counts[v][part]++;
            }
        }
    }
    for (size_t v = 0; v < self->num_views; v++) { /* a part has those that are in smaller ones */
        for (int part = MOST_HALVINGS; part-- > 0;) {
            self->counts[v][part] += self->counts[v][part + 1];
        }
    }
    return PSPEC_OK;
}

/* The largest part that has few enough points in every view; of sets that lie in a place, one that
 * may have more, but not none. */
static void choose_part(survey *self) {
    const size_t most = self->set->dimension == 1 ? PS_MOST_DRAWN_OF_LINE : PS_MOST_DRAWN;
    for (size_t v = 0; v < self->num_views; v++) {
        while (self->part < MOST_HALVINGS && self->counts[v][self->part] > most &&
               self->counts[v][self->part + 1] > 0) {
            self->part++;
        }
    }
}

/* ---- a panel --------------------------------------------------------------------------------- */

static void append(ps_text *title, const char *text) {
    ps_text_append(title, "%s%s", title->length > 0 ? ", " : "", text);
}

/* The set where there are several, the side of the sphere, the part of it. */
static void write_title(ps_text *title, const ps_drawn_set *set, bool is_one, const view *how,
                        double reach) {
    if (!is_one) {
        ps_text_append(title, "%s, N = %zu", set->name, set->num_points);
    }
    if (how->side != 0) {
        append(title, how->side > 0 ? "z ≥ 0, from above" : "z < 0, from below");
    }
    if (reach < 1 && how->side != 0) {
        ps_text_append(title, ", |x| and |y| up to %g", reach);
    } else if (reach < 1) {
        append(title, set->dimension == 1 ? "the part [0, " : "the corner [0, ");
        ps_text_append(title, "%g)%s", reach, set->dimension == 1 ? "" : "²");
    }
}

static ps_frame make_frame(const ps_drawn_set *set, const view *how, double reach) {
    static const char *const names[PS_MAX_DIMENSION] = {"x_1", "x_2", "x_3", "x_4", "x_5", "x_6"};
    const bool is_numbered = set->where == PS_SAMPLES_TORUS && set->dimension > 2;
    const bool is_disc = how->side != 0 && reach >= 1;
    return (ps_frame){.form = is_disc                     ? PS_FRAME_DISC
                              : how->first == how->second ? PS_FRAME_LINE
                                                          : PS_FRAME_SQUARE,
                      .first = how->side != 0 ? -reach : 0,
                      .last = reach,
                      .x_label = is_numbered ? names[how->first] : "x",
                      .y_label = is_numbered ? names[how->second] : "y",
                      .is_mirrored = how->side < 0};
}

static pspec_status fill(ps_series *out, ps_pool *memory, const survey *self, size_t v,
                         const ps_watch *watch, ps_error *error) {
    const ps_drawn_set *const set = self->set;
    const view *const how = &self->views[v];
    const size_t num = self->counts[v][self->part];
    double *places = NULL;
    size_t place = 0;
    PS_TRY(PS_POOL_NEW(memory, &places, 2 * num, "a picture", error));
    for (size_t i = 0; i < set->num_points; i++) {
        const double *const point = set->points + i * set->dimension;
        PS_TRY(tell(self, i, watch, error));
        if (find_part(how, point) >= self->part) {
            places[place] = point[how->first];
            places[num + place++] = point[how->second];
        }
    }
    *out = (ps_series){.num = num, .x = places, .y = places + num};
    return PSPEC_OK;
}

static pspec_status add_panel(ps_points_picture *self, const survey *how, size_t v,
                              const ps_watch *watch, ps_error *error) {
    const double reach = ldexp(1, -how->part);
    ps_text title = {0};
    ps_series *series = NULL;
    ps_panel *const panel = &self->panels[self->num++];
    PS_TRY(PS_POOL_NEW(self->memory, &series, 1, "a picture", error));
    write_title(&title, how->set, self->num_sets == 1, &how->views[v], reach);
    *panel = (ps_panel){
        .num_series = 1, .series = series, .frame = make_frame(how->set, &how->views[v], reach)};
    PS_TRY(ps_text_keep(&panel->title, self->memory, &title, error));
    return fill(series, self->memory, how, v, watch, error);
}

/* Room for all panels that there may be. */
static pspec_status begin(ps_points_picture *self, ps_error *error) {
    const size_t most = self->num_sets * (self->num_sets > 1 ? 2 : MOST_VIEWS);
    return PS_POOL_NEW(self->memory, &self->panels, most, "a picture", error);
}

pspec_status ps_points_picture_add(ps_points_picture *self, const ps_drawn_set *set,
                                   const ps_watch *watch, ps_error *error) {
    survey how = {.set = set};
    if (self->panels == NULL) {
        PS_TRY(begin(self, error));
    }
    how.num_views = list_views(how.views, set, self->num_sets == 1);
    PS_TRY(count_parts(&how, watch, error));
    choose_part(&how);
    self->num_points = set->num_points;
    for (size_t v = 0; v < how.num_views; v++) {
        PS_TRY(add_panel(self, &how, v, watch, error));
    }
    return PSPEC_OK;
}

/* ---- all of them ----------------------------------------------------------------------------- */

/* Nearly a square of panels, but three side by side; sides of a sphere stay together; lines are one
 * below the other. */
static size_t find_columns(const ps_points_picture *self) {
    const bool has_sides = self->num > 1 && self->panels[1].frame.is_mirrored;
    const size_t few = 3;
    size_t columns = 1;
    if (self->panels[0].frame.form == PS_FRAME_LINE) {
        return 1;
    }
    while (columns * columns < self->num && columns < PS_MOST_POINT_COLUMNS) {
        columns++;
    }
    if (has_sides) {
        return self->num <= 2 * few ? 2 : PS_MOST_POINT_COLUMNS;
    }
    return self->num == few ? few : columns;
}

ps_figure ps_points_picture_figure(const ps_points_picture *self, const char *title) {
    return (ps_figure){.form = PS_FIGURE_POINTS,
                       .title = title,
                       .num_panels = self->num,
                       .panels = self->panels,
                       .num_columns = find_columns(self)};
}

static ps_sampler_domain find_domain(const ps_table *table) {
    const char *const text = ps_cell_text(ps_table_find_meta(table, "domain"));
    return strcmp(text, "sphere") == 0       ? PS_SAMPLES_SPHERE
           : strcmp(text, "hemisphere") == 0 ? PS_SAMPLES_HEMISPHERE
                                             : PS_SAMPLES_TORUS;
}

pspec_status ps_points_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                              ps_error *error) {
    ps_points_picture picture = {.num_sets = chart->num_parts, .memory = memory};
    for (size_t i = 0; i < chart->num_parts; i++) {
        const ps_chart_part *const part = &chart->parts[i];
        const ps_npy_array *const sets = ps_table_find_array(part->table, "coordinates");
        const ps_drawn_set set = {part->label, find_domain(part->table), (unsigned)sets->shape[2],
                                  sets->shape[1], sets->data};
        PS_TRY(ps_points_picture_add(&picture, &set, chart->watch, error));
    }
    *out = ps_points_picture_figure(&picture, chart->title);
    return PSPEC_OK;
}
