/* The picture of --scatter: the first sets along a row of frequencies, and all at one of them. */
#include "answers/spectra/scatter.h"
#include "base/text.h"
#include "math/pi.h"

#include <math.h>

/* Sets that have a colour, a line and a mark. */
static const char *const labels[] = {"set 1", "set 2", "set 3"};
enum { MOST_LINES = sizeof labels / sizeof labels[0], CIRCLE = 129, BLACK = 6 };
/* Real parts, imaginary parts, the plane. */
enum { REAL, IMAGINARY, PLANE, NUM_PANELS, MOST_SERIES = MOST_LINES + 2 };

/* What the figure is made of. */
typedef struct picture {
    ps_scatter scatter;
    size_t num_lines; /* sets that are shown along the row */
    int32_t first;    /* the numbers of the row that are shown begin there */
    size_t num_row;   /* and are so many */
    double *row;      /* these numbers */
    double *parts;    /* [PLANE][num_lines][num_row] */
    double *plane;    /* [PLANE][num_sets] */
    double mark[PLANE][4], circle[2][CIRCLE];
    ps_panel panels[NUM_PANELS];
    ps_series series[NUM_PANELS][MOST_SERIES];
} picture;

static const double *value_of(const picture *self, size_t set, int32_t number) {
    const int32_t last = self->scatter.max_frequency;
    const size_t side = 2 * (size_t)last + 1;
    return self->scatter.rows + 2 * (set * side + (size_t)(number + last));
}

static bool is_dc(const picture *self, int32_t number) {
    const ps_frequencies_spec *const asked = self->scatter.asked;
    bool is_zero = number == 0;
    for (unsigned axis = 1; axis < asked->num_shown; axis++) {
        is_zero = is_zero && asked->shown[axis] == 0;
    }
    return is_zero;
}

static void add_series(picture *self, size_t panel, ps_series series) {
    self->series[panel][self->panels[panel].num_series++] = series;
}

/* The first sets, and a mark at the frequency from the least to the largest number. S(0), which is
 * larger than all others, is a gap. */
static void add_parts(picture *self, size_t panel) {
    double *const mark = self->mark[panel];
    mark[0] = mark[1] = self->scatter.asked->shown[0];
    for (size_t r = 0; r < self->num_lines; r++) {
        double *const part = self->parts + (panel * self->num_lines + r) * self->num_row;
        for (size_t j = 0; j < self->num_row; j++) {
            const int32_t number = self->first + (int32_t)j;
            self->row[j] = number;
            part[j] = is_dc(self, number) ? NAN : value_of(self, r, number)[panel];
            mark[2] = fmin(mark[2], part[j]);
            mark[3] = fmax(mark[3], part[j]);
        }
        add_series(
            self, panel,
            (ps_series){
                .label = labels[r], .kind = r, .num = self->num_row, .x = self->row, .y = part});
    }
    add_series(self, panel,
               (ps_series){.num = 2, .x = mark, .y = mark + 2, .look = PS_LOOK_REFERENCE});
}

/* |S| as it is in the root mean square. */
static void add_circle(picture *self, double radius) {
    for (size_t i = 0; i < CIRCLE; i++) {
        const double angle = PS_TWO_PI * (double)i / (CIRCLE - 1);
        self->circle[0][i] = radius * cos(angle);
        self->circle[1][i] = radius * sin(angle);
    }
    add_series(self, PLANE,
               (ps_series){.label = "root mean square of |S|",
                           .kind = BLACK,
                           .num = CIRCLE,
                           .x = self->circle[0],
                           .y = self->circle[1],
                           .look = PS_LOOK_BOUND});
}

