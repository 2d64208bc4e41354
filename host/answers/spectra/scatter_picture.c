/* The picture of --scatter: the first sets along a row of frequencies, and all at one of them. */
#include "answers/spectra/scatter.h"
#include "base/memory.h"
#include "base/text.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sets that have a colour, a line and a mark. */
enum { MOST_LINES = 3, CIRCLE = 129, BLACK = 6 };
/* Real parts, imaginary parts, the plane. */
enum { NUM_PANELS = 3, MOST_SERIES = MOST_LINES + 2 };

typedef struct picture {
    const ps_scatter *scatter;
    size_t num_lines;         /* sets that are shown along the row */
    int32_t first;            /* the numbers of the row that are shown begin there */
    size_t num_row;           /* and are so many */
    double *row;              /* these numbers */
    double *parts;            /* [NUM_PANELS - 1][num_lines][num_row] */
    double *plane;            /* real parts of all sets, then imaginary ones */
    double circle[2][CIRCLE]; /* |S| as it is in the root mean square */
    double mark[2][2][2];     /* the line at the frequency, in the panels of parts */
    ps_text labels[MOST_LINES];
    ps_text axis, titles[NUM_PANELS];
    ps_series series[NUM_PANELS][MOST_SERIES];
    ps_panel panels[NUM_PANELS];
    ps_panel_axes axes[NUM_PANELS];
} picture;

static void release(picture *self) {
    free(self->row);
    free(self->parts);
    free(self->plane);
    ps_text_free(&self->axis);
    for (size_t i = 0; i < MOST_LINES; i++) {
        ps_text_free(&self->labels[i]);
    }
    for (size_t i = 0; i < NUM_PANELS; i++) {
        ps_text_free(&self->titles[i]);
    }
}

static const double *value_of(const ps_scatter *scatter, size_t set, int32_t number) {
    const size_t side = 2 * (size_t)scatter->max_frequency + 1;
    return scatter->rows + 2 * (set * side + (size_t)(number + scatter->max_frequency));
}

static bool is_dc(const ps_scatter *scatter, int32_t number) {
    bool is_zero = number == 0;
    for (unsigned axis = 1; axis < scatter->asked->num_shown; axis++) {
        is_zero = is_zero && scatter->asked->shown[axis] == 0;
    }
    return is_zero;
}

/* ---- numbers --------------------------------------------------------------------------------- */

static pspec_status allocate(picture *self, ps_error *error) {
    const size_t num_sets = self->scatter->num_sets;
    PS_TRY(PS_NEW(&self->row, self->num_row, "a picture", error));
    PS_TRY(PS_NEW(&self->parts, (NUM_PANELS - 1) * self->num_lines * self->num_row + 1, "a picture",
                  error));
    return PS_NEW(&self->plane, 2 * num_sets + 1, "a picture", error);
}

/* S(0), which is larger than all others, is a gap. */
static void fill_parts(picture *self) {
    const size_t num_all = self->num_lines * self->num_row;
    for (size_t j = 0; j < self->num_row; j++) {
        const int32_t number = self->first + (int32_t)j;
        self->row[j] = number;
        for (size_t r = 0; r < self->num_lines; r++) {
            const double *const value = value_of(self->scatter, r, number);
            double *const part = self->parts + r * self->num_row + j;
            part[0] = is_dc(self->scatter, number) ? NAN : value[0];
            part[num_all] = is_dc(self->scatter, number) ? NAN : value[1];
        }
    }
}

static void fill_plane(picture *self) {
    const size_t num = self->scatter->num_sets;
    double sum = 0;
    for (size_t r = 0; r < num; r++) {
        const double *const value = value_of(self->scatter, r, self->scatter->asked->shown[0]);
        self->plane[r] = value[0];
        self->plane[num + r] = value[1];
        sum += value[0] * value[0] + value[1] * value[1];
    }
    const double radius = num > 0 ? sqrt(sum / (double)num) : 0;
    for (size_t i = 0; i < CIRCLE; i++) {
        const double angle = PS_TWO_PI * (double)i / (CIRCLE - 1);
        self->circle[0][i] = radius * cos(angle);
        self->circle[1][i] = radius * sin(angle);
    }
}

