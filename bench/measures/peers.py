"""The table of bench_measures.sh: what each program takes for the measures that both have, and how far they are apart."""

import csv
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import freud
import numpy as np

REPEATS = 3
REACH = 5.0463  # of our bins: 80 white points about each, in units of N^(-1/2)
BINS = 200
MOST_PSA_POINTS = 10_000  # it takes N^2: seven minutes at 1e5
SETS = {1_000: 100, 10_000: 10, 100_000: 1, 1_000_000: 1}  # so that starting a program is not what is timed


def seconds_of(work):
    """The least of a few, and what the last one returned."""
    least = float("inf")
    for _ in range(REPEATS):
        begin = time.perf_counter()
        result = work()
        least = min(least, time.perf_counter() - begin)
    return least, result


def by_pointspec(program, paths, names):
    out = paths[0].with_suffix(".npz")
    command = [program, "measure", *paths, "--measures", names, "--quiet"]

    def work():
        subprocess.run([*command, "-o", out], check=True)
        return np.load(out)

    seconds, arrays = seconds_of(work)
    table = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    rows = csv.DictReader(line for line in table.splitlines() if not line.startswith("#"))
    return seconds, {row["measure"]: float(row["value"]) for row in rows}, arrays["pair_correlation"][:, 1]


def by_psa(psa, paths):
    def work():
        command = [psa, *paths, "--avg", "--stats"]
        return subprocess.run(command, check=True, capture_output=True, text=True, cwd=paths[0].parent).stdout

    seconds, out = seconds_of(work)
    return seconds, [float(word) for word in out.splitlines()[-1].split()[1:]]


def by_freud(sets):
    """In this process: neither loading it nor reading files is counted."""
    box = freud.box.Box.square(1)
    all_places = [np.c_[points - 0.5, np.zeros(len(points))].astype(np.float32) for points in sets]

    def work():
        rdf = freud.density.RDF(BINS, REACH / np.sqrt(len(sets[0])))
        distances = []
        for places in all_places:
            rdf.compute((box, places), reset=False)
            near = freud.locality.AABBQuery(box, places).query(places, {"num_neighbors": 1, "exclude_ii": True})
            distances.append(near.toNeighborList().distances.mean())
        return rdf.rdf, np.mean(distances)

    return seconds_of(work)


def main():
    program, psa = sys.argv[1:]
    print("# seconds of all sets: of distances, effective Nyquist frequency and oscillation, as psa has them; of distances")
    print("# and g(r), as freud has them, without loading it; apart: largest difference of relative distances, and of g")
    columns = ("points", "sets", "spectra", "psa", "ratio", "apart", "near", "freud", "ratio", "apart")
    print(" ".join(f"{name:>8}" for name in columns))
    with tempfile.TemporaryDirectory() as folder:
        for num, num_sets in SETS.items():
            sets = [np.random.default_rng([num, number]).random((num, 2)) for number in range(num_sets)]
            paths = [Path(folder) / f"white{num}-{number}.txt" for number in range(num_sets)]
            for path, points in zip(paths, sets):
                np.savetxt(path, points, header=str(num), comments="", fmt="%.17g")
            cells = [f"{num}", f"{num_sets}"]
            names = "least_distance,mean_distance"
            every, values, _ = by_pointspec(program, paths, names + ",effective_nyquist,oscillation")
            if num <= MOST_PSA_POINTS:
                seconds, (least, mean, *_rest) = by_psa(psa, paths)
                apart = max(abs(least - values["least_distance"]), abs(mean - values["mean_distance"]))
                cells += [f"{every:.3f}", f"{seconds:.3f}", f"{seconds / every:.1f}", f"{apart:.0e}"]
            else:
                cells += [f"{every:.3f}", "-", "-", "-"]
            near, values, curve = by_pointspec(program, paths, names)
            seconds, (rdf, distance) = by_freud(sets)
            apart = max(
                np.abs(rdf * (num / (num - 1)) - curve).max(),
                abs(distance / np.sqrt(2 / (np.sqrt(3) * num)) - values["mean_distance"]),
            )
            cells += [f"{near:.3f}", f"{seconds:.3f}", f"{seconds / near:.1f}", f"{apart:.0e}"]
            print(" ".join(f"{cell:>8}" for cell in cells), flush=True)


main()
