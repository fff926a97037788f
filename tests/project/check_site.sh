#!/bin/bash
# The documentation becomes a site by one command, and no link in it leads nowhere.
#   check_site.sh <source directory> <work directory>
set -euo pipefail
cd "$1"
work=$2
page=$(scripts/site "$work")
[[ -s $page ]] || { echo "there is no $page"; exit 1; }
html=$(dirname "$page")
for wanted in library building driver simplification not_in_it concepts/improver source/examples/08_thresholds.cpp; do
  [[ -s $html/$wanted.html ]] || { echo "there is no page $wanted"; exit 1; }
done
problems=0
while IFS=: read -r file link; do
  target=${link#href=\"}
  target=${target%\"}
  target=${target%%#*}
  [[ -z $target || $target =~ ^[a-z]+: || $target == /* ]] && continue
  [[ -e $(dirname "$file")/$target ]] || { echo "$file: $target does not exist"; problems=1; }
done < <(grep -roE 'href="[^"]*"' --include=*.html "$html" | sort -u)
exit $problems
