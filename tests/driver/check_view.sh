#!/bin/bash
# Pages and pictures of meshes: they are written as a whole and need nothing else; what is wrong is one clear line.
#   check_view.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

write_cube >"$inputs/cube.off"
expect_success mesh "$inputs/cube.off" -s 0.25 --subdomains 3 --format vtu,msh --report run.json --quiet
mv "$sandbox/work/run.json" "$inputs/run.json"
mv "$sandbox/work/out" "$inputs/solid"
expect_success mesh "$inputs/cube.off" --dimension 2 -s 0.25 --subdomains 2 --quiet
mv "$sandbox/work/out" "$inputs/shell"
elements=$("$driver" check "$inputs/solid" | sed -n '1s/.*valid mesh of \([0-9]*\) .*/\1/p')
((elements > 100)) || fault "there are '$elements' elements"

is_png() { # file, width, height as hexadecimal digits
  [[ $(head -c 24 "$1" | od -An -tx1 | tr -d ' \n') == 89504e470d0a1a0a0000000d49484452"$2$3" ]] || fault "$1 is no such PNG"
}
largest() { # the more there is to see, the larger the file
  [[ $(stat -c %s "$1") -gt $(stat -c %s "$2") ]] || fault "$1 is not larger than $2"
}

# Pictures: of all kinds of files, from anywhere, and the same each time.
for mesh in solid solid/mesh.pvtu solid/mesh.msh shell; do
  expect_success view "$inputs/$mesh" --png picture.png --size 320x200
  grep -q "^picture.png: 320 x 200 pixels$" "$sandbox/stdout" || fault "it is not said what was written"
  is_png "$sandbox/work/picture.png" 00000140 000000c8
done
# The same mesh in other files is the same picture; VTU files have the groups of the surface beside them.
other_files=("--ranks 1 --redistribute none --format openfoam" "--ranks 1 --redistribute none --format mfem")
"$driver" mesh --help | grep -q "hdf5" && other_files+=("--format hdf5")
expect_success view "$inputs/solid/mesh.pvtu" --png picture.png --size 320x200 --cut x --colour angle
cp "$sandbox/work/picture.png" "$inputs/first.png"
expect_success view "$inputs/solid/mesh.pvtu" --png picture.png --size 320x200 --colour group
cp "$sandbox/work/picture.png" "$inputs/groups.png"
expect_success view "$inputs/solid/mesh.msh" --png picture.png --size 320x200 --colour group
cmp "$sandbox/work/picture.png" "$inputs/groups.png" || fault "other groups in MSH"
for how in "${other_files[@]}"; do
  expect_success mesh "$inputs/cube.off" -s 0.25 --subdomains 3 $how --quiet
  rm -rf "$inputs/other" && mv "$sandbox/work/out" "$inputs/other"
  expect_success view "$inputs/other" --png picture.png --size 320x200 --cut x --colour angle
  cmp "$sandbox/work/picture.png" "$inputs/first.png" || fault "another picture with $how"
  [[ $how == *hdf5 ]] && continue # which has no groups
  expect_success view "$inputs/other" --png picture.png --size 320x200 --colour group
  cmp "$sandbox/work/picture.png" "$inputs/groups.png" || fault "other groups with $how"
done
# Of second order the corners are drawn, as of the mesh of first order, whether it is read whole or in pieces.
expect_success mesh "$inputs/cube.off" -s 0.25 --subdomains 3 --format vtu,msh --order 2 --quiet
mv "$sandbox/work/out" "$inputs/quadratic"
for mesh in mesh.pvtu mesh.msh; do
  expect_success view "$inputs/quadratic/$mesh" --png picture.png --size 320x200 --cut x --colour angle
  grep -q "$mesh: elements of second order are drawn by their corners, with straight edges$" "$sandbox/stdout" || fault "the order is not said"
  [[ -s $sandbox/stderr ]] && fault "it warns"
  cmp "$sandbox/work/picture.png" "$inputs/first.png" || fault "another picture of second order"
  expect_success view "$inputs/quadratic/$mesh" --png picture.png --size 320x200 --colour group
  cmp "$sandbox/work/picture.png" "$inputs/groups.png" || fault "other groups of second order"
