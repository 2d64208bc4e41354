"""pointspec beside the libraries of others, on the torus, on the sphere and for pairs; bench_peers.sh calls this,
docs/developer/peers.md explains it."""

import argparse
import os
import sys
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")  # threads are asked for, not taken
os.environ.setdefault("DUCC0_NUM_THREADS", "2")  # what may be asked for, of ducc0 and of FINUFFT with its FFT

import loops
import yardstick
from cases import parse_case
from contest import Contest, has_loose, say
from domains import DOMAINS, domain_of
from pointspec import Pointspec
from report import CsvFile, Table
from tune import Tuner

SECONDS, QUICK_SECONDS = 2.0, 0.4
SKIP_SECONDS = 5.0
ENGINE_SECONDS = 0.5  # of a realization; engines that were not chosen are to cost little of a run


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev bench peers", description=__doc__)
    parser.add_argument("--domain", action="append", choices=list(DOMAINS),
                        help="torus, sphere or pairs, repeatable; default: those of the cases, else all")
    parser.add_argument("--case", action="append", type=parse_case, metavar="d,N,K[,R]|s,N,L[,R]|p,N,L[,R]",
                        help="one case, of the torus, the sphere or pairs on it, repeatable; default: all")
    parser.add_argument("--tol", action="append", type=float, metavar="T",
                        help="one tolerance, repeatable; default: torus 1e-3 1e-6 1e-9 1e-12, sphere 1e-5 1e-12, "
                             "pairs 1e-5 1e-10")
    parser.add_argument("--peers", default="finufft,ducc0,nfft,numpy", metavar="NAMES",
                        help="of finufft,ducc0,nfft,numpy, separated by commas")
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
    parser.add_argument("--output", type=Path, default=Path("bench-output"), metavar="FOLDER",
                        help="for peers.csv, peers_sphere.csv and peers_pairs.csv")
    parser.add_argument("--folder", type=Path, default=Path("build/peers"), help="what is installed")
    parser.add_argument("--build", type=Path, default=Path("build/dev"))
    parser.add_argument("--before", type=Path, metavar="FOLDER",
                        help="a release build of another version of pointspec, which runs in turn with this one")
    arguments = parser.parse_args()
    if arguments.budget is None:
        arguments.budget = QUICK_SECONDS if arguments.quick else SECONDS
    if arguments.domain is None:
        named = {domain_of(case) for case in arguments.case or []}
        arguments.domain = [name for name in DOMAINS if name in named or not named]
    arguments.folder = arguments.folder.resolve()
    return arguments


def open_peers(domain, arguments):
    peers = []
    for name in arguments.peers.split(","):
        if name not in domain.peers:
            continue
        try:
            peers.append(domain.peers[name](arguments.folder))
            print(f"# {peers[-1].name} {peers[-1].version}: {peers[-1].how}")
        except (ImportError, OSError) as error:
            print(f"# no {name}: {error}")
    return peers


def open_pointspec(domain, arguments):
    """(of this build or None, of the one before or None)"""
    if arguments.no_pointspec:
        return None, None
    pointspec = Pointspec(arguments.build.resolve(), domain.question)
    print(f"# pointspec {pointspec.version}")
    before = Pointspec(arguments.before.resolve(), domain.question) if arguments.before else None
    return pointspec, before


def column_names(domain, peers, pointspec, before):
    names = ["pointspec"] if pointspec is not None else []
    names += ["before"] if before is not None else []
    names += [domain.beside] if pointspec is not None else []
    for peer in peers:
        names += [peer.name] + ([peer.loose_name] if has_loose(peer) else [])
    return names + ["plain"] * (domain.plain is not None)


def run_domain(name, arguments):
    domain = DOMAINS[name]
    peers = open_peers(domain, arguments)
    pointspec, before = open_pointspec(domain, arguments)
    if not any(peer.name in ("finufft", "ducc0") for peer in peers):
        sys.exit("peers: neither finufft nor ducc0 is there to compute a reference")
    csv_file = CsvFile(arguments.output / domain.csv_name)
    table = Table(domain.heading, column_names(domain, peers, pointspec, before), any(map(has_loose, peers)))
    notes = []
    for case in [case for case in arguments.case or domain.cases if domain_of(case) == name]:
        points = domain.points(case)
        reference = domain.reference(points, peers, arguments.folder)
        notes.append(f"# {case}: {reference.note()}")
        tuners = [Tuner(peer, points, reference) for peer in peers]
        contest = Contest(domain, points, reference, tuners, pointspec, before, arguments)
        for tolerance in arguments.tol or domain.tolerances:
            results = contest.run(tolerance)
            csv_file.add(case, tolerance, results)
            table.add(case, tolerance, results)
    print("\n".join(notes))


def print_yardstick(when):
    milliseconds = yardstick.measure()
    if milliseconds is not None:
        print(f"# yardstick, FFTW 1280^2 complex single, 2 threads, {when}: {milliseconds:.2f} ms")


def main():
    arguments = parse_arguments()
    loops.load(arguments.folder)
    begin = time.monotonic()
    print_yardstick("begin")
    for name in arguments.domain:
        run_domain(name, arguments)
    print_yardstick("end")
    say(f"# {time.monotonic() - begin:.0f} s; every number is in {arguments.output}")


main()
