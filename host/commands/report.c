/* pointspec report: one page about point sets, beside known ones (scene/run/report.c). */
#include "scene/run/run.h"

const ps_command ps_command_report = {
    .name = "report",
    .purpose =
        "one page about point sets: points, spectrum, measures, integrals, beside known sets",
    .usage = "report [options] --sampler NAME -o PAGE.html | report [options] FILE... -o PAGE.html",
    .description =
        "Writes one page of HTML, which needs nothing beside it, about sets of the plane or the "
        "sphere: the averaged periodogram as picture and radial mean with standard errors, its fit "
        "at low frequencies and what that says of convergence, anisotropy, pair correlation and "
        "number variance, distances, capacity and discrepancies, predicted and measured variances "
        "of integrals, of samplers against N, and the rank beside white, jittered, Poisson-disk "
        "and BNOT points, on the sphere white, z-phi, HEALPix-jittered and Fibonacci ones; and "
        "how all of it was computed. Several files are realizations. Answers are kept in the cache "
        "that scenes have. Prints what was asked and how long it took.",
    .takes = PS_COMMAND_BIT(report),
    .makes_folder = true,
    .samples = PS_DOMAIN_ANY,
    .examples = {"pointspec report --sampler jittered -n 64 -m 8 -o jittered.html",
                 "pointspec sample --sampler bnot -n 64 -m 8 -o mine.txt && pointspec report "
                 "mine.txt -o mine.html"},
    .counted = "realizations",
    .run = ps_run_report,
    .plan = ps_run_plan_report,
};
