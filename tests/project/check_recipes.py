#!/usr/bin/python3
"""The recipes of package managers and the workflows name what there is: versions, options, adapters, scripts, presets.
The managers themselves are not run: the recipes of Conan and Spack are, against stand-ins of what they import.
  check_recipes.py SOURCE_DIRECTORY"""

import importlib.util
import json
import os
import re
import sys
import types

import yaml

SOURCE = sys.argv[1]
problems = []


def check(right, message):
    if not right:
        problems.append(message)


def text_of(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
        return file.read()


def load(path, **stand_ins):
    """The module of a file, with modules of these names instead of those that it imports."""
    for name, content in stand_ins.items():
        module = types.ModuleType(name.replace("__", "."))
        vars(module).update(content)
        if "__all__" not in content:
            module.__all__ = list(content)
        sys.modules[module.__name__] = module
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("recipe", os.path.join(SOURCE, path))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# What the project says of itself.
version = ".".join(re.findall(r"#define DOVETAIL_VERSION_\w+ (\d+)", text_of("include/dovetail/core/version.hpp")))
cmake = text_of("CMakeLists.txt") + "".join(
    text_of("cmake", name) for name in sorted(os.listdir(os.path.join(SOURCE, "cmake"))))
options = set(re.findall(r"option\((DOVETAIL_\w+)|set\((DOVETAIL_\w+) [^)]*CACHE", cmake))
options = {name for pair in options for name in pair if name}
adapters = set(re.findall(r"^dovetail_adapter\((\w+) ", cmake, re.MULTILINE))
presets = json.loads(text_of("CMakePresets.json"))
presets_of = {"cmake": "configurePresets", "--build": "buildPresets", "ctest": "testPresets"}


def check_options(where, given):
    """Options of CMake by name, and DOVETAIL_ADAPTERS among them."""
    for name in given:
        if name.startswith("DOVETAIL_"):
            check(name in options, f"{where}: CMake knows no option {name}")
    check("DOVETAIL_ADAPTERS" in given, f"{where}: adapters are left to chance")
    for name in filter(None, given.get("DOVETAIL_ADAPTERS", "").split(";")):
        check(name in adapters, f"{where}: there is no adapter {name}")
    # What compiles nothing must say so, as all is built by default.
    for name in options:
        if name.startswith("DOVETAIL_BUILD_"):
            check(name in given, f"{where}: says nothing about {name}")


# Debian
check(re.match(r"dovetail \(([^)]*)\)", text_of("debian/changelog")).group(1) == version,
      f"debian/changelog: the version is not {version}")
given = set(re.findall(r"-D(\w+)=", text_of("debian/rules")))
for name in given:
    check(not name.startswith("DOVETAIL_") or name in options, f"debian/rules: CMake knows no option {name}")
check(re.search(rf"^## {re.escape(version)} ", text_of("CHANGELOG.md"), re.MULTILINE),
      f"CHANGELOG.md: nothing about {version}")

# vcpkg
port = json.loads(text_of("packaging/vcpkg/dovetail/vcpkg.json"))
portfile = text_of("packaging/vcpkg/dovetail/portfile.cmake")
check(port["version"] == version, f"vcpkg.json: the version is not {version}")
check(set(port) <= {"name", "version", "description", "license", "dependencies", "features"}, "vcpkg.json: unknown keys")
listed = re.search(r"foreach\(feature IN ITEMS ([^)]*)\)", portfile).group(1).split()
check(listed == sorted(port["features"]), "portfile.cmake has other features than vcpkg.json")
for name, feature in port["features"].items():
    check(re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name), f"vcpkg.json: {name} is no name of a feature")
    check(set(feature) == {"description", "dependencies"}, f"vcpkg.json: {name} lacks something")
given = dict(re.findall(r"-D(\w+)=([^\s\")]*)", portfile))
given["DOVETAIL_ADAPTERS"] = ";".join(name.replace("-", "_") for name in listed)
check_options("portfile.cmake", given)
for called in set(re.findall(r"^(vcpkg_\w+)\(", portfile, re.MULTILINE)):
    check(called in {"vcpkg_cmake_configure", "vcpkg_cmake_install", "vcpkg_cmake_config_fixup", "vcpkg_fixup_pkgconfig",
                     "vcpkg_install_copyright"}, f"portfile.cmake: {called} is not a function that the port depends on")


# Conan
class Chosen(dict):
    get_safe = dict.get


class Toolchain:
    def __init__(self, recipe):
        self.cache_variables = recipe.cache_variables = {}

    def generate(self):
        pass


class Deps(Toolchain):
    def __init__(self, recipe):
        pass


def read(recipe, path):
    with open(path, encoding="utf-8") as file:
        return file.read()


conan = load("packaging/conan/conanfile.py", conan={"ConanFile": object}, conan__tools={},
             conan__tools__build={"check_min_cppstd": None},
             conan__tools__cmake={"CMake": None, "CMakeDeps": Deps, "CMakeToolchain": Toolchain},
             conan__tools__files={"copy": lambda recipe, pattern, src, dst: check(
                 os.path.exists(os.path.join(src, pattern.rstrip("*"))), f"conanfile.py: there is no {pattern}"),
                 "load": read})
