/* The values of one key of a scene. */
#include "answers/picture.h"
#include "base/counts.h"
#include "base/text.h"
#include "integrands/integrand.h"
#include "request/option_text.h"
#include "scene/scene_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A key has at most so many values: lists are typed by people. */
enum { MOST_VALUES = 1000 };

/* ---- paths ------------------------------------------------------------------------------- */

static bool is_absolute(const char *path) {
    return path[0] == '/';
}

static pspec_status complain_of_stream(const ps_scene_file *file, const ps_scene_value *value) {
    return ps_scene_complain(file, value->line, NULL, PS_SCENE_NO_STREAM);
}

ps_option_input *ps_scene_find_input(int option) {
    return option >= 0 && option < PS_NUM_OPTIONS ? ps_options[option].input : NULL;
}

const char *ps_scene_find_path(const ps_kind *kind, int option, const char *text) {
    if (option == PS_SCENE_FILES) {
        return text;
    }
    ps_option_input *const find = ps_scene_find_input(option);
    return find != NULL ? find(ps_command_words(kind, (ps_option_id)option), text) : NULL;
}

/* The first bytes of *text, and the path behind them in another folder. */
static pspec_status move_path(const ps_scene_file *file, const char **text, size_t num_before,
                              const char *folder, const char *path) {
    ps_text joined = {0};
    ps_text_append_bytes(&joined, *text, num_before);
    ps_text_append(&joined, "%s%s", folder, path);
    return ps_text_keep(text, &file->scene->memory, &joined, file->error);
}

/* Is the path that of an integrand which can do without? */
static bool is_spared(const char *text, size_t num_before, const char *key) {
    const size_t length = strlen(key);
    const ps_integrand_kind *kind = NULL;
    ps_error reason = {0};
    return num_before > length && strncmp(text + num_before - length, key, length) == 0 &&
           ps_integrand_find(&kind, text, &reason) == PSPEC_OK && kind->does_without_file;
}

/* Such an integrand is taken without its file, as the scene's page has it then. */
static pspec_status do_without(const ps_scene_file *file, ps_scene_value *value, size_t index,
                               const char *path, const char *after) {
    static const char key[] = "file=";
    const char *const text = value->originals[index];
    const size_t num_before = (size_t)(path - text);
    ps_text missing = {0};
    ps_text_append_bytes(&missing, path, (size_t)(after - path));
    PS_TRY(ps_text_keep(&file->scene->missing, &file->scene->memory, &missing, file->error));
    if (!is_spared(text, num_before, key)) {
        (void)ps_scene_complain(file, value->line, NULL, "cannot read \"%s\": " PS_SCENE_NO_DATA,
                                file->scene->missing);
        return file->error->status = PSPEC_ERROR_IO; /* the scene may be right */
    }
    /* the mark before the key goes where nothing is behind it, else that behind the path */
    const bool is_last = *after == '\0';
    PS_TRY(move_path(file, &value->originals[index], num_before - strlen(key) - (is_last ? 1 : 0),
                     "", is_last ? "" : after + 1));
    value->texts[index] = value->originals[index];
    value->label = value->originals[0];
    return PSPEC_OK;
}

/* "data:" stands for the folder of test data, which not every machine has. */
static pspec_status resolve_data(const ps_scene_file *file, ps_option_input *find,
                                 ps_scene_value *value, size_t index, const char *path) {
    const char *const said = getenv("POINTSPEC_TEST_DATA");
    const char *const folder = said != NULL && said[0] != '\0' ? said : NULL;
    const size_t num_before = (size_t)(path - value->texts[index]);
    ps_text alone = {0};
    ps_text joined = {0};
    pspec_status status = ps_input_keep(&alone, find, path, file->error);
    if (status == PSPEC_OK) {
        const char *const after = path + alone.length;
        ps_text_append_bytes(&joined, value->texts[index], num_before);
        ps_text_append(&joined, "%s/%s", folder != NULL ? folder : "",
                       ps_text_string(&alone) + strlen(PS_SCENE_DATA));
        const bool is_there =
            folder != NULL && access(ps_text_string(&joined) + num_before, R_OK) == 0;
        ps_text_append(&joined, "%s", after);
        status = is_there ? ps_text_keep(&value->texts[index], &file->scene->memory, &joined,
                                         file->error)
                          : do_without(file, value, index, path, after);
    }
    ps_text_free(&alone);
    ps_text_free(&joined);
    return status;
}

/* The path, a part of the text, becomes relative to what the scene's folder is relative to. */
static pspec_status resolve(const ps_scene_file *file, ps_option_input *find, ps_scene_value *value,
                            size_t index, const char *path) {
    const char **const text = &value->texts[index];
    if (strcmp(path, "-") == 0) {
        return complain_of_stream(file, value);
    }
    if (strncmp(path, PS_SCENE_DATA, strlen(PS_SCENE_DATA)) == 0) {
        return resolve_data(file, find, value, index, path);
    }
    /* "-odd.txt" alone would be an option in the command line of the question */
    const bool is_odd = file->scene->folder[0] == '\0' && path == *text && path[0] == '-';
    return is_absolute(path) ? PSPEC_OK
                             : move_path(file, text, (size_t)(path - *text),
                                         is_odd ? "./" : file->scene->folder, path);
}

