"""The table for people on standard output, and the CSV file for plots. A peer that is missing has no column."""

import csv
import math
from typing import NamedTuple

from timing import Contestant, ratio

FIELDS = ["dimension", "points", "max_frequency", "realizations", "tolerance", "peer", "version", "setting",
          "realizations_used", "error", "claimed_error", "microseconds", "nufft_microseconds",
          "accumulate_microseconds", "fastest_round", "slowest_round", "least_error"]
MICRO = 1e6
OURS, OTHER_ENGINE, PEER, LOOSE = "ours", "other engine", "peer", "loose"


class Entry(NamedTuple):
    """Who runs, and what is known before."""

    role: str  # OURS, OTHER_ENGINE, PEER or LOOSE
    contestant: Contestant
    version: str
    setting: str
    error: float  # nan: not measured
    least_error: float = math.nan  # what it is at least, where it is an estimate
    claimed_error: float = math.nan


class Result:
    """What one of them did in one cell."""

    def __init__(self, entry):
        self.role, self.contestant, self.version, self.setting = entry[:4]
        self.error, self.least_error, self.claimed_error = entry[4:]
        self.name, self.count = self.contestant.name, self.contestant.count
        self.seconds = self.contestant.median

    def row(self, case, tolerance):
        seconds, accumulating = self.contestant.seconds, sorted(self.contestant.accumulating)
        adding = accumulating[len(accumulating) // 2]
        numbers = [self.error, self.claimed_error, MICRO * self.seconds, MICRO * (self.seconds - adding),
                   MICRO * adding, MICRO * min(seconds), MICRO * max(seconds), self.least_error]
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


def ratios(results):
    """(name of the best peer that meets the tolerance, its time over ours, the same for the loose one)."""
    by_role = {role: [result for result in results if result.role == role] for role in (OURS, PEER, LOOSE)}
    best = min(by_role[PEER], key=lambda result: result.seconds, default=None)

    def over_ours(other):
        return ratio(other.contestant, by_role[OURS][0].contestant) if other and by_role[OURS] else None

    return best and best.name, over_ours(best), over_ours(next(iter(by_role[LOOSE]), None))


class Table:
    def __init__(self, heading, names, has_loose):
        self.names, self.has_loose = names, has_loose
        title = f"{heading:<20} {'tol':>5}"
        units = " " * len(title)
        for name in names:
            title += f" | {name:>13} {'':5}"
            units += f" | {'us/R':>11} {'error':>7}"
        last = " | best peer, ratio" + "    as asked" * has_loose + " | sets"
        print(f"{title}{last}\n{units} |", flush=True)

    def add(self, case, tolerance, results):
        by_name = {result.name: result for result in results}
        line = f"{str(case):<20} {tolerance:>5.0e}"
        for name in self.names:
            line += " | " + self._cell(by_name.get(name), tolerance)
        best, ratio, loose_ratio = ratios(results)
        counts = [by_name[name].count for name in ("pointspec", best) if name in by_name]
        line += f" | {best or '-':<8} {show(ratio):>9}" + f" {show(loose_ratio):>10}" * self.has_loose
        line += " | " + ", ".join(map(str, counts))
        print(line, flush=True)

    def _cell(self, result, tolerance):
        if result is None:
            return f"{'-':>11} {'':7}"
        mark = "!" if result.error > tolerance else " "
        error = "-" if math.isnan(result.error) else f"{result.error:.0e}"
        return f"{MICRO * result.seconds:>10.5g}{mark} {error:>7}"


def show(ratio):
    return "-" if ratio is None else f"{ratio:.3g}"
