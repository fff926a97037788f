#!/bin/bash
# Whole runs on a small model: files, figures, the same mesh whatever the workers, interruption and resumption.
#   check_runs.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

write_cube >"$inputs/cube.off"

figure() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}
mesh() { expect_success mesh "$inputs/cube.off" --report report.json "$@"; }

# Meanwhile one whose improver does not come back: CGAL's child process stops, until its half minute is over.
sharp=(0 0 0  3 0 0  3 1 0  0 0 20  3 0 20  3 1 20) # a prism with an edge of 18 degrees
{
  printf '%s\n' OFF "6 8 0"
  printf '%s %s %s\n' "${sharp[@]}"
  printf '3 %s\n' "0 2 1" "3 4 5" "0 1 4" "0 4 3" "1 2 5" "1 5 4" "2 0 3" "2 3 5"
} >"$inputs/sharp.off"
late=
if "$driver" mesh --help | grep -q "Mesh improver:.* cgal"; then
  mkdir "$sandbox/late"
  (cd "$sandbox/late" && exec "$driver" mesh "$inputs/sharp.off" --size 0.12 --subdomains 2 --workers 1 --improver cgal \
    --format none --report report.json >stdout 2>stderr </dev/null) &
  late=$!
  for ((tries = 0; tries < 20000; ++tries)); do
    work=$(pgrep -P $late) && worker=$(pgrep -P "$work") && child=$(pgrep -P "$worker") && break
    sleep 0.05
  done
  kill -STOP "$child" || fault "CGAL was never seen"
fi

# A run, its files and its figures.
mesh --size 0.08 --subdomains 4 --workers 2
hash=$(figure mesh_hash)
elements=$(figure elements)
((elements > 10000 && elements < 60000)) || fault "$elements elements"
[[ $(figure subdomains) == 4 ]] || fault "$(figure subdomains) subdomains"
[[ $(figure failed_subdomains) == 0 ]] || fault "failed subdomains"
[[ $(figure model_volume) == 1.0 ]] || fault "the model's volume is '$(figure model_volume)'" # found beside the run
[[ $hash =~ ^[0-9a-f]{16}$ && ! $hash =~ ^0*$ ]] || fault "the hash is '$hash'"
(cd "$sandbox/work/out" && ls) >"$sandbox/listing"
diff "$sandbox/listing" - <<<$'finished_run.txt\ninterfaces.vtp\nmesh.pvtu\nmesh_0000.vtu\nmesh_0001.vtu\nmesh_0002.vtu\nmesh_0003.vtu\nsurface.vtp' ||
  fault "other files than expected"
of_run=$(at_interfaces)
rows_of_run=$(rows_at_interfaces)
cp -r "$sandbox/work/out" "$inputs/mesh"

# The mesh is one, by our own checker, and the statistics of the file are those of the report.
expect_success check "$inputs/mesh"
grep -q "valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "the checker counts otherwise"
expect_success check "$inputs/mesh/surface.vtp"
grep -q "a valid mesh of .* triangles" "$sandbox/stdout" || fault "no mesh of triangles"
expect_success stats "$inputs/mesh/surface.vtp"
grep -q "No. of triangles" "$sandbox/stdout" || fault "no quality of triangles"
expect_success stats "$inputs/mesh/mesh.pvtu" --report report.json
[[ $(figure elements) == "$elements" ]] || fault "stats counts $(figure elements) elements, not $elements"
expect_at_interfaces "$of_run" "$rows_of_run" "$inputs/mesh/mesh.pvtu"
expect_no_interfaces "$inputs/mesh/surface.vtp"