static pspec_status resolve_paths(const ps_scene_file *file, const ps_kind *kind, int option,
                                  ps_scene_value *value) {
    for (size_t i = 0; i < value->num_texts; i++) {
        const char *const path = ps_scene_find_path(kind, option, value->texts[i]);
        if (path != NULL) {
            PS_TRY(resolve(file, ps_scene_find_input(option), value, i, path));
        }
    }
    return PSPEC_OK;
}

/* ---- values ------------------------------------------------------------------------------ */

/* The sentence of an option without the name that the complaint has already: `samplers` of a scene
 * is `sampler` of a command. */
static pspec_status complain_of_value(const ps_scene_file *file, int line, const char *key,
                                      ps_option_id option, const ps_error *reason) {
    const char *sentence = reason->message;
    const size_t length = strlen(ps_options[option].name);
    if (strncmp(sentence, ps_options[option].name, length) == 0 &&
        strncmp(sentence + length, ": ", 2) == 0) {
        sentence += length + 2;
    }
    return ps_scene_complain(file, line, key, "%s", sentence);
}

static pspec_status check_value(const ps_scene_file *file, const ps_kind *kind, int option,
                                const char *key, const ps_scene_value *value) {
    ps_request scratch = ps_request_default;
    ps_error reason = {0};
    if (option == PS_SCENE_FILES) {
        return PSPEC_OK;
    }
    const ps_option_id id = (ps_option_id)option;
    for (size_t i = 0; i < value->num_texts; i++) {
        if (ps_option_apply(&scratch, id, ps_command_words(kind, id), value->texts[i], &reason) !=
            PSPEC_OK) {
            return complain_of_value(file, value->line, key, id, &reason);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_scene_make_value(const ps_scene_file *file, size_t num, int line,
                                 ps_scene_value *out) {
    *out = (ps_scene_value){.num_texts = num, .line = line};
    PS_TRY(PS_SCENE_NEW(file, &out->texts, 2 * num));
    out->originals = out->texts + num;
    return PSPEC_OK;
}

void ps_scene_set_text(ps_scene_value *value, size_t index, const char *text) {
    value->texts[index] = value->originals[index] = text;
    value->label = value->originals[0];
}

/* The scalars of a node as the texts of one value. */
static pspec_status take_value(const ps_scene_file *file, const char *key,
                               const ps_scene_node *node, ps_scene_value *out) {
    const size_t num = ps_scene_num_items(node);
    if (num == 0) {
        return ps_scene_complain(file, node->line, key, "an empty list");
    }
    PS_TRY(ps_scene_make_value(file, num, node->line, out));
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        const char *text = NULL;
        PS_TRY(ps_scene_take_text(file, item, key, &text));
        ps_scene_set_text(out, i, text);
    }
    return PSPEC_OK;
}

/* Of a list of paths in which there are lists each item is a value. */
static bool has_lists(const ps_scene_node *node) {
    for (const ps_scene_node *item = node->first; item != NULL; item = item->next) {
        if (node->kind == PS_NODE_LIST && item->kind == PS_NODE_LIST) {
            return true;
        }
    }
    return false;
}

/* One spectrum serves all integrands of a question, several files are one set of points, and
 * samplers may be compared by a question, each with bounds of its own. */
static bool is_one_value(const ps_scene_result *result, int option, const ps_scene_node *node) {
    return option == PS_OPTION_INTEGRAND || (option == PS_SCENE_FILES && !has_lists(node)) ||
           ((option == PS_OPTION_SAMPLER || option == PS_OPTION_BOUNDS) && result->is_joined);
}

static pspec_status refuse_list(const ps_scene_file *file, const char *key,
                                const ps_scene_node *item) {
    return item->kind == PS_NODE_LIST
               ? ps_scene_complain(file, item->line, key, "a list in a list; only files have those")
               : PSPEC_OK;
}

/* Numbers of points, as -n has them, also in the items of a list. */
static pspec_status parse_points(const ps_scene_file *file, const char *key,
                                 const ps_scene_node *node, ps_counts *out) {
    const ps_option *const option = &ps_options[PS_OPTION_POINTS];
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < ps_scene_num_items(node); i++, item = item->next) {
        const char *text = NULL;
        ps_error reason = {0};
        PS_TRY(refuse_list(file, key, item));
        PS_TRY(ps_scene_take_text(file, item, key, &text));
        if (ps_counts_parse(out, text, key, option->minimum, option->maximum, &reason) !=
            PSPEC_OK) {
            return complain_of_value(file, item->line, key, PS_OPTION_POINTS, &reason);
        }
    }
    return out->num > 0 ? PSPEC_OK : ps_scene_complain(file, node->line, key, "an empty list");
}

/* "64,256" of num numbers. */
static pspec_status set_numbers(const ps_scene_file *file, const uint64_t *numbers, size_t num,
                                ps_scene_value *out, int line) {
    ps_text text = {0};
    const char *kept = NULL;
    for (size_t i = 0; i < num; i++) {
        ps_text_append(&text, "%s%llu", i > 0 ? "," : "", (unsigned long long)numbers[i]);
    }
    PS_TRY(ps_text_keep(&kept, &file->scene->memory, &text, file->error));
    PS_TRY(ps_scene_make_value(file, 1, line, out));
    ps_scene_set_text(out, 0, kept);
    return PSPEC_OK;
}

/* A value for each number, or one of all of them. */
static pspec_status take_points(const ps_scene_file *file, const char *key,
                                const ps_scene_node *node, bool are_joined, ps_scene_entry *out) {
    uint64_t numbers[MOST_VALUES];
    ps_counts list = {.most = MOST_VALUES, .values = numbers};
    PS_TRY(parse_points(file, key, node, &list));
    const size_t num_each = are_joined ? list.num : 1;
    out->num_values = list.num / num_each;
    PS_TRY(PS_SCENE_NEW(file, &out->values, out->num_values));
    for (size_t i = 0; i < out->num_values; i++) {
        PS_TRY(set_numbers(file, numbers + i, num_each, &out->values[i], out->line));
    }
    return PSPEC_OK;
}

static pspec_status take_values(const ps_scene_file *file, const ps_scene_result *result,
                                const char *key, const ps_scene_node *node, ps_scene_entry *out) {
    const bool is_one = is_one_value(result, out->option, node);
    const size_t num = is_one ? 1 : ps_scene_num_items(node);
    if (num == 0 || num > MOST_VALUES) {
        return num == 0 ? ps_scene_complain(file, node->line, key, "an empty list")
                        : ps_scene_complain(file, node->line, key, "%zu values, more than %d", num,
                                            MOST_VALUES);
    }
    PS_TRY(PS_SCENE_NEW(file, &out->values, num));
    out->num_values = num;
    const ps_scene_node *item = is_one ? node : ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        PS_TRY(!is_one && out->option != PS_SCENE_FILES ? refuse_list(file, key, item) : PSPEC_OK);
        PS_TRY(take_value(file, key, item, &out->values[i]));
    }
    return PSPEC_OK;
}

