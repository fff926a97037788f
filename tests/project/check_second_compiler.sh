#!/bin/bash
# Whether the driver's files are valid for a second compiler, clang, which takes less than g++ here and there.
#   check_second_compiler.sh <source directory> <generated headers> <file with flags> <clang++>
set -uo pipefail
cd "$1/app" || exit 1
mapfile -t flags < <(grep . "$3")
command=("$4" -DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT "${flags[@]}" "-I$2" -fsyntax-only)

failed=0
for file in *.cpp; do
  "${command[@]}" "$file" || failed=1
done
exit $failed
