#!/bin/bash
# Files for the ranks of a parallel solver: the same for any workers, and read by somebody else's reader.
#   check_ranks.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
reader=$(dirname "$0")/../files/check_rank_files.py

write_cube >"$inputs/cube.off"
small=(mesh "$inputs/cube.off" --size 0.15 --improver none)

counter() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}

# More ranks than workers, and other files beside; one worker writes the same.
expect_success "${small[@]}" --subdomains 8 --workers 2 --ranks 3 --format pvtu,vtu --report report.json
elements=$(counter elements)
hash=$(counter mesh_hash)
[[ $(counter ranks) == 3* && $(counter pieces) == 8* ]] || fault "the redistribution is not in the report"
(cd "$sandbox/work/out" && echo ranks*) >"$sandbox/listing"
grep -qx "ranks.pvtu ranks_0000.vtu ranks_0001.vtu ranks_0002.vtu" "$sandbox/listing" ||
  fault "other files than expected"
[[ -e $sandbox/work/out/mesh.pvtu && ! -e $sandbox/work/out/spool ]] || fault "not as without ranks"
rm -rf "$inputs/ranks" && cp -r "$sandbox/work/out" "$inputs/ranks"
if /usr/bin/python3 -c 'import numpy, vtkmodules.vtkIOXML' 2>/dev/null; then
  said=$(/usr/bin/python3 "$reader" pvtu "$inputs/ranks" 3) || fault "VTK finds no mesh in the files of ranks"
  [[ $said == "$elements elements, "*" measure 1.000000000,"* ]] || fault "VTK says: $said"
fi
expect_success "${small[@]}" --subdomains 8 --workers 1 --ranks 3 --report report.json # pvtu is the default
[[ $(counter mesh_hash) == "$hash" ]] || fault "another mesh by one worker"
for file in ranks.pvtu ranks_0000.vtu ranks_0001.vtu ranks_0002.vtu; do
  cmp -s "$inputs/ranks/$file" "$sandbox/work/out/$file" || fault "another $file by one worker"
done
expect_success "${small[@]}" --subdomains 8 --ranks 2 --redistribute none --report report.json
[[ $(counter largest_rank) =~ ^[1-9] ]] || fault "no elements of ranks"
expect_success "${small[@]}" --ranks 3 --report report.json # which would be one piece otherwise
[[ $(counter subdomains) == 3 ]] || fault "not a subdomain for each rank"
expect_success "${small[@]}" --subdomains 8 --ranks 2 --redistribute by-elements --format none --report report.json
[[ $(counter seams_before) =~ ^[1-9] ]] || fault "the redistribution by elements is not in the report"
expect_success "${small[@]}" --subdomains 8 --ranks 2 --format msh-ranks,openfoam
expect_files="ranks_1.msh ranks_2.msh processor0/constant/polyMesh/boundary processor1/constant/polyMesh/faces"
for file in $expect_files; do
  [[ -s $sandbox/work/out/$file ]] || fault "no $file"
done
expect_success "${small[@]}" --subdomains 8 --ranks 2 --format mfem,pvtu --ghosts
[[ -s $sandbox/work/out/mesh.000001 ]] || fault "no mesh.000001"
grep -q 'GhostLevel="1"' "$sandbox/work/out/ranks.pvtu" || fault "no ghosts"
expect_success mesh "$inputs/cube.off" --size 0.15 --dimension 2 --subdomains 4 --ranks 2

# Whoever is given a part of such a mesh judges the whole, or says that it is a part.
formats=pvtu,vtu,msh-ranks,mfem,openfoam
"$driver" mesh --help | grep -q "xdmf" && formats+=,xdmf,vtkhdf,hdf5
expect_success "${small[@]}" --subdomains 8 --ranks 4 --ghosts --format "$formats" --report report.json
elements=$(counter elements)
of_run=$(at_interfaces | without_angles)
set=$inputs/set
mv "$sandbox/work/out" "$set"
for file in ranks_1.msh ranks_4.msh; do
  expect_success check "$set/$file"
  grep -q "ranks_1.msh to ranks_4.msh: a valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "not the whole mesh"
  expect_success stats "$set/$file" --report report.json
  [[ $(counter elements) == "$elements" ]] || fault "not the figures of the whole mesh"
