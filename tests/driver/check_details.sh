#!/bin/bash
# Details of a model that are far smaller than the size: left out, kept, given a length, listed, marked.
#   check_details.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

# A prism of height 10 on a square of 10, one of whose corners is cut off by 0.1: a face 0.14 wide.
cat >"$inputs/cut.off" <<'END'
OFF
10 16 0
0 0 0
10 0 0
10 9.9 0
9.9 10 0
0 10 0
0 0 10
10 0 10
10 9.9 10
9.9 10 10
0 10 10
3 0 2 1
3 0 3 2
3 0 4 3
3 5 6 7
3 5 7 8
3 5 8 9
3 0 1 6
3 0 6 5
3 1 2 7
3 1 7 6
3 2 3 8
3 2 8 7
3 3 4 9
3 3 9 8
3 4 0 5
3 4 5 9
END

figure() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}
# mesh <options...>: a run whose mesh is valid; leaves $left_out, the details in its report, $hash and $least.
mesh() {
  expect_success mesh "$inputs/cut.off" --report report.json "$@"
  "$driver" check "$sandbox/work/out" >"$sandbox/checked" 2>&1 || fault "$(cat "$sandbox/checked")"
  left_out=$(grep -c '"what": ' "$sandbox/work/report.json")
  hash=$(figure mesh_hash)
  least=$(figure min_dihedral_deg)
}
above() { # value, limit
  awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'
}

mesh -s 1
((left_out == 1)) || fault "$left_out details are left out, not 1"
[[ $(figure what) == "narrow face" ]] || fault "it is a $(figure what)"
above "$(figure length)" 0.14 && above 0.15 "$(figure length)" || fault "its width is $(figure length)"
grep -qE 'Narrow faces +1$' "$sandbox/stdout" || fault "the summary does not count it"
above "$least" 12 || fault "the least angle is $least"
without=$hash
"$driver" view "$sandbox/work/out" --report "$sandbox/work/report.json" --png "$sandbox/work/view.png" -o "$sandbox/work/view.html" \
  >"$sandbox/stdout" 2>"$sandbox/stderr"
grep -q '1 x detail left out (green)' "$sandbox/stdout" "$sandbox/stderr" || fault "the view does not mark it"

for option in "--workers 1" "--executor threads" "--executor serial"; do
  mesh -s 1 $option
  [[ $hash == "$without" ]] || fault "another mesh: $hash, not $without"
done
mesh -s 1 --subdomains 5
((left_out == 1)) || fault "$left_out details are left out of five subdomains"

mesh -s 1 --keep-all
((left_out == 0)) || fault "$left_out details are left out"
grep -q 'left out' "$sandbox/stdout" && fault "the summary tells of details"
above 12 "$(sed -n 's/.*"min_face_angle_deg": \([0-9.]*\).*/\1/p' "$sandbox/work/report.json" | head -n 1)" ||
  fault "the narrow face has no narrow triangles"
[[ $hash != "$without" ]] || fault "it is the same mesh"
kept=$hash
mesh -s 1 --suppress 0.1
[[ $left_out == 0 && $hash == "$kept" ]] || fault "a face wider than the length given is left out"
mesh -s 0.3
((left_out == 0)) || fault "a face of half the size is left out"
mesh -s 0.3 --suppress 0.15
((left_out == 1)) || fault "a face narrower than the length given is not left out"
mesh -s 1 --dimension 2
((left_out == 1)) || fault "$left_out details are left out with --dimension 2"
above "$(figure min_dihedral_deg)" 15 || fault "the least angle is $(figure min_dihedral_deg)"

# What was made without details is not gone on with when they are wanted.
expect_success mesh "$inputs/cut.off" -s 1
(cd "$sandbox/work" && "$driver" mesh "$inputs/cut.off" -s 1 --resume) >"$sandbox/stdout" 2>&1
grep -q 'this run is finished' "$sandbox/stdout" || fault "a finished run is made again"
(cd "$sandbox/work" && "$driver" mesh "$inputs/cut.off" -s 1 --resume --keep-all --report kept.json) >"$sandbox/stdout" 2>&1
grep -q "\"mesh_hash\": \"$kept\"" "$sandbox/work/kept.json" || fault "the old mesh is taken for one with all details"

expect_success plan "$inputs/cut.off" -s 1
expect_usage_error "--suppress: 0 is not a length; give a positive number, or --keep-all" mesh nothing.off --suppress 0
expect_usage_error "--suppress: -1 is not a length" plan nothing.off --suppress=-1
expect_usage_error "--suppress: -1 is not a length" compare nothing.off --suppress=-1
expect_usage_error "--suppress.*--keep-all|--keep-all.*--suppress" mesh nothing.off --suppress 1 --keep-all

# A notch that ends just above the lower side: nothing is left out, and automatic sizes fit the narrow place.
echo '<svg><path d="M0 0 L10 0 L10 10 L8 10 L5 0.05 L2 10 L0 10 Z"/></svg>' >"$inputs/notch.svg"
notch() { # options...: leaves $least
  expect_success mesh "$inputs/notch.svg" --dimension 2 --report report.json "$@"
  least=$(figure min_dihedral_deg)
}
notch
above "$least" 20 || fault "the least angle beside the notch is $least"
notch --keep-all
above "$least" 20 || fault "with all details the least angle beside the notch is $least"
notch --elements 300
grep -q 'sizes fit 0 of 1 details .*--elements of at least [56]' "$sandbox/work/report.json" ||
  fault "a detail that needs too many elements is left without a word"
notch --elements 3000
! grep -q 'sizes fit' "$sandbox/work/report.json" || fault "a detail is said to be left that is not"
above "$least" 20 || fault "with 3000 elements the least angle beside the notch is $least"
above "$(figure elements | tr -d ,)" 2700 && above 3300 "$(figure elements | tr -d ,)" || fault "they are $(figure elements)"
notch -s 0.6
above 12 "$least" || fault "a size that was given is another one beside the notch: $least"

((problems == 0)) || exit 1
