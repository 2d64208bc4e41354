/* The table of targets. A new one is a function in fuzz.h, a row here and seeds in make_corpus.sh.
 */
#include "fuzz.h"

#include <string.h>

const fuzz_target fuzz_targets[] = {
    {"utk-text", fuzz_points, "utk-text", "text.dict"},
    {"csv", fuzz_points, "csv", "text.dict"},
    {"psa-text", fuzz_points, "psa-text", "text.dict"},
    {"gbn", fuzz_points, "gbn", "text.dict"},
    {"edat", fuzz_points, "edat", "text.dict"},
    {"eps", fuzz_points, "eps", "text.dict"},
    {"utk-binary", fuzz_points, "utk-binary", "binary.dict"},
    {"rps", fuzz_points, "rps", NULL},
    {"npy", fuzz_points, "npy", "binary.dict"},
    {"openquad", fuzz_points, "openquad", "binary.dict"},
    {"utk1", fuzz_points, "utk1", "text.dict"},
    {"lammps", fuzz_points, "lammps", "text.dict"},
    {"xyz", fuzz_points, "xyz", "text.dict"},
    {"ply", fuzz_points, "ply", "binary.dict"},
    {"obj", fuzz_points, "obj", "text.dict"},
    {"detection", fuzz_points, NULL, "binary.dict"},
    {"frequencies", fuzz_frequencies, NULL, "text.dict"},
    {"weights", fuzz_weights, NULL, "binary.dict"},
    {"saved", fuzz_saved, NULL, "binary.dict"},
    {"table", fuzz_table, NULL, "binary.dict"},
    {"image", fuzz_image, NULL, "binary.dict"},
    {"mesh", fuzz_mesh, NULL, "text.dict"},
    {"figures", fuzz_figures, NULL, "binary.dict"},
    {"scene", fuzz_scene, NULL, "scene.dict"},
    {"decimal", fuzz_decimal, NULL, "text.dict"},
    {"brdf", fuzz_brdf, NULL, "text.dict"},
    {"sampler", fuzz_sampler, NULL, "words.dict"},
    {"arguments", fuzz_arguments, NULL, "words.dict"},
    {NULL, NULL, NULL, NULL},
};

const fuzz_target *fuzz_target_find(const char *name) {
    for (const fuzz_target *target = fuzz_targets; target->name != NULL; target++) {
        if (strcmp(target->name, name) == 0) {
            return target;
        }
    }
    return NULL;
}
