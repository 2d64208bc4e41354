#include "request/options.h"

#include "frequencies/frequency_sample.h"
#include "points/points.h"
#include "request/option_rows.h"

/* In the order of ps_option_id, which is the order of --help. Where an option is repeated the last
 * one counts, but for --sampler, --set, --integrand and --bounds. */
const ps_option ps_options[PS_NUM_OPTIONS] = {
    [PS_OPTION_POINTS] =
        {NAMED("points", 'n', "N"), OF(READERS | BIT(sample), READS),
         .help =
             "points in each realization (default {check:as saved}{:1024}); several as 64,128,256 "
             "or 16..16384, which is 16 and its doubles; of files: points in each set, for "
             "formats that do not say (rps)",
         .set = ps_set_points, .minimum = 1, .maximum = MOST_POINTS},
    [PS_OPTION_REALIZATIONS] = {NAMED("realizations", 'm', "M"), .source = PS_OF_SAMPLERS,
                                OF(READERS | BIT(sample), BIT(report)),
                                .help = "realizations of each sampler (default {check:as saved, or "
                                        "128}{report:16}{:1})",
                                COUNT(num_realizations), .minimum = 1,
                                .maximum = MOST_REALIZATIONS},
    [PS_OPTION_RANGE] = {NAMED("range", 0, "A:B"), OF(0, SERIES),
                         .help = "only the realizations A to B - 1, from 0, for pointspec merge; "
                                 "of spectra multiples of 128, but B may be the last",
                         .set = ps_set_realization_range},
    [PS_OPTION_STANDARD_ERROR] =
        {NAMED("standard-error", 0, "X"), OF(SPECTRA | BIT(quadrature), 0),
         .help = "no more realizations than make the relative standard error of every "
                 "{power:ring}{:degree} X (above --floor; at least 16); -m: the most (default 1e6)",
         SHARE(accuracy.standard_error)},
    [PS_OPTION_DIMENSION] = {NAMED("dimension", 'd', "D"), OF(PLANE | BIT(sample), BIT(convert)),
                             .help = "dimension, 1 to 6 (default 2; of files: what they have)",
                             .set = ps_set_dimension, .minimum = 1, .maximum = PS_MAX_DIMENSION},
    [PS_OPTION_SEED] = {NAMED("seed", 's', "S"), .source = PS_OF_SAMPLERS,
                        /* but for --per-ring */ OF(READERS | BIT(sample), BIT(report)),
                        .help = "seed, 0 to 2^64 - 1 (default 1); same seed, same bits",
                        COUNT(seed), .minimum = 0, .maximum = UINT64_MAX},
    [PS_OPTION_SAMPLER] = {NAMED("sampler", 0, "NAME[:key=value,...]"),
                           OF(READERS | BIT(sample), BIT(report)),
                           .help = "makes the points, see Samplers{sample:}{:, or exec:PROGRAM}",
                           .set = ps_add_sampler, .maximum = PS_MAX_SAMPLERS},
    [PS_OPTION_SET] = {NAMED("set", 0, "NAME=FILES"), OF(0, SERIES),
                       .help = "points of files, with commas or patterns as in a=1.dat,b*.dat: "
                               "realizations of one average, a curve beside those of samplers",
                       .set = ps_add_set, .maximum = PS_MAX_SAMPLERS},
    [PS_OPTION_INTEGRAND] =
        {NAMED("integrand", 0, "NAME[:key=value,...]"),
         OF(BIT(variance) | BIT(shade) | SETLESS | BIT(interpolation), 0),
         .help = "what is {interpolation:interpolated}{light:shown}{:integrated}, see Integrands",
         TEXTS(integrands, PS_MAX_INTEGRANDS), .input = ps_input_of_named},
    [PS_OPTION_SHIFTS] =
        {NAMED("shifts", 0, "S"), OF(BIT(variance) | BIT(shade), 0),
         .help = "{shade:orientations of every set (default 1000, of all sets together; 0: "
                 "they are predicted alone)}{:random "
                 "shifts, on the sphere rotations, of every set that is measured (default 1; of a "
                 "single set in files 100; 0: nothing is measured)}",
         COUNT(num_shifts), .minimum = 0, .maximum = MOST_SHIFTS},
    [PS_OPTION_IN_PLACE] = {NAMED("in-place", 0, NULL), OF(BIT(variance), 0),
                            .help = "measure sets where they are, without shifts; the prediction "
                                    "is of shifted ones, and there is no z-score",
                            FLAG(in_place)},
    [PS_OPTION_TAIL] = {NAMED("tail", 0, "X"), OF(BIT(variance), 0),
                        .help = "no more than this may half of upper - lower be, over predicted, "
                                "of every row; else exit code 3, and the cut-off that would do",
                        POSITIVE(tail)},
    [PS_OPTION_PAPER_FORMULA] = {NAMED("paper-formula", 0, NULL), OF(BIT(variance), 0),
                                 .help = "a column more: the integral over |k| of radial means "
                                         "(E-13), which neglects P(0+) f_0^2 / N",
                                 FLAG(paper_formula)},
    [PS_OPTION_BOUNDS] = {NAMED("bounds", 0, "auto|G,A,B..G,A,B"), OF(BIT(variance), 0),
                          .help = "two columns more: the variance by profiles below and above P, "
                                  "G (nu/A)^B up to A, then G; auto: those of power --fit auto; "
                                  "again for each --sampler, or once for all",
                          .set = ps_set_bounds},
    [PS_OPTION_RATES] = {NAMED("rates", 0, "auto|A..B"), OF(BIT(variance), 0),
                         .help = "exponents of N, from N = A to B, with errors, and where two "
                                 "samplers change places; two columns more: from N to N",
                         .set = ps_set_rates, .is_of_all = true},
    [PS_OPTION_RANK] = {NAMED("rank", 0, NULL), OF(BIT(variance), 0),
                        .help = "which sampler has the least variance, factors of the others",
                        FLAG(wants_ranking), .is_of_all = true},
    [PS_OPTION_AGAINST] = {NAMED("against", 0, "FILE"), OF(BIT(check), 0),
                           .help =
                               "the saved spectrum: what power or angular wrote with -o FILE.npz",
                           TEXT(against), .input = ps_input_all},
    [PS_OPTION_HOMOGENEOUS] = {NAMED("homogeneous", 0, NULL), OF(BIT(check), 0),
                               .help = "instead: are realizations invariant under translations, "
                                       "on the sphere under rotations, in distribution?",
                               FLAG(homogeneous)},
    [PS_OPTION_FALSE_ALARM_RATE] = {NAMED("false-alarm-rate", 0, "P"), OF(BIT(check), 0),
                                    .help = "probability that anything differs by chance, "
                                            "above 0 and below 1 (default 0.001)",
                                    .set = ps_set_false_alarm_rate},
    [PS_OPTION_BRDF] = {NAMED("brdf", 0, "NAME[:key=value,...]"), OF(LOBES, 0),
                        .help = "lobe of reflection, see BRDFs", TEXT(brdf),
                        .input = ps_input_of_named},
    [PS_OPTION_VIEW] = {NAMED("view", 0, "DEGREES"), OF(BIT(shade), 0),
                        .help = "angle between the normal and the view: the lobe is about the "
                                "mirror direction, and what of it is below the horizon of the "
                                "normal counts for nothing (default: it is about the normal)",
                        QUARTER_TURN(view_angle)},
    [PS_OPTION_SMOOTHNESS] = {NAMED("smoothness", 0, "S"), OF(LOBES | BIT(interpolation), 0),
                              .help = "of the {interpolation:kernel of}{:integrands, functions of} "
                                      "the Sobolev space H^S, 1 < S < 2 (default 1.5){"
                                      "interpolation:; several as 1.1,1.5,1.9}{:}",
                              .set = ps_set_smoothness},
    [PS_OPTION_MESH] = {NAMED("mesh", 0, "FILE"), OF(BIT(occlusion), 0),
                        .help = "the scene: Wavefront OBJ, or a text of quadrilaterals", TEXT(mesh),
                        .input = ps_input_all, .is_of_all = true},
    [PS_OPTION_CAMERA] = {NAMED("camera", 0, "X,Y,Z,X,Y,Z[,ANGLE[,X,Y,Z]]"), OF(BIT(occlusion), 0),
                          .help = "where the camera is, what it looks at, its field of view from "
                                  "left to right in degrees (40), and which way is up (0,1,0); "
                                  "default: that of the file, else one that sees all of the mesh",
                          .set = ps_set_camera},
    [PS_OPTION_IMAGE] = {NAMED("image", 0, "WxH"), OF(BIT(occlusion), 0), .set = ps_set_image,
                         .help = "width and height of the picture in pixels (default 256x256)"},
    [PS_OPTION_RADIUS] = {NAMED("radius", 0, "R"), OF(BIT(occlusion), 0), POSITIVE(radius),
                          .help = "what is farther away hides nothing"},
    [PS_OPTION_MEASURES] = {NAMED("measures", 0, "NAME,..."), OF(BIT(measure), 0), TEXT(measures),
                            .help = "these alone (default: all but those that take long)"},
    [PS_OPTION_REFERENCE] = {NAMED("reference", 0, "R"), OF(BIT(occlusion), 0),
                             .help = "rays of a pixel of the reference, 4 n^2 (default 4096)",
                             COUNT(num_reference), .minimum = 4, .maximum = MOST_REFERENCE},
    [PS_OPTION_IMAGE_OUT] = {NAMED("image-out", 0, "FILE"), OF(0, BIT(occlusion)),
                             FILE_OUT(image_out),
                             .help = "write the image of the first realization too: .npy or .pfm"},
    [PS_OPTION_MAX_FREQUENCY] =
        {NAMED("max-frequency", 'k', "K"), OF(PLANE, 0),
         .help = "frequencies -K..K on every axis, rings 1..K (default "
                 "{check:2 N^(1/d)}{measure:6.5 N^(1/d), of large sets less}{:ceil(5 "
                 "N^(1/d)) for d <= 3})",
         .set = ps_set_max_frequency, .minimum = 1, .maximum = PS_MAX_FREQUENCY},
    [PS_OPTION_MAX_DEGREE] =
        {NAMED("max-degree", 'l', "L"),
         OF(SPHERES | LOBES | BIT(check) | BIT(variance) | BIT(measure) | BIT(light), 0),
         .help = "the largest degree (default {truncation:20}{light:64}{quadrature:at most "
                 "ceil(4 sqrt N)}{shade:that of the light, at most 256}{:ceil(4 sqrt N)})",
         .set = ps_set_max_degree},
    [PS_OPTION_MEMORY] = {NAMED("memory", 0, "SIZE"),
                          OF(READERS | BIT(sample), BIT(convert) | BIT(run)),
                          .help = "what points and the engine may take, as in 400M or 2G; it "
                                  "chooses among engines and is kept with the results (default: "
                                  "POINTSPEC_MEMORY, else what is free, which chooses nothing)",
                          .set = ps_set_size,
                          .offset = offsetof(ps_request, limits.constraints.memory_limit)},
    [PS_OPTION_HEMISPHERE] = {NAMED("hemisphere", 0, NULL),
                              OF(SPHERES | BIT(check) | BIT(variance) | BIT(occlusion), 0),
                              .help = "points of the hemisphere{occlusion:}{:, that is of the "
                                      "projective plane: even degrees, odd ones vanish}",
                              FLAG(hemisphere)},
    [PS_OPTION_COEFFICIENTS] = {NAMED("coefficients", 0, "FILE.npy"),
                                OF(0, BIT(power) | BIT(angular)),
                                .help =
                                    "write the complex128 array too: {angular:c_lm = sum w Y_lm of "
                                    "the only set, (l, m) at index m(2L+1-m)/2 + l}{:S(k) = sum w "
                                    "exp(-2 pi i k.x) of each set in the order of --full or of the "
                                    "list}",
                                FILE_OUT(coefficients)},
    [PS_OPTION_HARMONICS] = {NAMED("harmonics", 0, "spherical|hemispherical"),
                             OF(BIT(truncation), BIT(angular)),
                             .help = "of --coefficients, or of the products that are cut "
                                     "(default spherical); hemispherical ones are for points and "
                                     "lobes with z >= 0",
                             WORD(harmonics)},
    [PS_OPTION_FREQUENCIES] = {NAMED("frequencies", 0, "FILE"), OF(BIT(power), 0),
                               .help = "only the integer frequency vectors in FILE, one per line",
                               TEXT(frequencies.path), .input = ps_input_all},
    [PS_OPTION_BINS] = {NAMED("bins", 0, PS_BIN_RULES), OF(BIT(power) | BIT(variance), 0),
                        .help = "rings: of width 1 about whole |k| (round, the default), or by "
                                "floor of |k|, of |k| Q/P or of |k| Q/P N^(-1/d); or exact shells "
                                "of |k|^2{variance:, a sum over a ball instead of a box}",
                        .set = ps_set_bins},
    [PS_OPTION_PER_RING] = {NAMED("per-ring", 0, "S"), OF(BIT(power), 0),
                            .help = "of every ring (or shell) with more than S frequencies of the "
                                    "half lattice, only a random subset of S, from the seed",
                            COUNT(frequencies.per_ring), .minimum = PS_MIN_PER_RING,
                            .maximum = PS_MAX_NUM_FREQUENCIES},
    [PS_OPTION_FIT] = {NAMED("fit", 0, "auto|B"), OF(BIT(power) | BIT(angular), 0),
                       .help =
                           "also: power law or plateau at 0, peak, effective Nyquist, profiles "
                           "gamma (nu/alpha)^B about all powers (auto: B as found); -m 8 or more",
                       .set = ps_set_fit},
    [PS_OPTION_SCATTER] = {NAMED("scatter", 0, "K1,..,KD"), OF(BIT(power), 0),
                           .help = "S(k) of every set at this frequency: the mean, are phases "
                                   "uniform?; --plot shows the sets in the complex plane",
                           .set = ps_set_scatter},
    [PS_OPTION_FULL] = {NAMED("full", 0, "FILE.npy"), OF(0, BIT(power)),
                        .help = "write the whole array too, shape (2K+1)^D, DC in the middle, and "
                                "its standard error to FILE.standard_error.npy",
                        FILE_OUT(full)},
    [PS_OPTION_NORMALIZE] =
        {NAMED("normalize", 0, "power|effective|integral"), OF(BIT(power) | BIT(angular), 0),
         .help = "N |S|^2 / W^2 with N of each set (default power), |S|^2 / sum w^2, "
                 "or mean(N) mean(|S|^2 / W^2)",
         .set = ps_set_normalize},
    [PS_OPTION_HOMOGENIZE] =
        {NAMED("homogenize", 0, NULL), .source = PS_OF_SAMPLERS,
         OF(SETS | BIT(interpolation) | BIT(sample), 0),
         .help = "{power:shift every realization by one random vector, mod 1}"
                 "{angular,pairs,quadrature,shade,interpolation:rotate every realization by "
                 "one random rotation}{:shift every realization by one "
                 "random vector, mod 1; points of the sphere are rotated}",
         FLAG(homogenize)},
    [PS_OPTION_WEIGHTS] = {NAMED("weights", 0, "equal|column|FILE"), OF(ENGINES, BIT(convert)),
                           .help = "equal: all 1, weights of the files are dropped; column: the "
                                   "last one of the files (default: those that the format or "
                                   "--columns has, else all 1)",
                           .set = ps_set_weights, .offset = offsetof(ps_request, weights.path),
                           .input = ps_input_of_weights},
    [PS_OPTION_WEIGHT_SUM] = {NAMED("weight-sum", 0, "free|one"), OF(RULES, 0),
                              .help = "of --weights optimal: those of the smallest error (free), "
                                      "or those whose sum is 1 (one)",
                              .set = ps_set_weight_sum},
    [PS_OPTION_WEIGHTS_OUT] = {NAMED("weights-out", 0, "FILE"), OF(0, BIT(quadrature)),
                               .help = "write the weights of the only rule too, as --weights FILE "
                                       "reads them: an array where FILE ends in .npy, else text, "
                                       "one a line; 0 for points that were dropped",
                               FILE_OUT(weights_out)},
    [PS_OPTION_INPUT_FORMAT] = {NAMED("input-format", 0, PS_INPUT_FORMATS), .source = PS_OF_FILES,
                                OF(READERS, READS),
                                .help = "format of the point files (default: detected)",
                                WORD(reading.format)},
    [PS_OPTION_COLUMNS] = {NAMED("columns", 0, PS_POINT_COLUMNS), .source = PS_OF_FILES,
                           OF(READERS, READS),
                           .help = "what the columns of the point files are, w being the weight "
                                   "(default: found out{power:}{:; angles are in radians but "
                                   "lon-lat and those with :degrees}); or names with commas, as "
                                   "in x,y, that the first line of a text has, or numbers, as in "
                                   "3,7, and perhaps what they are, as in "
                                   "{power:x,y,mass=xyw}{:ra,dec=lon-lat}",
                           .set = ps_set_columns, .offset = offsetof(ps_request, reading.columns)},
    [PS_OPTION_SELECT] = {NAMED("select", 0, "NAME=VALUE"), .source = PS_OF_FILES,
                          OF(READERS, BIT(convert)),
                          .help = "only the rows with this value in the column of this name, as in "
                                  "type=1 or element=Ar, of texts with a line of names, frames of "
                                  "simulations (lammps, xyz) and vertices (ply)",
                          .set = ps_set_select, .offset = offsetof(ps_request, reading.select)},
    [PS_OPTION_HEADER] = {NAMED("header", 0, "yes|no"), .source = PS_OF_FILES,
                          OF(READERS, BIT(convert)),
                          .help = "has the first line of a text names of columns? (default: found "
                                  "out)",
                          WORD(reading.header)},
    [PS_OPTION_TRANSPOSE] = {NAMED("transpose", 0, NULL), .source = PS_OF_FILES,
                             OF(READERS, BIT(convert)),
                             .help = "points are the columns of arrays, as in shape (2, N)",
                             FLAG(reading.transpose)},
    [PS_OPTION_DOMAIN] = {NAMED("domain", 0, "torus|sphere"), .source = PS_OF_FILES,
                          OF(BIT(check) | BIT(variance) | BIT(measure), READS),
                          .help = "where the points lie (default: {check,measure:on the torus}"
                                  "{variance:where there are the integrands}{:found out})",
                          .set = ps_set_domain},
    [PS_OPTION_WRAP] = {NAMED("wrap", 0, NULL), .source = PS_OF_FILES, OF(PLANE, BIT(convert)),
                        .help = "reduce coordinates outside [0,1) mod 1", FLAG(reading.wrap)},
    [PS_OPTION_BOX] = {NAMED("box", 0, "X0,X1[,Y0,Y1,...]"), .source = PS_OF_FILES,
                       OF(READERS, READS),
                       .help = "coordinates of the files are in [X0,X1), as in 0,512 or -1,1, or "
                               "each axis in an interval of its own, as in 0,8,0,4, and become "
                               "those in [0,1)",
                       .set = ps_set_box},
    [PS_OPTION_NORMALIZE_VECTORS] = {NAMED("normalize-vectors", 0, NULL), .source = PS_OF_FILES,
                                     OF(ROUND, BIT(convert)),
                                     .help = "divide vectors by their lengths, whatever these are",
                                     FLAG(reading.normalize_vectors)},
    [PS_OPTION_LIFT] = {NAMED("lift", 0, "sphere|hemisphere"), .source = PS_OF_FILES,
                        OF(ROUND, BIT(convert)),
                        .help = "points (x, y) of the plane become points of the sphere, z = 2x - "
                                "1 or z = x, phi = 2 pi y, as by lift= of samplers",
                        .set = ps_set_lift},
    [PS_OPTION_MORPH] =
        {NAMED("morph", 0, "none|diffuse|glossy:n=N|phong:n=N"), .source = PS_OF_FILES,
         OF(SPHERES | RULES | BIT(check), BIT(convert)),
         .help = "points lifted to the hemisphere take the density of a lobe, as "
                 "by morph= of samplers (default {quadrature,shade:that of --brdf}{:none})",
         .set = ps_set_morph},
    [PS_OPTION_DROP_BELOW] = {NAMED("drop-below-horizon", 0, NULL), OF(RULES, 0),
                              .help = "leave points below the lobe's horizon out",
                              FLAG(drop_below_horizon)},
    [PS_OPTION_SELECT_SETS] = {NAMED("select-sets", 0, "A..B"), .source = PS_OF_FILES,
                               OF(READERS, BIT(convert)),
                               .help = "only these sets of each file, counted from 1; also A, A.., "
                                       "..B",
                               RANGE(reading.sets)},
    [PS_OPTION_SELECT_POINTS] = {NAMED("select-points", 0, "A..B"), OF(0, BIT(convert)),
                                 .help = "only these points of each set, counted from 1; also A, "
                                         "A.., ..B",
                                 RANGE(points)},
    [PS_OPTION_MERGE] = {NAMED("merge", 0, NULL), OF(0, BIT(convert)),
                         .help = "make one set of all sets", FLAG(merge)},
    [PS_OPTION_TO_COLUMNS] = {NAMED("to-columns", 0, PS_SPHERE_COLUMNS), OF(0, BIT(convert)),
                              .help = "columns of the output, for points of the sphere (default "
                                      "xyz, with w if there are weights)",
                              WORD(to_columns)},
    [PS_OPTION_TOLERANCE] =
        {NAMED("tol", 0, "T"), OF(ENGINES | BIT(interpolation), 0),
         .help = "largest error, above 0 and at most 1, of {pairs:Q(l) over (sum "
                 "|w|)^2 (default 1e-6)}{quadrature,shade:E^2 over c (sum |w|)^2 (default "
                 "1e-10)}{interpolation:K alpha over f by conjugate gradients (default 1e-12)}{:S "
                 "relative to white noise (default 1e-6)}",
         SHARE(accuracy.tolerance)},
    [PS_OPTION_FLOOR] = {NAMED("floor", 0, "P"), OF(SPECTRA, 0),
                         .help = "powers down to P are right to 10 %", POSITIVE(accuracy.floor)},
    [PS_OPTION_PRECISION] = {NAMED("precision", 0, "auto|single|double|extended"),
                             OF(ENGINES, SUITES),
                             .help = "arithmetic of the engine (default auto: the cheapest that "
                                     "meets the tolerance)",
                             .set = ps_set_precision},
    [PS_OPTION_ENGINE] = {NAMED("engine", 0, "NAME"), OF(ENGINES, SUITES),
                          .help = "this engine; pointspec plan lists them (default: the cheapest)",
                          TEXT(limits.constraints.engine)},
    [PS_OPTION_CASE] = {NAMED("case", 0, "NAME"), OF(0, SUITES), TEXT(case_name),
                        .help = "this case alone; the first column names them"},
    [PS_OPTION_CALIBRATE] = {NAMED("calibrate", 0, NULL), OF(0, BIT(bench)),
                             .help = "measure this device's figures for the planner and keep them",
                             FLAG(calibrate)},
    [PS_OPTION_DEVICE] = {NAMED("device", 0, "SELECTOR"),
                          OF(0,
                             READERS | SUITES | BIT(sample) | PAGES | BIT(devices) | BIT(doctor)),
                          .help = "OpenCL device: index, cpu, gpu, accelerator or part of a name; "
                                  "several: 0,1, gpu:all, cpu:split=2 "
                                  "(default: POINTSPEC_DEVICE, else the first GPU, else CPU)",
                          TEXT(limits.device)},
    [PS_OPTION_MIXED] = {NAMED("mixed", 0, NULL), OF(0, READERS | BIT(run)),
                         .help = "the list of --device may mix kinds, whose last bits differ",
                         FLAG(limits.mixed)},
    [PS_OPTION_CACHE] = {NAMED("cache", 0, "BYTES"), OF(0, PAGES),
                         .help = "disk for the cache of results; 0: none is used (default 1e9)",
                         COUNT(cache_bytes), .minimum = 0, .maximum = INT64_MAX},
    [PS_OPTION_KEPT_SETS] = {NAMED("kept-sets", 0, "BYTES"), OF(0, READERS | BIT(sample) | PAGES),
                             .help = "disk for sets that take long to make (default 4e9; 0: none)",
                             COUNT(limits.kept_bytes), .minimum = 0, .maximum = INT64_MAX},
    [PS_OPTION_CHECKPOINT] = {NAMED("checkpoint", 0, "FILE.npz"), OF(0, LONG),
                              .help = "keep the state of the job in FILE while it runs, and go on "
                                      "from there: same bits; of several questions FILE-2.npz, ..",
                              FILE_OUT(limits.checkpoint.path)},
    [PS_OPTION_CHECKPOINT_SECONDS] =
        {NAMED("checkpoint-interval", 0, "SECONDS"), OF(0, LONG),
         .help = "between two checkpoints (default: at most 1 % of the time); 0: each batch",
         COUNT(limits.checkpoint.interval), .minimum = 0, .maximum = MOST_SHIFTS},
    [PS_OPTION_PREFETCH] = {NAMED("prefetch", 0, NULL), OF(0, BIT(sample)), FLAG(prefetch),
                            .help = "make and keep sets that are not, write none"},
    [PS_OPTION_ALLOW_EXEC] = {NAMED("allow-exec", 0, NULL), OF(0, BIT(run)),
                              .help = "run programs that the scene names as samplers",
                              FLAG(reading.programs.may_run)},
    [PS_OPTION_RECORDED_ENGINES] = {NAMED("recorded-engines", 0, NULL), OF(0, BIT(run)),
                                    .help = "answer a record by the engines and precisions in it",
                                    FLAG(recorded_engines)},
    [PS_OPTION_NO_SKIP] = {NAMED("no-skip", 0, NULL), OF(READERS, BIT(run)),
                           .help = "do also what the question does not need",
                           FLAG(accuracy.no_skip)},
    [PS_OPTION_NO_SELF_CHECK] = {NAMED("no-self-check", 0, NULL),
                                 OF(SPECTRA | BIT(check) | BIT(variance) | BIT(measure), 0),
                                 .help = "do not recompute random entries with the referee",
                                 FLAG(accuracy.no_self_check)},
    [PS_OPTION_OUTPUT] = {NAMED("output", 'o', "FILE"),
                          OF(0, TABLES | BIT(sample) | BIT(run) | READS),
                          .help = "{run:write this folder, which is made (default: the name of the "
                                  "scene)}{:write there, in the format of its ending (default: "
                                  "standard output)}",
                          FILE_OUT(output)},
    [PS_OPTION_FORMAT] = {NAMED("format", 0, "FORMAT"), OF(0, TABLES | BIT(sample) | BIT(convert)),
                          .help = "format of the output (default: by the ending of FILE, else the "
                                  "first of these)",
                          WORD(format)},
    [PS_OPTION_PLOT] = {NAMED("plot", 0, "FILE"),
                        OF(0, PICTURES | BIT(bench) | BIT(sample) | BIT(convert)),
                        .help = "draw a picture too{light:, of powers where -l is given, else of "
                                "functions}{:}: .png, .svg or .pdf; one that fails is a warning, "
                                "and an error where nothing else is kept",
                        FILE_OUT(plot)},
    [PS_OPTION_PLOT_LOG] = {NAMED("plot-log", 0, "x|y|xy|none"), OF(0, PICTURES),
                            .help = "which axes of the picture are logarithmic",
                            .set = ps_set_plot_log},
    [PS_OPTION_PLOT_RANGE] = {NAMED("plot-range", 0, "X0..X1,Y0..Y1"), OF(0, PICTURES),
                              .help = "what the axes of the picture show; X0..X1 alone, or ,Y0..Y1",
                              .set = ps_set_plot_range},
    [PS_OPTION_PLOT_POINTS] = {NAMED("plot-points", 0, "yes|no"), OF(0, BIT(power) | BIT(angular)),
                               .help = "show the points of the first set, up to 16384, beside the "
                                       "spectrum of one sampler or of files (default yes)",
                               WORD(plot_points)},
    [PS_OPTION_PROFILE] = {NAMED("profile", 0, NULL), OF(0, READERS),
                           .help = "time, flop/s and bytes/s of every kernel on standard error",
                           FLAG(limits.profile)},
    [PS_OPTION_QUIET] = {NAMED("quiet", 0, NULL),
                         OF(0, READERS | SUITES | SETLESS | BIT(sample) | BIT(run) | READS),
                         .help = "no progress line, no remarks", FLAG(quiet)},
    [PS_OPTION_QUICK] = {NAMED("quick", 0, NULL), OF(0, SUITES),
                         .help = "leave out cases of more than a second or so", FLAG(quick)},
    [PS_OPTION_SCENES] = {NAMED("scenes", 0, NULL), OF(0, BIT(bench)),
                          .help = "time the scenes that are named instead, with and without skips, "
                                  "and compare the answers",
                          FLAG(scenes)},
    [PS_OPTION_VERBOSE] =
        {NAMED("verbose", 0, NULL), OF(0, READERS | SETLESS),
         .help = "{truncation,light:}{:say on standard error what is being done; }all lines "
                 "of the header, of which a terminal shows four",
         FLAG(verbose)},
    [PS_OPTION_HELP] = {NAMED("help", 'h', NULL), OF(0, 0), .help = "this text",
                        .set = ps_set_nothing},
};
