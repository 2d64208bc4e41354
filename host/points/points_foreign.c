#include "points/points_foreign.h"

#include "files/decimal.h"
#include "files/text_lines.h"

#include <string.h>

static const char arrays[] = "numpy.save of its array of coordinates (N, d) gives a .npy file, "
                             "which is read";
static const char meshes[] = "its vertices are read as a PLY file, or as text, x y z on a line";
static const char pictures[] = "points are read, one on a line, and no pictures of them";
static const char tables[] = "its coordinates are read as lines of numbers, or as CSV with names";

#define MAGIC(text) text, sizeof text - 1

/* Shorter signatures could begin a text. */
const ps_foreign_format ps_foreign_formats[] = {
    {MAGIC("\x89HDF\r\n\x1a\n"), "an HDF5 file", arrays},
    {MAGIC("CDF\x01"), "a NetCDF file", arrays},
    {MAGIC("CDF\x02"), "a NetCDF file", arrays},
    {MAGIC("SIMPLE  ="), "a FITS file", arrays},
    {MAGIC("PAR1"), "a Parquet file", tables},
    {MAGIC("MATLAB 5.0"), "a MATLAB file", arrays},
    {MAGIC("# vtk"), "a VTK file", meshes},
    {MAGIC("<VTKFile"), "a VTK file", meshes},
    {MAGIC("<?xml"), "an XML file", tables},
    {MAGIC("\x89PNG"), "a PNG image", pictures},
    {MAGIC("\xff\xd8\xff"), "a JPEG image", pictures},
    {MAGIC("GIF8"), "a GIF image", pictures},
    {MAGIC("II*\0"), "a TIFF image", pictures},
    {MAGIC("MM\0*"), "a TIFF image", pictures},
    {MAGIC("v/1\x01"), "an EXR image", pictures},
    {MAGIC("#?RADIANCE"), "a Radiance image", pictures},
    {MAGIC("#?RGBE"), "a Radiance image", pictures},
    {MAGIC("PF\n"), "a PFM image", pictures},
    {MAGIC("Pf\n"), "a PFM image", pictures},
    {MAGIC("%PDF"), "a PDF file", pictures},
    {NULL, 0, NULL, NULL},
};

pspec_status ps_foreign_refuse(const char *file, const ps_foreign_format *format, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s is %s, which is not read; %s", file, format->name,
                   format->advice);
}

/* Is the first word one of these, separated by bars? */
static bool begins_with(const char *line, const char *words) {
    const size_t length = ps_token_length(line);
    for (const char *word = words; *word != '\0';) {
        const size_t expected = strcspn(word, "|");
        if (length == expected && strncmp(line, word, length) == 0) {
            return true;
        }
        word += expected + (word[expected] == '|');
    }
    return false;
}

/* "v 0 0 1": a letter, where other texts have the name of a column, before a number. */
static bool is_vertex(const char *line) {
    double value = 0;
    return begins_with(line, "v|vn|vt") &&
           ps_decimal_parse(ps_skip_blanks(line + ps_token_length(line)), &value) != NULL;
}

/* "{" or "[[0.1, 0.2]": nothing that begins a row or a name. */
static bool is_json(const char *line) {
    const char *const next = *line == '{' || *line == '[' ? ps_skip_blanks(line + 1) : line;
    return next != line && (ps_ends_line(next) || strchr("[{]}\"-0123456789", *next) != NULL);
}

pspec_status ps_foreign_check_line(const char *file, const char *line, ps_error *error) {
    ps_foreign_format found = {NULL, 0, NULL, meshes};
    const char *const text = ps_skip_blanks(line);
    const char *const after = ps_skip_blanks(text + ps_token_length(text));
    if (begins_with(text, "OFF|COFF|NOFF|STOFF|4OFF|nOFF") && ps_ends_line(after)) {
        found.name = "an OFF file";
    } else if (is_vertex(text) || (begins_with(text, "mtllib|usemtl") && !ps_ends_line(after))) {
        found.name = "an OBJ file";
    } else if (is_json(text)) {
        found.name = "a JSON file";
        found.advice = tables;
    }
    return found.name == NULL ? PSPEC_OK : ps_foreign_refuse(file, &found, error);
}
