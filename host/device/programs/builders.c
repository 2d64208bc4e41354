/* Threads that build programs while the host goes on. */
#include "device/device_private.h"

#include "base/thread.h"

void ps_builders_create(ps_builders *builders) {
    pthread_mutex_init(&builders->mutex, NULL);
    pthread_cond_init(&builders->has_changed, NULL);
}

/* With the mutex, but while the driver works. */
static void build(ps_device *device, ps_program *program) {
    ps_builders *const builders = &device->builders;
    program->state = PS_PROGRAM_BEGUN;
    pthread_mutex_unlock(&builders->mutex);
    program->code = clBuildProgram(program->object, 1, &device->id,
                                   ps_text_string(&program->options), NULL, NULL);
    pthread_mutex_lock(&builders->mutex);
    program->state = program->code == CL_SUCCESS ? PS_PROGRAM_BUILT : PS_PROGRAM_FAILED;
    pthread_cond_broadcast(&builders->has_changed);
}

static ps_program *first_wanted(const ps_device *device) {
    ps_program *program = device->programs;
    while (program != NULL && program->state != PS_PROGRAM_WANTED) {
        program = program->next;
    }
    return program;
}

static void *build_wanted(void *argument) {
    ps_device *const device = argument;
    ps_builders *const builders = &device->builders;
    pthread_mutex_lock(&builders->mutex);
    while (!builders->is_over) {
        ps_program *const program = first_wanted(device);
        if (program != NULL) {
            build(device, program);
        } else {
            pthread_cond_wait(&builders->has_changed, &builders->mutex);
        }
    }
    pthread_mutex_unlock(&builders->mutex);
    return NULL;
}

bool ps_builders_begin(ps_device *device, ps_program *program) {
    ps_builders *const builders = &device->builders;
    if (builders->most == 0) {
        return false;
    }
    pthread_mutex_lock(&builders->mutex);
    const bool is_idle = program->state == PS_PROGRAM_IDLE;
    if (is_idle) {
        program->state = PS_PROGRAM_WANTED;
        pthread_cond_broadcast(&builders->has_changed);
    }
    pthread_mutex_unlock(&builders->mutex);
    if (is_idle && builders->num < builders->most) {
        builders->num += ps_thread_begin(&builders->threads[builders->num], build_wanted, device);
    }
    return true;
}

bool ps_builders_has(ps_device *device, const ps_program *program) {
    pthread_mutex_lock(&device->builders.mutex);
    const bool is_wanted = program->state != PS_PROGRAM_IDLE;
    pthread_mutex_unlock(&device->builders.mutex);
    return is_wanted;
}

cl_int ps_builders_wait(ps_device *device, ps_program *program) {
    ps_builders *const builders = &device->builders;
    pthread_mutex_lock(&builders->mutex);
    if (program->state == PS_PROGRAM_IDLE || program->state == PS_PROGRAM_WANTED) {
        build(device, program);
    }
    while (program->state == PS_PROGRAM_BEGUN) {
        pthread_cond_wait(&builders->has_changed, &builders->mutex);
    }
    program->state = program->code == CL_SUCCESS ? PS_PROGRAM_BUILT : PS_PROGRAM_IDLE;
    pthread_mutex_unlock(&builders->mutex);
    return program->code;
}

void ps_builders_end(ps_device *device) {
    ps_builders *const builders = &device->builders;
    pthread_mutex_lock(&builders->mutex);
    builders->is_over = true;
    pthread_cond_broadcast(&builders->has_changed);
    pthread_mutex_unlock(&builders->mutex);
    for (unsigned i = 0; i < builders->num; i++) {
        pthread_join(builders->threads[i], NULL);
    }
    pthread_cond_destroy(&builders->has_changed);
    pthread_mutex_destroy(&builders->mutex);
}

void ps_device_set_builders(ps_device *device, unsigned most) {
    device->builders.most = most < PS_WORKERS_MOST ? most : PS_WORKERS_MOST;
}
