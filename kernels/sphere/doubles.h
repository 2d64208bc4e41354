/* LANES doubles, whatever the precision of sums. Device only. */
#ifndef PS_SPHERE_DOUBLES_H
#define PS_SPHERE_DOUBLES_H

#include "shared/real.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

typedef PS_VECTOR(double) doublev;
typedef PS_VECTOR(int) intv;
typedef PS_VECTOR(long) longv;
typedef doublev unaligned_doublev __attribute__((aligned(sizeof(double))));
typedef intv unaligned_intv __attribute__((aligned(sizeof(int))));
#define TO_DOUBLEV(x) PS_JOIN(convert_, PS_VECTOR(double))(x)
#define TO_LONGV(x) PS_JOIN(convert_, PS_VECTOR(long))(x)
#define TO_INTV(x) PS_JOIN(convert_, PS_VECTOR(int))(x)

#endif
