#!/bin/bash
# Every relative link and picture in the documents, code aside, leads to a file, and what follows a # to a heading in it.
# No file has the marks of a merge.
set -uo pipefail
problems=0

# The anchors of a document: its headings, written as GitHub and MkDocs do.
anchors_of() {
  awk '/^```/ { code = !code } !code && /^#+ / { sub("^#+ +", ""); print }' "$1" |
    sed -E 's/\[([^]]*)\]\([^)]*\)/\1/g; s/`//g' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9_ -]//g; s/ /-/g'
}

for document in *.md docs/*.md docs/*/*.md; do
  while IFS= read -r target; do
    [[ $target =~ ^(https?:|mailto:) ]] && continue
    file=${target%%#*}
    file=${file:+$(dirname "$document")/$file}
    file=${file:-$document}
    [[ -e $file ]] || { echo "$document: $target does not exist"; problems=1; continue; }
    [[ $target == *#* && $file == *.md ]] || continue
    anchors_of "$file" | grep -qxF -- "${target#*#}" || { echo "$document: $target: there is no such heading"; problems=1; }
  done < <(awk '/^```/ { code = !code; next } !code' "$document" | grep -oE '\]\([^) ]+\)' | sed 's/^](//; s/)$//')
done
if grep -rInE '^(<{7}|>{7})( |$)' --exclude-dir='build*' --exclude-dir=.git .; then
  echo "marks of a merge are left"
  problems=1
fi
exit $problems
