#!/bin/bash
# The Debian packages are made from a clone: of the headers, against which a program is compiled with and without CMake, and
# of the driver, which is not compiled again for it.
#   check_debian.sh <source directory> <work directory> <compiler> <build directory with the driver, or "">
set -euo pipefail
source_directory=$1
work=$2
compiler=$3
export DOVETAIL_DRIVER_BUILD=$4 DEB_BUILD_OPTIONS=noautodbgsym # such a driver has no symbols to debug with
needs=() which=-b # all packages, or those for any architecture
[[ $DOVETAIL_DRIVER_BUILD ]] || needs=(-A) which=-A

command -v dh pkg-config dpkg-buildpackage >/dev/null || { echo "skipped: debhelper is not installed"; exit 77; }
rm -rf "$work"
mkdir -p "$work/dovetail" "$work/installed" "$work/driver"
cd "$source_directory"
cp -r app cmake debian docs include CHANGELOG.md CMakeLists.txt LICENSE README.md "$work/dovetail"

cd "$work/dovetail"
dpkg-checkbuilddeps "${needs[@]}" || { echo "skipped: a package that the build needs is missing"; exit 77; }
if ! dpkg-buildpackage $which -us -uc >"$work/log" 2>&1; then
  tail -n 40 "$work/log"
  exit 1
fi
version=$(dpkg-parsechangelog --show-field Version)
package=$work/libdovetail-dev_${version}_all.deb
dpkg-deb -x "$package" "$work/installed"
prefix=$work/installed/usr

# Every header is in it, and a component for each library that the package is built with.
headers() { (cd "$1" && find dovetail -name '*.[hi]pp' | LC_ALL=C sort); }
diff <(headers include) <(headers "$prefix/include")
adapters=$(sed -n 's/^dovetail_adapter(\([a-z_]*\) .*/\1/p' cmake/dovetail_targets.cmake)
for adapter in $adapters; do
  [[ -s $prefix/share/cmake/dovetail/dovetail-$adapter-targets.cmake ]] || { echo "no component $adapter"; exit 1; }
done

# For any architecture and from any folder.
[[ $(dpkg-deb --field "$package" Architecture) == all ]]
if grep -rlE "$work|$(dpkg-architecture --query DEB_HOST_MULTIARCH)" "$prefix"; then
  echo "the files above name the machine or the place they were made on"
  exit 1
fi

if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$work"/dovetail_*.changes
fi

consumer=$source_directory/tests/project/small_consumer
cmake -S "$consumer" -B "$work/consumer" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/consumer"
"$work/consumer/small_consumer"
export PKG_CONFIG_PATH=$prefix/share/pkgconfig
read -ra flags < <(pkg-config --cflags --libs dovetail)
"$compiler" "$consumer/main.cpp" "${flags[@]}" -o "$work/without_cmake"
"$work/without_cmake"

[[ $DOVETAIL_DRIVER_BUILD ]] || { rm -rf "$work"; exit 0; }

# The driver runs from its package, which depends on all that it links and loads, and has its manual pages.
driver=$work/dovetail_${version}_$(dpkg-architecture --query DEB_HOST_ARCH).deb
dpkg-deb -x "$driver" "$work/driver"
depends=$(dpkg-deb --field "$driver" Depends)
for library in libc6 libocct-data-exchange libmetis libtet1.5; do
  [[ $depends == *$library* ]] || { echo "the driver does not depend on $library: $depends"; exit 1; }
done
dovetail=$work/driver/usr/bin/dovetail
if readelf --dynamic "$dovetail" | grep -F "$DOVETAIL_DRIVER_BUILD"; then
  echo "the driver looks for libraries where it was built"
  exit 1
fi
commands=$("$dovetail" --help | sed -n '/^Subcommands:/,$ s/^  \([a-z]*\) .*/\1/p')
[[ $commands == *mesh* ]] || { echo "no commands in --help"; exit 1; }
for command in $commands; do
  [[ -s $work/driver/usr/share/man/man1/dovetail-$command.1.gz ]] || { echo "no manual page of $command"; exit 1; }
done
"$dovetail" mesh --model aircraft --elements 20000 --out "$work/mesh" --quiet
"$dovetail" check "$work/mesh"
rm -rf "$work"
