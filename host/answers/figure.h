/* Pictures of answers: figures that a kind makes of tables, which may come from a job or from a
 * cache, of one command or of many questions of a scene. */
#ifndef PS_ANSWERS_FIGURE_H
#define PS_ANSWERS_FIGURE_H

#include "base/memory.h"
#include "base/watch.h"
#include "jobs/variance/rates.h"
#include "plots/plot.h"
#include "request/request.h"
#include "fields/table.h"

typedef struct ps_picture_kind ps_picture_kind;

typedef struct ps_chart_part {
    const ps_table *table;
    const ps_request *request; /* that it answers */
    const char *label; /* what its rows have and those of other parts may not; "": nothing */
    size_t panel;      /* that its curves are in; parts of a panel stand together */
} ps_chart_part;

/* What a figure is made of. */
typedef struct ps_chart {
    const ps_picture_kind *what;
    const char *title;
    ps_plot_axes axes; /* {0}: nothing was asked of them */
    size_t num_parts;
    const ps_chart_part *parts;
    size_t num_panels;         /* 1: a frame without others */
    const char *const *panels; /* their titles */
    double image_maximum;      /* of the scale of images; 0: each has its own */
    const ps_watch *watch;     /* hears of the work for large sets */
} ps_chart;

/* *out borrows from the chart and from memory, which the caller frees, also after an error. */
typedef pspec_status ps_make_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                    ps_error *error);

/* The parts of a picture: all questions of a result, unless they are too many; those and the same
 * for other numbers of points, against which they are drawn; one question; sets side by side. */
typedef enum ps_dealing { PS_OF_CURVES, PS_OF_COUNTS, PS_OF_EACH, PS_OF_SETS } ps_dealing;

/* Who draws it, and what has to be asked for: several numbers of points, --scatter, pictures (a key
 * of scenes; a command asks by --plot), pictures: decibels, pictures of points that are read,
 * --integrand, --max-degree (of commands; scenes draw it). */
enum { PS_BY_SCENE = 1, PS_BY_COMMAND = 2 };
typedef enum ps_picture_need {
    PS_NEEDS_NOTHING,
    PS_NEEDS_COUNTS,
    PS_NEEDS_SCATTER,
    PS_NEEDS_PICTURES,
    PS_NEEDS_DECIBELS,
    PS_NEEDS_FILES,
    PS_NEEDS_INTEGRAND,
    PS_NEEDS_DEGREE
} ps_picture_need;

/* A line of every curve: a column, or a header entry, against those of x. */
typedef struct ps_picture_line {
    const char *y;                  /* NULL ends a list of them */
    const char *error, *low, *high; /* columns beside it; NULL: none */
    ps_look look;                   /* unless panels or spectra have looks of their own */
    const char *formula;            /* in the key; NULL: none */
    const char *name;               /* in the key; NULL: that of the curve; "": none */
    bool is_of_all;                 /* the same for all curves of a panel: once, and last */
} ps_picture_line;

enum { PS_MOST_LINES = 5, PS_MOST_DRAWN_ARRAYS = 2 };

/* An array that a picture shows: a square of points, a plane about 0 in the middle, or pixels, one
 * image or several. */
typedef struct ps_drawn_array {
    const char *name; /* NULL ends a list of them */
    ps_frame_form form;
} ps_drawn_array;

/* One of the pictures of a kind. A command draws the last of its own whose need is met. */
struct ps_picture_kind {
    const char *suffix, *what; /* in the name and the title of a scene's; NULL: nothing */
    ps_make_figure *make;      /* NULL ends a list of them */
    ps_dealing dealing;
    unsigned by;
    ps_picture_need needs;
    const char *panels; /* the column that tells panels of its own apart; NULL: it has none */
    const char *x;
    ps_picture_line lines[PS_MOST_LINES + 1];
    ps_drawn_array arrays[PS_MOST_DRAWN_ARRAYS + 1]; /* beside the lines, where there are any */
    const char *x_label, *y_label;
    bool is_of_entries;      /* x and y are header entries of a question, not columns */
    bool is_log_x, is_log_y; /* of spectra: where they are in panels */
    bool is_in_decibels;     /* its image */
    bool is_spectrum; /* y is a power, and stands beside its anisotropy and what was fitted */
    /* What the header has of the slope of a curve; NULL: nothing */
    ps_uncertain (*find_slope)(const ps_table *table, const char *sampler, const char *panel);
    /* Of a command; NULL: samplers or lobe, numbers of points, realizations */
    void (*write_title)(ps_text *out, const ps_request *request, const ps_table *table);
};

/* One of a scene: a column against degrees, on a logarithmic axis. */
#define PS_PICTURE_OF_DEGREES(file, words, column, degrees, numbers)                               \
    PS_PICTURE_WHERE(PS_NEEDS_NOTHING, file, words, column, degrees, numbers)
#define PS_PICTURE_WHERE(need, file, words, column, degrees, numbers)                              \
    {                                                                                              \
        .needs = (need), .suffix = (file), .what = (words), .make = ps_lines_figure,               \
        .by = PS_BY_SCENE, .x = "degree", .lines = {{.y = (column)}}, .x_label = (degrees),        \
        .y_label = (numbers), .is_log_y = true                                                     \
    }

/* A curve for each question, of PS_OF_COUNTS for those that differ in the number of points alone,
 * and its lines; spectra as PS_FIGURE_SPECTRA has them where there is one panel. */
ps_make_figure ps_lines_figure;

/* The entry `key` behind the header entry number `number`, from 0 on, that is called `first`, and
 * before the next such; where there is none of these, of all. Missing: there is no such entry. */
ps_cell ps_entry_of(const ps_table *table, const char *first, size_t number, const char *key);

#endif
