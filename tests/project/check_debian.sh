#!/bin/bash
# The Debian package of the headers is made from a clone; a program is compiled against what is in it, with and without
# CMake. The driver's package has the same rules, but compiling it is left to who wants it.
#   check_debian.sh <source directory> <work directory> <compiler>
set -euo pipefail
source_directory=$1
work=$2
compiler=$3

command -v dh pkg-config dpkg-buildpackage >/dev/null || { echo "skipped: debhelper is not installed"; exit 77; }
rm -rf "$work"
mkdir -p "$work/dovetail" "$work/installed"
cd "$source_directory"
cp -r app cmake debian include CMakeLists.txt LICENSE "$work/dovetail"

cd "$work/dovetail"
dpkg-checkbuilddeps -A || { echo "skipped: a package that the build needs is missing"; exit 77; }
if ! dpkg-buildpackage -A -us -uc >"$work/log" 2>&1; then
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
rm -rf "$work"
