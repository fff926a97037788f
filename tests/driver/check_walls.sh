#!/bin/bash
# Walls thinner than the sizes: resolved within a number of elements, or given up, which is said.
#   check_walls.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

# 1 x 0.2, so thick.
write_sheet() {
  echo "OFF"
  echo "8 12 0"
  printf '%s\n' "0 0 0" "1 0 0" "1 .2 0" "0 .2 0" "0 0 $1" "1 0 $1" "1 .2 $1" "0 .2 $1"
  printf '3 %s\n' "0 2 1" "0 3 2" "4 5 6" "4 6 7" "0 1 5" "0 5 4" "2 3 7" "2 7 6" "1 2 6" "1 6 5" "0 4 7" "0 7 3"
}
write_sheet 0.0019 >"$inputs/sheet.off"
write_sheet 0.0003 >"$inputs/foil.off"

figure() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1 | grep . ||
    echo "the report has no $1" >>"$sandbox/missing"
}
# mesh <file> <options...>: leaves $elements, $least and $hash
mesh() {
  expect_success mesh "$inputs/$1" --report report.json "${@:2}"
  elements=$(figure elements)
  least=$(figure min_dihedral_deg)
  hash=$(figure mesh_hash)
}
above() { # value, limit
  awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'
}
given_up='walls thinner than about [0-9.e-]+ are meshed with flat elements; to resolve all of them about'

mesh sheet.off
above "$least" 12 || fault "the least angle is $least"
grep -qE "$given_up" "$sandbox/stdout" "$sandbox/stderr" && fault "a wall is given up"
resolved=$elements first=$hash
mesh sheet.off --executor threads
[[ $hash == "$first" ]] || fault "another mesh: $hash, not $first"
expect_success plan "$inputs/sheet.off" --report report.json
predicted=$(figure predicted_elements)
above "$predicted" "$(awk -v n="$resolved" 'BEGIN { print 1.4 * n }')" && fault "$predicted are predicted for $resolved"
above "$predicted" "$(awk -v n="$resolved" 'BEGIN { print 0.6 * n }')" || fault "$predicted are predicted for $resolved"

mesh sheet.off --proximity 0
above "$resolved" $((100 * elements)) || fault "without walls there are $elements elements"
mesh sheet.off --elements 10000
above "$elements" 20000 && fault "$elements elements for 10000"

# Interfaces across a wall have narrow triangles: a mesh with walls is divided later than others.
expect_success plan "$inputs/sheet.off" --elements 1e6 --report report.json
[[ $(figure subdomains) == 1 ]] || fault "a mesh of walls is divided"
expect_success plan "$inputs/sheet.off" --elements 1e6 --proximity 0 --report report.json
[[ $(figure subdomains) == 1 ]] && fault "a mesh that sees no walls is one piece"
expect_success plan "$inputs/sheet.off" --elements 1e6 --partitioner greedy --report report.json
[[ $(figure subdomains) == 1 ]] && fault "a decomposition was asked for, and there is none"

expect_success plan "$inputs/foil.off"
grep -qE "$given_up" "$sandbox/stdout" || fault "the plan says nothing of the wall that is given up"
mesh foil.off
above "$elements" 200000 && fault "there are $elements elements"
grep -qE "$given_up [3-9][0-9.]*e\+06 elements are needed: see --elements" "$sandbox/stdout" "$sandbox/stderr" ||
  fault "it does not say what would resolve the foil"
grep -q 'are in walls thinner than the size' "$sandbox/stdout" "$sandbox/stderr" || fault "bad elements are not told of"

# Many bad elements are told of, whatever their cause: those of a bar that sizes are far too large for.
write_cube | awk 'NR > 2 && NF == 3 { print 10 * $1, 0.01 * $2, 0.01 * $3; next } { print }' >"$inputs/bar.off"
many=' tetrahedra are under 12 degrees; the cause of most is '
expect_success mesh "$inputs/bar.off" --size 0.3 --format none
grep -qE "[0-9]+ of [0-9]+$many'boundary triangle'" "$sandbox/stdout" "$sandbox/stderr" || fault "bad elements are not told of"
expect_success mesh "$inputs/bar.off" --size 0.003 --format none
grep -q "$many" "$sandbox/stdout" "$sandbox/stderr" && fault "good elements are called bad"

[[ ! -e $sandbox/missing ]] || fault "$(cat "$sandbox/missing")"
((problems == 0)) || exit 1
