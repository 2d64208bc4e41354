"""pointspec beside the libraries of others; bench_peers.sh calls this, docs/peers.md explains it."""

import argparse
import os
import sys
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")  # threads are asked for, not taken

import loops
import yardstick
from cases import CASES, TOLERANCES, parse_case
from peer_ducc0 import Ducc0
from peer_finufft import Finufft
from peer_nfft import Nfft
from points import Points
from pointspec import ENGINES, Pointspec
from reference import Reference
from report import MICRO, CsvFile, Result, Table
from timing import Contestant, alternate, ratio
from tune import Tuner

PEERS = {"finufft": Finufft, "ducc0": Ducc0, "nfft": Nfft}
BESIDE = "torus_direct"  # the engine that has a column of its own; all are in the CSV file and the picture
LOOSE = "finufft fp32"  # single precision with eps as asked, whatever its error
LOOSE_TOLERANCE = 1e-6  # single precision is asked for down to here
SECONDS, QUICK_SECONDS = 2.0, 0.4
SKIP_SECONDS = 5.0
ENGINE_SECONDS = 0.5  # of a realization; engines that were not chosen are to cost little of a run


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev bench peers", description=__doc__)
    parser.add_argument("--case", action="append", type=parse_case, metavar="d,N,K[,R]",
                        help="one case, repeatable; default: all nine")
    parser.add_argument("--tol", action="append", type=float, metavar="T",
                        help="one tolerance, repeatable; default: 1e-3 1e-6 1e-9 1e-12")
    parser.add_argument("--peers", default="finufft,ducc0,nfft", metavar="NAMES",
                        help="of finufft,ducc0,nfft, separated by commas")
    parser.add_argument("--no-pointspec", action="store_true", help="only the peers")
    parser.add_argument("--engine", help="force this engine of pointspec")
    parser.add_argument("--budget", type=float, metavar="SECONDS",
                        help=f"for each peer, case and tolerance; default {SECONDS:g}")
    parser.add_argument("--quick", action="store_true", help=f"a budget of {QUICK_SECONDS:g}")
    parser.add_argument("--skip-above", type=float, default=SKIP_SECONDS, metavar="SECONDS",
                        help="leave pointspec out when its plan says that a realization takes longer")
    parser.add_argument("--engines-above", type=float, default=ENGINE_SECONDS, metavar="SECONDS",
                        help="leave an engine that was not chosen out when its plan says that a realization "
                             f"takes longer; default {ENGINE_SECONDS:g}, 0: only the chosen one")
    parser.add_argument("--output", type=Path, default=Path("bench-output/peers.csv"))
    parser.add_argument("--folder", type=Path, default=Path("build/peers"), help="what is installed")
    parser.add_argument("--build", type=Path, default=Path("build/release"))
    arguments = parser.parse_args()
    if arguments.budget is None:
        arguments.budget = QUICK_SECONDS if arguments.quick else SECONDS
    return arguments


def say(sentence):
    print(sentence, file=sys.stderr, flush=True)


def open_peers(arguments):
    peers = []
    for name in arguments.peers.split(","):
        try:
            peers.append(PEERS[name](arguments.folder.resolve()))
            print(f"# {peers[-1].name} {peers[-1].version}: {peers[-1].how}")
        except (ImportError, OSError) as error:
            print(f"# no {name}: {error}")
    return peers


def enter_peer(name, peer, points, tuner, candidates):
    """A contestant and what to say of it, or None."""
    best = tuner.best(candidates)
    if best is None:
        return None
    precision, knob, accuracy, variant = best
    runner = peer.open(points, precision, knob, **accuracy, **variant)
    setting = f"{precision} {peer.knob}={knob:.2g} " + peer.describe({**accuracy, **variant})
    error = tuner.error(precision, knob, accuracy)
    return Contestant(name, runner, points.count), peer.version, setting, error


def enter_pointspec(pointspec, points, reference, tolerance, name, engine, longest):
    """engine: a name to force, or None for the choice of the planner. A contestant, or None: which is said."""
    case = points.case
    try:
        planned = pointspec.plan(case, tolerance, engine).seconds
        if planned > longest:
            say(f"# {case} {tolerance:.0e}: {name} left out: {planned:.2g} s for a realization, says its plan, "
                f"above {longest:g} s")
            return None
        runner = pointspec.open(points, tolerance, engine)
        magnitudes, claimed = runner.magnitudes(0)
    except RuntimeError as error:
        say(f"# {case} {tolerance:.0e}: {name} left out: {error}")
        return None
    error = reference.error_of_magnitudes(magnitudes)
    return Contestant(name, runner, points.count), pointspec.version, runner.text, error, claimed


