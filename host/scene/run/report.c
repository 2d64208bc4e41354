/* A page about some points: a scene is made of the command line, in which they stand beside known
 * sets, and its page is written alone. */
#include "scene/run/run.h"

#include "answers/output_check.h"
#include "files/output_file.h"
#include "jobs/source.h"
#include "request/file_list.h"
#include "request/point_source.h"
#include "spectra/shape/low_end.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Realizations unless -m is given: a fit at low frequencies needs 8. */
enum { DEFAULT_REALIZATIONS = 16, PLANE = 2 };
/* Known sets of which all realizations take longer are left out, and numbers of points go down from
 * N by this factor for rates. */
static const double MOST_SECONDS = 60;
enum { LEAST_SHARE = 16, FEWEST_POINTS = 16 };

typedef struct report {
    const ps_request *request;
    bool on_sphere, has_files; /* without a name, and so not beside samplers */
    uint64_t num_points;       /* of the first set */
    uint64_t num_realizations;
    ps_text known; /* samplers beside, ", \"white\", .." */
    ps_text name;  /* of the set of files */
    ps_text scene;
} report;

/* ---- what the points are ------------------------------------------------------------------- */

/* The first set of files, or of a program that stands first. */
static pspec_status look_at_set(report *self, const ps_file_list *files, ps_error *error) {
    const ps_request *const request = self->request;
    ps_source_options options = {.points = ps_point_options_make(request)};
    ps_source *source = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    self->on_sphere = request->reading.domain == PS_DOMAIN_SPHERE;
    options.points.domain = self->on_sphere ? PS_DOMAIN_SPHERE : PS_DOMAIN_TORUS;
    PS_TRY(ps_source_files(&source, files->paths, files->num, &options, error));
    pspec_status status = ps_source_next_whole(source, &set, &has_set, error);
    if (status == PSPEC_OK && !has_set) {
        status = ps_fail(error, PSPEC_ERROR_INPUT, "the files have no point sets");
    }
    if (status == PSPEC_OK && !self->on_sphere && set.dimension != PLANE) {
        status = ps_fail(error, PSPEC_ERROR_INPUT,
                         "a report is of the plane or the sphere (--domain sphere), and these "
                         "points have %u coordinates; power and measure have other dimensions",
                         set.dimension);
    }
    self->num_points = set.num_points;
    ps_point_set_free(&set);
    ps_source_destroy(source);
    return status;
}

static pspec_status look_at_files(report *self, ps_error *error) {
    ps_file_list files = {0};
    pspec_status status = ps_file_list_of_question(&files, self->request, 0, error);
    if (status == PSPEC_OK) {
        status = look_at_set(self, &files, error);
    }
    ps_file_list_free(&files);
    if (!self->has_files && !ps_request_has_own_counts(self->request)) {
        self->num_points = self->request->counts[0]; /* as it is told */
    }
    return status;
}

static pspec_status look_at_sampler(report *self, ps_error *error) {
    ps_sampler_request sampler = {0};
    PS_TRY(ps_sampler_request_make(&sampler, self->request, 0, error));
    self->on_sphere = ps_sampler_is_on_sphere(&sampler);
    self->num_points = sampler.num_points;
    return ps_sampler_is_on_hemisphere(&sampler) || (!self->on_sphere && sampler.dimension != PLANE)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "a report is of the plane or the whole sphere, and points of %s are not",
                         ps_request_sampler(self->request, 0))
               : PSPEC_OK;
}

/* "mine" of mine.txt, "white_set" of white.txt, since curves beside it have names of samplers. */
static void name_files(report *self) {
    enum { MOST_LETTERS = 40 };
    const char *const path = self->request->files[0];
    const char *const slash = strrchr(path, '/');
    ps_sampler_request sampler = {0};
    ps_error unused = {0};
    for (const char *at = slash != NULL ? slash + 1 : path;
         *at != '\0' && *at != '.' && self->name.length < MOST_LETTERS; at++) {
        const bool is_plain = (*at >= '0' && *at <= '9') || (*at >= 'a' && *at <= 'z') ||
                              (*at >= 'A' && *at <= 'Z') || *at == '-';
        ps_text_append(&self->name, "%c", is_plain ? *at : '_');
    }
    if (self->name.length == 0 ||
        ps_sampler_parse(&sampler, ps_text_string(&self->name), &unused) == PSPEC_OK) {
        ps_text_append(&self->name, "%sset", self->name.length > 0 ? "_" : "");
    }
}

