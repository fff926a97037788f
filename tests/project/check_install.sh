#!/bin/bash
# Installs the library to a fresh prefix and builds and runs a separate project against it.
#   check_install.sh <cmake> <source directory> <work directory> <compiler>
set -euo pipefail
cmake=$1
source_directory=$2
work=$3
compiler=$4

rm -rf "$work"
mkdir -p "$work"
"$cmake" -S "$source_directory" -B "$work/build" -DCMAKE_CXX_COMPILER="$compiler" -DDOVETAIL_BUILD_APP=OFF \
  -DDOVETAIL_BUILD_TESTS=OFF -DDOVETAIL_BUILD_EXAMPLES=OFF -DDOVETAIL_BUILD_BENCHMARKS=OFF \
  -DCMAKE_INSTALL_PREFIX="$work/prefix"
"$cmake" --install "$work/build"

# Moved, so that no path of the first place may be left in it.
mv "$work/prefix" "$work/elsewhere"
if grep -rl -e "$source_directory/include" -e "$work/prefix" "$work/elsewhere"; then
  echo "the installed files above name the place they were made in"
  exit 1
fi

consumer=$source_directory/tests/project/consumer
"$cmake" -S "$consumer" -B "$work/consumer" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/elsewhere"
"$cmake" --build "$work/consumer"
"$work/consumer/consumer"

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
