"""Runs of contestants in turn, A B C A B C ..., so that all of them see the same neighbours."""

import statistics

ROUNDS = 3
LONG_SECONDS = 2.5  # one run of this is all


class Contestant:
    def __init__(self, name, runner, num_available, batch=1):
        """batch: realizations that it takes to show its speed."""
        self.name, self.runner = name, runner
        self.num_available = num_available
        self.least = min(max(batch, len(getattr(runner, "plans", [None]))), num_available)
        self.seconds, self.accumulating = [], []  # of a realization, by round
        self.count = 0

    def settle(self, seconds_a_round):
        """How many realizations a round takes. The first run, which builds kernels, counts for nothing."""
        count = self.least
        self.runner.run(count)
        fastest = float("inf")
        while True:
            seconds = self.runner.run(count)[0]
            fastest = min(fastest, seconds / count)
            if seconds > seconds_a_round / 4 or count == self.num_available:
                break
            count = min(self.num_available, 4 * count)
        self.too_long = seconds > LONG_SECONDS
        if self.too_long:
            self.seconds, self.accumulating, self.count = [seconds / count], [float("nan")], count
        else:
            self.count = max(self.least, min(self.num_available, int(seconds_a_round / fastest)))

    def round(self):
        if not self.too_long:
            seconds, accumulating = self.runner.run(self.count)
            self.seconds.append(seconds / self.count)
            self.accumulating.append(accumulating / self.count)

    @property
    def median(self):
        return statistics.median(self.seconds)


def alternate(contestants, budget):
    for contestant in contestants:
        contestant.settle(budget / ROUNDS)
    for _ in range(ROUNDS):
        for contestant in contestants:
            contestant.round()


def ratio(other, ours):
    """Median of the ratios of the rounds."""
    if len(ours.seconds) != len(other.seconds):
        return other.median / ours.median
    return statistics.median(a / b for a, b in zip(other.seconds, ours.seconds))