pspec_status ps_scene_take_entry(const ps_scene_file *file, const ps_scene_result *result,
                                 int option, const char *key, const ps_scene_node *value,
                                 ps_scene_entry *out) {
    *out = (ps_scene_entry){.option = option, .line = value->line};
    PS_TRY(option == PS_OPTION_POINTS ? take_points(file, key, value, result->is_joined, out)
                                      : take_values(file, result, key, value, out));
    for (size_t i = 0; i < out->num_values; i++) {
        PS_TRY(resolve_paths(file, result->kind, option, &out->values[i]));
        PS_TRY(check_value(file, result->kind, option, key, &out->values[i]));
    }
    return PSPEC_OK;
}

/* ---- axes of pictures -------------------------------------------------------------------- */

const ps_option_id ps_scene_axes[] = {PS_OPTION_PLOT_LOG, PS_OPTION_PLOT_RANGE};

int ps_scene_find_axes(const char *key) {
    int axes = PS_SCENE_NUM_AXES - 1;
    while (axes >= 0 && strcmp(ps_options[ps_scene_axes[axes]].name, key) != 0) {
        axes--;
    }
    return axes;
}

bool ps_scene_has_axes(const ps_kind *kind, int axes) {
    return axes >= 0 && (ps_options[ps_scene_axes[axes]].commands & kind->takes) != 0;
}

pspec_status ps_scene_take_axes(const ps_scene_file *file, ps_scene_result *result, int axes,
                                const ps_scene_node *value) {
    const ps_option_id id = ps_scene_axes[axes];
    const char *const key = ps_options[id].name;
    ps_request scratch = ps_request_default;
    ps_error reason = {0};
    PS_TRY(ps_scene_take_text(file, value, key, &result->axes_texts[axes]));
    scratch.plot_axes = result->axes; /* what the other key said */
    if (ps_option_apply(&scratch, id, ps_command_words(result->kind, id), result->axes_texts[axes],
                        &reason) != PSPEC_OK ||
        ps_picture_check_axes(&scratch.plot_axes, &reason) != PSPEC_OK) {
        return complain_of_value(file, value->line, key, id, &reason);
    }
    result->axes = scratch.plot_axes;
    return PSPEC_OK;
}
