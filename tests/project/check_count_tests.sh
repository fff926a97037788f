#!/bin/bash
# scripts/count_tests: a test that could not be run counts as failed, one that skipped itself as skipped.
#   check_count_tests.sh <scripts/count_tests>
set -uo pipefail
results=$(mktemp)
trap 'rm -f "$results"' EXIT

problems=0
expect() { # expected line, expected status
  local line status
  line=$(awk -f "$count_tests" "$results")
  status=$?
  [[ $line == "$1" && $status == "$2" ]] && return
  echo "expected '$1' and status $2, got '$line' and $status"
  problems=1
}
count_tests=$1

passed='<testcase name="a" classname="a" time="1" status="run">
</testcase>'
failed='<testcase name="b" classname="b" time="1" status="fail">
<failure message=""/>
</testcase>'
skipped='<testcase name="c" classname="c" time="1" status="notrun">
<skipped message="SKIP_RETURN_CODE=77"/>
</testcase>'
not_built='<testcase name="d" classname="d" time="1" status="notrun">
<skipped message="Unable to find executable"/>
</testcase>'

printf '%s\n' "$passed" "$passed" "$skipped" >"$results"
expect "2 passed, 0 failed, 1 skipped" 0
printf '%s\n' "$passed" "$failed" "$not_built" "$skipped" >"$results"
expect "1 passed, 2 failed, 1 skipped" 1
: >"$results"
expect "0 passed, 0 failed, 0 skipped" 1
exit $problems
