#!/bin/bash
# Builds and runs separate projects: against an installation, header-only, from a build of which nothing was made, and with
# the compiled libraries of a build that has them; and with the library as a subfolder.
#   check_install.sh <cmake> <source directory> <work directory> <compiler> [<build directory with compiled libraries>]
set -euo pipefail
cmake=$1
source_directory=$2
work=$3
compiler=$4
compiled_build=${5:-}
consumer=$source_directory/tests/project/consumer

rm -rf "$work"
mkdir -p "$work"

install_moved() { # build directory, prefix; moved there, so that no path of the first place may be left in it
  "$cmake" --install "$1" --prefix "$work/prefix"
  mv "$work/prefix" "$2"
  if grep -rlI -e "$source_directory/include" -e "$work/prefix" "$2"; then
    echo "the installed files above name the place they were made in"
    exit 1
  fi
}
check_consumer() { # prefix, build directory, options
  local prefix=$1 build=$2
  shift 2
  "$cmake" -S "$consumer" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  "$cmake" --build "$build"
  "$build/consumer"
}

small=$source_directory/tests/project/small_consumer
check_small() { # name, options
  local build=$work/small_$1
  shift
  "$cmake" -S "$small" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" "$@"
  "$cmake" --build "$build"
  "$build/small_consumer"
}

"$cmake" -S "$source_directory" -B "$work/build" -DCMAKE_CXX_COMPILER="$compiler" \
  -DDOVETAIL_BUILD_TESTS=OFF -DDOVETAIL_BUILD_EXAMPLES=OFF -DDOVETAIL_BUILD_BENCHMARKS=OFF
install_moved "$work/build" "$work/elsewhere"
check_consumer "$work/elsewhere" "$work/consumer"
check_small installed -DCMAKE_PREFIX_PATH="$work/elsewhere"
# A module has all that its headers need; every module is a component.
check_small partitioners -DCMAKE_PREFIX_PATH="$work/elsewhere" -DCOMPONENT=partitioners
modules=$(sed -nE 's/^has *\| *([a-z]+) .*/\1/p' "$source_directory/cmake/modules.txt" | grep -v adapters | uniq | paste -sd ';')
check_small modules -DCMAKE_PREFIX_PATH="$work/elsewhere" -DCOMPONENT="$modules"

# As a subfolder of an empty project it brings the library alone: no program, no tests, nothing to install.
check_small subfolder -DSUBFOLDER="$source_directory"
check_small subfolder_modules -DSUBFOLDER="$source_directory" -DCOMPONENT="$modules"
"$cmake" --build "$work/small_subfolder" --target help >"$work/targets"
if grep -E "(^|[ /])(dovetail_compiled|dovetail|dovetail_driver_parts|tests?_[a-z0-9_]+|example_[a-z0-9_]+|install)(:|$| )" "$work/targets"; then
  echo "the targets above are not wanted in a project that has the library as a subfolder"
  exit 1
fi

if [[ -n $compiled_build ]]; then
  install_moved "$compiled_build" "$work/compiled"
  if [[ -x $work/compiled/bin/dovetail ]]; then
    "$work/compiled/bin/dovetail" --version || { echo "the driver does not start where it is installed"; exit 1; }
  fi
  check_consumer "$work/compiled" "$work/compiled_consumer" -DEXTRA_COMPONENT=compiled_occt
  check_small compiled -DCMAKE_PREFIX_PATH="$work/compiled" -DCOMPONENT=compiled
  if compgen -G "$work/compiled/lib*/libdovetail_compiled_cgal.a" >/dev/null; then
    check_small compiled_cgal -DCMAKE_PREFIX_PATH="$work/compiled" -DCOMPONENT=compiled_cgal
    "$work/small_compiled_cgal/cgal_consumer"
  fi
  if nm -C "$work/compiled_consumer/CMakeFiles/consumer.dir/main.cpp.o" | grep " W dovetail::occt_shape_from"; then
    echo "the program that links the compiled library has compiled its functions again"
    exit 1
  fi
fi

# A component that does not exist, and a version that is too new, are refused with a reason.
expect_refusal() { # reason, options
  local reason=$1 log
  shift
  if log=$("$cmake" -S "$consumer" -B "$work/refused" -DCMAKE_PREFIX_PATH="$work/elsewhere" "$@" 2>&1); then
    echo "configuring with $* should have failed"
    exit 1
  fi
  grep -q -- "$reason" <<<"$log" || { echo "no '$reason' in:"; echo "$log"; exit 1; }
  rm -rf "$work/refused"
}
expect_refusal "component 'nonsense' is not part of this installation" -DEXTRA_COMPONENT=nonsense
expect_refusal "requested version \"99" -DWANTED_VERSION=99
expect_refusal "component 'compiled' is not part of this installation" -DEXTRA_COMPONENT=compiled
