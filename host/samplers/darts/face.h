/* The twelve faces of HEALPix as squares [0,1]^2 of equal area (samplers/sphere/healpix_pixels.c
 * has the formulas), by + - * / and sqrt alone: the same bits on every machine.
 */
#ifndef PS_SAMPLERS_DARTS_FACE_H
#define PS_SAMPLERS_DARTS_FACE_H

enum { PS_NUM_FACES = 12 };

/* No point of a square of side h in a face is farther, as an angle, from the middle of the square
 * than PS_FACE_REACH h: 1.0686 for small squares at the corners of faces between cap and belt, less
 * for large ones (tests/samplers/darts/test_sphere_disk.c looks at all). */
#define PS_FACE_REACH 1.07

/* The unit vector at (x, y) of a face. */
void ps_face_point(unsigned face, double x, double y, double *vector);

/* Twice the sine of half an angle between 0 and pi: the length of its chord. */
double ps_chord(double angle);

#endif
