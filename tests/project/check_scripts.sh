#!/bin/bash
# Every script can be read by its interpreter, and those that are called by their name may be executed.
set -euo pipefail
status=0
count=0
fail() {
  echo "$*" >&2
  status=1
}
while IFS= read -r file; do
  first=$(head -n 1 "$file" | tr -d '\0')
  case $file:$first in
  *.py:* | *:'#!'*python3) python3 -c 'import sys; compile(open(sys.argv[1]).read(), sys.argv[1], "exec")' "$file" ||
    fail "$file: not Python" ;;
  *.sh:* | *:'#!'*bash) bash -n "$file" || fail "$file: not a shell script" ;;
  *) continue ;;
  esac
  if [[ $first == '#!'* && $file == @(benchmarks|scripts)/* ]]; then # a file without such a line is imported
    [[ $first == '#!/'[a-z]* ]] || fail "$file: its first line names no interpreter"
    [[ -x $file ]] || fail "$file: may not be executed"
  fi
  count=$((count + 1))
done < <(find . \( -name .git -o -name __pycache__ -o -path './build*' \) -prune -o -type f -print | sed 's|^\./||' | sort)
[[ $count -gt 50 ]] || fail "only $count scripts were found"
exit "$status"
