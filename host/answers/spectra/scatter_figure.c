/* The picture of --scatter: the first sets along a row of frequencies, and all at one of them. */
#include "answers/spectra/scatter.h"
#include "base/text.h"
#include "math/pi.h"

#include <math.h>

/* Sets that have a colour, a line and a mark. */
enum { MOST_LINES = 3, CIRCLE = 129, BLACK = 6 };
/* Real parts, imaginary parts, the plane. */
enum { REAL, IMAGINARY, PLANE, NUM_PANELS, MOST_SERIES = MOST_LINES + 2 };

typedef struct picture {
    const ps_frequencies_spec *asked;
    size_t num_sets;
    int32_t max_frequency;
    const double *rows; /* [num_sets][2K+1][2] */
    size_t num_lines;   /* sets that are shown along the row */
    int32_t first;      /* the numbers of the row that are shown begin there */
    size_t num_row;     /* and are so many */
    double *row;        /* these numbers */
    const char *labels[MOST_LINES];
    ps_panel *panels;
    ps_series *series; /* [NUM_PANELS][MOST_SERIES] */
    ps_pool *memory;
    ps_error *error;
} picture;

static const double *value_of(const picture *self, size_t set, int32_t number) {
    const size_t side = 2 * (size_t)self->max_frequency + 1;
    return self->rows + 2 * (set * side + (size_t)(number + self->max_frequency));
}

static bool is_dc(const picture *self, int32_t number) {
    bool is_zero = number == 0;
    for (unsigned axis = 1; axis < self->asked->num_shown; axis++) {
        is_zero = is_zero && self->asked->shown[axis] == 0;
    }
    return is_zero;
}

static pspec_status take_numbers(const picture *self, double **out, size_t num) {
    return PS_POOL_NEW(self->memory, out, num, "a picture", self->error);
}

static ps_series *add_series(const picture *self, size_t panel, ps_series series) {
    ps_panel *const own = &self->panels[panel];
    ps_series *const out = self->series + panel * MOST_SERIES + own->num_series++;
    *out = series;
    return out;
}

/* ---- parts ----------------------------------------------------------------------------------- */

/* From the least to the largest number of a panel of parts. */
static pspec_status add_mark(const picture *self, size_t panel, double low, double high) {
    double *mark = NULL;
    PS_TRY(take_numbers(self, &mark, 4));
    mark[0] = mark[1] = self->asked->shown[0];
    mark[2] = low;
    mark[3] = high;
    add_series(self, panel,
               (ps_series){.num = 2, .x = mark, .y = mark + 2, .look = PS_LOOK_REFERENCE});
    return PSPEC_OK;
}

/* S(0), which is larger than all others, is a gap. */
static pspec_status add_parts(const picture *self, size_t panel) {
    double low = 0;
    double high = 0;
    for (size_t r = 0; r < self->num_lines; r++) {
        double *part = NULL;
        PS_TRY(take_numbers(self, &part, self->num_row));
        for (size_t j = 0; j < self->num_row; j++) {
            const int32_t number = self->first + (int32_t)j;
            self->row[j] = number;
            part[j] = is_dc(self, number) ? NAN : value_of(self, r, number)[panel];
            low = fmin(low, part[j]);
            high = fmax(high, part[j]);
        }
        add_series(self, panel,
                   (ps_series){.label = self->labels[r],
                               .kind = r,
                               .num = self->num_row,
                               .x = self->row,
                               .y = part});
    }
    return add_mark(self, panel, low, high);
}

/* ---- the plane ------------------------------------------------------------------------------- */

/* |S| as it is in the root mean square. */
static pspec_status add_circle(const picture *self, double radius) {
    double *circle = NULL;
    PS_TRY(take_numbers(self, &circle, 2 * CIRCLE));
    for (size_t i = 0; i < CIRCLE; i++) {
        const double angle = PS_TWO_PI * (double)i / (CIRCLE - 1);
        circle[i] = radius * cos(angle);
        circle[CIRCLE + i] = radius * sin(angle);
    }
    add_series(self, PLANE,
               (ps_series){.label = "root mean square of |S|",
                           .kind = BLACK,
                           .num = CIRCLE,
                           .x = circle,
                           .y = circle + CIRCLE,
                           .look = PS_LOOK_BOUND});
    return PSPEC_OK;
}

