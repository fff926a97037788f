#!/bin/bash
# A page of `dovetail view` in a browser without a window: what is on the screen. Skipped (exit code 77) where there is no
# Chromium, where it does not start or has no WebGL, and where it takes too long.
#   check_view_in_browser.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
skip() {
  echo "skipped: $1"
  exit 77
}
node --version >/dev/null 2>&1 || skip "node is not installed"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "there is no Chromium"

middle=635,350 # of what is beside the panel

# shot <file> <address behind #>: a picture of the page in $sandbox/shot.png; pixel <x,y> of it. On a busy machine the browser may
# take it before anything is drawn: then again.
shot() {
  local attempt
  for attempt in 1 2 3 4 5; do
    rm -f "$sandbox/shot.png"
    timeout 150 "$browser" --headless --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
      --disable-dev-shm-usage --hide-scrollbars --force-device-scale-factor=1 --window-size=1000,700 --user-data-dir="$sandbox/profile" \
      --virtual-time-budget=$((attempt * 5000)) --screenshot="$sandbox/shot.png" "file://$1#$2" >"$sandbox/browser" 2>&1 </dev/null
    [[ -s $sandbox/shot.png ]] || skip "the browser made no picture in time"
    [[ $(pixel $middle) == "255 255 255" ]] || break
  done
  what="$(basename "$1")#$2"
}
pixel() {
  node "$(dirname "$0")/png_pixels.js" "$sandbox/shot.png" "$1"
}
# expect_shade <x,y> <red> <green> <blue>: the pixel has this colour, brighter or darker, and is no background.
expect_shade() {
  local found
  found=$(pixel "$1")
  awk -v found="$found" -v red="$2" -v green="$3" -v blue="$4" 'BEGIN {
    split(found, c, " ")
    f = (c[1] + c[2] + c[3]) / (red + green + blue)
    exit !(found != "255 255 255" && (c[1] - f * red) ^ 2 + (c[2] - f * green) ^ 2 + (c[3] - f * blue) ^ 2 < 60)
  }' || fault "the pixel at $1 is $found, no shade of $2 $3 $4"
}
expect_pixel() { # <x,y> <colour>
  [[ $(pixel "$1") == "$2" ]] || fault "the pixel at $1 is $(pixel "$1"), not $2"
}

cat >"$sandbox/red.html" <<'HTML'
<body style="margin:0"><canvas id="c" width="1000" height="700"></canvas><script>
const gl = document.getElementById("c").getContext("webgl"); gl.clearColor(1, 0, 0, 1); gl.clear(gl.COLOR_BUFFER_BIT);
</script></body>
HTML
shot "$sandbox/red.html" ""
[[ $(pixel 500,350) == "255 0 0" ]] || skip "the browser has no WebGL"

write_cube >"$inputs/cube.off"
expect_success mesh "$inputs/cube.off" -s 0.3 --subdomains 2 --quiet
cp -r "$sandbox/work/out" "$inputs/cube"
run_driver view "$inputs/cube" -o page.html
grep -q "install libjs-three" "$sandbox/stderr" && skip "the driver was built without three.js"
((status == 0)) || fault "exit code is $status"
page=$inputs/page.html
cp "$sandbox/work/page.html" "$page"

# What is in the corners is white.
plain="edges=0&outline=0"
shot "$page" "$plain"
cp "$sandbox/shot.png" "$sandbox/plain.png"
expect_pixel 990,10 "255 255 255"
expect_pixel 300,600 "255 255 255"
expect_shade $middle 108 164 216
shot "$page" "$plain&cut=x"
expect_shade $middle 214 208 196
shot "$page" "$plain&cut=x&flip=1"
expect_shade $middle 108 164 216
shot "$page" "$plain&colours=angle"
[[ $(pixel $middle) != "255 255 255" ]] || fault "nothing is to be seen"
shot "$page" "outline=0&under=0" # the surface as glass alone
pixel $middle | awk '{ exit !($1 > 200 && $2 > 200 && $3 > 200 && $1 + $2 + $3 < 765) }' || fault "no glass but $(pixel $middle)"
shot "$page" "$plain&apart=2"
cmp -s "$sandbox/shot.png" "$sandbox/plain.png" && fault "no piece has moved"
shot "$page" "$plain&azimuth=0&elevation=90" # and seen along an axis, one side alone
expect_shade $middle 108 164 216
[[ $(pixel $middle) == "$(pixel 600,300)" ]] || fault "a plane side has two shades"

# A mark in the middle of the mesh is over all that is before it.
cat >"$inputs/run.json" <<'JSON'
{"poor_elements": {"thinnest_wall": {"thickness": 0.1, "at": [0.5, 0.5, 0.5]}}}
JSON
expect_success view "$inputs/cube" -o page.html --report "$inputs/run.json"
cp "$sandbox/work/page.html" "$page"
shot "$page" "$plain"
expect_pixel $middle "150 50 200"
expect_shade 650,350 108 164 216
shot "$page" "$plain&marks=0"
expect_shade $middle 108 164 216
finish
