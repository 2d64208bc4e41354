#include "plan/specs.h"

#include "store/figures_file.h"

ps_sets_options ps_limits_sets(const ps_limits_spec *limits, bool no_skip) {
    return (ps_sets_options){{no_skip ? NULL : limits->cache_folder, limits->kept_bytes},
                             limits->constraints.memory_limit,
                             0,
                             limits->device,
                             0};
}

pspec_status ps_limits_open_device(const ps_limits_spec *limits, ps_device *open, bool may_lack,
                                   ps_device **out, bool *owns, ps_error *error) {
    if (*out != NULL || !ps_plan_may_need_device(&limits->constraints)) {
        return PSPEC_OK;
    }
    *out = open;
    if (open != NULL) {
        return PSPEC_OK;
    }
    const pspec_status status =
        ps_figures_open_device(out, limits->device, limits->profile, limits->cache_folder, error);
    *owns = status == PSPEC_OK;
    return status == PSPEC_ERROR_NO_DEVICE && may_lack ? PSPEC_OK : status;
}
