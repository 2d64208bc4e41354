"""The torus, the sphere, and pairs on the sphere: their problems, who solves them, and how results are measured."""

from typing import Callable, NamedTuple

from cases import (PAIRS_CASES, PAIRS_TOLERANCES, SPHERE_CASES, SPHERE_TOLERANCES, TORUS_CASES, TORUS_TOLERANCES,
                   SphereCase)
from libraries.ducc0_torus import Ducc0
from libraries.ducc0_sphere import Ducc0Sphere
from libraries.finufft_torus import Finufft
from libraries.nfft import Nfft
from libraries.nfsft import Nfsft
from libraries.numpy_pairs import NumpyPairs
from plain import PlainRunner
from points import TorusPoints
from points_sphere import SpherePoints
from pointspec_questions import PairsQuestion, SphereQuestion, TorusQuestion
from reference import TorusReference
from reference_pairs import PairsReference
from reference_sphere import SphereReference


class Domain(NamedTuple):
    heading: str  # of a case in the table
    cases: list
    tolerances: list
    peers: dict  # by the name of the library
    points: Callable
    reference: Callable
    question: object  # for pointspec
    beside: str  # the engine that has a column of its own; all are in the CSV file and the picture
    plain: Callable  # what one writes first, or None
    csv_name: str


DOMAINS = {
    "torus": Domain("d N K R", TORUS_CASES, TORUS_TOLERANCES, {"finufft": Finufft, "ducc0": Ducc0, "nfft": Nfft},
                    TorusPoints, TorusReference, TorusQuestion(), "torus_direct", None, "peers.csv"),
    "sphere": Domain("s N L R", SPHERE_CASES, SPHERE_TOLERANCES, {"ducc0": Ducc0Sphere, "nfft": Nfsft},
                     SpherePoints, SphereReference, SphereQuestion(), "sphere_direct", PlainRunner,
                     "peers_sphere.csv"),
    "pairs": Domain("p N L R", PAIRS_CASES, PAIRS_TOLERANCES, {"ducc0": Ducc0Sphere, "numpy": NumpyPairs},
                    SpherePoints, PairsReference, PairsQuestion(), "pairs_direct", None, "peers_pairs.csv"),
}


def domain_of(case):
    names = {"s": "sphere", "p": "pairs"}
    return names[case.domain] if isinstance(case, SphereCase) else "torus"
