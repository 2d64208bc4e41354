#!/usr/bin/env bash
# cli_npz.sh PROGRAM SOURCE_DIR: answers as NPZ have the numbers of CSV; NumPy, where there is one, opens every array.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" npz "$1"
source_dir=$(realpath "$2")

# Numbers, words, infinities, numbers that are missing, verdicts, plans, rows that are measured one after the other.
host=(--engine host_direct --quiet)
"$program" power "${host[@]}" --sampler white -n 16 -m 3 -k 2 -o saved.npz
lines=('power --sampler white --sampler jittered -n 16,32 -m 3 -k 2' 'power --sampler white -n 16 -m 1 -k 2'
    'angular --sampler fibonacci -n 16 -l 3' 'variance --sampler jittered -n 16 -m 3 -k 2 --integrand disk'
    'quadrature --sampler fibonacci-hemisphere -n 8 -l 2 --brdf diffuse' 'plan power --sampler white -n 16'
    'check --against saved.npz --sampler white -m 3')
for i in "${!lines[@]}"; do
    read -ra words <<<"${lines[i]}"
    "$program" "${words[@]}" "${host[@]}" --format npz >"$i.npz" 2>err || complain "${words[*]}: $(<err)"
    "$program" "${words[@]}" "${host[@]}" --format npz >again.npz
    cmp -s "$i.npz" again.npz || complain "${words[*]}: the same answer has other bytes"
    "$program" "${words[@]}" "${host[@]}" >"$i.csv"
done
for name in x.npz x.NPZ; do
    "$program" power "${host[@]}" --sampler white -n 16 -m 2 -k 2 -o $name || complain "-o $name"
    [[ $(head -c 4 $name) == $'PK\3\4' ]] || complain "$name is no archive"
done
"$program" power "${host[@]}" --sampler white -n 16 -m 2 -k 2 -o full.npz --format csv
[[ $(head -c 1 full.npz) == '#' ]] || complain "--format csv does not count"

# arrays that options ask for are fields, too
arrays=(--sampler white -n 16 -m 2 -k 2)
"$program" power "${host[@]}" "${arrays[@]}" --full f.npy --coefficients c.npy -o arrays.npz || complain "arrays"

# a table is no set of points
"$program" power x.npz -k 2 >out 2>err && complain "a table was taken for points"
[[ $(<err) == *'x.npz'*points* && $(wc -l <err) == 1 ]] || complain "a table as points: $(<err)"

# what the cache keeps: answers, a picture, sets
export POINTSPEC_CACHE_DIR=$PWD/cache
printf 'scene: 1\nresults:\n  - {result: power, sampler: bnot, points: 512, realizations: 2}\n' >kept.yaml
"$program" run kept.yaml -o page >out 2>err || complain "run: $(<err)"
[[ -n $(find cache/results -name '*.result') && -n $(find cache/sets -name '*.result') ]] || complain "nothing is kept: $(find cache)"
# and figures of the device
"$program" bench --calibrate --case list --quick -o /dev/null 2>err || complain "bench: $(<err)"
[[ -n $(find cache/devices -name '*.result') ]] || complain "no figures are kept: $(find cache)"

python=$(numpy_python)
if [[ -z $python ]]; then
    echo "cli_npz: no numpy: it does not read the archives"
    finish
fi
"$python" - "${#lines[@]}" <<'PYTHON' 2>err || complain "$(<err)"
import csv, glob, json, sys
import numpy as np
for i in range(int(sys.argv[1])):
    archive = np.load(f"{i}.npz", allow_pickle=False)
    with open(f"{i}.csv") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    assert json.loads(str(archive["meta"]))["columns"] == rows[0] == archive.files[3 : 3 + len(rows[0])]
    assert all(name.startswith("state_") for name in archive.files[3 + len(rows[0]) : -1])
    assert archive.files[:3] + archive.files[-1:] == ["meta", "fields", "cell_kinds", "file_digest"]
    for column, name in enumerate(rows[0]):
        array = archive[name]
        texts = [row[column] for row in rows[1:]]
        assert array.shape == (len(texts),)
        if array.dtype.kind == "U":
            assert list(array) == texts, name
        elif array.dtype.kind == "i":
            assert array.dtype == np.int64 and [str(value) for value in array] == texts, name
        else:
            assert array.dtype == np.float64
            numbers = np.array([float(text or "nan") for text in texts])
            assert np.array_equal(array, numbers, equal_nan=True), name
for path in glob.glob("cache/*/*"):
    kept = np.load(path, allow_pickle=False)
    assert {"cache_key", "file_digest"} < {name for name in kept.files if kept[name].size > 0}, path
arrays = np.load("arrays.npz", allow_pickle=False)
for name, path in ("full", "f"), ("full_standard_error", "f.standard_error"), ("coefficients", "c"):
    assert np.array_equal(arrays[name], np.load(path + ".npy"), equal_nan=True), name
PYTHON
"$python" "$source_dir/docs/examples/npz.py" 0.npz >out 2>err || complain "npz.py: $(<err)"
grep -q '^largest power' out || complain "npz.py prints $(<out)"
finish
