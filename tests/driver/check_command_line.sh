#!/bin/bash
# Wrong command lines.
#   check_command_line.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

expect_success --help
expect_success --version
grep -qE '^dovetail [0-9.]+ \(meshes of revision [0-9]+\)$' "$sandbox/stdout" || fault "no version, or no revision"
expect_success mesh --help
expect_success models
grep -q aircraft "$sandbox/stdout" || fault "the aircraft is not listed"

expect_usage_error "required|subcommand"
expect_usage_error "not expected|nonsense" nonsense
expect_usage_error "nonsense.*see dovetail mesh --help" mesh --nonsense
expect_usage_error "nonsense.*see dovetail plan --help" plan --model combustor --mesher nonsense
expect_usage_error "nonsense" mesh --model nonsense
expect_usage_error "nonsense.*tetgen" mesh --model combustor --mesher nonsense
expect_usage_error "nonsense.*native" mesh --model combustor --dimension 2 --mesher nonsense
expect_usage_error "nonsense.*metis" mesh --model combustor --partitioner nonsense
expect_usage_error "nonsense.*native" mesh --model combustor --improver nonsense
expect_usage_error "nonsense.*processes" mesh --model combustor --executor nonsense
expect_usage_error "nonsense.*vtu" mesh --model combustor --format nonsense
expect_usage_error "tetgen.*threads" mesh --model combustor --mesher tetgen --executor threads
expect_usage_error "--workers" mesh --model combustor --workers -1
expect_usage_error "--workers" mesh --model combustor --workers two
expect_usage_error "--subdomains" mesh --model combustor --subdomains 0
expect_usage_error "--subdomains" mesh --model combustor --subdomains -4
expect_usage_error "--elements: -5 is not a number of elements" mesh --model combustor --elements -5
expect_usage_error "excludes|--size" plan --model combustor --elements 5 --size 1
expect_usage_error "--files" mesh --model combustor --files -1
expect_usage_error "--coarsening" mesh --model combustor --coarsening 0
expect_usage_error "not both" mesh part.step --model combustor
expect_usage_error "excludes|sizing" mesh --model combustor --size 1 --sizing sizing.json
expect_usage_error "required|MESH" check
expect_usage_error "required|MESH" stats
expect_usage_error "required" improve
expect_usage_error "required|--out" improve mesh.vtu
expect_usage_error "required|--out" fill part.stl
expect_usage_error "extension" fill part.stl -o mesh.stl
expect_usage_error "excludes|sizing" fill part.stl -o mesh.vtu --size 1 --sizing sizes.json
expect_usage_error "--void: '1,2' is not a point; give x,y,z" fill part.stl -o mesh.vtu --void=1,2
expect_usage_error "--growth: 0 is not a growth" fill part.stl -o mesh.vtu --growth 0
expect_usage_error "--mesher: there is no 'nonsense'; there are: .*native" fill part.stl -o mesh.vtu --mesher nonsense
expect_usage_error "required|--out" adapt mesh.vtu --size 1
expect_usage_error "--sizes, --size or --sizing" adapt mesh.vtu -o next.vtu
expect_usage_error "excludes|sizes" adapt mesh.vtu -o next.vtu --sizes h --size 1
expect_usage_error "extension" adapt mesh.vtu -o next.png --sizes h
expect_usage_error "--feature-angle" adapt mesh.vtu -o next.vtu --sizes h --feature-angle -1

for size in 0 -1 nan -nan inf 1e-400; do
  expect_usage_error "--size" mesh no_such_file.step --size=$size
  expect_usage_error "--size" plan --model combustor --size=$size
  expect_usage_error "--size" compare --model combustor --size=$size
  expect_usage_error "--size" fill no_such_file.stl -o next.vtu --size=$size
  expect_usage_error "--size" adapt no_such_file.vtu -o next.vtu --size=$size
done
expect_usage_error "--size" mesh --model combustor --size large
for option in --curvature --proximity --growth; do
  for value in -1 nan inf 1001 many; do
    expect_usage_error "$option" plan no_such_file.step $option=$value
  done
  expect_usage_error "excludes|sizing" mesh no_such_file.step --sizing sizes.json $option 1
  expect_usage_error "plane domain, without curved faces" mesh no_such_file.svg --dimension 2 $option 1
done
expect_usage_error "--growth" compare no_such_file.step --growth 0
expect_usage_error "--preset: there is no 'nonsense'; there are: .*hard" \
  improve no_such_file.vtu -o better.vtu --preset nonsense
expect_usage_error "--dimension 2" mesh no_such_file.svg

# A variable of a script that is not set does not mean the default.
expect_usage_error "INPUT: the value is empty" mesh ""
for option in --size --sizing --mesher --model --out --report; do
  expect_usage_error "$option: the value is empty" mesh no_such_file.step $option ""
done
expect_usage_error "MESH: the value is empty" stats ""
expect_usage_error "give a mesh file, or --report" check

