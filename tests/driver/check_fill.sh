#!/bin/bash
# Filling: the inside of a surface file, each triangle kept with its group and name; faults of a surface are one clear line.
#   check_fill.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

# A solid of a text STL file: a block from one corner to the opposite one, oriented outwards or inwards.
solid() { # name, lower x y z, upper x y z, out or in
  awk -v name="$1" -v lower="$2" -v upper="$3" -v way="$4" 'BEGIN {
    split(lower, l, " "); split(upper, u, " ")
    count = split("0 2 1,0 3 2,4 5 6,4 6 7,0 1 5,0 5 4,2 3 7,2 7 6,1 2 6,1 6 5,0 4 7,0 7 3", triangles, ",")
    print "solid " name
    for (t = 1; t <= count; ++t) {
      split(triangles[t], v, " ")
      if (way == "in") { swap = v[2]; v[2] = v[3]; v[3] = swap }
      print "facet normal 0 0 0\nouter loop"
      for (k = 1; k <= 3; ++k)
        print "vertex", (v[k] % 4 == 1 || v[k] % 4 == 2 ? u[1] : l[1]), (v[k] % 4 >= 2 ? u[2] : l[2]), (v[k] >= 4 ? u[3] : l[3])
      print "endloop\nendfacet"
    }
    print "endsolid " name
  }'
}
solid shell "0 0 0" "4 4 4" out >"$inputs/body.stl"
solid hole "1 1 1" "2 2 2" in >>"$inputs/body.stl"
solid core "2.5 2.5 2.5" "3 3 3" out >>"$inputs/body.stl"

printed() { # label: the value that the summary has
  sed -n "s/^  $1  *\([^ ]*\)$/\1/p" "$sandbox/stdout"
}

# Whatever mesher there is.
"$driver" fill --help >"$sandbox/help"
others=()
for mesher in tetgen hxt; do
  grep -q "mesher: .*$mesher" <(tr -s ' \n' ' ' <"$sandbox/help") && others+=("--mesher $mesher")
done

# To both formats, by each kind of sizes; the checker counts the same.
for out in mesh.vtu mesh.msh; do
  for sizes in "" "-s 0.4" "--growth 0.5" "--improver none" "${others[@]}"; do
    expect_success fill "$inputs/body.stl" -o $out --report report.json $sizes
    [[ $(printed "No. of triangles, each one kept") == 36 ]] || fault "other triangles"
    [[ $(printed "No. of regions") == 2 ]] || fault "other regions"
    [[ $(printed "No. of voids") == 1 ]] || fault "other voids"
    [[ $(printed "Volume") == 63 ]] || fault "another volume"
    elements=$(printed "No. of tetrahedra")
    grep -q "\"elements\": $elements" "$sandbox/work/report.json" || fault "the report counts otherwise"
    cp "$sandbox/work/$out" "$inputs"
    expect_success check "$inputs/$out"
    grep -q "valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "the checker counts otherwise"
  done
done
expect_success fill "$inputs/body.stl" -o mesh.msh
cp "$sandbox/work/mesh.msh" "$inputs"
for name in '2 1 "shell"' '2 2 "hole"' '2 3 "core"' '3 2 "core"'; do
  grep -qa "^$name" "$inputs/mesh.msh" || fault "the group $name is not there"
done

# A name that two materials would have is none's; others keep theirs.
{ solid shell "0 0 0" "4 4 4" out && solid twin "5 0 0" "6 1 1" out && solid twin "7 0 0" "8 1 1" out &&
  solid last "9 0 0" "10 1 1" out; } >"$inputs/twins.stl"
expect_success fill "$inputs/twins.stl" -o mesh.msh
grep -qa '^3 [0-9]* "twin"' "$sandbox/work/mesh.msh" && fault "two materials have one name"
for name in shell last; do
  grep -qa "^3 [0-9]* \"$name\"" "$sandbox/work/mesh.msh" || fault "the material $name has lost its name"