static bool is_asked(const report *self, const char *name) {
    for (size_t i = 0; i < self->request->num_sources; i++) {
        if (strcmp(ps_request_source_name(self->request, i), name) == 0) {
            return true;
        }
    }
    return false;
}

/* Those that can have as many points, in a short time. */
static void find_known(report *self) {
    for (size_t i = 0; ps_samplers[i] != NULL; i++) {
        const char *const name = ps_samplers[i]->name;
        ps_sampler_request sampler = {.num_points = (size_t)self->num_points, .seed = 1};
        ps_error unused = {0};
        const bool is_possible = ps_samplers[i]->stands_beside &&
                                 (ps_samplers[i]->domain == PS_SAMPLES_SPHERE) == self->on_sphere &&
                                 ps_sampler_parse(&sampler, name, &unused) == PSPEC_OK &&
                                 ps_sampler_resolve(&sampler, &unused) == PSPEC_OK;
        if (is_possible && !is_asked(self, name) &&
            ps_sampler_seconds(&sampler) * (double)self->num_realizations < MOST_SECONDS) {
            ps_text_append(&self->known, ", \"%s\"", name);
        }
    }
}

static pspec_status check_file(const char *path, ps_error *error) {
    struct stat facts;
    const bool is_input = strcmp(path, "-") == 0;
    return !is_input && (stat(path, &facts) != 0 || !S_ISFIFO(facts.st_mode))
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "points are read for every result, which %s cannot",
                         is_input ? "standard input (-)" : "a pipe");
}

static pspec_status look(report *self, ps_error *error) {
    const ps_request *const request = self->request;
    PS_TRY(ps_sources_check(request, "nothing to report on", error));
    for (size_t i = 0; i < request->num_files; i++) {
        PS_TRY(check_file(request->files[i], error));
    }
    self->has_files = request->num_sources == 0;
    self->num_realizations = request->is_given[PS_OPTION_REALIZATIONS] ? request->num_realizations
                                                                       : DEFAULT_REALIZATIONS;
    if (request->num_counts > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a report is of one number of points; variances are against others, too");
    }
    const bool are_read = self->has_files || ps_request_program(request, 0) != NULL;
    PS_TRY(are_read ? look_at_files(self, error) : look_at_sampler(self, error));
    if (self->has_files) {
        name_files(self);
    }
    find_known(self);
    return PSPEC_OK;
}

/* ---- the scene ------------------------------------------------------------------------------ */

/* Samplers, of files with the known ones alone, and the set. */
static void print_sources(report *self, bool with_known) {
    ps_text *const out = &self->scene;
    const ps_request *const request = self->request;
    const char *const known = with_known ? ps_text_string(&self->known) : "";
    const char *begin = "\"samplers\": [";
    for (size_t i = 0; i < request->num_sources; i++) {
        ps_text_append(out, "%s", begin);
        ps_scene_print_text(ps_request_source_name(request, i), out);
        begin = ", ";
    }
    if (request->num_sources == 0 && *known != '\0') { /* behind its first comma */
        ps_text_append(out, "%s%s], ", begin, known + 2);
    } else if (request->num_sources > 0) {
        ps_text_append(out, "%s]", known);
    }
    for (size_t i = 0; i < request->num_files && self->has_files; i++) {
        ps_text_append(out, i > 0 ? ", " : "\"sets\": {\"%s\": [", ps_text_string(&self->name));
        ps_scene_print_text(request->files[i], out);
    }
    ps_text_append(out, self->has_files ? "]}" : "");
}