# A sizing file is looked at before the model is; what it says of a model or a mesh, when that is there.
echo '{ "size": 1, "soruces": [] }' >"$inputs/misspelt.json"
echo '{ "curvature": 0 }' >"$inputs/zero.json"
echo '{ "background": { "file": "no_such_mesh.vtu" }, "gradation": 0.3 }' >"$inputs/background.json"
expect_error 'misspelt.json:1: unknown key "soruces"' mesh no_such_file.step --sizing "$inputs/misspelt.json"
echo '{ "size": 1, "gradation": { "relative_error": 1e-9 } }' >"$inputs/exact.json"
expect_error 'exact.json:1: "relative_error" is 1e-09; give at least 0.001' mesh no_such_file.step --sizing "$inputs/exact.json"
expect_error 'zero.json:1: "curvature" is 0' mesh no_such_file.step --sizing "$inputs/zero.json"
expect_error "no_such.json: the sizing file cannot be read" mesh no_such_file.step --sizing no_such.json
expect_error "no_such_file.step: there is no such file" mesh no_such_file.step --sizing "$inputs/background.json"
expect_error "no_such_mesh.vtu" mesh --model combustor --sizing "$inputs/background.json"

# What a model decides is an error of another kind.
expect_error "larger than the model" mesh --model combustor --size 1e9
((status == 1)) || fault "exit code is $status, not 1"
expect_error "--size: 1e-20 is less" mesh --model combustor --size 1e-20
echo '{ "size": 1e-300 }' >"$inputs/tiny.json"
echo '{ "proximity": 1e9 }' >"$inputs/across.json"
expect_error "sizes down to 1e-300, less than a billionth" mesh --model combustor --sizing "$inputs/tiny.json"
expect_error 'across.json:1: "proximity" is 1e\+09; give .* at most 1000' mesh --model combustor --sizing "$inputs/across.json"
expect_error "100000000 subdomains are more than" mesh --model combustor --subdomains 100000000
write_cube >"$inputs/cube.off"
expect_error "more than any machine can hold" plan "$inputs/cube.off" --size 3e-9

# NaN is in no range.
for option in "view mesh.vtu --png view.png --explode" "view mesh.vtu --png view.png --under" "adapt mesh.vtu -o next.vtu --size 1 --feature-angle" \
  "simulate trace.json --workers 2 --latency" "mesh no_such_file.step --coarsening"; do
  expect_usage_error "${option##* }: .*nan is no decimal number" $option nan
done
expect_usage_error "0x10 is no decimal number" mesh no_such_file.step -s 0x10

# As few elements as a model allows, where fewer are wanted.
elements_for() { # number: sets $made
  expect_success mesh "$inputs/cube.off" --elements "$1" --format none --report report.json
  made=$(grep -oE '"elements": [0-9]+' "$sandbox/work/report.json" | head -1 | grep -oE '[0-9]+')
}
elements_for 200
most=$made
for few in 1 5; do
  elements_for $few
  ((made <= most)) || fault "$made elements for $few, $most for 200"
done

# A small mesh is one piece, unless something is said that only a decomposition is for.
planned() { # subdomains, options
  expect_success plan "$inputs/cube.off" --size "$2" "${@:3}" --report plan.json
  grep -qE "\"subdomains\": $1[,}]" "$sandbox/work/plan.json" || fault "not $1 subdomains"
}
planned 1 0.026
planned "[1-9][0-9]" 0.02
for options in "--partitioner greedy" "--simplifier none" "--coarsening 2" "--dihedral-angle 20" "--background-improver none"; do
  planned "[1-9][0-9]" 0.026 $options
done
planned 3 0.026 --subdomains 3
# Workers without a piece take no time away.
seconds() { grep -o '"predicted_seconds": [0-9.e+-]*' "$sandbox/work/plan.json"; }
planned 1 0.026 --workers 1 && alone=$(seconds)
planned 1 0.026 --workers 8
[[ -n $alone && $(seconds) == "$alone" ]] || fault "8 workers take another time for one piece than one does"
planned 3 0.026 --subdomains 3 --workers 8
[[ $(seconds) != "$alone" ]] || fault "3 workers are as slow as one"

# Without sizes the model's curvature and walls decide, for at most 2 million elements.
predicted() {
  expect_success plan "$inputs/cube.off" "$@" --report plan.json
  count=$(grep -o '"predicted_elements": [0-9]*' "$sandbox/work/plan.json" | tr -dc 0-9)
  ((${count:-0} > 0)) || fault "no elements are predicted"
}
predicted && by_default=$count
predicted --proximity 20
((count > 10 * by_default)) || fault "20 elements across the cube give $count, after $by_default"
predicted --proximity 0
((count > by_default / 2 && count < by_default * 2)) || fault "the largest size gives $count, not about $by_default"
predicted --proximity 150
((count > 1700000 && count <= 2000000)) || fault "$count is not nearly 2 million"
predicted --proximity 20 --size 0.012
((count > 2100000)) || fault "a size is given, and $count elements are bounded all the same"
predicted --proximity 0 --size 0.1
((count > 8000 && count < 16000)) || fault "the size given is the largest: $count"

# The examples at the end of each help are command lines: what is missing are their files.
examples=0
for command in mesh plan check stats view improve fill adapt compare; do
  mapfile -t lines < <("$driver" $command --help | sed -n '/^Examples:/,$ s/^  dovetail //p')
  ((${#lines[@]})) || { what="$command --help"; fault "there is no example"; }
  for line in "${lines[@]}"; do
    expect_error 'wing|plate|sizes|mesh' $line
    ((status == 1)) || fault "the example is a wrong command line"
    examples=$((examples + 1))
  done
done
((examples >= 8)) || fault "there are $examples examples only"
finish
