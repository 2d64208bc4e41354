/* The fine grid of the sphere in bands of longitudes, each with room behind it for windows that
 * begin in it. Band b has the longitudes ceil(b n / bands) .. ceil((b + 1) n / bands) - 1, no fewer
 * than a window is wide, or all are one band. In memory: [band][band_rows][pitch]. Device only.
 */
#ifndef PS_SPHERE_BANDS_H
#define PS_SPHERE_BANDS_H

/* Angles from the pole that points are sorted by, in cells. */
#define TILE_CELLS 64

static inline uint start_of_band(const uint band, const uint n, const uint bands) {
    return (uint)(((ulong)band * n + bands - 1) / bands);
}

#endif
