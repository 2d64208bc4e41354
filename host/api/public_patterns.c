/* The public library: patterns of a question, in memory or from a function. */
#include "api/question.h"
#include "base/process/memory_limit.h"

#include <string.h>

/* Sets of one name are one curve, of several numbers of points. */
static size_t count_before(const pspec_question *self, const char *name) {
    size_t count = 0;
    for (size_t i = 0; i < self->num_sets; i++) {
        const char *const known = ps_text_string(&self->sets[i].name);
        const size_t length = strcspn(known, "=");
        count += strlen(name) == length && strncmp(known, name, length) == 0;
    }
    return count;
}

static pspec_status begin_set(pspec_question *self, const char *name, ps_error *error) {
    void *sets = self->sets;
    const size_t count = count_before(self, name);
    PS_TRY(ps_grow(&sets, &self->sets_capacity, self->num_sets + 1, sizeof *self->sets, "sets",
                   error));
    self->sets = sets;
    ps_caller_set *const set = &self->sets[self->num_sets++];
    *set = (ps_caller_set){.count = count};
    ps_given_name(&set->name, name, count);
    ps_text_append(&set->word, "%s=%s", name, name);
    return ps_text_check(set->word.failed ? &set->word : &set->name, error);
}

pspec_status pspec_question_begin_set(pspec_question *question, const char *name) {
    static const char special[] = ",=*?[\\"; /* mean something in lists of files */
    if (question == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &question->context->error;
    return name == NULL || name[0] == '\0' || strcmp(name, "-") == 0 || strpbrk(name, special) ||
                   strcmp(name, PS_CALLER_POINTS) == 0 /* they are of no set */
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\" is no name of a set: it must not be empty, -, " PS_CALLER_POINTS
                         ", or have one of %s",
                         name != NULL ? name : "", special)
               : begin_set(question, name, error);
}

/* The set that patterns go to; without begin_set they are the points of the question. */
static pspec_status last_set(pspec_question *self, ps_caller_set **out, ps_error *error) {
    PS_TRY(self->num_sets == 0 ? begin_set(self, PS_CALLER_POINTS, error) : PSPEC_OK);
    *out = &self->sets[self->num_sets - 1];
    return PSPEC_OK;
}

/* Of num patterns of the shape of one of them; SIZE_MAX: more than there can be. */
static size_t count_numbers(const pspec_pattern *first, size_t num) {
    size_t size = 0;
    return ps_size_multiply(first->num_points, first->dimension + (first->weights != NULL),
                            &size) &&
                   ps_size_multiply(size, num, &size)
               ? size
               : SIZE_MAX;
}

static pspec_status check_memory(const pspec_question *self, const pspec_pattern *first, size_t num,
                                 ps_error *error) {
    char needed[PS_SIZE_TEXT];
    char allowed[PS_SIZE_TEXT];
    const uint64_t limit = self->context->memory_limit;
    double numbers = (double)count_numbers(first, num);
    for (size_t i = 0; i < self->num_sets; i++) {
        numbers += (double)self->sets[i].num_numbers;
    }
    const double bytes = numbers * (double)sizeof(double);
    return limit == 0 || bytes <= (double)limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "patterns in memory take %s, above the limit of %s; "
                         "pspec_question_give() asks for one at a time and keeps none",
                         ps_size_show(needed, bytes), ps_size_show(allowed, (double)limit));
}

static const char what[] = "patterns in memory";

/* Keeps views of num patterns of the shape of the first, one behind the other. */
static pspec_status keep_views(ps_caller_set *set, const pspec_pattern *first, size_t num,
                               ps_error *error) {
    const size_t coordinates = first->num_points * first->dimension;
    void *kept = set->kept;
    PS_TRY(ps_grow(&kept, &set->capacity, set->num_kept + num, sizeof *set->kept, what, error));
    set->kept = kept;
    for (size_t i = 0; i < num; i++) {
        set->kept[set->num_kept++] =
            (pspec_pattern){first->dimension, first->num_points, first->points + i * coordinates,
                            first->weights != NULL ? first->weights + i * first->num_points : NULL};
    }
    return PSPEC_OK;
}

/* Copies them before. */
static pspec_status keep_copies(ps_caller_set *set, const pspec_pattern *first, size_t num,
                                ps_error *error) {
    const size_t coordinates = first->num_points * first->dimension;
    const size_t size = count_numbers(first, num);
    double *numbers = NULL;
    PS_TRY(PS_POOL_NEW(&set->memory, &numbers, size, what, error));
    double *const weights = first->weights != NULL ? numbers + num * coordinates : NULL;
    memcpy(numbers, first->points, num * coordinates * sizeof *numbers);
    if (weights != NULL) {
        memcpy(weights, first->weights, num * first->num_points * sizeof *weights);
    }
    const pspec_pattern copy = {first->dimension, first->num_points, numbers, weights};
    PS_TRY(keep_views(set, &copy, num, error));
    set->num_numbers += size;
    return PSPEC_OK;
}

static pspec_status add(pspec_question *self, const pspec_pattern *first, size_t num,
                        bool is_copied, ps_error *error) {
    ps_caller_set *set = NULL;
    if (first->num_points == 0 || first->points == NULL || first->dimension == 0 ||
        first->dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a pattern has at least one point, of 1 to %d numbers, and these have %zu "
                       "points of %u numbers%s",
                       PS_MAX_DIMENSION, first->num_points, first->dimension,
                       first->points == NULL ? " at the address NULL" : "");
    }
    PS_TRY(is_copied ? check_memory(self, first, num, error) : PSPEC_OK);
    PS_TRY(last_set(self, &set, error));
    if (count_numbers(first, num) > SIZE_MAX / sizeof(double) - set->num_numbers) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "there is no memory for so many %s", what);
    }
    return set->give != NULL
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "the patterns of the set \"%s\" are those that a function gives",
                         ps_text_string(&set->name))
           : is_copied ? keep_copies(set, first, num, error)
                       : keep_views(set, first, num, error);
}

pspec_status pspec_question_add(pspec_question *question, size_t num_patterns, size_t num_points,
                                unsigned dimension, const double *points, const double *weights) {
    const pspec_pattern first = {dimension, num_points, points, weights};
    return question == NULL ? PSPEC_ERROR_INVALID_ARGUMENT
                            : add(question, &first, num_patterns, true, &question->context->error);
}

pspec_status pspec_question_borrow(pspec_question *question, size_t num_patterns, size_t num_points,
                                   unsigned dimension, const double *points,
                                   const double *weights) {
    const pspec_pattern first = {dimension, num_points, points, weights};
    return question == NULL ? PSPEC_ERROR_INVALID_ARGUMENT
                            : add(question, &first, num_patterns, false, &question->context->error);
}

pspec_status pspec_question_give(pspec_question *question, uint64_t num, pspec_give give,
                                 void *payload) {
    ps_caller_set *set = NULL;
    if (question == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &question->context->error;
    PS_TRY(last_set(question, &set, error));
    if (give == NULL || set->give != NULL || set->num_kept > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       give == NULL ? "there is no function that gives patterns"
                                    : "the set \"%s\" has patterns already",
                       ps_text_string(&set->name));
    }
    set->num = num;
    set->give = give;
    set->payload = payload;
    return PSPEC_OK;
}
