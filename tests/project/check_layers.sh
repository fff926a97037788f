#!/bin/bash
# The folders of include/dovetail are layers. A file includes its own folder, lower layers, and of the folders of its own
# layer what says what a role is: its concepts, and the models of them behind one type (any_*).
# Layers 1 to 4 are the core, which is what the paper says: data (1) and tools (2) may build on each other within their
# layer; stages (3) do not include each other, the pipeline (4) joins them. The core includes no third party: it compiles with
# nothing installed but a compiler. Around it are modules (5), which do not include each other either: kinds of models,
# files, processes and ranks. Adapters of libraries (6), some of which need a process of their own, what solvers need (6), and
# the paper's experiments (7) are built of these.
set -euo pipefail
cd include/dovetail

declare -A layer=(
  [core]=1 [mesh]=1 [graph]=1 [geometry]=1 [sizing]=1 [triangulation]=1
  [partition]=2 [remesh]=2 [mesher]=2 [improver]=2 [parallel]=2 [meshing]=2
  [background]=3 [simplification]=3 [decomposition]=3 [skeleton]=3 [intersection]=3
  [pipeline]=4
  [models]=5 [files]=5 [distributed]=5
  [adapters]=6 [solver]=6
  [experiments]=7
)

problems=0
complain() {
  echo "$1"
  problems=1
}

for folder in */; do
  [[ ${layer[${folder%/}]:-} ]] || complain "the folder $folder has no layer"
done
for folder in "${!layer[@]}"; do
  [[ -d $folder ]] || complain "there is no folder $folder"
done
while IFS=: read -r file include; do
  folder=${file%%/*}
  target=${include#*\"dovetail/}
  target=${target%%\"*}
  target_folder=${target%%/*}
  [[ $folder == "$target_folder" ]] && continue
  own=${layer[$folder]:?has no layer}
  other=${layer[$target_folder]:?has no layer}
  ((other < 5)) && [[ $target == */concepts.hpp || $target == */any_*.hpp ]] && continue
  ((other > own)) && complain "$file includes $target of a higher layer"
  ((own == other && own > 2)) && complain "$file includes $target of another stage or module"
done < <(find . -mindepth 2 \( -name '*.hpp' -o -name '*.ipp' \) -printf '%P\n' | sort | xargs grep -H '#include "dovetail/')

# A stage works on values: how these become bytes is the business of those who run its tasks (parallel/map_tasks.hpp).
stages=(background simplification partition decomposition skeleton remesh intersection meshing pipeline)
while IFS= read -r place; do
  complain "$place: a stage names bytes"
done < <(grep -rnE 'byte_(buffer|reader|writer)' "${stages[@]}" || true)

# Its policies are template parameters: what hides one behind one type is a model of its role like others.
while IFS= read -r place; do
  complain "$place: a stage names a type-erased policy"
done < <(grep -rnE 'any_(mesher|improver|partitioner|simplification_rule|surface_mesher)\b' "${stages[@]}" \
  | grep -vE '^[a-z]+/any_[a-z_]+\.[hi]pp:|:[0-9]+: *///' || true)

# Headers of the standard library have no slash and no dot; POSIX ones are listed.
posix='^(sys|unistd\.h|fcntl\.h|signal\.h|pthread\.h|poll\.h|sched\.h|dirent\.h|errno\.h|malloc\.h|netinet|linux)'
third_parties='^(adapters/|models/occt|experiments/builtin_models|files/(zlib|json_tree|hdf5)|distributed/mpi)'
while IFS=: read -r file include; do
  header=${include#*<}
  header=${header%%>*}
  [[ $header =~ ^[a-z_0-9]+$ || $header =~ $posix ]] && continue
  [[ $file =~ $third_parties ]] || complain "$file includes the third-party header <$header> and is no adapter"
done < <(find . -mindepth 2 -name '*.?pp' -printf '%P\n' | sort | xargs grep -H '#include <')

exit $problems
