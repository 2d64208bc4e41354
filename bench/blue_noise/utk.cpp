// BNOT (de Goes and others), dart throwing and fast Poisson disks (Dunbar and Humphreys) as UTK has
// them: bench/blue_noise/peers.sh.
#include "peers.h"

#include <cmath>
#include <vector>

#include <utk/samplers/SamplerDartThrowing.hpp>
#include <utk/samplers/SamplerFastPoisson.hpp>

#include <PeriodicBNOT/BNOT.hpp>

// UTK's own sampler begins with points of [0, 0.1)^2 and ends after 20 moves, wherever it is then; so
// its optimiser is called as that sampler does, with the limits of the program it comes from.
size_t peer_bnot(size_t num, double eps, uint64_t, double *points) {
    const unsigned most_newton_steps = 20;
    const unsigned most_moves = 10000;
    std::vector<PBNOT::Point> sites;
    for (size_t i = 0; i < num; i++) {
        sites.emplace_back(points[2 * i], points[2 * i + 1]);
    }
    const std::vector<PBNOT::FT> zeros(num, 0.0);
    PBNOT::Scene scene;
    scene.construct_triangulation(sites, zeros, zeros);
    scene.optimize_all(0.0, 0.0, most_newton_steps, eps, most_moves, std::cout, false);
    sites.clear();
    scene.collect_visible_points(sites);
    for (size_t i = 0; i < sites.size(); i++) {
        points[2 * i] = sites[i].x();
        points[2 * i + 1] = sites[i].y();
    }
    return sites.size();
}

static size_t copy(utk::Pointset<double> &made, double *points) {
    for (size_t i = 0; i < made.Npts(); i++) {
        points[2 * i] = made[i][0];
        points[2 * i + 1] = made[i][1];
    }
    return made.Npts();
}

size_t peer_darts(size_t num, double relative_radius, uint64_t set, double *points) {
    const double radius = relative_radius * std::sqrt(2 / std::sqrt(3.0)); // in units of N^(-1/2)
    const unsigned tries = 1000;
    const bool relaxed = false;
    const bool toroidal = true;
    utk::SamplerDartThrowing sampler(2, relaxed, toroidal, tries, 1, radius);
    utk::Pointset<double> made;
    sampler.setRandomSeed(set + 1);
    sampler.generateSamples(made, static_cast<uint32_t>(num));
    return copy(made, points);
}

size_t peer_fast_poisson(size_t num, double radius, uint64_t, double *points) {
    utk::SamplerFastPoisson sampler("Pure", radius); // half of 2 r in [-1,1]^2
    utk::Pointset<double> made;
    sampler.generateSamples(made, static_cast<uint32_t>(num));
    return copy(made, points);
}
