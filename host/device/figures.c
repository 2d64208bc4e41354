#include "device/figures.h"

#include <math.h>
#include <string.h>

double ps_figures_scale(const ps_figures *figures, const char *engine, unsigned precision) {
    if (figures == NULL || !figures->is_measured || precision >= PS_FIGURES_PRECISIONS) {
        return 1;
    }
    for (size_t i = 0; i < figures->num_engines; i++) {
        if (strcmp(figures->engines[i].engine, engine) == 0) {
            const double scale = figures->engines[i].scales[precision];
            return scale > 0 ? scale : 1;
        }
    }
    return 1;
}

double ps_figures_launch_seconds(const ps_figures *figures, double built_in) {
    return figures != NULL && figures->launches > 0 ? 1 / figures->launches : built_in;
}

double ps_figures_sent_bytes(const ps_figures *figures, double built_in) {
    return figures != NULL && figures->sent_bytes > 0 ? figures->sent_bytes : built_in;
}

ps_engine_figure *ps_figures_row(ps_figures *figures, const char *engine) {
    for (size_t i = 0; i < figures->num_engines; i++) {
        if (strcmp(figures->engines[i].engine, engine) == 0) {
            return &figures->engines[i];
        }
    }
    if (figures->num_engines == PS_FIGURES_ENGINES ||
        strlen(engine) >= sizeof figures->engines[0].engine) {
        return NULL;
    }
    ps_engine_figure *row = &figures->engines[figures->num_engines++];
    *row = (ps_engine_figure){{0}, {0}};
    memcpy(row->engine, engine, strlen(engine) + 1);
    return row;
}

double ps_figures_host_scale(const ps_figures *figures, const char *sampler) {
    double logarithms = 0;
    if (figures == NULL || !figures->is_measured || figures->num_host == 0) {
        return 1;
    }
    for (size_t i = 0; i < figures->num_host; i++) {
        if (sampler != NULL && strcmp(figures->host[i].sampler, sampler) == 0) {
            return figures->host[i].scale;
        }
        logarithms += log(figures->host[i].scale);
    }
    return exp(logarithms / (double)figures->num_host);
}

ps_host_figure *ps_figures_host_row(ps_figures *figures, const char *sampler) {
    for (size_t i = 0; i < figures->num_host; i++) {
        if (strcmp(figures->host[i].sampler, sampler) == 0) {
            return &figures->host[i];
        }
    }
    if (figures->num_host == PS_FIGURES_HOST ||
        strlen(sampler) >= sizeof figures->host[0].sampler) {
        return NULL;
    }
    ps_host_figure *const row = &figures->host[figures->num_host++];
    *row = (ps_host_figure){.scale = 1};
    memcpy(row->sampler, sampler, strlen(sampler) + 1);
    return row;
}
