#!/bin/bash
# CPack packs the headers, and a program is compiled against the archive, unpacked anywhere, by the flags of pkg-config.
#   check_pack.sh <cmake> <source directory> <work directory> <compiler>
set -euo pipefail
cmake=$1
source_directory=$2
work=$3
compiler=$4

command -v pkg-config >/dev/null || { echo "skipped: pkg-config is not installed"; exit 77; }
rm -rf "$work"
mkdir -p "$work/unpacked" "$work/of_deb"
fail() {
  echo "$1"
  exit 1
}

# A package has the adapters that were asked for; one that cannot be had is an error.
configure() { "$cmake" -S "$source_directory" --preset headers -B "$work/build" -DCMAKE_CXX_COMPILER="$compiler" "$@"; }
if said=$(configure -DDOVETAIL_ADAPTERS="zlib;nonsense" 2>&1); then
  fail "an adapter that does not exist is no error"
fi
grep -q "there is no 'nonsense'" <<<"$said" || fail "no word about the adapter in: $said"
if said=$(configure -DDOVETAIL_ADAPTERS=zlib -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON 2>&1); then
  fail "an adapter without its library is no error"
fi
grep -q "the library of 'zlib' was not found" <<<"$said" || fail "no word about the library in: $said"
configure -DDOVETAIL_ADAPTERS= -UCMAKE_DISABLE_FIND_PACKAGE_ZLIB >"$work/log" || fail "$(<"$work/log")"

cd "$work/build"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:.*=//p' CMakeCache.txt)
cpack -G "TGZ;DEB" >"$work/log" 2>&1 || fail "$(<"$work/log")"
tar -xzf "dovetail-$version-headers.tar.gz" -C "$work/unpacked"
prefix=$work/unpacked/dovetail-$version-headers
headers() { (cd "$1" && find dovetail -name '*.[hi]pp' | LC_ALL=C sort); }
diff <(headers "$source_directory/include") <(headers "$prefix/include")
components=$(cd "$prefix/lib/cmake/dovetail" && echo dovetail-*-targets.cmake)
[[ $components == dovetail-modules-targets.cmake ]] || fail "there are components that nobody asked for: $components"
if command -v dpkg-deb >/dev/null; then
  dpkg-deb -x "dovetail-$version-headers.deb" "$work/of_deb"
  diff <(headers "$source_directory/include") <(headers "$work/of_deb/usr/include")
fi
if grep -rlI -e "$source_directory" -e "$work" "$prefix"; then
  fail "the files above name the place they were made in"
fi

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
[[ $(pkg-config --modversion dovetail) == "$version" ]] || fail "pkg-config has another version than $version"
read -ra flags < <(pkg-config --cflags --libs dovetail)
[[ " ${flags[*]} " == *" -ffp-contract=off "* ]] || fail "the exact predicates are not exact with ${flags[*]}"
"$compiler" "$source_directory/tests/project/small_consumer/main.cpp" "${flags[@]}" -o "$work/consumer"
"$work/consumer"

# The program that Conan tries its package by; Conan itself is not run.
"$cmake" -S "$source_directory/packaging/conan/test_package" -B "$work/test_package" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" >"$work/log" || fail "$(<"$work/log")"
"$cmake" --build "$work/test_package"
"$work/test_package/test_package"
rm -rf "$work"
