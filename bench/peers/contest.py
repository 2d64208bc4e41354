"""One cell of the table: who takes part in a case at a tolerance, and the race."""

import math
import sys

from report import LOOSE, OTHER_ENGINE, OURS, PEER, Entry, Result
from timing import Contestant, alternate

BATCH, BATCH_SECONDS = 64, 0.3  # pointspec computes sets together: so many, or as many as its plan says for this,
BATCH_ALL = 10  # but all of a case with so few
LOOSE_TOLERANCE = 1e-6  # single precision with eps as asked, whatever its error, is run down to here


def say(sentence):
    print(sentence, file=sys.stderr, flush=True)


def enter_peer(role, name, points, tuner, candidates):
    """An entry with the best of the candidates, or None."""
    best = tuner.best(candidates)
    if best is None:
        return None
    peer = tuner.peer
    precision, knob, accuracy, variant = best
    runner = peer.open(points, precision, knob, **accuracy, **variant)
    setting = f"{precision} {peer.knob}={knob:.2g} " + peer.describe({**accuracy, **variant})
    return Entry(role, Contestant(name, runner, points.count), peer.version, setting,
                 tuner.error(precision, knob, accuracy))


def enter_plain(create, points, reference):
    runner = create(points)
    error = reference.error_of_modes(runner.modes(0)) if runner.is_whole else math.nan
    setting = "double" if runner.is_whole else f"double extrapolated from {runner.num_points} points"
    return Entry(PEER, Contestant("plain", runner, points.count), "", setting, error)


class Contest:
    """Of a case: its points, reference, and what was found out about peers."""

    def __init__(self, domain, points, reference, tuners, pointspec, before, arguments):
        self.domain, self.points, self.reference = domain, points, reference
        self.tuners, self.pointspec, self.before, self.arguments = tuners, pointspec, before, arguments

    def run(self, tolerance):
        entries = [entry for entry in self._entries(tolerance) if entry is not None]
        alternate([entry.contestant for entry in entries], self.arguments.budget)
        for entry in entries:
            entry.contestant.runner.close()
        return [Result(entry) for entry in entries]

    def _entries(self, tolerance):
        if self.pointspec is not None:
            yield from self._ours(tolerance)
        for tuner in self.tuners:
            peer = tuner.peer
            entry = enter_peer(PEER, peer.name, self.points, tuner, tuner.candidates(tolerance))
            if entry is None:
                say(f"# {self.points.case} {tolerance:.0e}: no setting of {peer.name} has this error")
            yield entry
            if has_loose(peer) and tolerance >= LOOSE_TOLERANCE:
                yield enter_peer(LOOSE, peer.loose_name, self.points, tuner, tuner.nominal(tolerance))
        if self.domain.plain is not None:
            yield enter_plain(self.domain.plain, self.points, self.reference)

    def _ours(self, tolerance):
        """What the planner chooses, and the other engines under their own names."""
        arguments = self.arguments
        try:
            plan = self.pointspec.plan(self.points.case, tolerance, arguments.engine)
        except RuntimeError as error:
            say(f"# {self.points.case} {tolerance:.0e}: pointspec left out: {error}")
            return
        yield self._enter(tolerance, OURS, self.pointspec, "pointspec", arguments.engine,
                          plan.seconds[plan.chosen], arguments.skip_above)
        if self.before is not None:
            yield self._enter(tolerance, OTHER_ENGINE, self.before, "before", arguments.engine,
                              plan.seconds[plan.chosen], arguments.skip_above)
        if arguments.engines_above > 0:
            for engine, seconds in plan.seconds.items():
                if engine != plan.chosen:
                    yield self._enter(tolerance, OTHER_ENGINE, self.pointspec, engine, engine, seconds,
                                      arguments.engines_above)

    def _enter(self, tolerance, role, pointspec, name, engine, planned, longest):
        """engine: a name to force, or None for the choice of the planner. None, which is said, for one that
        would take too long."""
        case = self.points.case
        if planned > longest:
            say(f"# {case} {tolerance:.0e}: {name} left out: {planned:.2g} s for a realization, says its plan, "
                f"above {longest:g} s")
            return None
        try:
            runner = pointspec.open(self.points, tolerance, engine)
            errors, claimed = self._errors(runner)
        except RuntimeError as error:
            say(f"# {case} {tolerance:.0e}: {name} left out: {error}")
            return None
        all_sets = case.realizations if case.realizations <= BATCH_ALL else 1
        batch = max(all_sets, min(BATCH, int(BATCH_SECONDS / planned)))
        return Entry(role, Contestant(name, runner, self.points.count, batch), pointspec.version,
                     runner.text, *errors, claimed)

    def _errors(self, runner):
        """((error, what it is at least), what pointspec claims)"""
        magnitudes, claimed = runner.magnitudes(0)
        if self.pointspec.question.gives_modes:
            return (self.reference.error_of_modes(runner.modes(0)), math.nan), claimed
        return self.reference.errors_of_magnitudes(magnitudes), claimed


def has_loose(peer):
    """Whether it also runs in single precision with eps as asked, whatever its error."""
    return hasattr(peer, "loose_name")
