#!/bin/bash
# The headers of a module compile where there is nothing but they, those of the modules that it may include, and a compiler. Left
# out are those that need another library (cmake/modules.txt). Header-only, so that all definitions are compiled too. Whatever
# file the compiler has read is one of these, or one that the standard library's headers and POSIX's read by themselves.
#   check_modules.sh <source directory> <work directory> <module> <compiler>
set -euo pipefail
cd "$1"
work=$2
wanted=$3
compiler=$4
source tests/project/modules.sh
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
# What of the standard's and the system's the files say that they include, without what they say it in.
while read -r header; do
  is_system "$header" && printf '#if __has_include(<%s>)\n#include <%s>\n#endif\n' "$header" "$header"
done < <(grep -rhoE '#include <[^>]+>' include | sed 's/.*<//; s/>//' | sort -u) >system.cpp

files_of() { # what a rule for make names, one a line
  tr -s ' \\' '\n\n' <"$1" | sed '1d; /^$/d' | xargs realpath | sort -u
}
flags=(-std=c++20 -Iinclude)
"$compiler" "${flags[@]}" -M -MF system.d system.cpp
files_of system.d >system_files
strangers() { # rule: the files in it that are not the module's, nor the system's
  files_of "$1" | grep -v "^$work/" | comm -23 - system_files
}

"$compiler" "${flags[@]}" -fsyntax-only -MD -MF all.d all.cpp
if found=$(strangers all.d | grep .); then
  echo "the module $wanted reads files that do not come with a compiler:"
  echo "$found"
  exit 1
fi
echo "$wanted: $count headers, $(files_of all.d | grep -c "^$work/include/") files of the library are read"

# What these checks are worth: a header of a module further up, or of another library, is found.
first=$(sed -n '1s/.*"\(.*\)"/\1/p' all.cpp)
cp "include/$first" kept
mkdir other
echo >other/library.h
echo '#include "dovetail/dovetail.hpp"' >>"include/$first"
if "$compiler" "${flags[@]}" -M -MF broken.d all.cpp 2>said; then
  echo "a header that is not there is no fault"
  exit 1
fi
grep -q 'dovetail/dovetail.hpp' said || { cat said; exit 1; }
cp kept "include/$first"
echo '#include <library.h>' >>"include/$first"
mkdir "${work}_other"
trap 'rm -rf "${work}_other"' EXIT
mv other/library.h "${work}_other"
"$compiler" "${flags[@]}" -isystem "${work}_other" -M -MF broken.d all.cpp
strangers broken.d | grep -q 'library\.h$' || { echo "a header of another library is no fault"; exit 1; }
rm -rf "$work"
