#!/bin/bash
# Outputs that are inputs or other outputs, by whatever names: refused before any work, with every file as it was. And
# outputs that cannot be written, which is found before any work too.
#   check_same_files.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
write_cube >"$inputs/cube.off"
here=$sandbox/here # where files of others are, in place of an empty folder
coarse=(--size 0.5 --subdomains 2 --workers 1 --quiet)

# prepare: files and other names of them.
prepare() {
  rm -rf "$here" && mkdir -p "$here/inner" && cd "$here" || exit 1
  write_cube >in.off
  echo '{"size": 0.5}' >sizes.json
  echo '{"minimum": [{"background": {"file": "inner/back.pvtu"}}, {"size": 1}]}' >by_mesh.json
  printf '%s' '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="back_0.vtu"/></PUnstructuredGrid></VTKFile>' >inner/back.pvtu
  echo piece >inner/back_0.vtu
  echo first >first.json
  echo second >second.json
  ln -s in.off link.off
  ln in.off hard.off
  ln -s . around
  ln -s nowhere.json dangling.json
  cd "$OLDPWD" || exit 1
}

# state: names and contents of all that is there.
state() { (cd "$here" && find . -mindepth 1 -printf '%p %y %l\n' | sort && find . -type f -exec cksum {} + | sort); }