done
expect_success mesh "$inputs/cube.off" --dimension 2 -s 0.25 --subdomains 2 --order 2 --quiet
mv "$sandbox/work/out" "$inputs/quadratic_shell"
expect_success view "$inputs/quadratic_shell" --png picture.png --size 320x200
cp "$sandbox/work/picture.png" "$inputs/shell.png"
expect_success view "$inputs/shell" --png picture.png --size 320x200
cmp "$sandbox/work/picture.png" "$inputs/shell.png" || fault "another picture of triangles of second order"
cp -r "$inputs/solid" "$inputs/alone"
rm "$inputs/alone/surface.vtp"
expect_success view "$inputs/alone/mesh.pvtu" --png picture.png --size 320x200 --colour group
[[ -s $sandbox/stderr ]] && fault "it warns"
cmp -s "$sandbox/work/picture.png" "$inputs/groups.png" && fault "there are groups without a file of them"

expect_success view "$inputs/shell" --png picture.png --size 320x200
cp "$sandbox/work/picture.png" "$inputs/first.png"
expect_success view "$inputs/shell" --png picture.png --size 320x200
cmp "$sandbox/work/picture.png" "$inputs/first.png" || fault "another picture"
for options in "--view front" "--view -30,20" "--cut x" "--cut z=0.3 --colour angle" "--cut view --no-edges" \
  "--explode 0.5 --colour piece" "--under 40" "--colour material"; do
  expect_success view "$inputs/solid/mesh.msh" --png picture.png --size 320x200 $options
  is_png "$sandbox/work/picture.png" 00000140 000000c8
  [[ -s $sandbox/stderr ]] && fault "it warns"
  cmp -s "$sandbox/work/picture.png" "$inputs/before.png" && fault "the same picture as with other options"
  cp "$sandbox/work/picture.png" "$inputs/before.png"
done
expect_success view "$inputs/solid" --png picture.png --under 0.01
grep -q "0 of $elements elements have an angle under 0.01 degrees" "$sandbox/stdout" || fault "the elements are not counted"
grep -q "^warning: picture.png: no element" "$sandbox/stderr" || fault "it does not warn"
# Colours of angles are told, others are not; and where a section meets nothing.
scale="colours of least angles: 0° dark red, .*, 70° blue"
for options in "--colour angle" "--under 40"; do
  expect_success view "$inputs/solid" --png picture.png $options
  grep -q "^$scale" "$sandbox/stdout" || fault "the colours of angles are not told"
done
for options in "--colour piece" "--under 40 --colour piece"; do
  expect_success view "$inputs/solid" --png picture.png $options
  grep -q "^$scale" "$sandbox/stdout" && fault "colours of angles are told"
done
for cut in y=1e9 y=-0.1 z=1.1; do
  expect_success view "$inputs/solid" --png picture.png --size 32x20 --cut $cut
  grep -q "^warning: picture.png: the section $cut is outside of the mesh (${cut%%=*} from 0 to 1)$" "$sandbox/stderr" || fault "it does not warn"
done
expect_success view "$inputs/solid" --png picture.png --size 32x20 --cut y=0.9 --view back
[[ -s $sandbox/stderr ]] && fault "it warns"
expect_success view "$inputs/solid" --png picture.png --no-edges --size 640x480
cp "$sandbox/work/picture.png" "$inputs/plain.png"
expect_success view "$inputs/solid" --png picture.png --size 640x480
largest "$sandbox/work/picture.png" "$inputs/plain.png"

# Marks: of the report of a run, or of one that has some.
expect_success view "$inputs/solid" --png picture.png --size 640x480 --report "$inputs/run.json"
grep -qE "run.json: (no marks|[0-9]+ marks?:)" "$sandbox/stdout" || fault "it is not said what is marked"
[[ -s $sandbox/stderr ]] && fault "it warns"
cat >"$inputs/marks.json" <<'JSON'
{"poor_elements": {"thinnest_wall": {"thickness": 0.1, "at": [0.5, 0.5, 0.5]}},
 "interfaces": {"below_threshold": [{"angle_deg": 9.5, "of": "face", "cause": "forced", "at": [1, 0, 0.5], "cad": ["<face> 3"]}]}}
