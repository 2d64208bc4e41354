"""Recipe for Spack. In a checkout: spack repo create here, this file as here/packages/pointspec/package.py, spack repo add
here, and spack dev-build pointspec@0.9.0."""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Pointspec(CMakePackage):
    """GPU-accelerated power spectra of sampling patterns (point sets on the torus, the sphere and the hemisphere), with
    standard errors and bounds on the numerical error, and what they say about Monte Carlo integration and quadrature."""

    license("GPL-3.0-or-later")

    version("0.9.0")

    variant("mpi", default=False, description="Build the module by which ranks share a job")

    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("opencl-c-headers", type="build")
    depends_on("opencl@1.2:")
    depends_on("gsl")
    depends_on("xxhash")
    depends_on("libyaml")
    depends_on("zlib-api")
    depends_on("gnuplot", type="run")
    depends_on("mpi", when="+mpi")

    conflicts("platform=darwin", msg="signals need timers of POSIX, which macOS has not")
    conflicts("platform=windows")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("POINTSPEC_BUILD_TESTS", False),
            self.define("POINTSPEC_BUILD_BENCH", False),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_MPI", not self.spec.satisfies("+mpi")),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        Executable(self.prefix.bin.pointspec)("power", "--sampler", "white", "-n", "16", "-k", "2", "--engine", "host_direct")
