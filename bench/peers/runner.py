"""Realizations through the plans of a peer: two plans of one thread each, or one of two threads."""

import threading
import time


class Runner:
    """A peer with its setting. Plans have run(first, count) -> seconds of accumulating, modes(r) -> the complex
    modes of realization r in C order, and close()."""

    def __init__(self, plans):
        self.plans = plans

    def modes(self, realization):
        return self.plans[0].modes(realization)

    def run(self, count):
        """(seconds, seconds of them for |F|^2) for the realizations 0 .. count - 1."""
        if len(self.plans) == 1:
            begin = time.perf_counter()
            accumulating = self.plans[0].run(0, count)
            return time.perf_counter() - begin, accumulating
        bounds = [count * i // len(self.plans) for i in range(len(self.plans) + 1)]
        results = [None] * len(self.plans)

        def work(i):
            try:
                results[i] = self.plans[i].run(bounds[i], bounds[i + 1] - bounds[i])
            except Exception as error:  # told by the thread that waits
                results[i] = error

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(self.plans))]
        begin = time.perf_counter()
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        seconds = time.perf_counter() - begin
        for result in results:
            if isinstance(result, Exception):
                raise result
        return seconds, sum(results) / len(results)

    def close(self):
        for plan in self.plans:
            plan.close()
        self.plans = []


SHARED_MODES = 1 << 18  # below, two threads in one plan were 3 to 100 times slower than two plans


def thread_choices(points, shared_modes=SHARED_MODES):
    """[(plans, threads of each)]; two plans have nothing to share with one realization."""
    if points.count == 1:
        return [(1, 2)]
    return [(2, 1), (1, 2)] if points.case.num_modes >= shared_modes else [(2, 1)]