done

# Its own output is a surface too: the same triangles, whose mesh has nothing of the tetrahedra.
expect_success fill "$inputs/mesh.msh" -o again.vtu --void=2.75,2.75,2.75 --quiet
grep -q "only its triangles are used" "$sandbox/stderr" || fault "the tetrahedra are not mentioned"
[[ -s $sandbox/stdout ]] && fault "it is not quiet"
cp "$sandbox/work/again.vtu" "$inputs"
grep -qa 'Name="patch_names"' "$inputs/again.vtu" || fault "the names of the groups are lost"
expect_success check "$inputs/again.vtu"

# Other formats of surfaces; the same mesh by any number of workers.
write_cube >"$inputs/cube.off"
for workers in 1 2; do
  expect_success fill "$inputs/cube.off" -o mesh.vtu -s 0.2 -j $workers
  cp "$sandbox/work/mesh.vtu" "$inputs/by_$workers.vtu"
done
cmp "$inputs/by_1.vtu" "$inputs/by_2.vtu" || fault "another mesh by two workers"
expect_success mesh "$inputs/cube.off" --dimension 2 -s 0.3 --subdomains 1 --format vtu
cp -r "$sandbox/work/out" "$inputs"
expect_success fill "$inputs/out/mesh.pvtu" -o mesh.vtu
[[ $(printed "Volume") == 1 ]] || fault "another volume"

# Orientations that mean nothing.
{ solid a "0 0 0" "4 4 4" in && solid b "1 1 1" "2 2 2" in; } >"$inputs/turned.stl"
expect_success fill "$inputs/turned.stl" -o mesh.vtu
grep -q "^warning: triangle 0 at .*all that is enclosed is filled" "$sandbox/stderr" || fault "no warning"
[[ $(printed "Volume") == 64 ]] || fault "another volume"

# A sheet of triangles far larger than it is thick.
write_cube | sed -E '3,10s/ ([01])$/ 0.0\1/' >"$inputs/sheet.off"
expect_success fill "$inputs/sheet.off" -o mesh.vtu
grep -q "^warning: .* % of the tetrahedra are under 12 degrees" "$sandbox/stderr" || fault "not a word on flat tetrahedra"
expect_success fill "$inputs/cube.off" -o mesh.vtu
grep -q "under 12 degrees" "$sandbox/stderr" && fault "flat tetrahedra in a cube"

# Faults.
expect_error "no_such.stl" fill no_such.stl -o mesh.vtu
sed '/^3 0 2 1$/d; s/^8 12 0/8 11 0/' "$inputs/cube.off" >"$inputs/open.off"
expect_error "open.off: 3 edges have one triangle only: the surface is open; close it: from \(" fill "$inputs/open.off" -o mesh.vtu
sed 's/^8 12 0/8 13 0/' "$inputs/cube.off" >"$inputs/twice.off" && echo "3 0 1 2" >>"$inputs/twice.off"
expect_error "twice.off: a triangle is there more than once" fill "$inputs/twice.off" -o mesh.vtu
{ solid a "0 0 0" "2 2 2" out && solid b "1 1 1" "3 3 3" out; } >"$inputs/crossing.stl"
expect_error "crossing.stl: [0-9]* pairs of triangles cross; cut them" fill "$inputs/crossing.stl" -o mesh.vtu
expect_error "outside of the surface" fill "$inputs/cube.off" -o mesh.vtu --void 5,5,5
expect_error "the sizes predict about" fill "$inputs/cube.off" -o mesh.vtu -s 1e-5
expect_error "larger than the model" fill "$inputs/cube.off" -o mesh.vtu -s 100
expect_error "would overwrite IN|is the same file" fill "$inputs/mesh.msh" -o "$inputs/mesh.msh"
printf '%s\n' OFF "0 0 0" >"$inputs/empty.off"
expect_error "empty.off" fill "$inputs/empty.off" -o mesh.vtu
finish
