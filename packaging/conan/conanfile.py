"""dovetail as a Conan 2 package: `conan create packaging/conan -s compiler.cppstd=20` in a clone."""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy, load

# The adapters whose library's recipe has the CMake names that dovetail looks for, each an option of the package.
ADAPTERS = {
    "boost_graph": "boost/[>=1.71 <2]",
    "cgal": "cgal/[>=5.4 <6]",
    "eigen": "eigen/[>=3.3 <4]",
    "json": "nlohmann_json/[>=3.7 <4]",
    "zlib": "zlib/[>=1.2 <2]",
}


class DovetailConan(ConanFile):
    name = "dovetail"
    description = "Parallel mesh generation from CAD by decomposition along clean interfaces"
    license = "MIT"
    topics = ("mesh-generation", "cad", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {adapter: [True, False] for adapter in ADAPTERS}
    default_options = {adapter: False for adapter in ADAPTERS}
    no_copy_source = True

    def set_version(self):
        header = load(self, os.path.join(self._clone(), "include", "dovetail", "core", "version.hpp"))
        self.version = ".".join(re.findall(r"#define DOVETAIL_VERSION_\w+ (\d+)", header))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*"):
            copy(self, pattern, src=self._clone(), dst=self.export_sources_folder)

    def requirements(self):
        for adapter in self._adapters():
            self.requires(ADAPTERS[adapter], transitive_headers=True, transitive_libs=True)

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.settings.clear()  # nothing is compiled

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for switch in ("APP", "COMPILED", "TESTS", "EXAMPLES", "BENCHMARKS"):
            toolchain.cache_variables[f"DOVETAIL_BUILD_{switch}"] = False
        toolchain.cache_variables["DOVETAIL_ADAPTERS"] = ";".join(self._adapters())
        toolchain.cache_variables["CMAKE_INSTALL_LIBDIR"] = "lib"
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # The package's own CMake files know the components, and what each needs.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "dovetail")]
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []

    def _adapters(self):
        return [adapter for adapter in ADAPTERS if self.options.get_safe(adapter)]

    def _clone(self):
        return os.path.join(self.recipe_folder, "..", "..")
