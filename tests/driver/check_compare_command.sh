#!/bin/bash
# Comparisons of policies on a small model: table, page, wrong names.
#   check_compare_command.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

write_cube >"$inputs/cube.off"
compare() { expect_success compare "$inputs/cube.off" --workers 1 --out out "$@"; }

# Two partitioners and two improvers, with and without simplification.
compare --size 0.1 --subdomains 4 --partitioners metis,greedy --meshers tetgen --improvers none,native
table=$sandbox/work/out/compare.csv
page=$sandbox/work/out/compare.html
(cd "$sandbox/work/out" && ls) >"$sandbox/listing"
diff "$sandbox/listing" - <<<$'compare.csv\ncompare.html' || fault "other files than expected"
(($(wc -l <"$table") == 9)) || fault "$(wc -l <"$table") lines in the table"
[[ $(sed 's/"[^"]*"/-/g' "$table" | awk -F, '{ print NF }' | sort -u | wc -l) == 1 ]] || fault "lines of different lengths"
column() { # key: the values
  awk -F, -v key="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == key) at = k; next } at { print $at }' "$table"
}
[[ -z $(column error | tr -d '\n') ]] || fault "errors: $(column error)"
for key in elements bad_per_million low_per_million min_dihedral_deg coarse_min_face_deg coarse_min_dihedral_deg \
  fine_min_face_deg fine_min_dihedral_deg fine_under_30 cut imbalance seconds_background seconds_meshing seconds_total; do
  (($(column "$key" | grep -cE '^[0-9]+(\.[0-9]+)?$') == 8)) || fault "no figures in the column $key"
done
[[ $(column simplifier | sort | uniq -c | tr -s ' \n' ' ') == " 4 none 4 paper " ]] ||
  fault "not half of the rows without simplification"
[[ $(column background_reused | sort | uniq -c | tr -s ' \n' ' ') == " 1 no 7 yes " ]] ||
  fault "the background mesh is not shared"
[[ $(column subdomains | sort -u) == 4 ]] || fault "other numbers of subdomains"
# The coarse interfaces depend on partitioner and simplifier only.
awk -F, 'NR > 1 { print $1 "," $4 }' "$table" | paste -d, - <(column cut) | sort -u >"$sandbox/cuts"
(($(wc -l <"$sandbox/cuts") == 4)) || fault "the improver changes the cut"
grep -q "^metis  *tetgen  *native  *none" "$sandbox/stdout" || fault "no table on the terminal"

# Where the figures come from is said with them.
command="dovetail compare $inputs/cube.off --workers 1 --out out --size 0.1 --subdomains 4 --partitioners metis,greedy"
command+=" --meshers tetgen --improvers none,native"
(($(grep -cF "\"$command\"" "$table") == 8)) || fault "the command line is not in every row"
for origin in "$command" "$("$driver" --version)" 'Checksum of cube.off'; do
  grep -qF "$origin" "$page" || fault "not on the page: $origin"
done
grep -qE ',dovetail [0-9.]+ \(meshes of revision [0-9]+\),20[0-9]{2}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z,0\.1,[0-9a-f]{16},[0-9a-f]{16}$' "$table" ||
  fault "version, date, sizes or checksums are not in the table"
mapfile -t hashes < <(awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "mesh_hash") at = k; next } { print $at }' "$table")

# One page with nothing from outside, which has everything without its script and is well-formed.
[[ $(head -n 1 "$page") == "<!DOCTYPE html>" ]] || fault "the page has no doctype"
! grep -qE 'http|src="[^d]|href=' "$page" || fault "the page refers to something outside"
check_static_page() { # of what
  (echo "<body>" && sed '1,/<body>/d; /<script/,$d' "$page" && echo "</body>") >"$static"
  (($(grep -c '<img alt="[^"]*" src="data:image/png;base64,' "$static") == 10)) || fault "not ten pictures of $1"
  (($(grep -c '</svg>' "$static") == 4)) || fault "not four plots of $1"
  (($(grep -c '<tbody><tr>' "$static") == 2)) || fault "not two tables of $1"
  ! sed 's/base64,[^"]*//' "$static" | grep -qwiE 'nan|null|undefined|inf|infinity' ||
    fault "the page of $1 has figures that are none"
  if command -v python3 >/dev/null; then
    python3 -c 'import sys, xml.etree.ElementTree as tree; tree.parse(sys.argv[1])' "$static" 2>"$sandbox/stderr" ||
      fault "the page of $1 is not well-formed"
  fi
}
static=$sandbox/static.html
check_static_page tetrahedra
grep -q 'dihedral' "$static" || fault "the page of tetrahedra has no word of dihedral angles"

# The script sorts: by numbers, up and down again.
if command -v node >/dev/null; then
  node "$(dirname "$0")/sort_page.js" "$page" elements >"$sandbox/sorted" 2>"$sandbox/stderr" || fault "the script of the page fails"
  line() { sed -n "$1p" "$sandbox/sorted" | tr ' ' '\n'; }
  cmp -s <(line 1) <(column elements) || fault "the page has other elements than the table"
  cmp -s <(line 2) <(column elements | sort -n) || fault "a click does not sort"
  cmp -s <(line 3) <(column elements | sort -rn) || fault "a second click does not sort the other way round"
  [[ $(line 4) == said ]] || fault "it is not said that a click sorts"
