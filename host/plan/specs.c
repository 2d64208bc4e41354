#include "plan/specs.h"

ps_sets_options ps_limits_sets(const ps_limits_spec *limits, bool no_skip) {
    return (ps_sets_options){{no_skip ? NULL : limits->cache_folder, limits->kept_bytes},
                             limits->constraints.memory_limit,
                             0,
                             limits->device,
                             0};
}