static void print_key(report *self, ps_option_id id, const char *value) {
    if (self->request->is_given[id]) {
        ps_text_append(&self->scene, ", \"%s\": ", ps_options[id].name);
        ps_scene_print_text(value, &self->scene);
    }
}

/* How files are read. */
static void print_reading(report *self, bool takes_domain) {
    const ps_point_options *const reading = &self->request->reading;
    ps_text box = {0};
    for (unsigned i = 0; i < reading->box.num_axes; i++) {
        ps_text_append(&box, "%s%.17g,%.17g", i > 0 ? "," : "", reading->box.low[i],
                       reading->box.high[i]);
    }
    const bool are_read = self->has_files || ps_request_has_programs(self->request);
    if (are_read) {
        print_key(self, PS_OPTION_INPUT_FORMAT, reading->format);
        print_key(self, PS_OPTION_COLUMNS, reading->columns);
        print_key(self, PS_OPTION_BOX, ps_text_string(&box));
    }
    if (are_read && self->on_sphere && takes_domain) {
        ps_text_append(&self->scene, ", \"domain\": \"sphere\"");
    }
    self->scene.failed = self->scene.failed || box.failed;
    ps_text_free(&box);
}

/* A result but for its own keys. Without samplers numbers of points and realizations are not of
 * it. */
static void begin_result(report *self, const char *kind, const char *name, const char *title,
                         bool with_known) {
    ps_text *const out = &self->scene;
    const bool is_spectrum = strcmp(kind, "power") == 0 || strcmp(kind, "angular") == 0;
    const bool has_samplers =
        self->request->num_sources > 0 || (with_known && self->known.length > 0);
    ps_text_append(out, "  {\"result\": \"%s\", \"name\": \"%s\", \"title\": \"%s\", ", kind, name,
                   title);
    print_sources(self, with_known);
    print_reading(self, !is_spectrum);
    if (has_samplers) {
        ps_text_append(out, ", \"realizations\": %llu, \"seed\": %llu",
                       (unsigned long long)self->num_realizations,
                       (unsigned long long)self->request->seed);
    }
    if (has_samplers && strcmp(name, "rates") != 0) {
        ps_text_append(out, ", \"points\": %llu", (unsigned long long)self->num_points);
    }
}

static void add_rates(report *self, const char *integrands) {
    uint64_t least = self->num_points;
    while (least / 2 >= FEWEST_POINTS && self->num_points / least < LEAST_SHARE) {
        least /= 2;
    }
    begin_result(self, "variance", "rates", "Variance of integrals against N", false);
    ps_text_append(&self->scene, ", \"points\": \"%llu..%llu\", \"integrand\": %s%s},\n",
                   (unsigned long long)least, (unsigned long long)self->num_points, integrands,
                   self->num_realizations >= PS_FEWEST_FITTED_REALIZATIONS ? ", \"rates\": \"auto\""
                                                                           : "");
}

static pspec_status make_scene(report *self, ps_error *error) {
    const char *const spectrum = self->on_sphere ? "angular" : "power";
    const char *const integrands =
        self->on_sphere ? "[\"cap\", \"harmonic\"]" : "[\"disk\", \"gaussian\", \"half-plane\"]";
    const bool fits = self->has_files || self->num_realizations >= PS_FEWEST_FITTED_REALIZATIONS;
    const char *const fit = fits ? ", \"fit\": \"auto\"" : "";
    ps_text *const out = &self->scene;
    ps_text_append(out, "{\"scene\": 1, \"title\": ");
    ps_scene_print_text(self->has_files ? ps_text_string(&self->name)
                                        : ps_request_source_name(self->request, 0),
                        out);
    ps_text_append(out, ",\n \"results\": [\n");
    if (!self->has_files && !ps_request_has_programs(self->request)) {
        begin_result(self, "sample", "points", "Points", false);
        ps_text_append(out, "},\n");
    }
    begin_result(self, spectrum, "spectrum", "Spectrum", false);
    ps_text_append(out, "%s, \"pictures\": \"%s\"},\n", fit, self->on_sphere ? "true" : "decibels");
    begin_result(self, spectrum, "beside", "Spectrum beside those of known sets", true);
    ps_text_append(out, "},\n");
    begin_result(self, "measure", "measures", "Measures", true);
    ps_text_append(out, "},\n");
    if (!self->has_files && !ps_request_has_own_counts(self->request) &&
        self->num_points >= 2 * FEWEST_POINTS) {
        add_rates(self, integrands);
    }
    begin_result(self, "variance", "integrals", "Variance of integrals, and ranks", true);
    ps_text_append(out, ", \"integrand\": %s%s}\n]}\n", integrands,
                   self->num_realizations >= PS_FEWEST_FITTED_REALIZATIONS
                       ? ", \"rank\": true, \"plot\": false"
                       : "");
    return ps_text_check(out, error);
}

