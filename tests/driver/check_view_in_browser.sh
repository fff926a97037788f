#!/bin/bash
# Pages of `dovetail view` in a browser without a window: what is on the screen. Skipped (exit code 77) where the browser has no WebGL.
#   check_view_in_browser.sh <driver> <Chromium>
driver=$1
browser=$2
source "$(dirname "$0")/expectations.sh"
skip() {
  echo "skipped: $1"
  exit 77
}

middle=635,350 # of what is beside the panel
front="205 108 216" top="219 242 121" # colours of groups: each side of the cube is one
declare -A pixels
pixel() { # <picture> <x,y>
  echo "${pixels[$1 $2]}"
}
# expect_shade <picture> <x,y> <red> <green> <blue>: the pixel has this colour, brighter or darker, and is no background.
expect_shade() {
  local found
  found=$(pixel "$1" "$2")
  awk -v found="$found" -v red="$3" -v green="$4" -v blue="$5" 'BEGIN {
    split(found, c, " ")
    f = (c[1] + c[2] + c[3]) / (red + green + blue)
    exit !(found != "255 255 255" && (c[1] - f * red) ^ 2 + (c[2] - f * green) ^ 2 + (c[3] - f * blue) ^ 2 < 60)
  }' || fault "the pixel at $2 of '$1' is $found, no shade of $3 $4 $5"
}
expect_pixel() { # <picture> <x,y> <colour>
  [[ $(pixel "$1" "$2") == "$3" ]] || fault "the pixel at $2 of '$1' is $(pixel "$1" "$2"), not $3"
}

# The pages: one by which WebGL is known, a mesh, and the mesh with a mark in its middle.
cat >"$inputs/red.html" <<'HTML'
<body style="margin:0"><canvas id="c" width="1000" height="700"></canvas><script>
const gl = document.getElementById("c").getContext("webgl"); gl.clearColor(1, 0, 0, 1); gl.clear(gl.COLOR_BUFFER_BIT);
</script></body>
HTML
write_cube >"$inputs/cube.off"
expect_success mesh "$inputs/cube.off" -s 0.3 --subdomains 2 --quiet
cp -r "$sandbox/work/out" "$inputs/cube"
run_driver view "$inputs/cube" -o page.html
grep -q "install libjs-three" "$sandbox/stderr" && skip "the driver was built without three.js"
((status == 0)) || fault "exit code is $status"
cp "$sandbox/work/page.html" "$inputs/mesh.html"
cat >"$inputs/run.json" <<'JSON'
{"poor_elements": {"thinnest_wall": {"thickness": 0.1, "at": [0.5, 0.5, 0.5]}}}
JSON
expect_success view "$inputs/cube" -o page.html --report "$inputs/run.json"
cp "$sandbox/work/page.html" "$inputs/marked.html"
# On the front, where the middle is seen through it.
sed -i 's/0.5, 0.5, 0.5/0.9, 0, 0.8248/' "$inputs/run.json"
expect_success view "$inputs/cube" -o page.html --report "$inputs/run.json"
cp "$sandbox/work/page.html" "$inputs/on_front.html"

what="the pages in $browser"
plain="edges=0&outline=0"
node "$(dirname "$0")/browser_shots.js" "$browser" "$sandbox" $middle 500,350 638,350 650,350 600,300 990,10 300,600 \
  >"$sandbox/stdout" 2>"$sandbox/stderr" <<LIST
red file://$inputs/red.html
plain file://$inputs/mesh.html#$plain
resized file://$inputs/mesh.html#$plain 720 700
cut file://$inputs/mesh.html#$plain&cut=x
flipped file://$inputs/mesh.html#$plain&cut=x&flip=1
angles file://$inputs/mesh.html#$plain&colours=angle
glass file://$inputs/mesh.html#outline=0&under=0
apart file://$inputs/mesh.html#$plain&apart=2
above file://$inputs/mesh.html#$plain&azimuth=0&elevation=90
marked file://$inputs/marked.html#$plain
marked_cut file://$inputs/marked.html#$plain&cut=x
on_front file://$inputs/on_front.html#$plain
unknown file://$inputs/mesh.html#$plain&colours=foo&cut=q&place=bar&apart=&azimuth=west
unmarked file://$inputs/marked.html#$plain&marks=0
LIST
(($? == 0)) || { fault "there are no pictures of all pages"; finish; }
while read -r name place colour; do
  pixels[$name $place]=$colour
done <"$sandbox/stdout"
[[ $(pixel red 500,350) == "255 0 0" ]] || skip "the browser has no WebGL"

# What is in the corners is white.
expect_pixel plain 990,10 "255 255 255"
expect_pixel plain 300,600 "255 255 255"
expect_shade plain $middle $front
expect_shade cut $middle 214 208 196
expect_shade flipped $middle $front
[[ $(pixel angles $middle) != "255 255 255" ]] || fault "nothing is to be seen by angles"
pixel glass $middle | awk '{ exit !($1 > 200 && $2 > 200 && $3 > 200 && $1 + $2 + $3 < 765) }' || fault "no glass but $(pixel glass $middle)"
cmp -s "$sandbox/apart.png" "$sandbox/plain.png" && fault "no piece has moved"
expect_shade above $middle $top # along an axis one side alone is seen
[[ $(pixel above $middle) == "$(pixel above 600,300)" ]] || fault "a plane side has two shades"
# In a window that has changed since then the mesh is fitted again.
cmp -s "$sandbox/resized.png" "$sandbox/plain.png" || fault "the page is another one where the window had another size"
cmp -s "$sandbox/unknown.png" "$sandbox/plain.png" || fault "the page is another one where its address has unknown values"
# A mark is a disc, and has a hole where it is hidden, in which the surface before it is seen.
violet="150 50 200"
expect_pixel on_front $middle "$violet"
expect_pixel on_front 638,350 "$violet"
expect_pixel marked_cut $middle "$violet"
expect_pixel marked 638,350 "$violet"
expect_shade marked $middle $front
expect_shade marked 650,350 $front
expect_shade unmarked $middle $front
finish
