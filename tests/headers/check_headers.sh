#!/bin/bash
# Compiles each header of one folder of the library alone: as it is with the compiled library and, where that leaves
# out its definitions (x.ipp), header-only too. What it defines is inline, so that two translation units can include it.
#   check_headers.sh <include directory> <folder under dovetail/> <file with flags> <compiler> <more flags...>
# The compiler may have a launcher in front (ccache: then a header that has not changed costs nothing). Works in the
# current folder.
# With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
set -uo pipefail
include_directory=$1
folder=$2
mapfile -t flags < <(grep . "$3")
shift 3

compile() { # Prints what the compiler says and what the header defines that is not inline; fails when it does either.
  "$@" "${flags[@]}" -c "$unit.cpp" -o "$unit.o" 2>&1 &&
    ! nm --demangle --extern-only --defined-only "$unit.o" | grep -v ' [VWu] '
}

failed=0
unit=alone_${folder//./umbrella}
unit=${unit//\//_}
trap 'rm -f "$unit".cpp "$unit".o' EXIT
for path in "$include_directory/dovetail/$folder"/*.hpp; do
  [[ -f $path ]] || continue
  header=${path#"$include_directory"/}
  printf '#include "%s"\n#include "%s"\n' "$header" "$header" >"$unit.cpp"
  messages=$(compile "$@" -DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT &&
    { [[ ! -f ${path%.hpp}.ipp ]] || compile "$@"; }) && continue
  if [[ -n ${DOVETAIL_ALLOW_MISSING_LIBRARIES:-} ]] &&
    grep -E "fatal error: .*([Nn]o such file|file not found)" <<<"$messages" | grep -qv "fatal error: '\?dovetail/"; then
    echo "$header: passed over, a library is missing"
    continue
  fi
  echo "$header does not compile alone, or defines what is not inline:"
  head -n 40 <<<"$messages"
  failed=1
done
exit $failed
