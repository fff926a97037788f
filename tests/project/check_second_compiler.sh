#!/bin/bash
# Whether the driver's files are valid for a second compiler, clang, which takes less than g++ here and there: as one unit, since
# most of the time would go to what they share, and when that is not valid each alone, which decides.
#   check_second_compiler.sh <source directory> <generated headers> <file with flags> <clang++>
set -uo pipefail
cd "$1/app" || exit 1
mapfile -t flags < <(grep . "$3")
command=("$4" -DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT -DDOVETAIL_COMPILED_CGAL "${flags[@]}" "-I$2" -I. -fsyntax-only)

printf '#include "%s"\n' *.cpp | "${command[@]}" -x c++ - && exit
failed=0
for file in *.cpp; do
  "${command[@]}" "$file" || failed=1
done
exit $failed