JSON
expect_success view "$inputs/solid" --png marked.png --size 640x480 --report "$inputs/marks.json"
grep -q "marks.json: 2 marks: 1 x thinnest wall (violet); 1 x interface angle, forced (red); those behind the surface are hollow$" "$sandbox/stdout" || fault "the marks are not counted"
[[ -s $sandbox/stderr ]] && fault "it warns"
cp "$sandbox/work/marked.png" "$inputs/marked.png"
expect_success view "$inputs/solid" --png picture.png --size 640x480
cmp -s "$sandbox/work/picture.png" "$inputs/marked.png" && fault "nothing is marked"
sed 's/0.5, 0.5, 0.5/0.5, 0.5, 50/' "$inputs/marks.json" >"$inputs/far.json"
expect_success view "$inputs/solid" --png picture.png --report "$inputs/far.json"
grep -q "^warning: .*far.json: 1 of 2 marks are outside of the mesh" "$sandbox/stderr" || fault "it does not warn"
expect_success view "$inputs/solid" --png picture.png --explode 0.5 --report "$inputs/marks.json"
grep -q "forced (red); none are in the picture, since its pieces are apart$" "$sandbox/stdout" || fault "it is not said that no mark is drawn"
sed '1s/{/{"elements": 7, /' "$inputs/marks.json" >"$inputs/seven.json"
expect_success view "$inputs/solid" --png picture.png --report "$inputs/seven.json"
grep -q "^warning: .*seven.json: it is of a mesh of 7 elements, and this one has $elements; is this" "$sandbox/stderr" || fault "it does not warn"
printf '{}\n' >"$inputs/other.json"
expect_success view "$inputs/solid" --png picture.png --report "$inputs/other.json"
grep -q "other.json: no marks" "$sandbox/stdout" || fault "it is not said that there are none"
sed 's/9.5/"9.5"/' "$inputs/marks.json" >"$inputs/text.json"
expect_error 'text\.json: interfaces/below_threshold/0/angle_deg is no finite number; give' \
  view "$inputs/solid" --png p.png --report "$inputs/text.json"
for wrong in "cube.off: it is not valid JSON.*" "missing.json: there is no such file" "solid: this is not a file"; do
  expect_error "$wrong; give the JSON file" view "$inputs/solid" --png p.png --report "$inputs/${wrong%%:*}"
done

# What is wrong is said before or instead of a file.
expect_success view --help
for format in VTU PVTU VTP MSH HDF5 MFEM OpenFOAM; do
  grep -q "Mesh file .*\b$format\b" "$sandbox/stdout" || fault "$format is not named"
done
expect_usage_error 'MESH' view "$inputs/solid" -o "$inputs/solid/surface.vtp"
printf 'no mesh at all\n' >"$inputs/text.vtu"
head -c 3000 "$inputs/solid/mesh.msh" >"$inputs/short.msh"
mkdir "$inputs/empty"
for mesh in text.vtu short.msh missing.vtu empty; do
  expect_error "${mesh//./\\.}" view "$inputs/$mesh" --png p.png
done
expect_success view "$inputs/solid" --png new/folder/p.png
[[ -s $sandbox/work/new/folder/p.png ]] || fault "there is no picture in a new folder"
expect_error 'cannot create the folder' view "$inputs/solid" --png "$inputs/text.vtu/new/p.png"
expect_usage_error 'give -o with an HTML file' view "$inputs/solid"
expect_usage_error 'MESH' view --png p.png
expect_usage_error '--view up: give front' view "$inputs/solid" --png p.png --view up
expect_usage_error '--view 1,x: give' view "$inputs/solid" --png p.png --view 1,x
expect_usage_error '--size 10: give WxH' view "$inputs/solid" --png p.png --size 10
expect_usage_error '--size 0x5: give WxH' view "$inputs/solid" --png p.png --size 0x5
for name in p.jpg p png p.png.txt; do
  expect_usage_error "--png $name: pictures are written to files with the extension \.png" view "$inputs/solid" --png "$name"