done
expect_success check "$set"
judged=(mesh.pvtu ranks.pvtu "ranks_1.msh to ranks_4.msh" "mesh.000000 to mesh.000003" set)
[[ ! -e $set/ranks.h5 ]] || judged+=(mesh.xdmf ranks.xdmf ranks.vtkhdf)
for file in "${judged[@]}"; do
  grep -q "/$file: a valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "not judged: $file"
done
(($(grep -c ": a valid mesh" "$sandbox/stdout") == ${#judged[@]})) || fault "not ${#judged[@]} meshes"

# Elements at interfaces: between the subdomains where files name them, otherwise between the ranks.
of_ranks=
for file in "${judged[@]}"; do
  [[ $file != set ]] || file=processor0
  expect_success stats "$set/${file%% *}" --report report.json
  found=$(at_interfaces | without_angles)
  case $file in
    *.msh | mesh.000000* | processor0)
      [[ -n $found && $found != "$of_run" && ${of_ranks:=$found} == "$found" ]] || fault "other interfaces of ranks" ;;
    *) [[ $found == "$of_run" ]] || fault "other figures at interfaces than the run's: $found" ;;
  esac
done

# So it is with other formats, by any of their files; a damaged one is named.
others=(mesh.000001 processor1 processor1/constant processor2/constant/polyMesh/faces)
[[ ! -e $set/ranks.h5 ]] || others+=(ranks.h5 ranks.xdmf ranks.vtkhdf mesh.xdmf mesh_0001.vtkhdf)
for file in "${others[@]}"; do
  expect_success check "$set/$file"
  grep -q "a valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "not the whole mesh"
  expect_success stats "$set/$file" --report report.json
  [[ $(counter elements) == "$elements" ]] || fault "not the figures of the whole mesh"
done
damaged() { # file, what is said, command that changes it
  cp "$set/$1" "$inputs/before"
  "${@:3}" "$set/$1"
  cmp -s "$inputs/before" "$set/$1" && fault "nothing is changed in $1"
  expect_error "$2" check "$set/$1"
  cp "$inputs/before" "$set/$1"
}
damaged mesh.000002 "mesh.000002: line .*: the attribute 0 is not" sed -i '/^elements/{n;n;s/^1/0/}'
damaged mesh.000002 "mesh.000002: line .*: the file ends" truncate -s 5000
damaged mesh.000001 "mesh.000001: shared vertex 0 of the group of ranks .* is not where" \
  sed -i '/^# group 1$/,/^shared_edges/{/^shared_vertices/{n;N;s/\(.*\)\n\(.*\)/\2\n\1/}}'
damaged processor1/constant/polyMesh/points "points: line .*: .*end" truncate -s 5000
damaged processor1/constant/polyMesh/boundary "boundary: .*its patches are not those of processor 0" \
  sed -i '0,/type patch/s//type processor; myProcNo 1; neighbProcNo 0/'
damaged processor2/constant/polyMesh/faces "faces: .*is no tetrahedron" sed -i '0,/^3(/s/^3(\([0-9]*\) \([0-9]*\) /3(\2 \1 /'
if [[ -e $set/ranks.h5 ]]; then
  damaged ranks.h5 "ranks.h5: HDF5 cannot read the file" truncate -s 30000
  damaged ranks.xdmf "ranks.xdmf: it has not one grid of $elements elements" sed -i 's/NumberOfElements="/&1/'
  damaged mesh.xdmf "mesh.xdmf: subdomain 0 has 1[0-9]* elements, and" sed -i '0,/NumberOfElements="/s//&1/'
  damaged mesh_0003.vtkhdf "mesh_0003.vtkhdf: this is no mesh file that is known" sed -i '1s/HDF/XXX/'
fi
for command in check stats "improve -o better.vtu" "adapt -s 0.2 -o next.vtu"; do
  # shellcheck disable=SC2086
  set -- $command
  expect_error "ranks_0001.vtu: this is one of the 4 files of .*ranks.pvtu, not a whole mesh" "$1" "$set/ranks_0001.vtu" "${@:2}"
  expect_error "mesh_0001.vtu: this is one of the 8 files of .*mesh.pvtu, not a whole mesh" "$1" "$set/mesh_0001.vtu" "${@:2}"
done
improved_elements() {
  sed -n 's/^ *No. of tetrahedra *\([0-9]*\) .*/\1/p' "$sandbox/stdout"
}
for file in "${others[@]}"; do
  expect_success improve "$set/$file" -o better.vtu --preset fast
  [[ $(improved_elements) == "$elements" ]] || fault "not the whole mesh is improved"
  expect_success adapt "$set/$file" -s 0.2 -o next.vtu
  grep -q "sides with ids" "$sandbox/stderr" && fault "it knows sides that are none"
done
if [[ -e $set/ranks.h5 ]]; then
  expect_success improve "$set/mesh.xdmf" -o better.vtu --preset none
  grep -q "not kept of .*the names of materials and faces" "$sandbox/stderr" || fault "names are lost without a word"
fi
expect_success adapt "$set/ranks_2.msh" -s 0.2 -o next.vtu
grep -q "sides with ids" "$sandbox/stderr" && fault "sides between ranks are taken for some of the model"
expect_success improve "$set/ranks_2.msh" -o better.vtu --preset fast
[[ $(improved_elements) == "$elements" ]] || fault "not the whole mesh is improved"
mkdir "$inputs/lone"
cp "$set/mesh_0000.vtu" "$set/ranks_0000.vtu" "$set/ranks_0002.vtu" "$inputs/lone" # nothing beside them says what they are
for file in mesh_0000 ranks_0000 ranks_0002; do
  run_driver check "$inputs/lone/$file.vtu"
  ((status == 1)) || fault "exit code is $status"
  grep -q "not a valid mesh: .*\(part of a larger mesh\|isolated point\)" "$sandbox/stderr" || fault "it does not say that it is a part"
done
expect_success stats "$inputs/lone/mesh_0000.vtu"
grep -q "^warning: .*mesh_0000.vtu: .*part of a larger mesh" "$sandbox/stderr" || fault "no warning"
# What is damaged and still a mesh does not agree with the record of the run: in a folder, and of a mesh its own files.
expect_success check "$set"
grep -q "set: [1-9][0-9]* files are as they were written" "$sandbox/stdout" || fault "no comparison with the record"
cp -r "$set" "$inputs/harmed"
printf '\1' | dd of="$inputs/harmed/surface.vtp" bs=1 seek=$(($(stat -c %s "$set/surface.vtp") - 40)) conv=notrunc status=none
echo >>"$inputs/harmed/mesh.000001"
rm "$inputs/harmed/interfaces.vtp"
expect_error "harmed: not as it was written: .*interfaces.vtp is missing" check "$inputs/harmed"
for harm in "surface.vtp has another content" "mesh.000001 has another size"; do
  grep -q "/$harm" "$sandbox/stderr" || fault "it does not say: $harm"
done
expect_error "mesh.000001: not as it was written: .*/mesh.000001 has another size$" check "$inputs/harmed/mesh.000001"
expect_success check "$inputs/harmed/ranks.pvtu"
rm "$inputs/harmed/finished_run.txt"
expect_success check "$inputs/harmed"

mv "$set/ranks_3.msh" "$set/third.msh"
for command in check stats "improve -o better.vtu"; do
  # shellcheck disable=SC2086
  set -- $command
  expect_error "ranks_3.msh: there is no such file, and ranks_2.msh is part 2 of a mesh in 4 parts" "$1" "$set/ranks_2.msh" "${@:2}"
done
expect_error "third.msh: this is part 3 of a mesh in 4 parts" check "$set/third.msh"
rm "$set/ranks_0003.vtu" "$set"/*.msh
run_driver check "$set" # the pieces of the other mesh are all there
((status == 1)) || fault "exit code is $status"
grep -q "ranks_0003.vtu: there is no such file" "$sandbox/stderr" || fault "the missing file is not named"

# Elements of second order are those of the same mesh; with ghosts, the same by one worker.
readers=(vtkmodules.vtkIOXML:pvtu os:mfem)
formats=pvtu,msh-ranks,mfem
judged=(ranks.pvtu "ranks_1.msh to ranks_3.msh" "mesh.000000 to mesh.000002")
if "$driver" mesh --help | grep -q "xdmf"; then
  readers+=(h5py:xdmf)
  formats+=,xdmf,vtkhdf,hdf5
  judged+=(mesh.xdmf ranks.xdmf ranks.vtkhdf)
fi
quadratic=("${small[@]}" --subdomains 8 --ranks 3 --order 2 --ghosts --format "$formats" --report report.json)
expect_success "${quadratic[@]}" --workers 2
[[ $(counter mesh_hash) == "$hash" ]] || fault "another mesh of second order"
rm -rf "$inputs/quadratic" && cp -r "$sandbox/work/out" "$inputs/quadratic"
for each in "${readers[@]}"; do
  format=${each#*:}
  if /usr/bin/python3 -c "import numpy, ${each%:*}" 2>/dev/null; then
    said=$(/usr/bin/python3 "$reader" "$format" "$inputs/quadratic" 3) || fault "no mesh of second order: $format"
    [[ $said == *"$elements elements, "*" measure 1.000000000,"* ]] || fault "$format has: $said"
    [[ $format != pvtu || $said != *" 0 ghosts"* ]] || fault "no ghosts of second order"
  fi
done
expect_success check "$inputs/quadratic"
for file in "${judged[@]}"; do
  grep -q "/$file: a valid mesh of $elements tetrahedra and .* of second order with [0-9]* middles of edges" "$sandbox/stdout" ||
    fault "not judged: $file"
done
(($(sed -n 's/.* vertices, //p' "$sandbox/stdout" | sort -u | wc -l) == 1)) || fault "different numbers of middles"
expect_error "ranks.pvtu: .*quadratic tetrahedron|ranks_0000.vtu: .*quadratic tetrahedron" improve "$inputs/quadratic" -o better.vtu
set=$inputs/quadratic
last_middle=$(($(grep -n '^mfem_serial_mesh_end' "$set/mesh.000001" | cut -d: -f1) - 2))
damaged mesh.000001 "mesh.000001: ([0-9]+ x element that its middles may invert|the middle of shared edge .* is not where)" \
  sed -i "${last_middle}s/^[^ ]* /9 /"
expect_success "${quadratic[@]}" --workers 1
diff -rq "$inputs/quadratic" "$sandbox/work/out" | grep -v finished_run && fault "other nodes by one worker"
formats=pvtu,vtu,msh
judged=(mesh.pvtu ranks.pvtu mesh.msh)
if "$driver" mesh --help | grep -q "xdmf"; then
  formats+=,xdmf,vtkhdf,hdf5
  judged+=(mesh.xdmf ranks.xdmf ranks.vtkhdf)
fi
expect_success mesh "$inputs/cube.off" --size 0.15 --dimension 2 --subdomains 4 --ranks 2 --order 2 --format "$formats"
mv "$sandbox/work/out" "$inputs/flat"
expect_success check "$inputs/flat"
for file in "${judged[@]}"; do
  grep -q "/$file: a valid mesh of [0-9]* triangles and .* of second order with [0-9]* middles of edges" "$sandbox/stdout" ||
    fault "not judged: $file"
done
expect_success mesh "$inputs/cube.off" --size 0.15 --subdomains 2 --ranks 3 --redistribute by-elements --order 2 \
  --report report.json
[[ $(counter largest_rank) =~ ^[1-9] ]] || fault "no elements of second order of ranks"
if /usr/bin/python3 -c 'import numpy, vtkmodules.vtkIOXML' 2>/dev/null; then
  said=$(/usr/bin/python3 "$reader" pvtu "$sandbox/work/out" 3) || fault "VTK finds no mesh of second order by elements"
  [[ $said == "$(counter elements) elements, "*" measure 1.000000000,"* ]] || fault "VTK says: $said"
fi

# Elements go to other pieces: as many, in even shares, the same by one worker, and for more ranks than subdomains.
by_elements=("${small[@]}" --subdomains 2 --ranks 3 --redistribute by-elements --improve-again=none --report report.json)
expect_success "${by_elements[@]}" --workers 2 --format pvtu,msh-ranks,openfoam
(($(counter largest_rank | cut -d. -f1) * 100 <= ($(counter elements) / 3 + 1) * 105)) || fault "uneven ranks"
(($(counter seams_before | cut -d. -f1) > 0)) || fault "no interface before"
hash=$(counter mesh_hash)
rm -rf "$inputs/elements" && cp -r "$sandbox/work/out" "$inputs/elements"
[[ ! -e $sandbox/work/out/spool ]] || fault "the spool is left"
if /usr/bin/python3 -c 'import numpy, vtkmodules.vtkIOXML' 2>/dev/null; then
  said=$(/usr/bin/python3 "$reader" pvtu "$inputs/elements" 3) || fault "VTK finds no mesh of redistributed elements"
  [[ $said == "$(counter elements) elements, "*" measure 1.000000000,"* ]] || fault "VTK says: $said"
fi
expect_success "${by_elements[@]}" --workers 1 --format pvtu,msh-ranks,openfoam
[[ $(counter mesh_hash) == "$hash" ]] || fault "elements went elsewhere by one worker"
diff -rq "$inputs/elements" "$sandbox/work/out" | grep -v finished_run && fault "other files by one worker"
expect_success mesh "$inputs/cube.off" --size 0.15 --dimension 2 --subdomains 4 --ranks 3 --redistribute by-elements

# Improved again, which is the default, the elements are the same by another number of workers.
again=(mesh "$inputs/cube.off" --size 0.15 --subdomains 8 --ranks 2 --redistribute by-elements --report report.json)
expect_success "${again[@]}" --workers 2 --improve-again=none
once=$(counter mesh_hash)
expect_success "${again[@]}" --workers 2
hash=$(counter mesh_hash)
[[ $hash != "$once" && $(counter improver_seconds) ]] || fault "not improved again"
expect_success "${again[@]}" --workers 1 --improve-again
[[ $(counter mesh_hash) == "$hash" ]] || fault "improved otherwise by one worker"
expect_success "${again[@]}" --workers 2 --improver none
unimproved=$(counter mesh_hash)
expect_success "${again[@]}" --workers 2 --improver none --improve-again=none
[[ $(counter mesh_hash) == "$unimproved" ]] || fault "improved by no improver"
for strategy in ito loehner; do
  expect_success "${again[@]}" --workers 2 --improve-again=$strategy
  [[ $(counter mesh_hash) != "$hash" && $(counter mesh_hash) != "$once" ]] || fault "not improved by $strategy"
done

# For the figures alone there need not be files.
expect_success "${again[@]}" --improve-again=ito --format none --trace trace.json
[[ ! -e $sandbox/work/out/ranks.pvtu ]] || fault "files that were not asked for"
for stage in redistribution first_pass between_passes second_pass writing_back; do
  [[ $(counter $stage) =~ [1-9] ]] || fault "no time of $stage"
done
for stage in "redistributing elements" "first pass" collection "second pass" "writing back"; do
  grep -q "\"tid\": 0, \"name\": \"$stage\"" "$sandbox/work/trace.json" || fault "the trace has no stage $stage"
done
(($(counter elements_between_passes) > 0)) || fault "no elements between the passes"

# What does not fit is refused before anything is read.
expect_usage_error "--improve-again goes with" mesh nothing.off --ranks 2 --improve-again
expect_usage_error "there is no 'nobody'; there are: pieces, ito, loehner, none" mesh nothing.off --ranks 2 \
  --redistribute by-elements --improve-again=nobody
expect_usage_error "--ranks is missing" mesh nothing.off --format pvtu
expect_usage_error "--ranks is missing" mesh nothing.off --redistribute none
expect_usage_error "--ranks is missing" mesh nothing.off --ghosts
# A mesh stays in the spool while files by ranks are written, twice when it is cut anew: there is room for fewer elements.
room() {
  run_driver mesh "$inputs/cube.off" --size 0.0003 --out out "$@"
  sed -nE 's/.* has room for about ([0-9.]+) ?([kMGT]?);.*/\1 \2/p' "$sandbox/stderr" |
    awk '{ print $1 * 1000 ^ index("kMGT", $2) }'
}
by_pieces=$(room --ranks 4 --format msh-ranks)
by_elements=$(room --ranks 4 --format msh-ranks --redistribute by-elements)
awk -v msh="$(room --format msh)" -v pieces="$by_pieces" -v elements="$by_elements" \
  'BEGIN { exit !(elements > 0 && elements < 0.9 * pieces && pieces < 0.9 * msh) }' ||
  fault "room for $by_pieces elements, and for $by_elements when they are cut anew"
