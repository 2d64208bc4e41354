"""The fastest setting of a peer whose measured error meets the tolerance: for each precision and oversampling
the loosest accuracy parameter that does, then every variant (FFT, planner, threads) against the clock."""

import time

FIRST_SECONDS = 0.03  # of a trial; the best of TRIALS counts
TRIALS = 3
LONG_SECONDS = 0.5  # one trial is enough
HOPELESS = 5  # times slower than the best so far, cold: likewise
CLOSE = 1.5
SLOW_SECONDS = 2.5  # for a realization: such a peer is measured at one setting that is accurate enough
MOST_STEPS = 7  # tighter than the first guess, before a tolerance counts as out of reach


class Tuner:
    def __init__(self, peer, points, reference):
        self.peer, self.points, self.reference = peer, points, reference
        self.errors = {}
        self.is_slow = False

    def error(self, precision, knob, accuracy):
        key = (precision, knob, *accuracy.values())
        if key not in self.errors:
            variant = self.peer.variants(self.points, precision)[0]
            try:
                runner = self.peer.open(self.points, precision, knob, **accuracy, **variant)
                begin = time.perf_counter()
                self.errors[key] = self.reference.error_of_modes(runner.modes(0))
                self.is_slow = self.is_slow or time.perf_counter() - begin > SLOW_SECONDS
                runner.close()
            except (RuntimeError, MemoryError, ValueError):
                self.errors[key] = float("inf")  # this accuracy is not offered
        return self.errors[key]

    def accuracies(self, precision):
        accuracies = self.peer.accuracies(self.points, precision)
        return accuracies[-1:] if self.is_slow else accuracies

    def variants(self, precision):
        variants = self.peer.variants(self.points, precision)
        return variants[:1] if self.is_slow else variants

    def loosest(self, precision, accuracy, tolerance):
        """The loosest knob that meets the tolerance, or None. Errors fall along the ladder, up to a floor."""
        ladder = self.peer.ladder(precision)

        def meets(i):
            return self.error(precision, ladder[i], accuracy) <= tolerance

        at = min(self.peer.guess(precision, tolerance), len(ladder) - 1)
        if meets(at):
            while at > 0 and not self.is_slow and meets(at - 1):
                at -= 1
            return ladder[at]
        for i in range(at + 1, min(at + MOST_STEPS, len(ladder))):
            if meets(i):
                return ladder[i]
        return None

    def candidates(self, tolerance):
        """In the cheapest precision that meets it."""
        for precision in self.peer.precisions:
            found = []
            for accuracy in self.accuracies(precision):
                knob = self.loosest(precision, accuracy, tolerance)
                if knob is not None:
                    found.append((precision, knob, accuracy))
            if found:
                return found
        return []

    def nominal(self, tolerance):
        """Single precision with eps as asked, met or not."""
        return [("single", tolerance, accuracy)
                for accuracy in self.accuracies("single")
                if self.error("single", tolerance, accuracy) < float("inf")]

    def trial(self, candidate, variant, best):
        """Seconds of a realization; best are those of the best so far."""
        precision, knob, accuracy = candidate
        runner = self.peer.open(self.points, precision, knob, **accuracy, **variant)
        try:
            count = min(len(runner.plans), self.points.count)
            seconds = runner.run(count)[0] / count
            if seconds * count > LONG_SECONDS or seconds > HOPELESS * best:
                return seconds
            count = max(count, min(self.points.count, int(FIRST_SECONDS / seconds)))
            return min(runner.run(count)[0] for _ in range(TRIALS)) / count
        finally:
            runner.close()

    def best(self, candidates):
        """(precision, knob, accuracy, variant) or None. Those that come close to the fastest are tried twice."""
        tried = [(*candidate, variant) for candidate in candidates for variant in self.variants(candidate[0])]
        if self.is_slow or len(tried) < 2:
            return tried[0] if tried else None
        seconds = {}
        for i, setting in enumerate(tried):
            self._try(i, setting, seconds)
        for i in [i for i in seconds if seconds[i] < CLOSE * min(seconds.values())]:
            self._try(i, tried[i], seconds)
        return tried[min(seconds, key=seconds.get)] if seconds else None

    def _try(self, i, setting, seconds):
        fastest = min(seconds.values(), default=float("inf"))
        try:
            trial = self.trial(setting[:3], setting[3], fastest)
            seconds[i] = min(trial, seconds.get(i, float("inf")))
        except (RuntimeError, MemoryError):
            pass  # this variant is not offered
