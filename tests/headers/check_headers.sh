#!/bin/bash
# Compiles the headers of one folder of the library, with the compiled library and header-only. What they define is inline, so that
# two translation units can include it.
#   check_headers.sh <include directory> <folder under dovetail/> <file with flags> alone|together <compiler> <more flags...>
# alone: each header with the compiled library. together: all of them in one translation unit, the last one first, since the
# compiled library has the first one first; if that fails each alone, with its definitions (x.ipp) too, to tell which.
# The compiler may have a launcher in front (ccache: then a header that has not changed costs nothing). Works in the
# current folder.
# With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
set -uo pipefail
include_directory=$1
folder=$2
mapfile -t flags < <(grep . "$3")
way=$4
shift 4

unit=${way}_${folder//./umbrella}
unit=${unit//\//_}
trap 'rm -f "$unit".cpp "$unit".o' EXIT
with_library=(-DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT)
compile() { # Prints what the compiler says and what the header defines that is not inline; fails when it does either.
  "$@" "${flags[@]}" -c "$unit.cpp" -o "$unit.o" 2>&1 &&
    ! nm --demangle --extern-only --defined-only "$unit.o" | grep -v ' [VWu] '
}

if [[ $way == together ]]; then
  for path in "$include_directory/dovetail/$folder"/*.hpp; do
    printf '#include "%s"\n' "${path#"$include_directory"/}"
  done | tac >"$unit.cpp"
  told_together=$(compile "$@" "${with_library[@]}" && compile "$@") && exit
fi

failed=0
passed_over=0
for path in "$include_directory/dovetail/$folder"/*.hpp; do
  [[ -f $path ]] || continue
  header=${path#"$include_directory"/}
  printf '#include "%s"\n#include "%s"\n' "$header" "$header" >"$unit.cpp"
  messages=$(compile "$@" "${with_library[@]}" &&
    { [[ $way == alone || ! -f ${path%.hpp}.ipp ]] || compile "$@"; }) && continue
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
if [[ $way == together ]] && ((!failed && !passed_over)); then
  echo "the headers of $folder/ do not compile together:"
  head -n 40 <<<"$told_together"
  failed=1
fi
exit $failed
