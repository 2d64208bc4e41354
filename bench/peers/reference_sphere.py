"""The exact coefficients of the first realization, and errors against them relative to white noise:
sqrt(sum over l >= 1 and m of |dc_lm|^2 / (coefficients N / (4 pi))), which is what pointspec's --tol bounds."""

import threading

import numpy as np

from loops_sphere import exact_order, num_coefficients
from runner import thread_choices

SMALLEST = [1e-14, 1e-13, 2.1e-13, 3e-13]  # eps of ducc0: what is offered depends on its version
MOST_PAIRS = 1e10  # of points and coefficients, of a reference that is summed directly: a minute or two
KEPT_PAIRS = 1e8  # from here on it is kept for the next run
CHECK_PAIRS = 3e7  # of sums that check another one
CHECK_ORDERS = 8
THREADS = 2


def exact_orders(points, degree, orders):
    """{m: coefficients}"""
    found = {}

    def work(which):
        for order in which:
            found[order] = exact_order(points, degree, order)

    threads = [threading.Thread(target=work, args=(orders[i::THREADS],)) for i in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


class SphereReference:
    """Sums in long double where that is a matter of a minute, kept in folder/references, else ducc0 in double
    precision at its smallest eps. self.error is the difference of the two, of large sets only for some high
    orders."""

    def __init__(self, points, peers, folder):
        self.case = points.case
        degree = self.case.degree
        lengths = degree + 1 - np.arange(degree + 1)
        self.starts = np.concatenate([[0], np.cumsum(lengths)])
        self.degrees = np.concatenate([np.arange(m, degree + 1) for m in range(degree + 1)])
        self.counts = np.repeat(np.where(np.arange(degree + 1) > 0, 2.0, 1.0), lengths)
        self.counts[0] = 0  # degree 0 is known
        self.pairs = self.case.points * num_coefficients(degree)
        self.is_exact = self.pairs <= MOST_PAIRS
        fast = self._fast(points, peers)
        if self.is_exact:
            self.modes = self._exact(points, folder / "references")
            self.error = self.error_of_modes(fast)
        else:
            self.modes = fast
            self.error = self._check(points)

    def note(self):
        if self.is_exact:
            return f"reference summed in long double; ducc0 at its smallest eps differs by {self.error:.0e}"
        return f"reference ducc0 at its smallest eps, wrong by {self.error:.0e}"

    def _at(self, order):
        return slice(self.starts[order], self.starts[order + 1])

    def _exact(self, points, folder):
        kept = folder / ("-".join(str(number) for number in self.case) + ".npy")
        if kept.exists():
            return np.load(kept)
        orders = exact_orders(points.rows[0], self.case.degree, range(self.case.degree + 1))
        modes = np.concatenate([orders[order] for order in sorted(orders)])
        if self.pairs >= KEPT_PAIRS:
            folder.mkdir(exist_ok=True)
            np.save(kept, modes)
        return modes

    def _check(self, points):
        """Against random orders among the highest, whose sums are short."""
        degree = self.case.degree
        affordable = int(max(2, CHECK_PAIRS // self.case.points))
        longest = int(min(degree, np.sqrt(2 * affordable)))
        num = max(1, min(CHECK_ORDERS, 2 * affordable // (longest + 1)))
        orders = np.random.default_rng(1).permutation(np.arange(degree - longest, degree + 1))[:num]
        exact = exact_orders(points.rows[0], degree, orders.tolist())
        at = np.concatenate([np.r_[self._at(order)] for order in exact])
        return self._error(self.modes[at] - np.concatenate(list(exact.values())), self.counts[at])

    def _fast(self, points, peers):
        ducc0 = next((peer for peer in peers if peer.name == "ducc0"), None)
        if ducc0 is None:
            raise RuntimeError("no ducc0 to compute a reference")
        plans, threads = thread_choices(points)[-1]
        for eps in SMALLEST:
            try:
                runner = ducc0.open(points, "double", eps, plans, threads)
                break
            except (RuntimeError, ValueError):
                if eps == SMALLEST[-1]:
                    raise
        modes = runner.modes(0).copy()
        runner.close()
        return modes

    def _relative(self, squares, coefficients):
        return float(np.sqrt(squares * 4 * np.pi / (coefficients * self.case.points)))

    def _error(self, differences, counts):
        return self._relative(np.sum(counts * np.abs(differences) ** 2), np.sum(counts))

    def error_of_modes(self, modes):
        return self._error(modes - self.modes, self.counts)

    def _norms(self, modes):
        """Of the 2l + 1 coefficients of the degrees 1 .. L."""
        return np.sqrt(np.bincount(self.degrees, self.counts * np.abs(modes) ** 2))[1:]
