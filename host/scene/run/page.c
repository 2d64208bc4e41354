/* The page of a run: one file of HTML with its pictures inside, which needs no network. */
#include "pointspec_version.h"
#include "scene/run/run.h"

#include <math.h>
#include <string.h>

static const char style[] =
    "body{font:15px/1.45 sans-serif;color:#222;max-width:1280px;margin:1.5em auto;padding:0 1em}\n"
    "h1{font-size:1.6em;margin:.2em 0}\n"
    "h2{font-size:1.2em;margin:2em 0 .3em;border-top:1px solid #ccc;padding-top:.8em}\n"
    ".facts{color:#555;margin:.2em 0}.scroll{overflow-x:auto}\n"
    "table{border-collapse:collapse;margin:.6em 0;font-size:.87em}\n"
    "th,td{padding:.15em .7em;text-align:right;border-bottom:1px solid #e4e4e4}\n"
    "td{white-space:nowrap}th{background:#f3f3f3;vertical-align:bottom}\n"
    "td.text,th.text{text-align:left}\n"
    ".plots{display:flex;flex-wrap:wrap;gap:.6em}\n"
    ".plots>svg{width:100%;max-width:580px;height:auto;flex:1 1 460px;border:1px solid #eee}\n"
    ".plots.one>svg{max-width:900px}\n"
    ".bad{color:#b00020;font-weight:bold}.good{color:#006b3c;font-weight:bold}\n"
    "details{margin:.4em 0}summary{cursor:pointer;color:#0b5394}code{font-size:.92em}\n"
    "dl{display:grid;grid-template-columns:max-content auto;gap:.1em 1em;font-size:.87em}\n"
    "dl{margin:.3em 0 1em}dt{color:#555}dd{margin:0;overflow-wrap:anywhere}\n"
    "@media "
    "print{@page{margin:9mm}body{font-size:8.5px;margin:0;max-width:none}details{display:none}\n"
    "h1,h2{margin:.2em 0 0;padding:.1em 0;font-size:1.3em}p,table{margin:.2em "
    "0}.scroll{overflow:visible}\n"
    "th,td{padding:0 .35em}.plots{flex-wrap:nowrap}.plots>svg{flex:1 1 "
    "0;min-width:0;max-width:none}\n"
    ".plots.one>svg{max-width:62%}}\n";

/* ---- texts ------------------------------------------------------------------------------- */

/* Bytes that are no character would end what a parser takes. */
static void print_text(const char *text, ps_text *out) {
    static const char special[] = "<>&\"";
    static const char *const names[] = {"lt", "gt", "amp", "quot"};
    while (*text != '\0') {
        const size_t length = ps_text_character(text);
        const char *const found = strchr(special, *text);
        if (found != NULL) {
            ps_text_append(out, "&%s;", names[found - special]);
        } else if (length > 0 || *text == '\n' || *text == '\t') {
            ps_text_append_bytes(out, text, length > 0 ? length : 1);
        } else {
            ps_text_append(out, "%s", PS_TEXT_UNKNOWN);
        }
        text += length > 0 ? length : 1;
    }
}

/* The name of a column in words, which may stand below each other. */
static void print_name(const char *name, ps_text *out) {
    for (; *name != '\0'; name++) {
        ps_text_append(out, "%c", *name == '_' ? ' ' : *name);
    }
}

/* Tables for reading have five digits; those of files have all. */
static void print_cell(ps_cell cell, ps_text *out) {
    switch (cell.kind) {
    case PS_CELL_NUMBER:
        ps_text_append(out, "%.5g", cell.number);
        break;
    case PS_CELL_INTEGER:
        ps_text_append(out, "%lld", (long long)cell.integer);
        break;
    case PS_CELL_TEXT:
        print_text(cell.text, out);
        break;
    case PS_CELL_MISSING:
        break;
    }
}

static void print_seconds(double seconds, ps_text *out) {
    const double millisecond = 1e-3;
    const double shown_in_seconds = 0.1;
    if (seconds < shown_in_seconds) {
        ps_text_append(out, "%.1f ms", seconds / millisecond);
    } else {
        ps_text_append(out, "%.2f s", seconds);
    }
}

/* ---- a result ---------------------------------------------------------------------------- */

