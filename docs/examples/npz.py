"""Reads what `pointspec power -o answer.npz` wrote: columns of the table by their names, and the header.

    pointspec power --sampler jittered -n 1024 -m 100 -o answer.npz && python3 npz.py answer.npz
"""
import json
import sys

import numpy as np

answer = np.load(sys.argv[1])
header = json.loads(str(answer["meta"]))
print(header["meta"]["command"], "has", ", ".join(answer.files))
if "power" in answer:
    largest = np.argmax(answer["power"])
    print("largest power", answer["power"][largest], "+-", answer["standard_error"][largest], "in row", largest)
