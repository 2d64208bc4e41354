/* How options store their values: the setters of the table of options. */
#ifndef PS_REQUEST_OPTION_SETTERS_H
#define PS_REQUEST_OPTION_SETTERS_H

#include "request/options.h"

/* These set the field at option->offset: a bool, a text, one more of several texts, a uint64_t
 * within limits, a ps_point_range, one of words, a number above 0 (and at most 1), or one from 0 to
 * 90. */
ps_option_setter ps_set_flag, ps_set_text, ps_add_text, ps_set_count, ps_set_points, ps_set_size,
    ps_set_range, ps_set_word, ps_set_positive, ps_set_share, ps_set_quarter_turn;

ps_option_setter ps_set_nothing, ps_set_dimension, ps_set_max_frequency, ps_set_max_degree,
    ps_set_smoothness, ps_set_plot_log, ps_set_plot_range, ps_add_sampler, ps_add_set, ps_set_bins,
    ps_set_box, ps_set_columns, ps_set_select, ps_set_weights, ps_set_weight_sum, ps_set_domain,
    ps_set_lift, ps_set_morph, ps_set_normalize, ps_set_precision, ps_set_false_alarm_rate,
    ps_set_fit, ps_set_bounds, ps_set_rates, ps_set_scatter, ps_set_camera, ps_set_image,
    ps_set_realization_range;

#endif