/* From the least to the largest number of a panel of parts. */
static void fill_mark(picture *self, size_t panel) {
    const size_t num = self->num_lines * self->num_row;
    const double *const parts = self->parts + panel * num;
    double low = 0;
    double high = 0;
    for (size_t i = 0; i < num; i++) {
        low = fmin(low, parts[i]);
        high = fmax(high, parts[i]);
    }
    self->mark[panel][0][0] = self->mark[panel][0][1] = self->scatter->asked->shown[0];
    self->mark[panel][1][0] = low;
    self->mark[panel][1][1] = high;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* k, or k_1 where there are others, which stand beside it. */
static pspec_status write_words(picture *self, ps_error *error) {
    const ps_frequencies_spec *const asked = self->scatter->asked;
    static const char *const parts[] = {"real part of S(k)", "imaginary part of S(k)"};
    ps_text_append(&self->axis, "%s", asked->num_shown > 1 ? "k_1" : "k");
    for (unsigned axis = 1; axis < asked->num_shown; axis++) {
        ps_text_append(&self->axis, ", k_%u = %d", axis + 1, (int)asked->shown[axis]);
    }
    for (size_t i = 0; i < NUM_PANELS - 1; i++) {
        ps_text_append(&self->titles[i], "%s", parts[i]);
        PS_TRY(ps_text_check(&self->titles[i], error));
    }
    ps_text *const last = &self->titles[NUM_PANELS - 1];
    ps_text_append(last, "S(");
    for (unsigned axis = 0; axis < asked->num_shown; axis++) {
        ps_text_append(last, "%s%d", axis > 0 ? ", " : "", (int)asked->shown[axis]);
    }
    ps_text_append(last, ") of %zu set%s", self->scatter->num_sets,
                   self->scatter->num_sets == 1 ? "" : "s");
    for (size_t r = 0; r < self->num_lines; r++) {
        ps_text_append(&self->labels[r], "set %zu", r + 1);
        PS_TRY(ps_text_check(&self->labels[r], error));
    }
    PS_TRY(ps_text_check(last, error));
    return ps_text_check(&self->axis, error);
}

/* ---- panels ---------------------------------------------------------------------------------- */

static void make_parts(picture *self, size_t panel) {
    ps_series *const series = self->series[panel];
    const double *const parts = self->parts + panel * self->num_lines * self->num_row;
    for (size_t r = 0; r < self->num_lines; r++) {
        series[r] = (ps_series){.label = ps_text_string(&self->labels[r]),
                                .kind = r,
                                .num = self->num_row,
                                .x = self->row,
                                .y = parts + r * self->num_row};
    }
    series[self->num_lines] = (ps_series){
        .num = 2, .x = self->mark[panel][0], .y = self->mark[panel][1], .look = PS_LOOK_REFERENCE};
    self->panels[panel] = (ps_panel){.title = ps_text_string(&self->titles[panel]),
                                     .num_series = self->num_lines + 1,
                                     .series = series};
    self->axes[panel].x_label = ps_text_string(&self->axis);
}

/* All sets, the circle, and the first sets upon them. */
static void make_plane(picture *self) {
    enum { PLANE = NUM_PANELS - 1 };
    ps_series *const series = self->series[PLANE];
    const size_t num = self->scatter->num_sets;
    const double *const real = self->plane;
    const double *const imaginary = self->plane + num;
    series[0] = (ps_series){.num = num, .x = real, .y = imaginary, .look = PS_LOOK_CLOUD};
    series[1] = (ps_series){.label = "root mean square of |S|",
                            .kind = BLACK,
                            .num = CIRCLE,
                            .x = self->circle[0],
                            .y = self->circle[1],
                            .look = PS_LOOK_BOUND};
    for (size_t r = 0; r < self->num_lines; r++) {
        series[2 + r] = (ps_series){.label = ps_text_string(&self->labels[r]),
                                    .kind = r,
                                    .num = 1,
                                    .x = real + r,
                                    .y = imaginary + r,
                                    .look = PS_LOOK_MARKS};
    }
    self->panels[PLANE] = (ps_panel){.title = ps_text_string(&self->titles[PLANE]),
                                     .num_series = 2 + self->num_lines,
                                     .series = series};
    self->axes[PLANE] = (ps_panel_axes){"real part", "imaginary part", true};
}

static pspec_status make(picture *self, ps_error *error) {
    PS_TRY(allocate(self, error));
    fill_parts(self);
    fill_plane(self);
    PS_TRY(write_words(self, error));
    for (size_t panel = 0; panel < NUM_PANELS - 1; panel++) {
        fill_mark(self, panel);
        make_parts(self, panel);
    }
    make_plane(self);
    return PSPEC_OK;
}

/* On the line negative frequencies say nothing new. */
pspec_status ps_scatter_draw(const ps_scatter *scatter, const char *title, ps_take_figure *take,
                             void *payload, ps_error *error) {
    const int32_t last = scatter->max_frequency;
    const int32_t first = scatter->asked->num_shown > 1  ? -last
                          : scatter->asked->shown[0] > 0 ? 1
                                                         : -last;
    picture self = {.scatter = scatter,
                    .num_lines = scatter->num_sets < MOST_LINES ? scatter->num_sets : MOST_LINES,
                    .first = first,
                    .num_row = (size_t)(last - first + 1)};
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = title,
                              .x_label = "",
                              .y_label = "",
                              .num_panels = NUM_PANELS,
                              .panels = self.panels,
                              .panel_axes = self.axes};
    pspec_status status = make(&self, error);
    if (status == PSPEC_OK) {
        status = take(payload, &figure, error);
    }
    release(&self);
    return status;
}

/* ---- of a command ---------------------------------------------------------------------------- */

static pspec_status write_figure(void *payload, const ps_figure *figure, ps_error *error) {
    const ps_request *const request = payload;
    return ps_figure_write(request->plot, figure, error);
}

pspec_status ps_scatter_plot(const ps_request *request, const ps_power_job *job, const char *title,
                             ps_error *error) {
    ps_scatter self;
    double *rows = NULL;
    ps_request own = *request;
    pspec_status status = ps_scatter_take(&self, &rows, &request->frequencies, job, error);
    if (status == PSPEC_OK) {
        status = ps_scatter_draw(&self, title, write_figure, &own, error);
    }
    free(rows);
    return status;
}
