/* pointspec convert: the sets of all files into one, block by block: no set is ever in memory as a
 * whole (but for formats that lie in columns), and the first is drawn. Without an output the first
 * of every file is only drawn. hooks->warn hears what the format could not keep, hooks->watch of
 * points. */
#include "answers/output_check.h"
#include "commands/points_drawing.h"
#include "jobs/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "request/point_source.h"

#include <math.h>
#include <string.h>

/* Small enough to stay in the cache, large enough for few system calls. */
enum { BLOCK_POINTS = 32768 };

typedef struct worker {
    const ps_request *request;
    const ps_answer_hooks *hooks;
    const char *const *paths; /* their sets become the sets of one output, in this order */
    size_t num_paths;
    const char *output; /* "-": standard output; NULL: nothing is written */
    /* Gets the first set that is written, or would be, whole: angles as vectors; NULL: nobody wants
     * it */
    ps_point_set *first;
    ps_point_options options; /* of every file */
    ps_point_reader *reader;
    ps_point_writer *writer; /* made when the first block tells what there is to write; or none */
    ps_point_set block;
    const char *path;
    ps_point_shape shape; /* of the first block */
    bool has_shape;
    bool has_first;      /* the set that somebody wants is there */
    uint64_t num_points; /* read so far */
    uint64_t position;   /* points of the set in front of the block */
    bool turns_angles;   /* directions came as angles and became vectors */
} worker;

/* ---- what is written --------------------------------------------------------------------- */

/* Angles that are written as angles are not turned into vectors on the way. */
static bool writes_angles(const worker *w) {
    const ps_request *const request = w->request;
    const char *const format = w->output == NULL || request->format != NULL
                                   ? request->format
                                   : ps_points_format_by_ending(w->output);
    return w->output == NULL             ? false
           : request->to_columns != NULL ? request->to_columns[0] != 'x'
                                         : strcmp(format, "openquad") == 0;
}

static pspec_status create_writer(worker *w, ps_error *error) {
    const ps_request *const request = w->request;
    w->has_shape = true;
    w->shape = (ps_point_shape){.num_sets = request->merge ? 1 : 0,
                                .coordinates = w->block.coordinates,
                                .dimension = w->block.dimension,
                                .has_weights = w->block.has_weights,
                                .columns = request->to_columns,
                                .memory_limit = w->options.memory_limit};
    return w->output != NULL
               ? ps_points_create(&w->writer, w->output, request->format, &w->shape, error)
               : PSPEC_OK;
}

static void describe_points(ps_text *out, ps_coordinates coordinates, unsigned dimension,
                            bool has_weights) {
    switch (coordinates) {
    case PS_TORUS_COORDINATES:
        ps_text_append(out, "points of the torus in %u dimension%s", dimension,
                       dimension == 1 ? "" : "s");
        break;
    case PS_UNIT_VECTORS:
        ps_text_append(out, "unit vectors");
        break;
    case PS_ANGLES:
        ps_text_append(out, "angles");
        break;
    }
    ps_text_append(out, has_weights ? " with weights" : "");
}

/* One output holds one kind of points. */
static pspec_status check_kind(const worker *w, ps_error *error) {
    const ps_point_set *const block = &w->block;
    const ps_point_shape *const shape = &w->shape;
    if (block->coordinates == shape->coordinates && block->dimension == shape->dimension &&
        block->has_weights == shape->has_weights) {
        return PSPEC_OK;
    }
    ps_text these = {0};
    ps_text those = {0};
    describe_points(&these, block->coordinates, block->dimension, block->has_weights);
    describe_points(&those, shape->coordinates, shape->dimension, shape->has_weights);
    ps_fail(error, PSPEC_ERROR_INPUT,
            "\"%s\" holds %s, but \"%s\" %s; one output holds one kind (--domain, --columns and "
            "--weights say how all files are read)",
            w->path, ps_text_string(&these), w->paths[0], ps_text_string(&those));
    ps_text_free(&these);
    ps_text_free(&those);
    return PSPEC_ERROR_INPUT;
}

/* The part of the block that is wanted; the view borrows its arrays. */
static ps_point_set select_points(const worker *w) {
    const ps_point_range *const range = &w->request->points;
    ps_point_set view = w->block;
    uint64_t first = 0;
    uint64_t end = view.num_points;
    if (range->last > 0) {
        const uint64_t wanted = range->first - 1;
        first = wanted > w->position ? wanted - w->position : 0;
        end = range->last > w->position ? range->last - w->position : 0;
    }
    end = end < view.num_points ? end : view.num_points;
    first = first < end ? first : end;
    view.num_points = (size_t)(end - first);
    view.points += first * view.dimension;
    view.weights += view.has_weights ? first : 0;
    return view;
}

