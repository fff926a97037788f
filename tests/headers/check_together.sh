#!/bin/bash
# Compiles the headers of one folder of the library together, with the compiled library and header-only. What they define is
# inline, so that two translation units can include it. The last header comes first, since the compiled library has the first one
# first; if that fails each is compiled alone, with its definitions (x.ipp) too, to tell which.
#   check_together.sh <include directory> <folder under dovetail/> <file with flags> <compiler> <more flags...>
# The compiler may have a launcher in front (ccache: then a header that has not changed costs nothing). Works in the
# current folder.
# With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
set -uo pipefail
include_directory=$1
folder=$2
mapfile -t flags < <(grep . "$3")
shift 3

unit=together_${folder//./umbrella}
unit=${unit//\//_}
trap 'rm -f "$unit".cpp "$unit".o' EXIT
with_library=(-DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT -DDOVETAIL_COMPILED_CGAL)
compile() { # Prints what the compiler says and what the header defines that is not inline; fails when it does either.
  "$@" "${flags[@]}" -c "$unit.cpp" -o "$unit.o" 2>&1 &&
    ! nm --demangle --extern-only --defined-only "$unit.o" | grep -v ' [VWu] '
}

for path in "$include_directory/dovetail/$folder"/*.hpp; do
  printf '#include "%s"\n' "${path#"$include_directory"/}"
done | tac >"$unit.cpp"
told_together=$(compile "$@" "${with_library[@]}" && compile "$@") && exit

failed=0
passed_over=0
for path in "$include_directory/dovetail/$folder"/*.hpp; do
  [[ -f $path ]] || continue
  header=${path#"$include_directory"/}
  printf '#include "%s"\n#include "%s"\n' "$header" "$header" >"$unit.cpp"
  messages=$(compile "$@" "${with_library[@]}" &&
    { [[ ! -f ${path%.hpp}.ipp ]] || compile "$@"; }) && continue
  if [[ -n ${DOVETAIL_ALLOW_MISSING_LIBRARIES:-} ]] &&
    grep -E "fatal error: .*([Nn]o such file|file not found)" <<<"$messages" | grep -qv "fatal error: '\?dovetail/"; then
    echo "$header: passed over, a library is missing"
    passed_over=1
    continue
  fi
  echo "$header does not compile alone, or defines what is not inline:"
  head -n 40 <<<"$messages"
  failed=1
done
if ((!failed && !passed_over)); then
  echo "the headers of $folder/ do not compile together:"
  head -n 40 <<<"$told_together"
  failed=1
fi
exit $failed
