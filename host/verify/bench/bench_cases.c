/* The cases of `pointspec bench`. Frequencies are what the program takes where nothing is said, or
 * what makes the case. */
#include "verify/bench/bench.h"

#define TORUS .kind = PS_STRESS_TORUS
#define SPHERE .kind = PS_STRESS_SPHERE
#define PAIRS .kind = PS_STRESS_PAIRS
#define QUICK .is_quick = true
#define BOX(d, k) .dimension = (d), .reach = (k)
#define LIST(d, num, k) .dimension = (d), .num_listed = (num), .reach = (k)
#define WHITE(num) .shape = "white", .num_points = (num)
#define CHECKED(num) .num_checked = (num)

/* clang-format off */
const ps_bench_case ps_bench_cases[] = {
    {{"plane-many", "", "256 points in the plane to K = 32, 1024 realizations",
      TORUS, QUICK, WHITE(256), BOX(2, 32), CHECKED(1000)}, 1024},
    {{"plane", "", "1024 points in the plane to K = 160, 64 realizations",
      TORUS, WHITE(1024), BOX(2, 160), CHECKED(500)}, 64},
    {{"plane-large", "", "65536 points in the plane to K = 256, 16 realizations",
      TORUS, WHITE(65536), BOX(2, 256), CHECKED(16)}, 16},
    {{"line", "", "16384 points on a line to K = 8192, 32 realizations",
      TORUS, WHITE(16384), BOX(1, 8192), CHECKED(64)}, 32},
    {{"space", "", "4096 points in space to K = 16, 64 realizations",
      TORUS, WHITE(4096), BOX(3, 16), CHECKED(250)}, 64},
    {{"list", "", "4096 points in space at 1000 frequencies up to 100000, 64 realizations",
      TORUS, WHITE(4096), LIST(3, 1000, 100000), CHECKED(250)}, 64},
    {{"sphere", "", "1024 points on the sphere to L = 128, 64 realizations",
      SPHERE, QUICK, WHITE(1024), .reach = 128, CHECKED(32)}, 64},
    {{"sphere-large", "", "16384 points on the sphere to L = 256, 8 realizations",
      SPHERE, WHITE(16384), .reach = 256, CHECKED(6)}, 8},
    {{"hemisphere", "", "1024 points on the hemisphere to L = 128, 64 realizations",
      SPHERE, WHITE(1024), .reach = 128, .is_hemisphere = true, CHECKED(32)}, 64},
    {{"pairs", "", "pair sums of 1024 points on the sphere to L = 128, 64 realizations",
      PAIRS, QUICK, WHITE(1024), .reach = 128, CHECKED(32)}, 64},
    {{"pairs-large", "", "pair sums of 4096 points on the sphere to L = 256, 8 realizations",
      PAIRS, WHITE(4096), .reach = 256, CHECKED(8)}, 8},
    {{0}, 0},
};
/* clang-format on */