/* An XML declaration and a document type belong at the beginning of a file only. */
static void print_plot(const ps_run_plot *plot, ps_text *out) {
    const char *const svg = plot->svg != NULL ? strstr(plot->svg, "<svg") : NULL;
    ps_text_append(out, "%s\n", svg != NULL ? svg : "");
}

/* What is to be known of pictures: why they have panels, or why they are not there. */
static void print_remarks(const ps_run_result *result, ps_text *out) {
    for (size_t p = 0; p < result->num_plots; p++) {
        const ps_run_plot *const plot = &result->plots[p];
        if (plot->svg != NULL && plot->what->num_panels == 1) {
            continue;
        }
        ps_text_append(out, "<p class=\"facts\">%s%s.svg: ", result->asked->name,
                       plot->what->suffix);
        if (plot->svg == NULL) {
            ps_text_append(out, "<span class=\"bad\">not drawn</span>: ");
            print_text(plot->reason, out);
        } else {
            ps_picture_say_panels(plot->what, result->asked, out);
        }
        ps_text_append(out, "</p>\n");
    }
}

static void print_plots(const ps_run_result *result, ps_text *out) {
    if (result->num_plots == 0) {
        return;
    }
    const bool is_wide = result->num_plots == 1 || result->plots[0].what->num_panels > 1;
    ps_text_append(out, "<div class=\"plots%s\">\n", is_wide ? " one" : "");
    for (size_t p = 0; p < result->num_plots; p++) {
        print_plot(&result->plots[p], out);
    }
    ps_text_append(out, "</div>\n");
    print_remarks(result, out);
}

static void print_cells(const ps_table *table, size_t number, ps_text *out) {
    for (size_t column = 0; column < ps_table_num_columns(table); column++) {
        const ps_cell cell = ps_table_cell(table, number, column);
        const bool is_verdict = strcmp(ps_table_column_name(table, column), "verdict") == 0;
        ps_text_append(out, "<td%s>",
                       is_verdict && cell.kind == PS_CELL_TEXT
                           ? (strcmp(cell.text, "same") == 0 ? " class=\"good\"" : " class=\"bad\"")
                       : cell.kind == PS_CELL_TEXT ? " class=\"text\""
                                                   : "");
        print_cell(cell, out);
        ps_text_append(out, "</td>");
    }
}

static void print_row(const ps_run_result *result, size_t number, ps_text *out) {
    const ps_run_question *const question = &result->questions[number];
    ps_text_append(out, "<tr>");
    print_cells(result->summary, number, out);
    ps_text_append(out, "<td>");
    print_seconds(question->seconds, out);
    ps_text_append(out, "</td><td class=\"text\">%s</td></tr>\n",
                   question->is_cached ? "cache" : "computed");
}

static void print_names(const ps_table *table, ps_text *out) {
    ps_text_append(out, "<div class=\"scroll\"><table><tr>");
    for (size_t column = 0; column < ps_table_num_columns(table); column++) {
        const bool is_text = ps_table_cell(table, 0, column).kind == PS_CELL_TEXT;
        ps_text_append(out, "<th%s>", is_text ? " class=\"text\"" : "");
        print_name(ps_table_column_name(table, column), out);
        ps_text_append(out, "</th>");
    }
}

static void print_summary(const ps_run_result *result, ps_text *out) {
    print_names(result->summary, out);
    ps_text_append(out, "<th>time</th><th class=\"text\">from</th></tr>\n");
    for (size_t q = 0; q < result->num; q++) {
        print_row(result, q, out);
    }
    ps_text_append(out, "</table></div>\n");
}

/* What a question found out, in words. */
static void print_sentences(const ps_run_result *result, size_t number, ps_text *out) {
    const ps_table *const table = result->questions[number].answer.table;
    const char *const *const wanted = result->asked->kind->sentences;
    for (size_t i = 0; wanted != NULL && i < ps_table_num_meta(table); i++) {
        const char *key = NULL;
        const ps_cell value = ps_table_meta(table, i, &key);
        size_t k = 0;
        while (wanted[k] != NULL && strcmp(wanted[k], key) != 0) {
            k++;
        }
        if (wanted[k] != NULL) {
            ps_text_append(out, "<p>");
            print_cell(value, out);
            ps_text_append(out, "</p>\n");
        }
    }
}