static pspec_status check_selection(const worker *w, ps_error *error) {
    const ps_point_range *const range = &w->request->points;
    const uint64_t needed = range->last == UINT64_MAX ? range->first : range->last;
    return w->position >= needed
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "\"%s\": a set has %llu points; point %llu is asked for", w->path,
                         (unsigned long long)w->position, (unsigned long long)needed);
}

/* ---- the set that somebody wants --------------------------------------------------------- */

static void append_point(ps_point_set *first, const ps_point_set *view, size_t i) {
    double *const out = first->points + first->num_points++ * first->dimension;
    const double *const point = view->points + i * view->dimension;
    if (view->coordinates == PS_ANGLES) {
        out[0] = sin(point[0]) * cos(point[1]);
        out[1] = sin(point[0]) * sin(point[1]);
        out[2] = cos(point[0]);
    } else {
        memcpy(out, point, first->dimension * sizeof *out);
    }
}

static pspec_status keep_block(worker *w, const ps_point_set *view, bool ends_set,
                               ps_error *error) {
    ps_point_set *const first = w->first;
    const uint64_t limit = w->options.memory_limit;
    if (first == NULL || w->has_first) {
        return PSPEC_OK;
    }
    const bool are_angles = view->coordinates == PS_ANGLES;
    first->coordinates = are_angles ? PS_UNIT_VECTORS : view->coordinates;
    first->dimension = are_angles ? 3 : view->dimension;
    const size_t num = first->num_points + view->num_points;
    if (limit > 0 && (double)num * first->dimension * sizeof(double) > (double)limit) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "\"%s\": the set that is drawn does not fit in the memory that is allowed",
                       w->path);
    }
    PS_TRY(ps_points_reserve(first, num, error));
    for (size_t i = 0; i < view->num_points; i++) {
        append_point(first, view, i);
    }
    w->has_first = ends_set;
    return PSPEC_OK;
}

/* Nothing more is wanted of the files. */
static bool is_done(const worker *w) {
    return w->output == NULL && w->has_first;
}

static pspec_status write_block(worker *w, bool ends_set, ps_error *error) {
    const ps_point_set view = select_points(w);
    const bool ends_output_set = ends_set && !w->request->merge;
    PS_TRY(keep_block(w, &view, ends_output_set, error));
    if (w->writer != NULL && (view.num_points > 0 || ends_output_set)) {
        PS_TRY(ps_points_write(w->writer, &view, ends_output_set, error));
    }
    w->num_points += w->block.num_points;
    w->position += w->block.num_points;
    if (ends_set) {
        PS_TRY(check_selection(w, error));
        w->position = 0;
    }
    return PSPEC_OK;
}

/* ---- files ------------------------------------------------------------------------------- */

static pspec_status take_block(worker *w, bool ends_set, ps_error *error) {
    if (!w->has_shape) {
        PS_TRY(create_writer(w, error));
    }
    PS_TRY(check_kind(w, error));
    const char *const columns = ps_points_columns(w->reader);
    w->turns_angles =
        w->turns_angles || (w->block.coordinates == PS_UNIT_VECTORS && columns[0] != 'x');
    PS_TRY(write_block(w, ends_set, error));
    return ps_watch_tell(&w->hooks->watch, "points", w->num_points, 0, NULL, error);
}

static pspec_status take_file(worker *w, ps_error *error) {
    bool has_block = true;
    bool ends_set = false;
    PS_TRY(ps_points_open(&w->reader, w->path, &w->options, error));
    while (has_block && !is_done(w)) {
        w->block.num_points = 0;
        PS_TRY(
            ps_points_next_block(w->reader, &w->block, BLOCK_POINTS, &has_block, &ends_set, error));
        if (has_block) {
            PS_TRY(take_block(w, ends_set, error));
        }
    }
    ps_points_close(w->reader);
    w->reader = NULL;
    return PSPEC_OK;
}

static void describe_loss(const worker *w, ps_text *loss) {
    enum { LOSS_BYTES = 512 };
    char text[LOSS_BYTES];
    ps_points_describe_loss(w->writer, text, sizeof text);
    ps_text_append(loss, "%s", text);
    if (w->turns_angles) {
        ps_text_append(loss, "%sangles became vectors, rounded in their last digits",
                       text[0] != '\0' ? "; " : "");
    }
}

static pspec_status take_files(worker *w, ps_text *loss, ps_error *error) {
    for (size_t i = 0; i < w->num_paths && !is_done(w); i++) {
        w->path = w->paths[i];
        PS_TRY(take_file(w, error));
    }
    if (w->writer == NULL) {
        return PSPEC_OK;
    }
    if (w->request->merge) {
        w->block.num_points = 0;
        PS_TRY(ps_points_write(w->writer, &w->block, true, error));
    }
    describe_loss(w, loss);
    PS_TRY(ps_text_check(loss, error));
    return ps_points_commit(w->writer, error);
}