def enter_ours(pointspec, points, reference, tolerance, arguments):
    """What the planner chooses, and the other engines under their own names."""
    entries = [enter_pointspec(pointspec, points, reference, tolerance, "pointspec", arguments.engine,
                               arguments.skip_above)]
    if arguments.engine or arguments.engines_above <= 0:
        return entries
    chosen = pointspec.plan(points.case, tolerance, None).engine
    return entries + [enter_pointspec(pointspec, points, reference, tolerance, engine, engine,
                                      arguments.engines_above)
                      for engine in ENGINES if engine != chosen]


def compare(case, tolerance, points, reference, tuners, pointspec, arguments):
    entries = []
    if pointspec is not None:
        entries += enter_ours(pointspec, points, reference, tolerance, arguments)
    for tuner in tuners:
        peer = tuner.peer
        entries.append(enter_peer(peer.name, peer, points, tuner, tuner.candidates(tolerance)))
        if entries[-1] is None:
            say(f"# {case} {tolerance:.0e}: no setting of {peer.name} has this error")
        if peer.name == "finufft" and tolerance >= LOOSE_TOLERANCE:
            entries.append(enter_peer(LOOSE, peer, points, tuner, tuner.nominal(tolerance)))
    entries = [entry for entry in entries if entry is not None]
    alternate([entry[0] for entry in entries], arguments.budget)
    results = [Result(*entry) for entry in entries]
    for entry in entries:
        entry[0].runner.close()
    return results


def ratios(results):
    """(name of the best peer that meets the tolerance, its time over ours, the same for LOOSE)."""
    ours = [result for result in results if result.name == "pointspec"]
    peers = [result for result in results if result.name not in ("pointspec", *ENGINES, LOOSE)]
    loose = [result for result in results if result.name == LOOSE]
    best = min(peers, key=lambda result: result.seconds, default=None)
    name = best.name if best else None
    if not ours:
        return name, None, None
    return (name, ratio(best.contestant, ours[0].contestant) if best else None,
            ratio(loose[0].contestant, ours[0].contestant) if loose else None)


def print_yardstick(when):
    milliseconds = yardstick.measure()
    if milliseconds is not None:
        print(f"# yardstick, FFTW 1280^2 complex single, 2 threads, {when}: {milliseconds:.2f} ms")


def main():
    arguments = parse_arguments()
    loops.load(arguments.folder.resolve())
    print_yardstick("begin")
    peers = open_peers(arguments)
    pointspec = None
    if not arguments.no_pointspec:
        pointspec = Pointspec(arguments.build.resolve())
        print(f"# pointspec {pointspec.version}")
    if not any(peer.name in ("finufft", "ducc0") for peer in peers):
        sys.exit("peers: neither finufft nor ducc0 is there to compute a reference")
    csv_file = CsvFile(arguments.output)
    names = ["pointspec", BESIDE] if pointspec is not None else []
    for peer in peers:
        names += [peer.name] + [LOOSE] * (peer.name == "finufft")
    table = Table(names)
    begin = time.monotonic()
    notes = []
    for case in arguments.case or CASES:
        points = Points(case)
        reference = Reference(points, peers)
        pairs = case.points * (case.num_modes // 2)
        notes.append(f"# {case}: reference wrong by {reference.error:.0e}; direct sum, two threads, "
                     f"extrapolated: {MICRO * reference.seconds_per_pair * pairs / 2:.3g} us/R")
        tuners = [Tuner(peer, points, reference) for peer in peers]
        for tolerance in arguments.tol or TOLERANCES:
            results = compare(case, tolerance, points, reference, tuners, pointspec, arguments)
            csv_file.add(case, tolerance, results)
            table.add(case, tolerance, results, *ratios(results))
    print("\n".join(notes))
    print_yardstick("end")
    say(f"# {time.monotonic() - begin:.0f} s; every number is in {arguments.output}")


main()