static void free_report(report *self) {
    ps_text_free(&self->known);
    ps_text_free(&self->name);
    ps_text_free(&self->scene);
}

/* ---- the page ------------------------------------------------------------------------------ */

static pspec_status write_page(const ps_run *run, const char *path, ps_error *error) {
    ps_output_file *file = NULL;
    ps_text page = {0};
    pspec_status status = ps_run_page(run, &page, error);
    if (status == PSPEC_OK) {
        status = ps_output_open(&file, path, error);
    }
    if (status == PSPEC_OK) {
        ps_output_write(file, ps_text_string(&page), 1, page.length);
        status = ps_output_commit(&file, error);
    }
    ps_text_free(&page);
    return status;
}

static pspec_status produce(void *payload, ps_run *run, ps_error *error) {
    ps_answer *const out = payload;
    const char *const path = run->arguments->output;
    if (path == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "-o PAGE.html is needed: where the page goes");
    }
    if (!ps_text_ends_in(path, ".html") && !ps_text_ends_in(path, ".htm")) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "\"%s\": a page ends in .html, so that it takes no other file's place",
                       path);
    }
    PS_TRY(ps_outputs_check(run->arguments, false, error));
    PS_TRY(ps_run_ask(run, error));
    PS_TRY(ps_run_open_cache(run, error));
    PS_TRY(ps_run_answer(run, error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(ps_run_make_tables(run, &run->results[i], error));
        PS_TRY(ps_run_make_plots(run, &run->results[i], error));
    }
    PS_TRY(write_page(run, path, error));
    ps_run_tell_of_pictures(run, path);
    return ps_run_overview(&out->table, run, error);
}

/* Makes the scene and does something with it. */
static pspec_status with_scene(const ps_request *arguments, const ps_answer_hooks *hooks,
                               pspec_status (*work)(void *payload, ps_run *run, ps_error *error),
                               void *payload, ps_error *error) {
    report self = {.request = arguments};
    ps_scene scene = {0};
    ps_run run = {.hooks = *hooks,
                  .arguments = arguments,
                  .scene = &scene,
                  .folder = "",
                  .is_page_alone = true};
    pspec_status status = look(&self, error);
    if (status == PSPEC_OK) {
        status = make_scene(&self, error);
    }
    if (status == PSPEC_OK) {
        status = ps_scene_read_text(&scene, "report", ps_text_string(&self.scene), error);
    }
    if (status == PSPEC_OK) {
        status = work(payload, &run, error);
    }
    ps_run_free(&run);
    ps_scene_free(&scene);
    free_report(&self);
    return status;
}

static pspec_status plan(void *payload, ps_run *run, ps_error *error) {
    return ps_run_plan_blocks(run, payload, error);
}

pspec_status ps_run_report(ps_answer *out, const ps_request *arguments,
                           const ps_answer_hooks *hooks, ps_error *error) {
    return with_scene(arguments, hooks, produce, out, error);
}

pspec_status ps_run_plan_report(ps_planner *planner, const ps_request *arguments, ps_error *error) {
    return with_scene(arguments, planner->hooks, plan, planner, error);
}