recipe = conan.DovetailConan()
recipe.recipe_folder = os.path.join(SOURCE, "packaging/conan")
recipe.export_sources_folder = ""
recipe.set_version()
check(recipe.version == version, f"conanfile.py: the version is {recipe.version}, not {version}")
recipe.export_sources()
for chosen in ({}, {name: True for name in recipe.options}):
    recipe.options = Chosen(recipe.default_options, **chosen)
    recipe.requires = lambda reference, **traits: check(
        re.fullmatch(r"[a-z_]+/\[>=[\d.]+ <\d+\]", reference), f"conanfile.py: {reference} is no range of versions")
    recipe.requirements()
    recipe.generate()
    check_options("conanfile.py", recipe.cache_variables)
    check(bool(chosen) == bool(recipe.cache_variables["DOVETAIL_ADAPTERS"]), "conanfile.py: options do not choose adapters")
compile(text_of("packaging/conan/test_package/conanfile.py"), "test_package/conanfile.py", "exec")

# Spack
variants = {}
needs = []


class Spec:
    def __init__(self, chosen):
        self.chosen = chosen

    def satisfies(self, word):
        check(word[1:] in variants, f"package.py: there is no variant {word[1:]}")
        return word[0] == "+" and word[1:] in self.chosen


def ignore(*words, when="", **more):
    for word in re.findall(r"[+~](\w+)", when):
        check(word in variants, f"package.py: there is no variant {word}")
        needs.append(word)


class CMakePackage:
    @staticmethod
    def define(name, value):
        return name, value

    @staticmethod
    def define_from_variant(name, variant):
        check(variant in variants, f"package.py: there is no variant {variant}")
        return name, False


def variant(name, default, description):
    variants[name] = default


spack = load("packaging/spack/packages/dovetail/package.py", spack={}, spack__package={
    "CMakePackage": CMakePackage, "depends_on": ignore, "conflicts": ignore, "license": ignore, "version": ignore,
    "variant": variant})
check(set(spack.Dovetail.ADAPTERS) == set(variants) - {"driver"}, "package.py: variants are not those of the adapters")
check(set(variants) <= set(needs), "package.py: a variant needs nothing")
check(os.path.samefile(spack.Dovetail.git[len("file://"):], SOURCE), "package.py: its repository is not the clone it is in")
for chosen in (set(), set(variants)):
    package = spack.Dovetail()
    package.spec = Spec(chosen)
    check_options("package.py", dict(package.cmake_args()))
check(yaml.safe_load(text_of("packaging/spack/repo.yaml"))["repo"]["namespace"] == "dovetail", "repo.yaml has no namespace")


# Workflows
def check_commands(where, lines):
    for line in lines:
        for path in re.findall(r"(?:^|\s)((?:scripts|benchmarks|tests)/[\w./]+)", line):
            check(os.access(os.path.join(SOURCE, path), os.X_OK), f"{where}: {path} is no program")
        for program, preset in re.findall(r"(ctest|cmake|--build) --preset (\S+)", line):
            kind = presets_of[program]
            check(any(known["name"] == preset for known in presets[kind]), f"{where}: {kind} has no {preset}")
        for folder in re.findall(r"BUILD=(\S+)", line):
            check(any(known["binaryDir"] == "${sourceDir}/" + folder for known in presets["configurePresets"]),
                  f"{where}: no preset builds in {folder}")


# With CI=true all tests are asked for, so all that they need is installed.
check(re.search(r"CI:-.* == true.*\n\s*scripts/setup consumers", text_of("scripts", "test.sh")),
      "scripts/test.sh: does not install what tests of consumers need")


def check_called(where, commands):
    for script in ("scripts/test.sh", "scripts/mesh.sh", "scripts/site", "benchmarks/fuzz", "benchmarks/same_mesh"):
        check(any(script in command for command in commands), f"{where}: {script} is not called")
    check(any("--preset asan" in command for command in commands), f"{where}: no sanitizer")


folder = os.path.join(SOURCE, ".github/workflows")
for name in sorted(os.listdir(folder)):
    workflow = yaml.safe_load(text_of(".github/workflows", name))
    check({"name", True, "jobs"} <= set(workflow), f"{name}: not a workflow")  # YAML takes `on` for true
    commands = []
    for job, content in workflow["jobs"].items():
        check({"runs-on", "container", "steps"} <= set(content), f"{name}: {job} lacks something")
        for step in content["steps"]:
            check(("run" in step) != ("uses" in step), f"{name}: a step of {job} runs nothing")
            commands.append(step.get("run", ""))
            check("@" in step.get("uses", "@"), f"{name}: {job} uses an action of no version")
        matrix = content.get("strategy", {}).get("matrix", {})
        known = set(matrix) | {key for row in matrix.get("include", []) for key in row}
        for key in re.findall(r"matrix\.(\w+)", json.dumps(content)):
            check(key in known, f"{name}: {job} has no {key} in its matrix")
        needed = content.get("needs", [])
        for other in [needed] if isinstance(needed, str) else needed:
            check(other in workflow["jobs"], f"{name}: {job} needs {other}, which is no job")
    check_commands(name, commands)
    check_called(name, commands)

gitlab = yaml.safe_load(text_of(".gitlab-ci.yml"))
jobs = {name: content for name, content in gitlab.items() if name not in ("stages", "default", "variables")}
commands = []
for name, content in jobs.items():
    whole = dict(jobs.get(content.get("extends"), {}), **content)
    check("extends" not in content or content["extends"] in jobs, f".gitlab-ci.yml: {name} extends no job")
    check("script" in whole, f".gitlab-ci.yml: {name} runs nothing")
    check(whole.get("stage") in gitlab["stages"], f".gitlab-ci.yml: {name} has no stage")
    commands += whole.get("script", [])
check_commands(".gitlab-ci.yml", commands)
check_called(".gitlab-ci.yml", commands)

print("\n".join(problems))
sys.exit(bool(problems))
