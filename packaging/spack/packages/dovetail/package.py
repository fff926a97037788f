# Copyright (c) 2026 the dovetail authors
# SPDX-License-Identifier: MIT
"""dovetail as a Spack package: `spack repo add packaging/spack`, then `spack install dovetail`, from a clone."""

import os

from spack.package import *


class Dovetail(CMakePackage):
    """Parallel mesh generation from CAD by decomposition along clean interfaces."""

    git = "file://" + os.path.realpath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 4))
    license("MIT")

    version("main", branch="main")

    variant("driver", default=False, description="Build the command-line driver")

    # Adapters of libraries, each with what it needs.
    variant("boost_graph", default=False, description="Graphs of the Boost Graph Library")
    variant("cgal", default=False, description="CGAL's meshers and improver (GPL)")
    variant("eigen", default=False, description="Graphs as matrices of Eigen")
    variant("gmsh", default=False, description="Gmsh's meshers and improver (GPL)")
    variant("hdf5", default=False, description="Files of HDF5")
    variant("json", default=False, description="Reports as JSON")
    variant("metis", default=True, description="The partitioner METIS")
    variant("occt", default=True, description="CAD files by Open CASCADE")
    variant("scotch", default=False, description="The partitioner Scotch")
    variant("zlib", default=False, description="Compressed VTU files")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("boost@1.71:+graph", when="+boost_graph")
    depends_on("cgal@5.4:5", when="+cgal")
    depends_on("eigen@3.3:3", when="+eigen")
    depends_on("gmsh@4.8:", when="+gmsh")
    depends_on("hdf5", when="+hdf5")
    depends_on("nlohmann-json@3.7:", when="+json")
    depends_on("metis@5:", when="+metis")
    depends_on("opencascade@7.6:7", when="+occt")
    depends_on("scotch", when="+scotch")
    depends_on("zlib-api", when="+zlib")
    depends_on("cli11", when="+driver")
    depends_on("libpng", when="+driver")
    for adapter in ("json", "metis", "occt", "zlib"):
        conflicts(f"~{adapter}", when="+driver", msg="the driver needs json, metis, occt and zlib")

    conflicts("%gcc@:11")
    conflicts("%clang@:13")

    ADAPTERS = ("boost_graph", "cgal", "eigen", "gmsh", "hdf5", "json", "metis", "occt", "scotch", "zlib")

    def cmake_args(self):
        adapters = [adapter for adapter in self.ADAPTERS if self.spec.satisfies(f"+{adapter}")]
        return [
            self.define("DOVETAIL_ADAPTERS", ";".join(adapters)),
            self.define("DOVETAIL_DEVELOPER", False),
            self.define_from_variant("DOVETAIL_BUILD_APP", "driver"),
            self.define_from_variant("DOVETAIL_BUILD_COMPILED", "driver"),
            self.define("DOVETAIL_BUILD_TESTS", False),
            self.define("DOVETAIL_BUILD_EXAMPLES", False),
            self.define("DOVETAIL_BUILD_BENCHMARKS", False),
        ]