fi

# The same figures as a run of that combination has, whatever is shared.
elements=$(column elements | sed -n 3p)
expect_success mesh "$inputs/cube.off" --workers 1 --size 0.1 --subdomains 4 --mesher tetgen --format none --report report.json
grep -q "\"elements\": $elements," "$sandbox/work/report.json" || fault "mesh makes other than $elements elements"
grep -q "\"mesh_hash\": \"${hashes[2]}\"" "$sandbox/work/report.json" || fault "mesh makes another mesh than ${hashes[2]}"

# Other rules, and what mesh makes by one of them.
compare --size 0.1 --subdomains 4 --simplifiers none,dihedrals,shape --quiet
[[ $(column simplifier | tr '\n' ' ') == "none dihedrals shape " ]] || fault "other simplifiers than asked for"
elements=$(column elements | sed -n 2p)
expect_success mesh "$inputs/cube.off" --workers 1 --size 0.1 --subdomains 4 --simplifier dihedrals --format none --report report.json
grep -q "\"elements\": $elements," "$sandbox/work/report.json" || fault "mesh makes other than $elements elements"
grep -q '"simplifier": "dihedrals"' "$sandbox/work/report.json" || fault "the report does not name the simplifier"

# Without names the defaults are run; quiet is quiet; sizes follow the number of elements asked for.
compare --elements 3000 --subdomains 2 --quiet
[[ ! -s $sandbox/stdout && ! -s $sandbox/stderr ]] || fault "not quiet"
(($(wc -l <"$table") == 3)) || fault "more than the defaults"
elements=$(column elements | head -n 1)
((elements > 1500 && elements < 6000)) || fault "$elements elements"
expect_success mesh "$inputs/cube.off" --workers 1 --elements 3000 --subdomains 2 --format none --report report.json
grep -q "\"elements\": $elements," "$sandbox/work/report.json" || fault "mesh --elements makes other than $elements elements"
! grep -q "were asked for" "$sandbox/stdout" || fault "a warning about a number that can be had"
expect_success mesh "$inputs/cube.off" --workers 1 --elements 2 --format none
grep -q "about 2 elements were asked for, and about .* are predicted at best" "$sandbox/stdout" || fault "no warning"

# Triangles: a plane domain and the cube's surface, the same table with columns that make sense for them.
cat >"$inputs/square.svg" <<<'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 H10 V10 H0 Z M3 3 V6 H6 V3 Z"/></svg>'
expect_success compare "$inputs/square.svg" --dimension 2 --workers 1 --size 0.5 --subdomains 4 --out out \
  --partitioners metis,greedy --meshers native --improvers none,native
(($(wc -l <"$table") == 9)) || fault "$(wc -l <"$table") lines in the table of triangles"
[[ -z $(column error | tr -d '\n') ]] || fault "errors: $(column error)"
for key in elements bad_per_million low_per_million min_angle_deg mean_min_angle_deg coarse_min_corner_deg \
  coarse_under_50 fine_min_corner_deg fine_under_50 cut imbalance background_elements seconds_total; do
  (($(column "$key" | grep -cE '^[0-9]+(\.[0-9]+)?$') == 8)) || fault "no figures of triangles in the column $key"
done
! head -n 1 "$table" | grep -qE 'dihedral|face' || fault "columns of tetrahedra in the table of triangles"
[[ $(column subdomains | sort -u) == 4 ]] || fault "other numbers of subsurfaces"
awk -F, 'NR > 1 { print $4 }' "$table" | paste -d, - <(column coarse_under_50) >"$sandbox/corners"
! grep -qE '^paper,[1-9]' "$sandbox/corners" || fault "small corners with simplification"
check_static_page triangles
! grep -q 'dihedral\|tetrahedra' "$static" || fault "words about tetrahedra on the page of triangles"
elements=$(column elements | sed -n 3p)
expect_success mesh "$inputs/square.svg" --dimension 2 --workers 1 --size 0.5 --subdomains 4 --partitioner metis \
  --format none --report report.json
grep -q "\"elements\": $elements," "$sandbox/work/report.json" || fault "mesh makes other than $elements triangles"
compare --dimension 2 --elements 2000 --subdomains 2 --quiet
elements=$(column elements | head -n 1)
((elements > 1500 && elements < 3000)) || fault "$elements triangles"
expect_error "there is no 'tetgen'; there are: native" compare "$inputs/square.svg" --dimension 2 --meshers tetgen
expect_error "--dimension" compare "$inputs/square.svg" --dimension 4

# Wrong names and numbers are found before anything runs.
expect_usage_error "there is no 'nonsense'; there are: .*metis" compare "$inputs/cube.off" --partitioners metis,nonsense
expect_usage_error "there is no 'nonsense'; there are: .*tetgen" compare "$inputs/cube.off" --meshers nonsense
expect_usage_error "there is no 'nonsense'; there are: .*native" compare no_such_file.step --improvers native,nonsense
expect_error "no_such_file" compare no_such_file.step
expect_usage_error "--elements" compare "$inputs/cube.off" --elements -5
expect_usage_error "--size" compare "$inputs/cube.off" --elements 5 --size 1
expect_error "cannot create the folder" compare "$inputs/cube.off" --out "$inputs/cube.off"
finish