# A spool elsewhere takes none of the room for the files.
own_spool=$(room --ranks 4 --format msh-ranks --redistribute by-elements --spool "$sandbox/spools")
grep -q "its disk, or that of --spool, has room" "$sandbox/stderr" || fault "the line does not speak of two disks"
awk -v own="$own_spool" -v both="$by_elements" 'BEGIN { exit !(own > 1.3 * both) }' ||
  fault "room for $own_spool elements with a spool elsewhere, and for $by_elements without"
expect_usage_error "--ghosts: none of the formats has elements of other ranks; these have: pvtu, msh-ranks" \
  mesh nothing.off --ranks 2 --ghosts --format openfoam,mfem
expect_usage_error "--ranks: 0 is less than 1" mesh nothing.off --ranks 0
expect_usage_error "--ranks: 5 are more than the 4 subdomains" mesh nothing.off --ranks 5 --subdomains 4
expect_usage_error "--ranks goes with one of the formats pvtu" mesh nothing.off --ranks 2 --format vtu
expect_usage_error "--ranks goes with .*, or with none and --redistribute by-elements" mesh nothing.off --ranks 2 --format none
expect_usage_error "--rank-partitioner goes with --redistribute by-elements" mesh nothing.off --ranks 2 --rank-partitioner gathered
expect_usage_error "--rank-partitioner: there is no 'x'; there are: gathered" mesh nothing.off --ranks 2 \
  --redistribute by-elements --rank-partitioner x
if "$driver" mesh --help | grep -q ptscotch; then
  expect_usage_error "--rank-partitioner ptscotch partitions on several ranks: start the run by mpirun" mesh nothing.off \
    --ranks 2 --redistribute by-elements --rank-partitioner ptscotch
fi
expect_usage_error "--order 2: the files of openfoam are of first order; with --ranks there are pvtu, msh-ranks, mfem" \
  mesh nothing.off --ranks 2 --order 2 --format vtu,openfoam
expect_usage_error "--redistribute: there is no 'x'; there are: by-pieces, by-elements, none" \
  mesh nothing.off --ranks 2 --redistribute x
expect_usage_error "--format: there is no 'x'.*with --ranks also pvtu" mesh nothing.off --ranks 2 --format x
finish
