/* Writing openquad: an array of theta, phi and perhaps weights as rows. */
#include "base/text.h"
#include "files/npy.h"
#include "points/points_format.h"

/* Columns are written one after the other, so the set is kept until it is complete. */
void ps_openquad_write(ps_point_writer *writer, const double *rows, size_t num_rows) {
    ps_text_append_bytes(&writer->kept, (const char *)rows,
                         num_rows * writer->columns * sizeof *rows);
}

pspec_status ps_openquad_finish(ps_point_writer *writer, ps_error *error) {
    PS_TRY(ps_text_check(&writer->kept, error));
    const size_t num = writer->kept.length / sizeof(double) / writer->columns;
    const size_t shape[] = {writer->columns, num};
    ps_npy_write_header(writer->file, "f8", 2, shape);
    for (unsigned column = 0; column < writer->columns; column++) {
        for (size_t i = 0; i < num; i++) {
            ps_output_write(writer->file,
                            writer->kept.data + (i * writer->columns + column) * sizeof(double),
                            sizeof(double), 1);
        }
    }
    return PSPEC_OK;
}
