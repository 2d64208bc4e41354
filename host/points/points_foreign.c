#include "points/points_foreign.h"

#include <string.h>

static const char arrays[] = "numpy.save of its array of coordinates (N, d) gives a .npy file, "
                             "which is read";
const char ps_foreign_meshes[] = "its vertices are read as a PLY file, or as text, x y z on a line";
static const char pictures[] = "points are read, one on a line, and no pictures of them";
const char ps_foreign_tables[] =
    "its coordinates are read as lines of numbers, or as CSV with names";

/* Archivers have the same letters for it. */
#define UNPACKED(archiver) archiver " -dc FILE | pointspec power - reads what is in it"
#define MAGIC(text) text, sizeof text - 1

/* Shorter signatures could begin a text. */
static const ps_foreign_format formats[] = {
    {MAGIC("\x89HDF\r\n\x1a\n"), "an HDF5 file", arrays},
    {MAGIC("CDF\x01"), "a NetCDF file", arrays},
    {MAGIC("CDF\x02"), "a NetCDF file", arrays},
    {MAGIC("SIMPLE  ="), "a FITS file", arrays},
    {MAGIC("PAR1"), "a Parquet file", ps_foreign_tables},
    {MAGIC("MATLAB 5.0"), "a MATLAB file", arrays},
    {MAGIC("# vtk"), "a VTK file", ps_foreign_meshes},
    {MAGIC("<VTKFile"), "a VTK file", ps_foreign_meshes},
    {MAGIC("<?xml"), "an XML file", ps_foreign_tables},
    {MAGIC("\xfd\x37zXZ\0"), "an xz file", UNPACKED("xz")},
    {MAGIC("\x28\xb5\x2f\xfd"), "a zstd file", UNPACKED("zstd")},
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
    {MAGIC("<svg"), "an SVG image", pictures},
};

bool ps_magic_begins(const char *magic, size_t magic_bytes, const unsigned char *bytes,
                     size_t num_bytes, bool *needs_more) {
    const size_t there = num_bytes < magic_bytes ? num_bytes : magic_bytes;
    const bool agrees = memcmp(bytes, magic, there) == 0;
    *needs_more = *needs_more || (agrees && there < magic_bytes);
    return agrees && there == magic_bytes;
}

/* ---- formats that could begin a text ------------------------------------------------------ */

typedef struct bytes_left {
    const unsigned char *at, *end;
} bytes_left;

static bool is_one_of(const bytes_left *left, const char *characters) {
    return left->at < left->end && *left->at != '\0' && strchr(characters, *left->at) != NULL;
}

static void skip_all(bytes_left *left, const char *characters) {
    while (is_one_of(left, characters)) {
        left->at++;
    }
}

/* A whole number, of which small ones matter; 0: there is none. */
static unsigned take_count(bytes_left *left) {
    enum { BASE = 10, LARGEST = 1 << 20 };
    unsigned value = 0;
    for (; is_one_of(left, "0123456789"); left->at++) {
        value = value < LARGEST ? value * BASE + (unsigned)(*left->at - '0') : value;
    }
    return value;
}

/* "P5", perhaps comments, width and height on a line. "P5" may also name the column of a text, but
 * before rows of two numbers the first would be an index, which begins with 0 or 1. */
static bool is_netpbm(const unsigned char *bytes, size_t num_bytes) {
    bytes_left left = {bytes + 2, bytes + num_bytes};
    if (bytes[0] != 'P' || bytes[1] < '1' || bytes[1] > '6' || !is_one_of(&left, " \t\r\n")) {
        return false;
    }
    skip_all(&left, " \t\r\n");
    while (is_one_of(&left, "#")) {
        while (left.at < left.end && *left.at != '\n') {
            left.at++;
        }
        skip_all(&left, " \t\r\n");
    }
    const unsigned width = take_count(&left);
    const bool goes_on = is_one_of(&left, " \t");
    skip_all(&left, " \t");
    return width > 1 && goes_on && take_count(&left) > 0 && is_one_of(&left, " \t\r\n");
}

