/* What the points of a request come from, and how many questions that makes. */
#include "request/request.h"

size_t ps_request_num_questions(const ps_request *request) {
    const size_t num_sources = request->num_sources > 0 ? request->num_sources : 1;
    return num_sources * request->num_counts;
}

const char *ps_request_sampler(const ps_request *request, size_t question) {
    return request->num_sources > 0 ? request->sources[question / request->num_counts].sampler
                                    : NULL;
}

const char *ps_request_source_name(const ps_request *request, size_t source) {
    const ps_source_words *const words = &request->sources[source];
    return words->sampler != NULL   ? words->sampler
           : words->name[0] != '\0' ? words->name
                                    : words->files;
}

const char *ps_request_name(const ps_request *request, size_t question) {
    return request->num_sources > 0
               ? ps_request_source_name(request, question / request->num_counts)
               : NULL;
}

const char *ps_request_program(const ps_request *request, size_t source) {
    const char *const files = request->sources[source].files;
    return files != NULL ? ps_points_program(files) : NULL;
}

bool ps_request_has_programs(const ps_request *request) {
    size_t i = 0;
    while (i < request->num_sources && ps_request_program(request, i) == NULL) {
        i++;
    }
    return i < request->num_sources;
}

bool ps_request_has_samplers(const ps_request *request) {
    size_t i = 0;
    while (i < request->num_sources && request->sources[i].sampler == NULL) {
        i++;
    }
    return i < request->num_sources;
}

bool ps_request_has_told(const ps_request *request) {
    return ps_request_has_samplers(request) || ps_request_has_programs(request);
}

bool ps_request_has_files(const ps_request *request) {
    size_t i = 0;
    while (i < request->num_sources && request->sources[i].files == NULL) {
        i++;
    }
    return i < request->num_sources || request->num_files > 0;
}

ps_bounds_spec ps_request_bounds(const ps_request *request, size_t question) {
    return request->num_bounds == 0   ? (ps_bounds_spec){0}
           : request->num_bounds == 1 ? request->bounds[0]
                                      : request->bounds[question / request->num_counts];
}

uint64_t ps_request_points(const ps_request *request, size_t question) {
    return request->counts[question % request->num_counts];
}
