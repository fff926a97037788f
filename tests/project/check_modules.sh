#!/bin/bash
# The headers of a module compile where there is nothing but they, those of the modules that it may include, and a compiler. Left
# out are those that need another library (cmake/modules.txt). Whatever file the compiler reads is one of these, or one that
# the headers of the standard library and of POSIX read by themselves.
# Definitions (x.ipp) are compiled in the core, erased, rules, storage, surfaces, the partitioners, the improver, the mesher, the sizing fields and what is finished. In
# the other modules all that they include is found and looked at likewise, but to compile them is left to the tests of headers.
#   check_modules.sh <source directory> <work directory> <module> <compiler>
set -euo pipefail
cd "$1"
work=$2
wanted=$3
compiler=$4
source cmake/modules.sh
[[ " ${modules[*]} " == *" $wanted "* ]] || { echo "there is no module $wanted"; exit 1; }

rm -rf "$work"
mkdir -p "$work/include/dovetail"
work=$(realpath "$work")
count=0
while read -r file; do
  find_place "$file" || { echo "$file is in no module"; exit 1; }
  [[ ${includes_of[$wanted]} == *" $module "* && ! $component ]] || continue
  mkdir -p "$work/include/dovetail/${file%/*}"
  cp "include/dovetail/$file" "$work/include/dovetail/$file"
  if [[ $module == "$wanted" && $file == *.hpp ]]; then
    printf '#include "dovetail/%s"\n' "$file"
    count=$((count + 1))
  fi
done < <(find include/dovetail -mindepth 2 -name '*.?pp' -printf '%P\n' | sort) >"$work/all.cpp"
((count)) || { echo "the module $wanted has no headers"; exit 1; }
cd "$work"
# What they include of the standard and of the system, by itself.
while read -r header; do
  ! is_system "$header" || printf '#if __has_include(<%s>)\n#include <%s>\n#endif\n' "$header" "$header"
done < <(grep -rhoE '#include <[^>]+>' include | sed 's/.*<//; s/>//' | sort -u) >system.cpp

files_of() { # what a rule for make names, one a line
  tr -s ' \\' '\n\n' <"$1" | sed '1d; /^$/d' | xargs realpath | sort -u
}
flags=(-std=c++20 -Iinclude)
"$compiler" "${flags[@]}" -M -MF system.d system.cpp
files_of system.d >system_files
strangers() { # rule: the files in it that are not the module's, nor the system's
  files_of "$1" | grep -v "^$work/include/" | grep -vx "$work/all\.cpp" | comm -23 - system_files
}

"$compiler" "${flags[@]}" -M -MF all.d all.cpp
if found=$(strangers all.d | grep .); then
  echo "the module $wanted reads files that do not come with a compiler:"
  echo "$found"
  exit 1
fi
declarations=(-DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT -DDOVETAIL_COMPILED_CGAL)
[[ " core erased rules storage surfaces partitioners improver mesher sizing finished " != *" $wanted "* ]] || declarations=()
"$compiler" "${flags[@]}" "${declarations[@]}" -fsyntax-only all.cpp
echo "$wanted: $count headers, $(files_of all.d | grep -c "^$work/include/") files of the library are read"

# What these checks are worth, seen once: a header of a module further up, or of another library, is found.
if [[ $wanted != core ]]; then
  rm -rf "$work"
  exit
fi
mkdir other
touch other/library.h
first=include/$(sed -n '1s/.*"\(.*\)"/\1/p' all.cpp)
cp "$first" kept
echo '#include "dovetail/dovetail.hpp"' >>"$first"
if "$compiler" "${flags[@]}" -M -MF broken.d all.cpp 2>said || ! grep -q 'dovetail/dovetail\.hpp' said; then
  echo "that a header of another module is included is no fault"
  exit 1
fi
cp kept "$first"
echo '#include <library.h>' >>"$first"
"$compiler" "${flags[@]}" -isystem other -M -MF broken.d all.cpp
strangers broken.d | grep -qx "$work/other/library\.h" || { echo "a header of another library is no fault"; exit 1; }
rm -rf "$work"