/* The size of the second header is below 256, and no text has bytes 0. */
static bool is_bitmap(const unsigned char *bytes, size_t num_bytes) {
    enum { SIZE = 14, SIZE_END = 18 };
    return num_bytes >= SIZE_END && memcmp(bytes, "BM", 2) == 0 && bytes[SIZE] > 0 &&
           memcmp(bytes + SIZE + 1, "\0\0", 3) == 0;
}

static bool is_svg(const unsigned char *bytes, size_t num_bytes) {
    static const char element[] = "<svg";
    size_t i = 0;
    if (memcmp(bytes, "<?", 2) != 0) {
        return false;
    }
    while (i + sizeof element - 1 < num_bytes && memcmp(bytes + i, element, 4) != 0) {
        i++;
    }
    return i + sizeof element - 1 < num_bytes;
}

/* The level, a digit, stands between the signature and the first block, or the end. */
static bool is_bzip2(const unsigned char *bytes, size_t num_bytes) {
    enum { LEVEL = 3, BLOCK_BYTES = 6 };
    return num_bytes > LEVEL + BLOCK_BYTES && memcmp(bytes, "BZh", LEVEL) == 0 &&
           (memcmp(bytes + LEVEL + 1, "1AY&SY", BLOCK_BYTES) == 0 ||
            memcmp(bytes + LEVEL + 1, "\x17\x72\x45\x38\x50\x90", BLOCK_BYTES) == 0);
}

/* More bytes are waited for only where two say that they come. */
static const ps_foreign_format *find_longer(const unsigned char *bytes, size_t num_bytes,
                                            bool *needs_more) {
    static const char *const begins[] = {"P1", "P2", "P3", "P4", "P5", "P6", "BM", "BZ", "<?"};
    enum { MOST_BYTES = 1024 };
    static const ps_foreign_format netpbm[] = {
        {NULL, 0, "a PBM image", pictures},
        {NULL, 0, "a PGM image", pictures},
        {NULL, 0, "a PPM image", pictures},
    };
    static const ps_foreign_format bitmap = {NULL, 0, "a BMP image", pictures};
    static const ps_foreign_format bzip2 = {NULL, 0, "a bzip2 file", UNPACKED("bzip2")};
    static const ps_foreign_format svg = {NULL, 0, "an SVG image", pictures};
    bool may_be = false;
    for (size_t i = 0; i < sizeof begins / sizeof begins[0]; i++) {
        may_be = may_be || ps_magic_begins(begins[i], 2, bytes, num_bytes, needs_more);
    }
    if (!may_be) {
        return NULL;
    }
    *needs_more = *needs_more || num_bytes < MOST_BYTES;
    num_bytes = num_bytes < MOST_BYTES ? num_bytes : MOST_BYTES;
    if (is_netpbm(bytes, num_bytes)) {
        return &netpbm[(bytes[1] - '1') % 3]; /* text and bytes of the same three */
    }
    if (is_bzip2(bytes, num_bytes)) {
        return &bzip2;
    }
    return is_bitmap(bytes, num_bytes) ? &bitmap : is_svg(bytes, num_bytes) ? &svg : NULL;
}

const ps_foreign_format *ps_foreign_find(const unsigned char *bytes, size_t num_bytes, bool are_all,
                                         bool *needs_more) {
    const ps_foreign_format *const longer = find_longer(bytes, num_bytes, needs_more);
    if (longer != NULL || (*needs_more && !are_all)) {
        return longer;
    }
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (ps_magic_begins(formats[i].magic, formats[i].magic_bytes, bytes, num_bytes,
                            needs_more)) {
            return &formats[i];
        }
    }
    return NULL;
}

/* ---- refusals ----------------------------------------------------------------------------- */

pspec_status ps_foreign_refuse(const char *file, const ps_foreign_format *format, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s is %s, which is not read; %s", file, format->name,
                   format->advice);
}