/* All of them. */
static void print_rows(const ps_table *table, ps_text *out) {
    print_names(table, out);
    ps_text_append(out, "</tr>\n");
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        ps_text_append(out, "<tr>");
        print_cells(table, row, out);
        ps_text_append(out, "</tr>\n");
    }
    ps_text_append(out, "</table></div>\n");
}

static void print_with_error(ps_cell value, ps_cell error, ps_text *out) {
    ps_text_append(out, "<td>");
    print_cell(value, out);
    if (error.kind == PS_CELL_NUMBER) {
        ps_text_append(out, " &plusmn; %.2g", error.number);
    }
    ps_text_append(out, "</td>");
}

/* A column for each question, for kinds whose rows are the same in all of them. */
static void print_side_by_side(const ps_run_result *result, ps_text *out) {
    const char *const row_name = result->asked->kind->row_name;
    const ps_table *const first = result->questions[0].answer.table;
    ps_text_append(out, "<div class=\"scroll\"><table><tr><th class=\"text\">%s</th>", row_name);
    for (size_t q = 0; q < result->num; q++) {
        ps_text label = {0};
        ps_run_label(result, q, &label);
        ps_text_append(out, "<th>");
        print_text(ps_text_string(&label), out);
        ps_text_append(out, "</th>");
        out->failed = out->failed || label.failed;
        ps_text_free(&label);
    }
    for (size_t row = 0; row < ps_table_num_rows(first); row++) {
        ps_text_append(out, "</tr>\n<tr><td class=\"text\">");
        print_name(ps_table_find_cell(first, row, row_name).text, out);
        ps_text_append(out, "</td>");
        for (size_t q = 0; q < result->num; q++) {
            const ps_table *const table = result->questions[q].answer.table;
            print_with_error(ps_table_find_cell(table, row, "value"),
                             ps_table_find_cell(table, row, "standard_error"), out);
        }
    }
    ps_text_append(out, "</tr></table></div>\n");
}

/* Do all questions have the rows of the first? */
static bool are_rows_alike(const ps_run_result *result) {
    const char *const row_name = result->asked->kind->row_name;
    const ps_table *const first = result->questions[0].answer.table;
    for (size_t q = 0; q < result->num && row_name != NULL; q++) {
        const ps_table *const table = result->questions[q].answer.table;
        if (ps_table_num_rows(table) != ps_table_num_rows(first)) {
            return false;
        }
        for (size_t row = 0; row < ps_table_num_rows(first); row++) {
            const ps_cell a = ps_table_find_cell(first, row, row_name);
            const ps_cell b = ps_table_find_cell(table, row, row_name);
            if (a.kind != PS_CELL_TEXT || b.kind != PS_CELL_TEXT || strcmp(a.text, b.text) != 0) {
                return false;
            }
        }
    }
    return row_name != NULL;
}

/* The header of a question: command, engine, precision, what was skipped, how it was checked. */
static void print_header(const ps_run_result *result, size_t number, ps_text *out) {
    const ps_table *const table = result->questions[number].answer.table;
    ps_text_append(out, "<dl>");
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const char *key = NULL;
        const ps_cell value = ps_table_meta(table, i, &key);
        const bool is_command = strcmp(key, "command") == 0;
        if (strcmp(key, "pointspec_version") == 0 || strcmp(key, "schema") == 0) {
            continue;
        }
        ps_text_append(out, "<dt>");
        print_text(key, out);
        ps_text_append(out, "</dt><dd>%s", is_command ? "<code>" : "");
        print_cell(value, out);
        ps_text_append(out, "%s</dd>\n", is_command ? "</code>" : "");
    }
    ps_text_append(out, "</dl>\n");
}

static void print_plan(const ps_run_result *result, ps_text *out) {
    ps_text_append(out, "<details><summary>plan: how every number was made, and what was skipped"
                        "</summary>\n");
    for (size_t q = 0; q < result->num; q++) {
        ps_text_append(out, "<details><summary>");
        ps_text label = {0};
        ps_run_label(result, q, &label);
        print_text(ps_text_string(&label), out);
        out->failed = out->failed || label.failed;
        ps_text_free(&label);
        ps_text_append(out, "</summary>\n");
        print_header(result, q, out);
        ps_text_append(out, "</details>\n");
    }
    ps_text_append(out, "</details>\n");
}

