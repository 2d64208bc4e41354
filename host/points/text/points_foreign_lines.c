/* Texts of formats that are not read, by their first lines. */
#include "files/decimal.h"
#include "points/points_foreign.h"

#include <ctype.h>
#include <string.h>

/* ASE writes the box with the atoms, which few lines of awk could. */
#define BY_ASE(format)                                                                             \
    "ase convert -i " format " FILE atoms.xyz makes extended XYZ of it, which is read with its "   \
    "box"

/* The lines from the cursor on, of which those that were asked for before may have moved. */
typedef struct first_lines {
    ps_lines *lines;
    pspec_status status;
    ps_error *error;
} first_lines;

/* An empty one behind the last. */
static const char *line_at(first_lines *self, size_t index) {
    const char *line = NULL;
    if (self->status == PSPEC_OK) {
        self->status = ps_lines_peek(self->lines, index, &line, self->error);
    }
    return line != NULL ? ps_skip_blanks(line) : "\n";
}

static size_t count_numbers(const char *text, bool are_whole) {
    return ps_line_numbers(text, are_whole, 0, NULL);
}

static bool is_one_word(const char *text) {
    return !ps_ends_line(text) && ps_ends_line(ps_skip_blanks(text + ps_token_length(text)));
}

static bool is_off(first_lines *lines) {
    const char *const text = line_at(lines, 0);
    return ps_token_is_one_of(text, "OFF|COFF|NOFF|STOFF|4OFF|nOFF") && is_one_word(text);
}

/* "{" or "[[0.1, 0.2]": nothing that begins a row or a name. */
static bool is_json(first_lines *lines) {
    const char *const text = line_at(lines, 0);
    const char *const next = *text == '{' || *text == '[' ? ps_skip_blanks(text + 1) : text;
    return next != text && (ps_ends_line(next) || strchr("[{]}\"-0123456789", *next) != NULL);
}

/* Two records, since one could be a line of names. */
static bool is_pdb(first_lines *lines) {
    static const char records[] =
        "HEADER|OBSLTE|TITLE|SPLIT|CAVEAT|COMPND|SOURCE|KEYWDS|EXPDTA|NUMMDL|MDLTYP|AUTHOR|REVDAT|"
        "SPRSDE|JRNL|REMARK|DBREF|SEQADV|SEQRES|MODRES|HET|HELIX|SHEET|SSBOND|CRYST1|ORIGX1|SCALE1|"
        "MTRIX1|MODEL|ATOM|HETATM|ANISOU|TER|CONECT|ENDMDL|END";
    return ps_token_is_one_of(line_at(lines, 0), records) &&
           ps_token_is_one_of(line_at(lines, 1), records);
}

/* "data_NAME", and then the name of an item or a loop of them. */
static bool is_cif(first_lines *lines) {
    enum { MOST_LINES = 100 }; /* of comments and blank ones between the two */
    const char *text = line_at(lines, 0);
    bool is_it = strncmp(text, "data_", sizeof "data_" - 1) == 0 && is_one_word(text);
    for (size_t i = 1; is_it && i < MOST_LINES; i++) {
        text = line_at(lines, i);
        if (*text != '#' && !ps_ends_line(text)) {
            return *text == '_' || ps_token_is_one_of(text, "loop_");
        }
    }
    return false;
}

static bool is_pcd(first_lines *lines) {
    return ps_token_is_one_of(line_at(lines, 0), "VERSION|FIELDS") &&
           ps_token_is_one_of(line_at(lines, 1), "FIELDS|SIZE");
}

/* "    1SOL     OW    1   0.126   1.624   1.679": columns of a fixed width. */
static bool is_gromacs_atom(const char *text) {
    enum { COLUMNS = 15 }; /* of the number of the residue, its name and that of the atom */
    const size_t num_digits = strspn(text, "0123456789");
    double value = 0;
    bool is_atom = num_digits > 0 && isalpha((unsigned char)text[num_digits]) &&
                   strcspn(text, "\r\n") > COLUMNS;
    const char *at = text + num_digits;
    while (is_atom && !ps_ends_line(at) && *at != '.') { /* coordinates alone have points */
        at++;
    }
    while (is_atom && at > text && at[-1] != ' ') {
        at--;
    }
    for (int axis = 0; is_atom && axis < 3; axis++) {
        at = ps_decimal_parse(ps_skip_blanks(at), &value);
        is_atom = at != NULL;
    }
    return is_atom;
}

/* A title, unless it began with a mark and was passed over, the number of atoms, the first of them.
 */
static bool is_gromacs(first_lines *lines) {
    const size_t count = count_numbers(line_at(lines, 0), true) == 1 ? 0 : 1;
    return count_numbers(line_at(lines, count), true) == 1 &&
           is_gromacs_atom(line_at(lines, count + 1));
}

/* A title, a scale, three edges, perhaps names of elements, their numbers, perhaps "Selective
 * dynamics", "Direct" or "Cartesian". */
static bool is_poscar(first_lines *lines) {
    enum { AXES = 3 };
    size_t next = count_numbers(line_at(lines, 0), false) == 1 ? 0 : 1;
    bool is_it = count_numbers(line_at(lines, next++), false) == 1;
    for (int axis = 0; is_it && axis < AXES; axis++) {
        is_it = count_numbers(line_at(lines, next++), false) == AXES;
    }
    if (!is_it) {
        return false;
    }
    next += isalpha((unsigned char)*line_at(lines, next)) != 0;
    is_it = count_numbers(line_at(lines, next++), true) > 0;
    next += is_it && tolower((unsigned char)*line_at(lines, next)) == 's';
    return is_it && strchr("DdCcKk", *line_at(lines, next)) != NULL;
}

pspec_status ps_foreign_check_lines(ps_lines *lines, ps_error *error) {
    static const struct {
        bool (*is_it)(first_lines *lines);
        ps_foreign_format format;
    } known[] = {
        {is_off, {NULL, 0, "an OFF file", ps_foreign_meshes}},
        {is_json, {NULL, 0, "a JSON file", ps_foreign_tables}},
        {is_pdb, {NULL, 0, "a PDB file", BY_ASE("proteindatabank")}},
        {is_cif, {NULL, 0, "a CIF file", BY_ASE("cif")}},
        {is_poscar, {NULL, 0, "a POSCAR file", BY_ASE("vasp")}},
        {is_gromacs, {NULL, 0, "a GROMACS file", BY_ASE("gromacs")}},
        {is_pcd,
         {NULL, 0, "a PCD file",
          "awk '/^DATA ascii/ { on = 1; next } on { print $1, $2, $3 }' FILE | pointspec convert - "
          "takes the points of an ASCII one, and pcl_pcd2ply FILE points.ply makes PLY of any"}},
    };
    first_lines first = {lines, PSPEC_OK, error};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const bool is_it = known[i].is_it(&first);
        PS_TRY(first.status);
        if (is_it) {
            return ps_foreign_refuse(lines->input->name, &known[i].format, error);
        }
    }
    return PSPEC_OK;
}
