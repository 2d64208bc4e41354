/* Pi and its multiples, once. Doubling is exact, so that a multiple has the same bits as its own
 * literal. The _L are of long double. */
#ifndef PS_MATH_PI_H
#define PS_MATH_PI_H

#define PS_PI 3.14159265358979323846
#define PS_TWO_PI (2 * PS_PI)
#define PS_FOUR_PI (4 * PS_PI)

#define PS_PI_L 3.14159265358979323846264338327950288L
#define PS_TWO_PI_L (2 * PS_PI_L)
#define PS_FOUR_PI_L (4 * PS_PI_L)

#endif
