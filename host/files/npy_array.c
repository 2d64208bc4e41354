#include "files/npy_array.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *ps_npy_show(unsigned num, const size_t *numbers, char text[PS_NPY_PLACE_BYTES]) {
    const size_t size = PS_NPY_PLACE_BYTES;
    size_t length = (size_t)snprintf(text, size, "(");
    for (unsigned i = 0; i < num; i++) {
        length +=
            (size_t)snprintf(text + length, size - length, "%s%zu", i > 0 ? ", " : "", numbers[i]);
    }
    snprintf(text + length, size - length, num == 1 ? ",)" : ")");
    return text;
}

const char *ps_npy_place(const ps_npy_array *array, size_t i, char text[PS_NPY_PLACE_BYTES]) {
    size_t place[PS_NPY_MAX_RANK];
    for (unsigned axis = array->rank; axis-- > 0;) {
        place[axis] = i % array->shape[axis];
        i /= array->shape[axis];
    }
    return ps_npy_show(array->rank, place, text);
}

const char *ps_npy_shape(const ps_npy_array *array, char text[PS_NPY_SHAPE_BYTES]) {
    const size_t length = (size_t)snprintf(text, PS_NPY_SHAPE_BYTES, "an array of shape ");
    ps_npy_show(array->rank, array->shape, text + length);
    return text;
}

/* The first axis is the fastest in the file, the last one in the array. */
static pspec_status turn_around(ps_npy_array *array, ps_error *error) {
    const size_t parts = array->is_complex ? 2 : 1;
    double *turned = NULL;
    PS_TRY(PS_NEW(&turned, array->num * parts, "an array", error));
    for (size_t i = 0; i < array->num; i++) {
        size_t rest = i;
        size_t to = 0;
        size_t stride = array->num;
        for (unsigned axis = 0; axis < array->rank; axis++) {
            stride /= array->shape[axis];
            to += rest % array->shape[axis] * stride;
            rest /= array->shape[axis];
        }
        memcpy(turned + to * parts, array->data + i * parts, parts * sizeof *turned);
    }
    free(array->data);
    array->data = turned;
    return PSPEC_OK;
}

static pspec_status check_numbers(const ps_npy_array *array, const char *name, ps_error *error) {
    const size_t parts = array->is_complex ? 2 : 1;
    for (size_t i = 0; i < array->num * parts; i++) {
        if (!isfinite(array->data[i])) {
            char place[PS_NPY_PLACE_BYTES];
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: the entry at %s is %g, not a finite number", name,
                           ps_npy_place(array, i / parts, place), array->data[i]);
        }
    }
    return PSPEC_OK;
}

static pspec_status read_array(ps_npy_array *out, ps_input *input, bool may_be_complex,
                               ps_error *error) {
    ps_npy_header header;
    PS_TRY(ps_npy_read_header(input, &header, may_be_complex, error));
    out->rank = header.rank;
    out->num = header.num_elements;
    out->is_complex = header.is_complex;
    memcpy(out->shape, header.shape, sizeof out->shape);
    if (out->num == 0) {
        char shape[PS_NPY_SHAPE_BYTES];
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s has no entries", input->name,
                       ps_npy_shape(out, shape));
    }
    const size_t count = out->num * (out->is_complex ? 2 : 1); /* check_size has multiplied it */
    PS_TRY(PS_NEW(&out->data, count, "an array", error));
    PS_TRY(ps_npy_read_elements(input, &header, out->data, count, error));
    PS_TRY(ps_npy_check_end(input, error));
    if (header.is_fortran_order && out->rank > 1) {
        PS_TRY(turn_around(out, error));
    }
    return check_numbers(out, input->name, error);
}

pspec_status ps_npy_read_array(ps_npy_array *out, ps_input *input, bool may_be_complex,
                               ps_error *error) {
    *out = (ps_npy_array){0};
    const pspec_status status = read_array(out, input, may_be_complex, error);
    if (status != PSPEC_OK) {
        ps_npy_array_free(out);
    }
    return status;
}

pspec_status ps_npy_make_array(ps_npy_array *out, unsigned rank, const size_t *shape,
                               bool is_complex, ps_error *error) {
    *out = (ps_npy_array){.rank = rank, .num = 1, .is_complex = is_complex};
    for (unsigned axis = 0; axis < rank; axis++) {
        out->shape[axis] = shape[axis];
        if (!ps_size_multiply(out->num, shape[axis], &out->num)) {
            return ps_fail(error, PSPEC_ERROR_MEMORY, "an array is too large");
        }
    }
    return ps_allocate_for(&out->data, out->num, (is_complex ? 2 : 1) * sizeof *out->data,
                           "an array", error);
}

size_t ps_npy_num_doubles(const ps_npy_array *array) {
    return array->num * (array->is_complex ? 2 : 1);
}

pspec_status ps_npy_write_array(const char *path, const ps_npy_array *array, ps_error *error) {
    ps_output_file *file = NULL;
    PS_TRY(ps_output_open(&file, path, error));
    ps_npy_write_header(file, array->is_complex ? "c16" : "f8", array->rank, array->shape);
    ps_output_write(file, array->data, sizeof *array->data, ps_npy_num_doubles(array));
    return ps_output_commit(&file, error);
}

void ps_npy_array_free(ps_npy_array *array) {
    free(array->data);
    array->data = NULL;
}
