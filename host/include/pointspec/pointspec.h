/** @file
 * pointspec: power spectra of sampling patterns, averaged over realizations, with standard errors.
 *
 * **Conventions.** Points lie on the torus [0,1)^d, d = 1..6; frequencies are integer vectors k, in
 * cycles per unit cell. With weights w_j (real, of either sign; all 1 when absent)
 *
 *     S(k) = sum_j w_j exp(-2 pi i k.x_j),   W = sum_j w_j,   V = sum_j w_j^2
 *     power, default normalization:    P(k) = N |S(k)|^2 / W^2     (unit weights: |S|^2 / N)
 *     power, effective normalization:  P(k) = |S(k)|^2 / V
 *     power, for integrals:            P(k) = mean(N) |S(k)|^2 / W^2
 *
 * The option "normalize" chooses. The last is what variances of integrals are made of, and differs
 * from the first where realizations have different N: the first counts each with its own N.
 *
 * Weights are not all 0, and |w_j| sum to at most 1e290. Sums over pairs and quadrature, whose
 * results have the units of weights, take sets whose largest |w_j| is between 1e-60 and 1e60.
 * Others are #PSPEC_ERROR_INPUT, as is W = 0, or within 2^-52 sum |w_j| of it, where W divides.
 *
 * White noise has mean power 1 at every k != 0. DC (k = 0) is never part of a radial mean. Ring b
 * holds the frequencies with b^2 - b + 1 <= |k|^2 <= b^2 + b.
 *
 * On the sphere points are unit vectors (lengths may be off by 1e-6; they are divided), and powers
 * are of degrees l = 1..L, means over the 2l + 1 orders of the orthonormal spherical harmonics Y_lm
 *
 *     Q(l) = 4 pi / (2l + 1) sum_m |sum_j w_j Y_lm(u_j)|^2 = sum_ij w_i w_j P_l(u_i.u_j)
 *     power, default normalization:    P(l) = N Q(l) / W^2
 *     power, effective normalization:  P(l) = Q(l) / V
 *
 * Sums over pairs are Q(l) itself, with weights 1/N where there are none, and their tolerance is of
 * Q(l), in units of (sum |w|)^2.
 *
 * White noise has mean power 1 at every l >= 1. On the hemisphere, which is the projective plane, a
 * point stands for its direction and the opposite one, and only even degrees are there.
 *
 * **Objects.** A context holds the device, the callbacks and the sentence of the last error. A
 * question is one of a kind of answer, as "power" or "variance": options by the names that the
 * program has for them, and patterns, of samplers, files or the caller. An answer is named fields.
 *
 *     pspec_context_create -> pspec_question_create -> _set, _add ... -> pspec_question_answer
 *
 * **Ownership.** Every create has a destroy, which accepts NULL, and so have answers. Destroy
 * questions before their context; an answer needs neither once it exists. What an object points to
 * belongs to the object. Arguments are only borrowed for the call, but for functions, which are
 * kept with what they are called with.
 *
 * **Threads.** One context, and the questions made from it, may be used by one thread at a time.
 * Different contexts are independent, the first use of a device included: several threads, each
 * with a context of its own, may ask at once. An answer may be read by any number of threads. GSL
 * has one error handler for the process: while a call of this library is inside GSL the handler is
 * off for everybody, and afterwards it is the one that was there.
 *
 * **Errors.** Whatever can fail returns a #pspec_status; the sentence that goes with it (what,
 * where, which value, which limit) is pspec_context_message(). Objects arrive through the first
 * argument, which is set to NULL on failure. The library never prints, exits or aborts, has no
 * global state, and leaves the error handler of GSL, which it uses, alone.
 */
#ifndef POINTSPEC_POINTSPEC_H
#define POINTSPEC_POINTSPEC_H

#include "pointspec/answer.h"
#include "pointspec/common.h"
#include "pointspec/context.h"
#include "pointspec/question.h"

#endif