static void print_links(const ps_scene_result *asked, const ps_run_result *result, ps_text *out) {
    ps_text_append(out,
                   "<p class=\"facts\">%s; tables <a href=\"%s.csv\">%s.csv</a>, "
                   "<a href=\"%s.summary.csv\">%s.summary.csv</a>",
                   asked->kind->name, asked->name, asked->name, asked->name, asked->name);
    if (asked->wants_arrays) {
        ps_text_append(out,
                       "; arrays %s-array-1.npy to %s-array-%zu.npy, in the order of the summary",
                       asked->name, asked->name, result->num);
    }
    ps_text_append(out, "</p>\n");
}

static void print_result(const ps_run *run, const ps_run_result *result, ps_text *out) {
    const ps_scene_result *const asked = result->asked;
    ps_text_append(out, "<h2 id=\"%s\">", asked->name);
    print_text(asked->title != NULL ? asked->title : asked->name, out);
    ps_text_append(out, "</h2>\n");
    if (!run->is_page_alone) {
        print_links(asked, result, out);
    }
    print_plots(result, out);
    for (size_t q = 0; q < result->num; q++) {
        print_sentences(result, q, out);
    }
    if (are_rows_alike(result)) {
        print_side_by_side(result, out);
    } else if (asked->kind->has_few_rows) {
        print_rows(result->table, out);
    }
    print_summary(result, out);
    print_plan(result, out);
}

/* ---- the page ---------------------------------------------------------------------------- */

static void print_facts(const ps_run *run, ps_text *out) {
    const ps_run_question *slowest = &run->questions[0];
    for (size_t i = 1; i < run->num_questions; i++) {
        slowest = run->questions[i].seconds > slowest->seconds ? &run->questions[i] : slowest;
    }
    ps_text_append(out,
                   "<p class=\"facts\">pointspec %s; %zu result%s, %zu question%s, %zu from the "
                   "cache; ",
                   PS_VERSION, run->num_results, run->num_results == 1 ? "" : "s",
                   run->num_questions, run->num_questions == 1 ? "" : "s", run->num_cached);
    print_seconds(run->seconds, out);
    ps_text_append(out, ", of which the slowest question (%s) took ", slowest->asked.result->name);
    print_seconds(slowest->seconds, out);
    if (run->is_page_alone) {
        ps_text_append(out, "; made by <code>");
        print_text(run->arguments->command_line, out);
        ps_text_append(out, "</code></p>\n");
    } else {
        ps_text_append(out, "; <a href=\"record.json\">record.json</a> repeats it: "
                            "<code>pointspec run record.json</code></p>\n");
    }
}

static void print_contents(const ps_run *run, ps_text *out) {
    ps_text_append(out, "<p class=\"facts\">");
    for (size_t i = 0; i < run->num_results && run->num_results > 1; i++) {
        const ps_scene_result *const asked = run->results[i].asked;
        ps_text_append(out, "%s<a href=\"#%s\">", i > 0 ? " &middot; " : "", asked->name);
        print_text(asked->title != NULL ? asked->title : asked->name, out);
        ps_text_append(out, "</a>");
    }
    ps_text_append(out, "</p>\n");
}

pspec_status ps_run_page(const ps_run *run, ps_text *out, ps_error *error) {
    const ps_scene *const scene = run->scene;
    const char *const title = scene->title != NULL ? scene->title : scene->path;
    ps_text_append(out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
                        "name=\"viewport\" content=\"width=device-width\">\n<title>");
    print_text(title, out);
    ps_text_append(out, "</title>\n<style>\n%s</style></head><body>\n<h1>", style);
    print_text(title, out);
    ps_text_append(out, "</h1>\n");
    if (scene->description != NULL) {
        ps_text_append(out, "<p>");
        print_text(scene->description, out);
        ps_text_append(out, "</p>\n");
    }
    print_facts(run, out);
    print_contents(run, out);
    for (size_t i = 0; i < run->num_results; i++) {
        print_result(run, &run->results[i], out);
    }
    ps_text_append(out, "</body></html>\n");
    return ps_text_check(out, error);
}