/* first: gets the first set, for the picture; NULL: nothing is drawn. */
static pspec_status convert_files(const ps_request *request, size_t i_file, size_t num_files,
                                  ps_point_set *first, const ps_answer_hooks *hooks,
                                  ps_error *error) {
    worker w = {.request = request,
                .hooks = hooks,
                .paths = request->files + i_file,
                .num_paths = num_files,
                .output = ps_request_only_draws(request) ? NULL : request->output,
                .first = first,
                .options = ps_point_options_make(request)};
    ps_text loss = {0};
    if (w.output != NULL && request->format == NULL) {
        PS_TRY(ps_points_check_ending(w.output, error)); /* before anything is read */
    }
    w.options.keep_angles = writes_angles(&w);
    const pspec_status status = take_files(&w, &loss, error);
    ps_answer_warn_of(hooks, status == PSPEC_OK ? ps_text_string(&loss) : "");
    ps_points_close(w.reader);
    ps_points_discard(w.writer);
    ps_point_set_free(&w.block);
    ps_text_free(&loss);
    return status;
}

/* Files into one output; those that are only drawn, one by one. */
static pspec_status convert_all(const ps_request *request, ps_points_picture *picture,
                                const ps_answer_hooks *hooks, ps_error *error) {
    const bool is_drawn = request->plot != NULL;
    const size_t step = request->num_files / picture->num_sets;
    pspec_status status = PSPEC_OK;
    ps_answer_begin_next(hooks);
    for (size_t i = 0; status == PSPEC_OK && i < request->num_files; i += step) {
        ps_point_set first = {0};
        status = convert_files(request, i, step, is_drawn ? &first : NULL, hooks, error);
        if (status == PSPEC_OK && is_drawn) {
            status = ps_points_draw_file(picture, request->files[i], &first, &hooks->watch, error);
        }
        ps_point_set_free(&first);
    }
    ps_answer_end(hooks);
    return status;
}

/* ---- the command --------------------------------------------------------------------------- */

/* Writes no table. */
static pspec_status run(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error) {
    const bool is_apart = ps_request_only_draws(request) && !request->merge;
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = is_apart ? request->num_files : 1, .memory = &memory};
    (void)out;
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    PS_TRY(ps_point_options_check(request, error));
    PS_TRY(ps_points_drawing_check(request, hooks, error));
    PS_TRY(ps_outputs_check(request, false, error));
    pspec_status status = convert_all(request, &picture, hooks, error);
    if (status == PSPEC_OK && request->plot != NULL) {
        status = ps_points_draw(&picture, request, hooks, error);
    }
    ps_pool_free(&memory);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    ps_point_set set = {0};
    ps_point_reader *reader = NULL;
    const ps_point_options options = ps_point_options_make(request);
    bool has_block = false;
    bool ends_set = false;
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    pspec_status status = ps_points_open(&reader, request->files[0], &options, error);
    if (status == PSPEC_OK) { /* one point tells how many numbers each has */
        status = ps_points_next_block(reader, &set, 1, &has_block, &ends_set, error);
    }
    if (status == PSPEC_OK) {
        const unsigned numbers = set.dimension + (set.has_weights ? 1 : 0);
        ps_phases_start(&phases, NULL, NULL);
        const double points =
            ps_phases_read(&phases, request->files, request->num_files, &options, numbers);
        if (!ps_request_only_draws(request)) {
            ps_phases_write(&phases, request->output != NULL ? request->output : "-",
                            request->format, points * numbers);
        }
        ps_plan_table_add_picture(&phases, request);
        status = ps_plan_table_add_host(planner, &phases, 0, "a block of points at a time", error);
    }
    ps_points_close(reader);
    ps_point_set_free(&set);
    return status;
}

const ps_command ps_command_convert = {
    .name = "convert",
    .purpose = "one format of point files into another",
    .usage = "convert [options] FILE... [-o OUT]",
    .description =
        "Reads point sets of the torus or of the sphere and writes them in another format, a block "
        "of points at a time, so that files may be larger than memory. Several files become sets "
        "of one output. What the format of the output cannot keep is refused, or said on standard "
        "error. Files compressed by gzip are read as they are. --plot draws the first set; without "
        "-o "
        "and --format the picture is all that is made, and several files are drawn side by side.",
    .takes = PS_COMMAND_BIT(convert),
    .examples = {"pointspec sample --sampler white -n 64 -m 3 | pointspec convert - -o sets.npy",
                 "pointspec sample --sampler halton -n 8 | pointspec convert --select-points 2.. "
                 "--format csv -"},
    .formats = PS_POINT_FORMATS,
    .weights = "equal|column",
    .samples = PS_DOMAIN_ANY,
    .counted = "points",
    .speaker = "pointspec convert",
    .makes_points = true,
    .run = run,
    .plan = plan,
};
