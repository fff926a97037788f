#!/bin/bash
# Every relative link and picture in the documents leads to a file.
set -uo pipefail
problems=0
for document in *.md docs/*.md docs/*/*.md; do
  while IFS= read -r target; do
    [[ $target =~ ^(https?:|#|mailto:) ]] && continue
    [[ -e $(dirname "$document")/${target%%#*} ]] || { echo "$document: $target does not exist"; problems=1; }
  done < <(grep -oE '\]\([^) ]+\)' "$document" | sed 's/^](//; s/)$//')
done
exit $problems