done
expect_success view "$inputs/solid" --png P.PNG --size 32x20
cp "$inputs/solid/mesh.msh" "$inputs/solid/other.msh"
for name in "$inputs/solid/other.msh" p.vtu p html p.html.gz; do
  expect_usage_error "--out .*: pages are written to files with the extension \.html or \.htm" view "$inputs/solid/mesh.pvtu" -o "$name"
done
cmp "$inputs/solid/mesh.msh" "$inputs/solid/other.msh" || fault "another mesh is overwritten"
rm "$inputs/solid/other.msh"
expect_usage_error '--cut w: give' view "$inputs/solid" --png p.png --cut w
expect_usage_error '--cut x=: give' view "$inputs/solid" --png p.png --cut x=
expect_usage_error '--under' view "$inputs/solid" --png p.png --under 200
expect_usage_error '--most' view "$inputs/solid" -o p.html --most 0
expect_usage_error '--most requires' view "$inputs/solid" --png p.png --most 10
expect_usage_error '--cut requires' view "$inputs/solid" -o p.html --cut x
expect_usage_error 'same file|--png' view "$inputs/solid" -o p.png --png p.png
expect_usage_error 'MESH' view "$inputs/solid/mesh.msh" --png "$inputs/solid/mesh.msh"

# Pages: whole, with nothing from outside; bounded where that is asked for.
run_driver view "$inputs/solid" -o page.html
if grep -q "install libjs-three" "$sandbox/stderr"; then
  expect_error 'install libjs-three' view "$inputs/solid" -o page.html --png p.png
  finish
fi
expect_success view "$inputs/solid" -o PAGE.HTM
for mesh in solid solid/mesh.msh shell; do
  expect_success view "$inputs/$mesh" -o page.html --png picture.png
  page=$sandbox/work/page.html
  grep -q "^page.html: [0-9.]* MB$" "$sandbox/stdout" || fault "it is not said what was written"
  [[ $(head -n 1 "$page") == "<!DOCTYPE html>" && $(tail -n 1 "$page") == "</html>" ]] || fault "the page is not whole"
  grep -qiE '(src|href|action|data) *= *["'\'']?(https?:)?//' "$page" && fault "the page refers to something outside"
  grep -qE '<(link|iframe|img|object|embed|base)[ >]' "$page" && fault "the page loads something"
  grep -q '"count":' "$page" || fault "the page has no data"
  is_png "$sandbox/work/picture.png" 000004b0 00000384
done
expect_success view "$inputs/solid" -o page.html
grep -q "\"count\":$elements," "$sandbox/work/page.html" || fault "the page counts otherwise"
cp "$sandbox/work/page.html" "$inputs/all.html"
expect_success view "$inputs/solid" -o page.html --most 600
grep -qE "only .*of $elements elements inside, half of them the worst; see --most$" "$sandbox/stdout" ||
  fault "it is not said what is left out"
grep -q "of $elements elements inside" "$sandbox/work/page.html" || fault "the page does not say what is left out"
largest "$inputs/all.html" "$sandbox/work/page.html"
grep -q '"secondOrder":false' "$sandbox/work/page.html" || fault "the page is said to be of second order"
expect_success view "$inputs/quadratic" -o page.html
grep -q '"secondOrder":true' "$sandbox/work/page.html" || fault "the page does not know its order"
expect_success view "$inputs/solid" -o page.html --report "$inputs/marks.json"
grep -qF '"text":"interface angle, forced: 9.5\u00b0 of a face; CAD: \u003cface> 3"' "$sandbox/work/page.html" || fault "the page has no marks"
expect_usage_error '--report' view "$inputs/solid" -o "$inputs/marks.json" --report "$inputs/marks.json"
expect_error 'text\.vtu' view "$inputs/text.vtu" -o p.html
expect_success view "$inputs/solid" -o new/folder/p.html
[[ -s $sandbox/work/new/folder/p.html ]] || fault "there is no page in a new folder"
expect_error 'text\.vtu' view "$inputs/text.vtu" -o new/folder/p.html
[[ ! -e $sandbox/work/new ]] || fault "an empty folder is left"
expect_usage_error 'MESH' view "$inputs/solid/mesh.msh" -o "$inputs/solid/mesh.msh"
finish
