"""What is asked of pointspec: a kind of answer and its options, for the C library and for `pointspec plan`."""


class TorusQuestion:
    gives_modes = False
    kind, powers = b"power", "full"

    def options(self, case):
        return {"max-frequency": case.max_frequency}

    def arguments(self, case):
        return ["power", "--sampler", "white", "-d", case.dimension, "-k", case.max_frequency]


class SphereQuestion:
    gives_modes = True  # the coefficients that powers are made of
    kind, powers = b"angular", "power"

    def options(self, case):
        return {"max-degree": case.degree}

    def arguments(self, case):
        return ["angular", "--sampler", "white-sphere", "-l", case.degree]


class PairsQuestion:
    gives_modes = False
    kind, powers = b"pairs", "legendre_sum"

    def options(self, case):
        return {"max-degree": case.degree}

    def arguments(self, case):
        return ["pairs", "--sampler", "white-sphere", "-l", case.degree]