/* All sets, the circle, and the first sets upon them. */
static void add_plane(picture *self) {
    const size_t num = self->scatter.num_sets;
    double *const real = self->plane;
    double *const imaginary = self->plane + num;
    double sum = 0;
    for (size_t r = 0; r < num; r++) {
        const double *const value = value_of(self, r, self->scatter.asked->shown[0]);
        real[r] = value[0];
        imaginary[r] = value[1];
        sum += value[0] * value[0] + value[1] * value[1];
    }
    add_series(self, PLANE,
               (ps_series){.num = num, .x = real, .y = imaginary, .look = PS_LOOK_CLOUD});
    add_circle(self, num > 0 ? sqrt(sum / (double)num) : 0);
    for (size_t r = 0; r < self->num_lines; r++) {
        add_series(self, PLANE,
                   (ps_series){.label = labels[r],
                               .kind = r,
                               .num = 1,
                               .x = real + r,
                               .y = imaginary + r,
                               .look = PS_LOOK_MARKS});
    }
}

/* k, or k_1 where there are others, which stand beside it. */
static pspec_status write_words(picture *self, ps_pool *memory, ps_error *error) {
    const ps_frequencies_spec *const asked = self->scatter.asked;
    const size_t num = self->scatter.num_sets;
    ps_text title = {0};
    ps_text axis = {0};
    ps_text_append(&title, "S(%d", (int)asked->shown[0]);
    ps_text_append(&axis, "%s", asked->num_shown > 1 ? "k_1" : "k");
    for (unsigned i = 1; i < asked->num_shown; i++) {
        ps_text_append(&title, ", %d", (int)asked->shown[i]);
        ps_text_append(&axis, ", k_%u = %d", i + 1, (int)asked->shown[i]);
    }
    ps_text_append(&title, ") of %zu set%s", num, num == 1 ? "" : "s");
    self->panels[REAL].title = "real part of S(k)";
    self->panels[IMAGINARY].title = "imaginary part of S(k)";
    self->panels[PLANE].frame =
        (ps_frame){.form = PS_FRAME_PLANE, .x_label = "real part", .y_label = "imaginary part"};
    const pspec_status status = ps_text_keep(&self->panels[PLANE].title, memory, &title, error);
    if (status != PSPEC_OK) {
        ps_text_free(&axis);
        return status;
    }
    PS_TRY(ps_text_keep(&self->panels[REAL].frame.x_label, memory, &axis, error));
    self->panels[IMAGINARY].frame = self->panels[REAL].frame;
    return PSPEC_OK;
}

static pspec_status allocate(picture *self, ps_pool *memory, ps_error *error) {
    const size_t num_parts = PLANE * self->num_lines;
    PS_TRY(PS_POOL_NEW(memory, &self->row, self->num_row, "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &self->parts, num_parts * self->num_row, "a picture", error));
    return PS_POOL_NEW(memory, &self->plane, PLANE * self->scatter.num_sets, "a picture", error);
}

/* On the line negative frequencies say nothing new. */
pspec_status ps_scatter_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                               ps_error *error) {
    const ps_chart_part *const part = &chart->parts[0];
    const ps_npy_array *const sets = ps_table_find_array(part->table, "scatter");
    const ps_frequencies_spec *const asked = &part->request->frequencies;
    const int32_t last = (int32_t)(sets->shape[1] / 2);
    picture *self = NULL;
    PS_TRY(PS_POOL_NEW(memory, &self, 1, "a picture", error));
    self->scatter = (ps_scatter){sets->shape[0], asked, last, sets->data};
    self->num_lines = sets->shape[0] < MOST_LINES ? sets->shape[0] : MOST_LINES;
    self->first = asked->num_shown > 1 || asked->shown[0] <= 0 ? -last : 1;
    self->num_row = (size_t)(last - self->first + 1);
    PS_TRY(allocate(self, memory, error));
    PS_TRY(write_words(self, memory, error));
    add_parts(self, REAL);
    add_parts(self, IMAGINARY);
    add_plane(self);
    for (size_t panel = 0; panel < NUM_PANELS; panel++) {
        self->panels[panel].series = self->series[panel];
    }
    *out = (ps_figure){.form = PS_FIGURE_FRAME,
                       .title = chart->title,
                       .x_label = "",
                       .y_label = "",
                       .num_panels = NUM_PANELS,
                       .panels = self->panels};
    return PSPEC_OK;
}