# refused <expression> <arguments...>: a usage error, in the folder with files, of which nothing changes.
refused() {
  local expression=$1 before
  shift
  what="dovetail $*"
  before=$(state)
  (cd "$here" && timeout 1000 "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
  ((status == 2)) || fault "exit code is $status, not 2"
  [[ $(wc -l <"$sandbox/stderr") == 1 ]] || fault "not one line"
  grep -qE -- "^dovetail: .*$expression" "$sandbox/stderr" || fault "the line does not match '$expression'"
  [[ $(state) == "$before" ]] || fault "files are not as they were: $(diff <(echo "$before") <(state))"
  return 0
}

# made <arguments...>: goes well there.
made() {
  what="dovetail $*"
  (cd "$here" && timeout 1000 "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
  ((status == 0)) || fault "exit code is $status"
  return 0
}

prepare
# Every spelling of an input, as every output.
for output in --report --trace; do
  for name in in.off ./in.off inner/../in.off "$here/in.off" link.off hard.off around/in.off around/./around/link.off; do
    refused "$output $name: would overwrite INPUT in.off" mesh in.off "${coarse[@]}" $output $name
  done
  refused "$output ./in.off: would overwrite INPUT link.off" mesh link.off "${coarse[@]}" $output ./in.off
  refused "$output sizes.json: would overwrite --sizing" mesh in.off --sizing ./sizes.json $output sizes.json
  refused "inner/back.pvtu: would overwrite a mesh that --sizing names" \
    mesh in.off --sizing by_mesh.json $output inner/back.pvtu
  refused "inner/back_0.vtu: would overwrite a file of a mesh that --sizing names" \
    mesh in.off --sizing by_mesh.json $output inner/back_0.vtu
done
refused "would overwrite INPUT" plan in.off --size 1 --report in.off
refused "would overwrite --sizing" plan in.off --sizing sizes.json --report around/sizes.json
refused "would overwrite MESH" stats inner/back.pvtu --report inner/back.pvtu
refused "would overwrite a file of MESH" stats inner/back.pvtu --report inner/back_0.vtu
refused "would overwrite a file of MESH" stats inner --report inner/back.pvtu
refused "--out inner/back_0.vtu: would overwrite a file of IN" improve inner/back.pvtu -o inner/back_0.vtu
refused "would overwrite IN" improve inner/back.pvtu -o better.vtu --report inner/back.pvtu
refused "would overwrite MESH" adapt inner/back_0.vtu -s 1 -o around/inner/back_0.vtu
refused "would overwrite --sizing" adapt inner/back_0.vtu --sizing sizes.json -o next.vtu --report sizes.json
refused "would overwrite a mesh that --sizing names" adapt in.off --sizing by_mesh.json -o inner/back.pvtu
# Outputs that are each other, there or not yet.
for pair in "r r" "r ./r" "first.json $here/first.json" "around/r r" "inner/r around/inner/../inner/r" "around/inner/r inner/r"; do
  set -- $pair
  refused "is the same file" mesh in.off "${coarse[@]}" --report $1 --trace $2
done
refused "is the same file" improve inner/back.pvtu -o x.vtu --report ./x.vtu
refused "is the same file" adapt inner/back.pvtu -s 1 -o x.vtu --report around/x.vtu
# Names that files have until they are complete.
cp "$here/in.off" "$here/r.json.part"
refused "until it is complete, and that is INPUT r.json.part" mesh r.json.part "${coarse[@]}" --report r.json
rm "$here/r.json.part"
refused "until it is complete, and that is --trace r.part" mesh in.off "${coarse[@]}" --report r --trace r.part
# What is written in folders.
refused "is the same file, or folder" mesh in.off "${coarse[@]}" --out o --report o
refused "is the same file, or folder" mesh in.off "${coarse[@]}" --out o --report inner/../o
refused "--out o/rank_0 is the same" mesh in.off "${coarse[@]}" --out o/rank_0 --spool o
for name in o/finished_run.txt around/o/mesh.pvtu o/mesh_0001.vtu o/surface.vtp o/unfinished/x o/spool/manifest.txt \
  o/mesh.pvtu.part; do
  refused "--out o is for files of this name" mesh in.off "${coarse[@]}" --out o --report $name
  refused "--out o is for files of this name" mesh in.off "${coarse[@]}" --out o --trace $name
done
refused "is for files of this name" mesh in.off "${coarse[@]}" --out o --spool s --report s/rank_0/manifest.txt
refused "is for files of this name" mesh in.off "${coarse[@]}" --out o --spool s --report s/rank_0/piece_1.blob
refused "--out inner: would overwrite" mesh in.off --sizing by_mesh.json --format vtu --out inner \
  --report "$(mv "$here/inner/back.pvtu" "$here/inner/mesh.pvtu"; sed -i s/back.pvtu/mesh.pvtu/ "$here/by_mesh.json"; echo r.json)"
prepare
ln -s ../in.off "$here/inner/compare.csv" # through which in.off would be written
refused "--out inner: would overwrite INPUT in.off" compare in.off --size 0.5 --out inner
rm "$here/inner/compare.csv"
mkdir "$here/runs" && cp "$here/in.off" "$here/runs/in.off"
refused "--out .: would overwrite --input runs/in.off" experiment table2 --input runs/in.off --out .
rm -r "$here/runs"

# What only looks like that.
made mesh in.off "${coarse[@]}" --format msh --out inner --report inner/mesh.pvtu --trace inner/mesh_notes.vtu
made mesh in.off "${coarse[@]}" --format none --out o --report /dev/null --trace /dev/null
made stats inner/mesh.msh --report report.json
prepare
made mesh in.off "${coarse[@]}" --out . --spool . --report report.json # beside the input
cmp -s "$here/in.off" "$inputs/cube.off" || fault "the input is another one"

# The files of every format are refused by the names that it gives them.
formats=$("$driver" mesh --help | tr '\n' ' ' | grep -oE 'several allowed: [^;]*' | sed 's/several allowed: //; s/,//g')
by_ranks=$("$driver" mesh --help | tr '\n' ' ' | grep -oE 'with --ranks also: [^;]*' | sed 's/with --ranks also: //; s/,//g')
[[ $formats == *vtu* && $by_ranks == *pvtu* ]] || fault "the formats are not found in the help: $formats; $by_ranks"
for format in $formats $by_ranks; do
  [[ $format == none ]] && continue
  prepare
  ranks=()
  [[ " $by_ranks " == *" $format "* ]] && ranks=(--ranks 2)
  made mesh in.off "${coarse[@]}" --format "$format" "${ranks[@]}" --out o --report o/report.json
  files=$(grep -oE '"name": "[^"]*", *$' "$here/o/report.json" | cut -d'"' -f4 | grep -E '[./0-9]' | sort -u)
  count=0
  for file in $files; do
    [[ -f $here/o/$file ]] || continue
    count=$((count + 1))
    refused "is for files of this name" mesh in.off "${coarse[@]}" --format "$format" "${ranks[@]}" --out o --report "o/$file"
  done
  ((count > 0)) || fault "$format: no files in the report"
done

# In a folder that the run makes itself.
prepare
made mesh in.off "${coarse[@]}" --out new --report new/report.json --trace new/trace.json
[[ -s $here/new/report.json && -s $here/new/trace.json ]] || fault "they are not there"
[[ -z $(find "$here" -name '*.part') ]] || fault "parts are left"
made mesh in.off "${coarse[@]}" --out new2 --spool spooled --report spooled/report.json
[[ -s $here/spooled/report.json ]] || fault "it is not there"

# at_once <expression> <arguments...>: fails before the model is read.
at_once() {
  local expression=$1 before
  shift
  what="dovetail $*"
  before=$(state)
  (cd "$here" && timeout 1000 "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
  ((status == 1)) || fault "exit code is $status, not 1"
  [[ $(wc -l <"$sandbox/stderr") == 1 ]] || fault "not one line"
  grep -qE -- "^dovetail: .*$expression" "$sandbox/stderr" || fault "the line does not match '$expression'"
  [[ $(state) == "$before" ]] || fault "files are not as they were: $(diff <(echo "$before") <(state))"
  return 0
}
prepare
for broken in "mesh nothing.step" "plan nothing.step" "stats nothing.vtu" "improve nothing.vtu -o x.vtu" \
  "adapt nothing.vtu -s 1 -o x.vtu"; do
  at_once "--report inner: .*there is a folder of this name" $broken --report inner
  at_once "cannot create the folder" $broken --report in.off/new/r
  at_once "--report in.off/r: cannot create" $broken --report in.off/r
done
mkdir "$here/x.vtu"
at_once "--out x.vtu: .*there is a folder of this name" improve nothing.vtu -o x.vtu
at_once "--out x.vtu: .*there is a folder of this name" adapt nothing.vtu -s 1 -o x.vtu
at_once "cannot create the folder" mesh nothing.step --out in.off
at_once "cannot create the folder" mesh nothing.step --spool in.off
at_once "--trace inner: " mesh nothing.step --trace inner
finish
