/* The torus has at most so many dimensions. */
#ifndef PS_MATH_DIMENSION_H
#define PS_MATH_DIMENSION_H

enum { PS_MAX_DIMENSION = 6 };

#endif
