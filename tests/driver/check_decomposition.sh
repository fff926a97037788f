#!/bin/bash
# The domain divided otherwise than by a coarse mesh: a mesh like any other, the same for any workers and after a stop.
#   check_decomposition.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
write_cube >"$inputs/cube.off"

figure() { # the first with this key in the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}
positive() {
  awk -v value="$1" 'BEGIN { exit !(value > 0) }'
}

# What each of them has to do.
#   check_contract NAME STAGE SUMMARY TRACE: the report's name of its stage, the row in the summary, the stage in the trace
check_contract() {
  local divided=(mesh "$inputs/cube.off" --size 0.1 --subdomains 6 --decomposition "$1" --report report.json) hash stage
  # One mesh, whole and valid, with the times of what was done.
  expect_success "${divided[@]}" --workers 2 --trace trace.json
  hash=$(figure mesh_hash)
  [[ $(figure decomposition) == "$1" ]] || fault "the report names another decomposition"
  (($(figure subdomains) >= 6)) || fault "only $(figure subdomains) subdomains"
  (($(figure background_elements) == 0)) || fault "a background mesh"
  awk -v angle="$(figure min_dihedral_deg)" 'BEGIN { exit !(angle > 0 && angle < 180) }' || fault "no angle of interfaces"
  for stage in background skeleton "$2" meshing improvement total; do
    positive "$(figure "$stage")" || fault "no time of $stage"
  done
  for stage in simplification partition; do
    positive "$(figure $stage)" && fault "a time of $stage, which there is not"
  done
  grep -q "$3" "$sandbox/stdout" || fault "no row '$3' in the summary"
  grep -q "\"name\": \"$4\"" "$sandbox/work/trace.json" || fault "no $4 in the trace"
  rm -rf "$inputs/out"
  mv "$sandbox/work/out" "$sandbox/work/report.json" "$inputs"
  expect_success check "$inputs/out/mesh.pvtu"
  expect_success check --report "$inputs/report.json"
  expect_success "${divided[@]}" --workers 1
  [[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh by one worker"
  diff -rq "$inputs/out" "$sandbox/work/out" | grep -v finished_run && fault "other files by one worker"
  expect_success mesh "$inputs/cube.off" --size 0.1 --subdomains 6 --report report.json
  [[ $(figure mesh_hash) != "$hash" && $(figure decomposition) == simplification ]] || fault "not the other decomposition by default"
  positive "$(figure "$2")" && fault "a time of $2 by default"

  # What comes after: ranks, with pieces as they are and cut, and the second order.
  expect_success "${divided[@]}" --ranks 3
  [[ -s $sandbox/work/out/ranks_0002.vtu ]] || fault "no file of the last rank"
  expect_success "${divided[@]}" --ranks 5 --redistribute by-elements --partitioner metis --format none --improve-again
  for stage in redistribution first_pass; do
    positive "$(figure $stage)" || fault "no time of $stage"
  done
  expect_success "${divided[@]}" --order 2 --format vtu,msh
}
check_contract bisection bisection "Bisection of the fine surface" "recursive bisection"
check_contract fine-partition fine_partition "Partition of the fine mesh" "fine partition"

# Without a number of subdomains it is the number of faces that counts, and a small surface stays whole.
expect_success mesh "$inputs/cube.off" --size 0.1 --decomposition bisection --format none --report report.json
(($(figure subdomains) == 1)) || fault "$(figure subdomains) subdomains of a small surface"

# A run that is stopped goes on, and one that is finished has nothing left to do.
long=(mesh "$inputs/cube.off" --size 0.018 --subdomains 8 --decomposition bisection --out "$inputs/long" --report report.json)
expect_success "${long[@]}" --format none
hash=$(figure mesh_hash)
rm -rf "$inputs/long"
what="${long[*]}, stopped"
: >"$sandbox/stderr"
(cd "$sandbox/work" && exec "$driver" "${long[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null) &
job=$!
for ((tenths = 0; tenths < 10000; ++tenths)); do
  compgen -G "$inputs/long/spool/piece_*.blob" >/dev/null && break
  sleep 0.1
done
kill -TERM $job || fault "it had ended before"
wait $job
status=$?
((status == 130)) || fault "exit code is $status"
cp "$sandbox/stderr" "$inputs/stopped"
grep -q -- "--resume goes on" "$inputs/stopped" || fault "that another run can go on is not said"
expect_error "decomposition" mesh "$inputs/cube.off" --size 0.018 --subdomains 8 --out "$inputs/long" --resume
expect_success "${long[@]}" --resume
[[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh after a stop"
expect_success "${long[@]}" --resume
grep -q "this run is finished" "$sandbox/stdout" || fault "a finished run is made again"

# Another seed of the partitioner, by its name, makes another mesh; its own makes the same.
declare -A hash_by
for partitioner in metis metis:1 metis:2; do
  expect_success mesh "$inputs/cube.off" --size 0.1 --subdomains 6 --partitioner $partitioner --report report.json --format none
  hash_by[$partitioner]=$(figure mesh_hash)
  [[ $(figure partitioner) == "$partitioner" ]] || fault "the report names another partitioner"
done
[[ ${hash_by[metis]} == "${hash_by[metis:1]}" ]] || fault "another mesh from the partitioner's own seed"
[[ ${hash_by[metis]} != "${hash_by[metis:2]}" ]] || fault "the same mesh from another seed"
expect_usage_error "there is no 'hilbert:2'; there are: metis:2, .*greedy:2" mesh "$inputs/cube.off" --size 0.1 --partitioner hilbert:2
expect_usage_error "after the colon of 'metis:two' there is no seed" mesh "$inputs/cube.off" --size 0.1 --partitioner metis:two

# Each thing that is added to the paper's method can be left out, and --paper leaves out all of them; what is given stays.
shown=(mesh "$inputs/cube.off" --size 0.1 --subdomains 6 --mesher native --format none --report report.json)
expect_success "${shown[@]}"
hash=$(figure mesh_hash)
positive "$(figure matched_lines)" || fault "no lines are matched"
[[ $(figure weight_bound) != null ]] || fault "no bound"
expect_success "${shown[@]}" --super-element-bound off
[[ $(figure weight_bound) == null ]] || fault "a bound of $(figure weight_bound)"
expect_success "${shown[@]}" --weights equal
[[ $(figure mesh_hash) != "$hash" ]] || fault "the mesh of predicted weights"
expect_success "${shown[@]}" --segment-matching off
positive "$(figure matched_lines)" && fault "lines are matched"
positive "$(figure repartition_rounds)" || fault "nothing is moved in place of it"
expect_success "${shown[@]}" --segment-matching off --local-repartition off
positive "$(figure repartition_rounds)" && fault "interfaces are moved"
expect_success "${shown[@]}" --partitioner metis --simplifier paper --background-improver none --weights equal \
  --super-element-bound off --segment-matching off --local-repartition off
hash=$(figure mesh_hash)
expect_success "${shown[@]}" --paper
[[ $(figure mesh_hash) == "$hash" ]] || fault "--paper is not its choices"
[[ $(figure weight_bound) == null ]] || fault "--paper has a bound of $(figure weight_bound)"
expect_success "${shown[@]}" --paper --partitioner metis:2
[[ $(figure partitioner) == metis:2 ]] || fault "--paper takes back what was given"
expect_usage_error "--segment-matching: with --dimension 2 there are no faces" \
  mesh "$inputs/cube.off" --dimension 2 --segment-matching off

check_mesh() { # the one that was just made
  rm -rf "$inputs/out"
  mv "$sandbox/work/out" "$inputs"
  expect_success check "$inputs/out"
}

# Pieces by themselves are those of the whole mesh, any order, workers and formats.
some=(mesh "$inputs/cube.off" --size 0.1 --subdomains 6 --report report.json)
expect_success "${some[@]}"
elements=$(figure elements)
sides=$(figure boundary_triangles)
sum=0
sum_of_sides=0
for only in 0 1-2,4 5,3; do
  expect_success "${some[@]}" --only $only
  (($(figure of_subdomains) == 6)) || fault "of $(figure of_subdomains) subdomains"
  sum=$((sum + $(figure elements)))
  sum_of_sides=$((sum_of_sides + $(figure boundary_triangles)))
  check_mesh
done
((sum == elements)) || fault "$sum elements in pieces, and $elements in all"
((sum_of_sides == sides)) || fault "$sum_of_sides triangles of pieces on the surface, and $sides in all"
expect_success "${some[@]}" --out "$inputs/piece" --only 1
expect_success "${some[@]}" --out "$inputs/piece" --only 2 --resume # the run before is another one
grep -q "this run is finished" "$sandbox/stdout" && fault "another piece is taken for the one that is there"
expect_success "${some[@]}" --out "$inputs/piece" --only 2 --resume
grep -q "this run is finished" "$sandbox/stdout" || fault "a finished piece is made again"
expect_success "${some[@]}" --only 5,3 --only 3 --workers 1
(($(figure subdomains) == 2)) || fault "$(figure subdomains) pieces of two"
hash=$(figure mesh_hash)
expect_success "${some[@]}" --only 3,5 --format msh,hdf5
[[ $(figure mesh_hash) == "$hash" ]] || fault "other pieces in another order"
check_mesh
expect_success mesh "$inputs/cube.off" --size 0.1 --only 0 --format none --report report.json # a mesh of one piece
[[ $(figure of_subdomains) == 1 ]] || fault "a mesh of one piece is divided for --only"
expect_error "there is no subdomain 6: there are 6, numbered from 0" "${some[@]}" --only 2,6
expect_error "there is no subdomain 2147483646: there are 6" "${some[@]}" --only 2147483646-2147483647

# Alone, as in the whole mesh without local repartition.
many=(mesh "$inputs/cube.off" --size 0.04 --subdomains 150 --report report.json)
expect_success "${many[@]}" --only 3,5 --local-repartition off
hash=$(figure mesh_hash)
of_whole=$(figure faces)
expect_success "${many[@]}" --only 3,5 --alone
[[ $(figure mesh_hash) == "$hash" ]] || fault "other pieces when they are made alone"
(($(figure faces) < of_whole / 2)) || fault "$(figure faces) triangles of interfaces around two pieces, and $of_whole in all"
check_mesh
expect_success mesh "$inputs/cube.off" --size 0.1 --subdomains 1 --only 0 --alone --format none
expect_success "${some[@]}" --out "$inputs/alone" --only 2 --local-repartition off
expect_success "${some[@]}" --out "$inputs/alone" --only 2 --alone --resume # the run before is another one
grep -q "this run is finished" "$sandbox/stdout" && fault "a piece made alone is taken for one that was not"
expect_usage_error "--alone: give the subdomains with --only" mesh nothing.off --alone
expect_usage_error "--alone is for tetrahedra" mesh nothing.off --alone --only 1 --dimension 2
expect_usage_error "--alone: which interfaces --local-repartition moves" mesh nothing.off --alone --only 1 --local-repartition on
for list in x 3-1 1- 2x 1.5 99999999999; do
  expect_usage_error "--only: '$list' is neither the number of a subdomain nor a range like 12-15" mesh nothing.off --only $list
done
expect_usage_error "--only: these are more than 10000000 subdomains" mesh nothing.off --only 0-99999999
expect_usage_error "--only: --ranks divides whole meshes" mesh nothing.off --only 1 --ranks 2
expect_usage_error "--only: where middles of edges are depends on the other pieces" mesh nothing.off --only 1 --order 2
expect_usage_error "--only: the trace of some pieces" mesh nothing.off --only 1 --trace t.json
expect_success mesh --size 0.1 --subdomains 6 --format none --only 1,2 "$inputs/cube.off" # the list ends before the input
expect_usage_error "--decomposition bisection cannot make pieces by themselves" mesh nothing.off --decomposition bisection --only 1

# What has no part in it is refused before anything is read.
bad=(mesh nothing.off --decomposition bisection)
expect_usage_error "--decomposition: there is no 'halves'; there are: simplification, bisection, fine-partition" \
  mesh nothing.off --decomposition halves
expect_usage_error "--decomposition bisection divides solids; with --dimension 2" "${bad[@]}" --dimension 2
expect_usage_error "--decomposition fine-partition has no background mesh: --simplifier does nothing there" \
  mesh nothing.off --decomposition fine-partition --simplifier none
for option in --paper "--weights equal" "--super-element-bound off" "--segment-matching off" "--local-repartition off" "--coarsening 3" "--background-mesher native" "--background-improver none" "--simplifier none" "--dihedral-angle 20" "--partitioner metis"; do
  expect_usage_error "--decomposition bisection has no background mesh: ${option% *} does nothing there" "${bad[@]}" $option
done
expect_usage_error "--decomposition bisection with --ranks: give --subdomains, or --redistribute by-elements" "${bad[@]}" --ranks 3
finish
