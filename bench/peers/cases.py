"""The problems: R realizations of N points in d dimensions, all frequencies |k_i| <= K; and of N points of
the sphere, all degrees up to L, their powers or their sums over pairs. What takes long for a set stands there
twice: one set, and R of them in one call."""

from typing import NamedTuple


def short(number):
    return f"{number:.0e}".replace("e+0", "e") if number >= 10**6 else str(number)


class TorusCase(NamedTuple):
    dimension: int
    points: int
    max_frequency: int
    realizations: int

    @property
    def numbers(self):
        return list(self)

    @property
    def width(self):
        return 2 * self.max_frequency + 1

    @property
    def num_modes(self):
        return self.width**self.dimension

    def __str__(self):
        return f"{self.dimension} {short(self.points)} {self.max_frequency} {self.realizations}"


class SphereCase(NamedTuple):
    domain: str  # "s", of pairs "p", where the others have their dimension
    points: int
    degree: int
    realizations: int

    @property
    def dimension(self):
        """Of the unit vectors."""
        return 3

    @property
    def numbers(self):
        return list(self[1:])

    @property
    def num_modes(self):
        return (self.degree + 1) ** 2

    def __str__(self):
        return f"{self.domain} {short(self.points)} {self.degree} {self.realizations}"


TORUS_CASES = [
    TorusCase(2, 256, 32, 20000),
    TorusCase(2, 1024, 128, 1000),
    TorusCase(2, 4096, 64, 10000),
    TorusCase(2, 4096, 256, 1000),
    TorusCase(2, 16384, 512, 1000),
    TorusCase(2, 10**7, 1024, 1),
    TorusCase(1, 65536, 32768, 1000),
    TorusCase(3, 4096, 32, 1000),
    TorusCase(3, 10**6, 64, 1),
    TorusCase(3, 10**6, 64, 4),
]

SPHERE_CASES = [
    SphereCase("s", 256, 64, 5000),
    SphereCase("s", 1024, 128, 1000),
    SphereCase("s", 4096, 256, 1000),
    SphereCase("s", 16384, 512, 100),
    SphereCase("s", 10**6, 1000, 1),
    SphereCase("s", 10**6, 1000, 4),
    SphereCase("s", 10**7, 512, 1),
    SphereCase("s", 4096, 2000, 1),
    SphereCase("s", 4096, 2000, 10),
]

PAIRS_CASES = [
    SphereCase("p", 64, 32, 5000),
    SphereCase("p", 256, 100, 1000),
    SphereCase("p", 1024, 128, 200),
    SphereCase("p", 1024, 512, 200),
    SphereCase("p", 4096, 256, 100),
]

TORUS_TOLERANCES = [1e-3, 1e-6, 1e-9, 1e-12]
SPHERE_TOLERANCES = [1e-5, 1e-12]
PAIRS_TOLERANCES = [1e-5, 1e-10]


def parse_case(text):
    """ "2,1024,128,1000", "s,1024,128,1000" or "p,1024,128,200"; without R, that of the lists above, else 1000."""
    words = text.split(",")
    on_sphere = words[0] in ("s", "p")
    kind = SphereCase if on_sphere else TorusCase
    values = words[:on_sphere] + [int(float(word)) for word in words[on_sphere:]]
    if len(values) == 3:
        known = [case[3] for case in TORUS_CASES + SPHERE_CASES + PAIRS_CASES if list(case[:3]) == values]
        values.append(max(known) if known else 1000)
    return kind(*values)
