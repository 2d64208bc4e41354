"""The table for people on standard output, and the CSV file for plots. A peer that is missing has no column."""

import csv
import math

FIELDS = ["dimension", "points", "max_frequency", "realizations", "tolerance", "peer", "version", "setting",
          "realizations_used", "error", "claimed_error", "microseconds", "nufft_microseconds",
          "accumulate_microseconds", "fastest_round", "slowest_round"]
MICRO = 1e6


class Result:
    """What one peer did in one cell."""

    def __init__(self, contestant, version, setting, error, claimed_error=math.nan):
        self.name, self.count = contestant.name, contestant.count
        self.contestant, self.version, self.setting = contestant, version, setting
        self.error, self.claimed_error = error, claimed_error
        self.seconds = contestant.median

    def row(self, case, tolerance):
        seconds, accumulating = self.contestant.seconds, sorted(self.contestant.accumulating)
        adding = accumulating[len(accumulating) // 2]
        numbers = [self.error, self.claimed_error, MICRO * self.seconds, MICRO * (self.seconds - adding),
                   MICRO * adding, MICRO * min(seconds), MICRO * max(seconds)]
        numbers = ["" if math.isnan(number) else f"{number:.4g}" for number in numbers]
        return [*case, tolerance, self.name, self.version, self.setting, self.count, *numbers]


class CsvFile:
    def __init__(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        self.file = path.open("w", newline="")
        self.writer = csv.writer(self.file, lineterminator="\n")
        self.writer.writerow(FIELDS)

    def add(self, case, tolerance, results):
        self.writer.writerows(result.row(case, tolerance) for result in results)
        self.file.flush()


class Table:
    def __init__(self, names):
        self.names = names
        title = f"{'d N K R':<20} {'tol':>5}"
        units = " " * len(title)
        for name in names:
            title += f" | {name:>11} {'':7}"
            units += f" | {'us/R':>11} {'error':>7}"
        print(f"{title} | best peer, ratio    as asked\n{units} |", flush=True)

    def add(self, case, tolerance, results, best, ratio, loose_ratio):
        by_name = {result.name: result for result in results}
        line = f"{str(case):<20} {tolerance:>5.0e}"
        for name in self.names:
            result = by_name.get(name)
            if result is None:
                line += f" | {'-':>11} {'':7}"
            else:
                mark = "!" if result.error > tolerance else " "
                line += f" | {MICRO * result.seconds:>10.5g}{mark} {result.error:>7.0e}"
        line += f" | {best or '-':<8} {show(ratio):>9} {show(loose_ratio):>10}"
        print(line, flush=True)


def show(ratio):
    return "-" if ratio is None else f"{ratio:.3g}"
