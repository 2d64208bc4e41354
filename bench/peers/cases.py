"""The problems: R realizations of N points in d dimensions, all frequencies |k_i| <= K."""

from typing import NamedTuple


class Case(NamedTuple):
    dimension: int
    points: int
    max_frequency: int
    realizations: int

    @property
    def width(self):
        return 2 * self.max_frequency + 1

    @property
    def num_modes(self):
        return self.width**self.dimension

    def __str__(self):
        points = f"{self.points:.0e}".replace("e+0", "e") if self.points >= 10**6 else self.points
        return f"{self.dimension} {points} {self.max_frequency} {self.realizations}"


CASES = [
    Case(2, 256, 32, 20000),
    Case(2, 1024, 128, 1000),
    Case(2, 4096, 64, 10000),
    Case(2, 4096, 256, 1000),
    Case(2, 16384, 512, 1000),
    Case(2, 10**7, 1024, 1),
    Case(1, 65536, 32768, 1000),
    Case(3, 4096, 32, 1000),
    Case(3, 10**6, 64, 4),
]

TOLERANCES = [1e-3, 1e-6, 1e-9, 1e-12]


def parse_case(text):
    """ "2,1024,128,1000"; without R, that of the list above, else 1000."""
    numbers = [int(float(word)) for word in text.split(",")]
    if len(numbers) == 3:
        known = [case.realizations for case in CASES if list(case[:3]) == numbers]
        numbers.append(known[0] if known else 1000)
    return Case(*numbers)