# The same mesh by one worker, without workers, and in other files.
mesh --size 0.08 --subdomains 4 --workers 1 --format none
[[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh by one worker"
[[ ! -e $sandbox/work/out ]] || fault "an empty folder is left"
mesh --size 0.08 --subdomains 4 --executor serial --format msh,msh-partitioned
[[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh without workers"
for file in mesh mesh_partitioned; do
  cp "$sandbox/work/out/$file.msh" "$inputs"
done
for file in mesh mesh_partitioned; do
  expect_success check "$inputs/$file.msh"
  grep -q "valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "$file.msh has other counts"
done
expect_at_interfaces "$of_run" "$rows_of_run" "$inputs/mesh_partitioned.msh"
expect_no_interfaces "$inputs/mesh.msh" # which does not say what the pieces were
formats=vtu
"$driver" mesh --help | grep -q "hdf5" && formats+=,hdf5
mesh --size 0.08 --subdomains 4 --files 1 --format $formats
rm -rf "$inputs/mesh" && mv "$sandbox/work/out" "$inputs/mesh"
for file in "$inputs"/mesh/mesh.{pvtu,xdmf}; do
  [[ ! -e $file ]] || expect_at_interfaces "$of_run" "$rows_of_run" "$file"
done
# A material or a CAD face without a name.
overwrite_end() { # file, array of which the last bytes are written over, these as printf has them
  local file=$1 offset start bytes
  offset=$(grep -ao "<DataArray [^>]*Name=\"$2\"[^>]*>" "$file" | head -n 1 | sed 's/.*offset="\([0-9]*\)".*/\1/')
  start=$(grep -abo '<AppendedData encoding="raw">' "$file" | head -n 1 | cut -d: -f1)
  start=$((start + 31 + offset)) # behind the end of the line and "_"
  bytes=$(od -An -t u8 -j "$start" -N 8 "$file" | tr -d ' ')
  printf "$3" >"$sandbox/bytes"
  dd if="$sandbox/bytes" of="$file" bs=1 conv=notrunc seek=$((start + 8 + bytes - $(stat -c %s "$sandbox/bytes"))) status=none
}
for damage in "surface.vtp cad_face CAD.face" "mesh_0000.vtu region material"; do
  read -r file array kind <<<"$damage"
  cp "$inputs/mesh/$file" "$inputs/whole"
  overwrite_end "$inputs/mesh/$file" "$array" '\x63\0\0\0'
  expect_error "$file: .*element [0-9]+ is of the $kind 99, and there are names of [0-9]+" check "$inputs/mesh/${file/_0000.vtu/.pvtu}"
  mv "$inputs/whole" "$inputs/mesh/$file"
done
mesh --size 0.3 --subdomains 1
mv "$sandbox/work/out" "$inputs/one_piece"
expect_no_interfaces "$inputs/one_piece/mesh.pvtu"

# In second-order elements, which do not change the mesh.
mesh --size 0.08 --subdomains 4 --format vtu,msh --order 2 --files 1
[[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh of second-order elements"
grep -q '"moved_back"' "$sandbox/work/report.json" || fault "the report does not tell of middles"
cp "$sandbox/work/out/mesh.msh" "$inputs/second.msh"
cp "$sandbox/work/out/mesh_0000.vtu" "$inputs/second.vtu"
rm -rf "$inputs/second" && mv "$sandbox/work/out" "$inputs/second"
for file in "$inputs"/second{.msh,.vtu,/mesh.pvtu}; do
  expect_success check "$file"
  grep -qE "valid mesh of $elements tetrahedra and [0-9]+ vertices, of second order with [0-9]+ middles of edges$" \
    "$sandbox/stdout" || fault "no mesh of second order"
  expect_success stats "$file"
  grep -q "No. of tetrahedra" "$sandbox/stdout" || fault "no quality of second order"
done
expect_error "elements of type 8; only points" improve "$inputs/second.msh" -o better.vtu
expect_error "quadratic tetrahedron" adapt "$inputs/second.vtu" -s 0.2 -o next.vtu

# A middle that is elsewhere, and one that is another point.
overwrite_end "$inputs/second.vtu" Points '\x24\x40' # z is 10
expect_error "second.vtu: not a valid mesh: [0-9]+ x element that its middles may invert \([0-9]+\)" check "$inputs/second.vtu"
cp "$inputs/second/mesh_0000.vtu" "$inputs/second.vtu"
overwrite_end "$inputs/second.vtu" connectivity '\0\0\0\0'
expect_error "second.vtu: not a valid mesh: a corner is also the middle of an edge \(point 0\)" check "$inputs/second.vtu"
expect_usage_error "--order" mesh --order 3

# An edge so sharp that interfaces cannot end there without small angles: they are listed with what forces them.
expect_success mesh "$inputs/sharp.off" --size 0.15 --subdomains 8 --simplifier none --improver none --format none \
  --report report.json
(($(figure forced) > 0)) || fault "no angle is forced"
tr -d ' \n' <"$sandbox/work/report.json" | sed 's/"coarse":.*//' >"$sandbox/listing" # of the fine interfaces
grep -qE '"cause":"forced","at":\[[^]]*\],"cad":\["curve[^]]*"face[^]]*"face' "$sandbox/listing" ||
  fault "no forced angle is listed with its curve and faces"
[[ $(figure repeatable) == true ]] || fault "not repeatable"
low_by() { tr -d ' \n' <"$sandbox/work/report.json" | sed "s/.*\"cause\":\"$1\",\"bad\":[0-9]*,\"low\":\([0-9]*\).*/\1/"; }
(($(low_by angleofthemodel) > 0)) || fault "no element is in the sharp angle"

# A wall far thinner than the size: elements across it are bad, which is said once, with the place; a cube has none.
write_cube | sed 's/^\([01] [01]\) 1$/\1 0.02/' >"$inputs/plate.off"
expect_success mesh "$inputs/plate.off" --size 0.12 --format none --report report.json
(($(low_by thinwall) > 0)) || fault "no element is in the thin wall"
grep -qE '^warning: [0-9]+ tetrahedra under 12 degrees .* thick at \(' "$sandbox/stdout" ||
  fault "no word on the thin wall"
grep -qE '^  Thin wall +[0-9,]+ \([1-9][0-9,]*\)$' "$sandbox/stdout" || fault "the summary has no elements of the wall"
tr -d ' \n' <"$sandbox/work/report.json" | grep -qE '"thinnest_wall":\{"thickness":0\.0[12][0-9]*,"at":\[0\.[^]]*\]\}' ||
  fault "how thin it is is not told"
mesh --size 0.3 --format none
grep -q "by cause\|thinner" "$sandbox/stdout" && fault "a cube has elements of low quality"
[[ $(figure thinnest_wall) == null ]] || fault "a cube has a thin wall"

# Every policy that has a name works.
mesh --size 0.15 --subdomains 3 --partitioner greedy --improver none --files 1 --quiet
[[ ! -s $sandbox/stdout && ! -s $sandbox/stderr ]] || fault "not quiet"
[[ $(cd "$sandbox/work/out" && echo mesh_*.vtu) == mesh_0000.vtu ]] || fault "more than one file"

# The names that --help offers for a mesher: its kind, its help.
offered() {
  local names
  names=$("$driver" mesh --help | tr -s ' \n' ' ' | sed -n "s/.*$2: \\([a-z, ]*\\) -.*/\\1/p" | tr -d ,)
  [[ $names == native* ]] && echo "$names" || echo "no_native_$1_mesher_among_$names" | tr ' ' _
}

# A valid mesh by a mesher of that kind, and another one than by the native one.
mesh_by() { # name, kind
  mesh --size 0.08 --subdomains 4 "--$2-mesher" "$1"
  [[ $(figure "$2_mesher") == "$1" ]] || fault "the $2 mesher was $(figure "$2_mesher")"
  [[ $1 == native || $(figure mesh_hash) != "$hash" ]] || fault "the same mesh as from the native one"
  rm -rf "$inputs/made" && cp -r "$sandbox/work/out" "$inputs/made"
  expect_success check "$inputs/made"
}

# A background mesh by every mesher of whole domains that is offered; the mesh is another one. Two solids are refused.
{
  printf '%s\n' OFF "16 24 0"
  for x in 0 3; do
    printf '%s\n' "$x 0 0" "$((x + 1)) 0 0" "$((x + 1)) 1 0" "$x 1 0" "$x 0 1" "$((x + 1)) 0 1" "$((x + 1)) 1 1" "$x 1 1"
  done
  for first in 0 8; do
    tail -n 12 "$inputs/cube.off" | awk -v first=$first '{ print 3, $2 + first, $3 + first, $4 + first }'
  done
} >"$inputs/cubes.off"
background_meshers=$(offered background "Mesher of the coarse mesh that is decomposed")
for name in $background_meshers; do
  mesh_by "$name" background
  [[ $name == native ]] ||
    expect_error "2 solids.*native" mesh "$inputs/cubes.off" --size 0.2 --background-mesher "$name"
  [[ $name == native ]] ||
    expect_error "--background-mesher.*--dimension 2" mesh "$inputs/cube.off" --dimension 2 --background-mesher "$name"
done
expect_error "--background-mesher: there is no 'nonsense'; there are: native" \
  mesh "$inputs/cube.off" --background-mesher nonsense

# Another improver of the background mesh, and another angle of the rule, change both the coarse mesh's interfaces.
mesh --size 0.08 --subdomains 4 --format none
unchanged=$(figure mesh_hash)
for change in "--background-improver none" "--dihedral-angle 60"; do
  mesh --size 0.08 --subdomains 4 --format none $change
  [[ $(figure mesh_hash) != "$unchanged" ]] || fault "$change changes nothing"
done
expect_error "--background-improver.*--dimension 2" \
  mesh "$inputs/cube.off" --dimension 2 --background-improver none
expect_error "--background-improver: there is no 'nonsense'; there are: native" \
  mesh "$inputs/cube.off" --background-improver nonsense
expect_error "--dihedral-angle: 91 is not between 0 and 90" mesh "$inputs/cube.off" --dihedral-angle 91
expect_error "--dihedral-angle: .*shape has no angle" mesh "$inputs/cube.off" --dihedral-angle 20 --simplifier shape

# The surface by every mesher that is offered.
surface_meshers=$(offered surface "Mesher of the surface of --dimension 3")
for name in $surface_meshers; do
  mesh_by "$name" surface
done
expect_error "--surface-mesher: there is no 'nonsense'; there are: native" \
  mesh "$inputs/cube.off" --surface-mesher nonsense
expect_error "--surface-mesher.*--dimension 2.*--mesher" \
  mesh "$inputs/cube.off" --dimension 2 --surface-mesher native

# Improving keeps a mesh valid, and what the file says of it.
cat >"$inputs/with_pressure.vtu" <<'VTU'
<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><PointData>
<DataArray type="Float32" Name="pressure" format="ascii">1 2 3 4</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
VTU
expect_success improve "$inputs/mesh.msh" --out better.vtu --preset fast
cp "$sandbox/work/better.vtu" "$inputs"
grep -q "not kept of .*mesh.msh: points and lines as elements$" "$sandbox/stderr" || fault "what is lost is not named"
grep -qa 'Name="region_names" NumberOfTuples="1"' "$inputs/better.vtu" || fault "the name of the region is lost"
grep -qa 'Name="patch_names" NumberOfTuples="6"' "$inputs/better.vtu" || fault "the names of the faces are lost"
expect_success improve "$inputs/mesh_partitioned.msh" --out better.msh --preset fast
grep -qa "PartitionedEntities" "$sandbox/work/better.msh" || fault "the subdomains are lost"
expect_success improve "$inputs/with_pressure.vtu" --out better.msh --preset fast
grep -q "not kept of .*with_pressure.vtu: the values 'pressure' of points, which have moved$" "$sandbox/stderr" ||
  fault "what is lost is not named"
expect_success improve "$inputs/better.vtu" --out best.vtu --preset fast
[[ ! -s $sandbox/stderr ]] || fault "something is lost"
expect_success check "$inputs/better.vtu"
expect_success plan "$inputs/cube.off" --size 0.08
grep -q "No. of tetrahedra" "$sandbox/stdout" || fault "no prediction"
for options in "plan" "mesh" "mesh --force" "plan --dimension 2" "mesh --force --dimension 2 --subdomains 3"; do
  expect_error "^dovetail: the sizes predict about [0-9.e+]* elements, more than any machine can hold" \
    $options "$inputs/cube.off" --size 1e-6
done

# Killed, interrupted, resumed: the same mesh as in one go. Twice as many pieces as can be finished at once.
long=(mesh "$inputs/cube.off" --size 0.028 --subdomains 12 --workers 1 --format none --report report.json)
expect_success "${long[@]}"
hash=$(figure mesh_hash)

interrupt() { # signal
  what="dovetail ${long[*]}, then SIG$1"
  rm -rf "$sandbox/work"
  mkdir "$sandbox/work"
  cd "$sandbox/work" || exit 1
  "$driver" "${long[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null &
  local process=$!
  for ((tenths = 0; tenths < 10000; ++tenths)); do
    compgen -G "out/spool/piece_*" >/dev/null && break
    sleep 0.1
  done
  kill -"$1" $process
  wait $process 2>/dev/null
  status=$?
  cd "$OLDPWD" || exit 1
  compgen -G "$sandbox/work/out/spool/piece_*" >/dev/null || fault "no finished pieces are kept"
}
resume() {
  what="dovetail ${long[*]} --resume"
  (cd "$sandbox/work" && timeout 1000 "$driver" "${long[@]}" --resume >"$sandbox/stdout" 2>"$sandbox/stderr")
  status=$?
  ((status == 0)) || fault "exit code is $status"
  [[ $(figure mesh_hash) == "$hash" ]] || fault "another mesh than in one go"
  [[ ! -e $sandbox/work/out/spool ]] || fault "the spool is left"
}

interrupt KILL
resume

# Killed while files are written: what is complete is neither made nor written again.
written=("${long[@]/none/vtu}")
extension=vtu
kill_finishing() {
  what="dovetail ${written[*]}, killed while it writes"
  for ((try = 0; try < 5; ++try)); do
    rm -rf "$sandbox/work"
    mkdir "$sandbox/work"
    cd "$sandbox/work" || exit 1
    "$driver" "${written[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null &
    local process=$!
    # One worker: where the second file is complete, the first one's piece is given up.
    while kill -0 $process 2>/dev/null && (($(compgen -G "out/unfinished/0/mesh_*.$extension" | wc -l) < 2)); do sleep 0.01; done
    kill -KILL $process 2>/dev/null
    wait $process 2>/dev/null
    cd "$OLDPWD" || exit 1
    [[ -d $sandbox/work/out/spool ]] && return
  done
  fault "it was never killed in time"
}
kill_finishing
complete=$(cd "$sandbox/work/out/unfinished/0" && ls mesh_*.vtu | wc -l)
((complete > 0 && complete < 12)) || fault "$complete complete files"
long=("${written[@]}")
resume
grep -q '"taken_over": [1-9]' "$sandbox/work/report.json" || fault "no file was taken over"
[[ ! -e $sandbox/work/out/unfinished ]] || fault "unfinished files are left"
expect_same_files() { # folder of another run
  diff -r "$sandbox/work/out" "$1" || fault "other files than in one go"
}
mv "$sandbox/work/out" "$inputs/resumed"
expect_success "${long[@]}"
expect_same_files "$inputs/resumed"

# So it is when such a file has gone: its piece is made again.
kill_finishing
rm "$(compgen -G "$sandbox/work/out/unfinished/0/mesh_*.vtu" | head -n 1)"
resume
expect_same_files "$inputs/resumed"

# And so it is with HDF5 files.
if "$driver" mesh --help | tr -s ' \n' ' ' | grep -q "msh-partitioned, hdf5"; then
  written=("${long[@]/%vtu/hdf5}")
  extension=vtkhdf
  kill_finishing
  long=("${written[@]}")
  resume
  grep -q '"taken_over": [1-9]' "$sandbox/work/report.json" || fault "no HDF5 file was taken over"
  mv "$sandbox/work/out" "$inputs/resumed_hdf5"
  expect_success "${long[@]}"
  expect_same_files "$inputs/resumed_hdf5"
  long=("${long[@]/%hdf5/vtu}")
  written=("${long[@]}")
fi

interrupt INT
((status == 130)) || fault "exit code after Ctrl-C is $status"
grep -q -- "--resume" "$sandbox/stderr" || fault "nothing is said about --resume"
[[ ! -e $sandbox/work/report.json ]] || fault "a report of half a run"

# Another run cannot be resumed, and says what differs; the pieces stay for the right one.
stale() { # what differs, arguments of the other run
  what="resuming with another $1"
  (cd "$sandbox/work" && "$driver" "${@:2}" --resume) >"$sandbox/stdout" 2>"$sandbox/stderr"
  status=$?
  ((status == 1)) || fault "exit code is $status"
  grep -q "cannot be resumed: .*$1" "$sandbox/stderr" || fault "the difference is not named"
}
stale sizes mesh "$inputs/cube.off" --size 0.03 --subdomains 12
stale subdomains mesh "$inputs/cube.off" --size 0.028 --subdomains 11
stale coarsening "${long[@]}" --coarsening 2
stale dimension "${long[@]}" --dimension 2
stale partitioner "${long[@]}" --partitioner greedy
stale simplifier "${long[@]}" --simplifier none
stale simplifier "${long[@]}" --dihedral-angle 40
stale "background improver" "${long[@]}" --background-improver none
stale improver "${long[@]}" --improver none
[[ $surface_meshers == *cgal* ]] && stale "surface mesher" "${long[@]}" --surface-mesher cgal
[[ $background_meshers == *cgal* ]] && stale "background mesher" "${long[@]}" --background-mesher cgal
other_mesher=$("$driver" mesh --help | tr -s ' \n' ' ' | grep -oE "hxt|netgen" | head -n 1)
[[ -z $other_mesher ]] || stale "mesher" "${long[@]}" --mesher "$other_mesher"
other_library=$(ldconfig -p | awk '/libcrypt\.so\.1 /{ print $NF; exit }')
[[ -z $other_library ]] || LD_PRELOAD=$other_library stale libraries "${long[@]}"
cp "$inputs/cube.off" "$inputs/as_it_was.off"
echo "# the same shape" >>"$inputs/cube.off"
stale file "${long[@]}"
cp "$inputs/as_it_was.off" "$inputs/cube.off"
resume

# So it is with what the sizes are read from: the text, and the mesh that it names, even where no sample of the field
# tells: one size, at a point in a corner.
cat >"$inputs/sizes.msh" <<'MSH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 -1 -1 -1
2 9 -1 -1
3 -1 9 -1
4 -1 -1 9
5 -1 -1 -0.999
$EndNodes
$Elements
2
1 4 2 1 1 5 2 3 4
2 4 2 1 1 1 2 3 5
$EndElements
$NodeData
1
"size"
1
0
3
0
1
5
1 0.03
2 0.03
3 0.03
4 0.03
5 0.03
$EndNodeData
MSH
echo '{ "background": { "file": "sizes.msh" } }' >"$inputs/sizes.json"
long=(mesh "$inputs/cube.off" --sizing "$inputs/sizes.json" --subdomains 12 --workers 1 --format none)
interrupt KILL
sed -i 's/^1 0.03$/1 0.02/' "$inputs/sizes.msh"
stale "meshes of the sizing" "${long[@]}"
sed -i 's/^1 0.02$/1 0.03/' "$inputs/sizes.msh"
echo >>"$inputs/sizes.json"
stale sizing "${long[@]}"
long=("${written[@]}")
expect_success "${long[@]}"

# A batch script always says --resume: what is finished is left alone, what is not there is started.
inode=$(stat -c %i "$sandbox/work/out/mesh.pvtu")
what="resuming a finished run"
resume_again() {
  (cd "$sandbox/work" && timeout 1000 "$driver" "${long[@]}" --resume >"$sandbox/stdout" 2>"$sandbox/stderr")
  status=$?
  ((status == 0)) || fault "exit code is $status"
}
resume_again
grep -q "this run is finished" "$sandbox/stdout" || fault "nothing is said"
[[ $(stat -c %i "$sandbox/work/out/mesh.pvtu") == "$inode" ]] || fault "the mesh was written again"
rm "$sandbox/work/out/mesh_0003.vtu"
what="resuming a finished run that has lost a file"
resume
expect_same_files "$inputs/resumed"
what="resuming what was killed before it was begun"
rm -rf "$sandbox/work/out" && mkdir -p "$sandbox/work/out/spool" && echo "dove" >"$sandbox/work/out/spool/manifest.txt.part"
resume
expect_same_files "$inputs/resumed"
what="another run in the folder of a finished one"
piped() { # the sizes
  what="resuming with the sizes $1 from a pipe"
  (cd "$sandbox/work" && "$driver" mesh "$inputs/cube.off" --sizing <(echo "$1") --out piped --resume >"$sandbox/stdout" 2>"$sandbox/stderr") ||
    fault "exit code is $?"
}
piped '{ "size": 0.2 }'
piped '{ "size": 0.2 }'
grep -q "this run is finished" "$sandbox/stdout" || fault "the same sizes are meshed again"
piped '{ "size": 0.2, "scale": 1 }'
grep -q "this run is finished" "$sandbox/stdout" && fault "a mesh of another text is taken for this one's"

(cd "$sandbox/work" && "$driver" mesh "$inputs/cube.off" --size 0.2 --subdomains 2 --resume) >"$sandbox/stdout" 2>"$sandbox/stderr"
status=$?
((status == 0)) || fault "exit code is $status"
grep -q "this run is finished" "$sandbox/stdout" && fault "it was taken for the finished one"

# The report tells whether files are as they were written.
check_report() { # expression, status
  what="dovetail check --report, $1"
  (cd "$sandbox" && "$driver" check --report work/report.json >"$sandbox/stdout" 2>"$sandbox/stderr")
  status=$?
  ((status == $2)) || fault "exit code is $status"
  cat "$sandbox/stdout" "$sandbox/stderr" | grep -qE "$1" || fault "it does not say '$1'"
}
mesh --size 0.2 --subdomains 2
check_report "5 files are as they were written" 0
rm -rf "$sandbox/kept" && cp -r "$sandbox/work" "$sandbox/kept"
[[ $(stat -c %s "$sandbox/work/out/mesh_0001.vtu") == "$(grep -A1 mesh_0001 "$sandbox/work/report.json" | tr -dc '0-9\n' | tail -n 1)" ]] ||
  fault "another size in the report"
printf x | dd of="$sandbox/work/out/mesh_0001.vtu" bs=1 seek=3000 conv=notrunc 2>/dev/null
check_report "mesh_0001.vtu has another content" 1
echo >>"$sandbox/work/out/mesh_0001.vtu"
check_report "mesh_0001.vtu has another size" 1
rm "$sandbox/work/out/mesh_0000.vtu"
check_report "mesh_0000.vtu is missing, .*mesh_0001.vtu has another size" 1
expect_error "not a report" check --report "$inputs/cube.off"
expect_error "cannot read" check --report nowhere.json
expect_usage_error "give a mesh file" check
cp -r "$sandbox/kept/out" "$sandbox/kept/copy"
for mesh in out out/mesh.pvtu; do
  expect_success check "$sandbox/kept/$mesh" --report "$sandbox/kept/report.json"
  expect_error "of another run: it lists none of the files of" check "$sandbox/kept/copy${mesh#out}" --report "$sandbox/kept/report.json"
done
mv "$sandbox/kept/copy" "$sandbox/kept/above" # beside the report, and above what it lists
mv "$sandbox/kept/out" "$sandbox/kept/report.json" "$sandbox/kept/above"
expect_error "of another run" check "$sandbox/kept/above" --report "$sandbox/kept/above/report.json"

# Triangles by every mesher that is offered.
of_triangles=$("$driver" mesh --help | tr -s ' \n' ' ' | sed -n 's/.*; of triangles: \([a-z, ]*\) -.*/\1/p' | tr -d ,)
[[ $of_triangles == *native* ]] || fault "no mesher of triangles is listed"
for name in $of_triangles; do
  mesh --dimension 2 --size 0.1 --subdomains 3 --mesher "$name"
  [[ $(figure mesher) == "$name" ]] || fault "the mesher was $(figure mesher)"
  rm -rf "$inputs/triangles" && cp -r "$sandbox/work/out" "$inputs/triangles"
  expect_success check "$inputs/triangles/mesh.pvtu"
  grep -q "a valid mesh of .* triangles" "$sandbox/stdout" || fault "not a valid mesh of triangles"
done

# A folder that happens to have our name for one is left as it is.
what="a folder of somebody else, called unfinished"
rm -rf "$sandbox/work" && mkdir -p "$sandbox/work/out/unfinished/0"
for file in letter.txt 0/letter.txt 0/mesh_0000.vtu; do echo mine >"$sandbox/work/out/unfinished/$file"; done
(cd "$sandbox/work" && "$driver" mesh "$inputs/cube.off" --size 0.2 --subdomains 2) >"$sandbox/stdout" 2>"$sandbox/stderr"
status=$?
((status == 0)) || fault "exit code is $status"
(cd "$sandbox/work/out/unfinished" && find . -type f | sort) >"$sandbox/listing"
diff "$sandbox/listing" - <<<$'./0/letter.txt\n./letter.txt' || fault "other files are left than those of somebody else"

# A file that may not grow any further is like a full disk.
what="a limit to the size of files"
rm -rf "$sandbox/work"
mkdir "$sandbox/work"
(cd "$sandbox/work" && ulimit -f 64 && "$driver" mesh "$inputs/cube.off" --size 0.05 --subdomains 2) \
  >"$sandbox/stdout" 2>"$sandbox/stderr"
status=$?
((status == 1)) || fault "exit code is $status"
(($(grep -c '^dovetail: ' "$sandbox/stderr") == 1)) || fault "not one line of complaint"
[[ -z $(find "$sandbox/work" -name '*.vtu' -o -name '*.pvtu' -o -name '*.part') ]] || fault "half a mesh is left"

# The run that was left alone has ended: a clock has decided on its mesh, and it says so.
if [[ $late ]]; then
  what="a piece that is not improved in time"
  wait $late
  status=$?
  mv "$sandbox/late/"{stdout,stderr} "$sandbox"
  mv "$sandbox/late/report.json" "$sandbox/work"
  ((status == 0)) || fault "exit code is $status"
  [[ $(figure repeatable) == false ]] || fault "the report says that it is repeatable"
  grep -q "^NOT REPEATABLE" "$sandbox/stdout" || fault "the summary does not say that it is not repeatable"
fi
finish