/* All sets, the circle, and the first sets upon them. */
static pspec_status add_plane(const picture *self) {
    const size_t num = self->num_sets;
    double *real = NULL;
    double sum = 0;
    PS_TRY(take_numbers(self, &real, 2 * num));
    double *const imaginary = real + num;
    for (size_t r = 0; r < num; r++) {
        const double *const value = value_of(self, r, self->asked->shown[0]);
        real[r] = value[0];
        imaginary[r] = value[1];
        sum += value[0] * value[0] + value[1] * value[1];
    }
    add_series(self, PLANE,
               (ps_series){.num = num, .x = real, .y = imaginary, .look = PS_LOOK_CLOUD});
    PS_TRY(add_circle(self, num > 0 ? sqrt(sum / (double)num) : 0));
    for (size_t r = 0; r < self->num_lines; r++) {
        add_series(self, PLANE,
                   (ps_series){.label = self->labels[r],
                               .kind = r,
                               .num = 1,
                               .x = real + r,
                               .y = imaginary + r,
                               .look = PS_LOOK_MARKS});
    }
    return PSPEC_OK;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* k, or k_1 where there are others, which stand beside it. */
static pspec_status write_axes(const picture *self) {
    const ps_frequencies_spec *const asked = self->asked;
    ps_text axis = {0};
    ps_text_append(&axis, "%s", asked->num_shown > 1 ? "k_1" : "k");
    for (unsigned i = 1; i < asked->num_shown; i++) {
        ps_text_append(&axis, ", k_%u = %d", i + 1, (int)asked->shown[i]);
    }
    PS_TRY(ps_text_keep(&self->panels[REAL].frame.x_label, self->memory, &axis, self->error));
    self->panels[IMAGINARY].frame = self->panels[REAL].frame;
    self->panels[PLANE].frame =
        (ps_frame){.form = PS_FRAME_PLANE, .x_label = "real part", .y_label = "imaginary part"};
    return PSPEC_OK;
}

static pspec_status write_words(picture *self) {
    const ps_frequencies_spec *const asked = self->asked;
    ps_text title = {0};
    ps_text_append(&title, "S(");
    for (unsigned axis = 0; axis < asked->num_shown; axis++) {
        ps_text_append(&title, "%s%d", axis > 0 ? ", " : "", (int)asked->shown[axis]);
    }
    ps_text_append(&title, ") of %zu set%s", self->num_sets, self->num_sets == 1 ? "" : "s");
    PS_TRY(ps_text_keep(&self->panels[PLANE].title, self->memory, &title, self->error));
    self->panels[REAL].title = "real part of S(k)";
    self->panels[IMAGINARY].title = "imaginary part of S(k)";
    for (size_t r = 0; r < self->num_lines; r++) {
        ps_text label = {0};
        ps_text_append(&label, "set %zu", r + 1);
        PS_TRY(ps_text_keep(&self->labels[r], self->memory, &label, self->error));
    }
    return write_axes(self);
}

static pspec_status fill(picture *self) {
    PS_TRY(take_numbers(self, &self->row, self->num_row));
    PS_TRY(PS_POOL_NEW(self->memory, &self->panels, NUM_PANELS, "a picture", self->error));
    PS_TRY(PS_POOL_NEW(self->memory, &self->series, NUM_PANELS * MOST_SERIES, "a picture",
                       self->error));
    for (size_t panel = 0; panel < NUM_PANELS; panel++) {
        self->panels[panel].series = self->series + panel * MOST_SERIES;
    }
    PS_TRY(write_words(self));
    PS_TRY(add_parts(self, REAL));
    PS_TRY(add_parts(self, IMAGINARY));
    return add_plane(self);
}

/* On the line negative frequencies say nothing new. */
pspec_status ps_scatter_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                               ps_error *error) {
    const ps_chart_part *const part = &chart->parts[0];
    const ps_npy_array *const scatter = ps_table_find_array(part->table, "scatter");
    const ps_frequencies_spec *const asked = &part->request->frequencies;
    const int32_t last = (int32_t)(scatter->shape[1] / 2);
    const int32_t first = asked->num_shown > 1 || asked->shown[0] <= 0 ? -last : 1;
    picture self = {.asked = asked,
                    .num_sets = scatter->shape[0],
                    .max_frequency = last,
                    .rows = scatter->data,
                    .num_lines = scatter->shape[0] < MOST_LINES ? scatter->shape[0] : MOST_LINES,
                    .first = first,
                    .num_row = (size_t)(last - first + 1),
                    .memory = memory,
                    .error = error};
    PS_TRY(fill(&self));
    *out = (ps_figure){.form = PS_FIGURE_FRAME,
                       .title = chart->title,
                       .x_label = "",
                       .y_label = "",
                       .num_panels = NUM_PANELS,
                       .panels = self.panels};
    return PSPEC_OK;
}
