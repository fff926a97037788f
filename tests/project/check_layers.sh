#!/bin/bash
# A header includes its own module and those that cmake/modules.txt lets it include. In a module of several layers, the core
# and the mesher, a file includes its own folder, lower layers, and of the folders of its own layer what says what a role is: its
# concepts. In the core these are data (1) and tools (2), which may build on each other
# within their layer, and stages (3), which do not include each other: the pipeline, a module of its own, joins them.
# Other libraries are included only where the list says so: all else compiles with nothing installed but a compiler.
set -euo pipefail
source cmake/modules.sh
cd include/dovetail

problems=0
complain() {
  echo "$1"
  problems=1
}

for path in "${!module_of_path[@]}" "${!component_of_path[@]}"; do
  [[ -d $path || -f $path.hpp ]] || complain "cmake/modules.txt: there is no $path"
done
headers=$(find . -mindepth 2 -name '*.?pp' -printf '%P\n' | sort)
while read -r file; do
  find_place "$file" || complain "$file is in no module"
done <<<"$headers"
previous=
while IFS=: read -r file include; do
  if [[ $file != "$previous" ]]; then
    find_place "$file" || continue
    previous=$file
    own_module=$module own_layer=$layer own_component=$component
  fi
  target=${include#*\"dovetail/}
  target=${target%%\"*}
  find_place "$target" || { complain "$file includes $target, which is in no module"; continue; }
  if [[ $module != "$own_module" && ${includes_of[$own_module]} != *" $module "* ]]; then
    complain "$file includes $target: the module $own_module may not include the module $module"
  fi
  # An adapter's target brings all that its library needs.
  if [[ $component && $component != "$own_component" && $own_module != adapters ]]; then
    complain "$file includes $target, which needs $component, and the list does not say that it does"
  fi
  [[ $module == "$own_module" && ${file%%/*} != "${target%%/*}" ]] || continue
  [[ $target == */concepts.hpp ]] && continue
  ((layer > own_layer)) && complain "$file includes $target of a higher layer"
  ((layer == own_layer && layer > 1 && layer == layers_of[$module])) && complain "$file includes $target of another stage"
done < <(xargs grep -H '#include "' <<<"$headers")

# A stage works on values: how these become bytes is the business of those who run its tasks (parallel/map_tasks.hpp).
stages=(background simplification partition decomposition skeleton remesh intersection meshing pipeline)
while IFS= read -r place; do
  complain "$place: a stage names bytes"
done < <(grep -rnE 'byte_(buffer|reader|writer)' "${stages[@]}" || true)

# Where results are kept, and which ranks make them, is the executor's business (parallel/kept.hpp, parallel/memo.hpp).
alone=(background simplification decomposition skeleton remesh intersection meshing)
while IFS= read -r place; do
  complain "$place: a stage names a store, a key, a rank or a folder for results"
done < <(grep -rnE 'core/content_key|parallel/(any_communicator|common_memory|entity_store|run_results|spool)|(content_key|key_maker|entity_store|run_results|spool|store_of|lasting_store_of)\b|(\.|->)(network|leads|results)\(|\b(network_of|results_of|has_others|leads)\(' \
  "${alone[@]}" | grep -vE ':[0-9]+: *///' || true)

# Its policies are template parameters: what hides one behind one type is a model of its role like others.
while IFS= read -r place; do
  complain "$place: a stage names a type-erased policy"
done < <(grep -rnE 'any_(mesher|improver|partitioner|simplification_rule|surface_mesher)\b' "${stages[@]}" \
  | grep -vE '^[a-z]+/any_[a-z_]+\.[hi]pp:|:[0-9]+: *///' || true)

# Nor do they name what holds a model or an executor: the pipeline does, where it is entered.
while IFS= read -r place; do
  complain "$place: a stage names a type-erased model or executor"
done < <(grep -rnE 'any_(geometry|executor)\b' "${alone[@]}" \
  | grep -vE '^background/whole_domain\.[hi]pp:|:[0-9]+: *///' || true)

while IFS=: read -r file include; do
  header=${include#*<}
  header=${header%%>*}
  is_system "$header" && continue
  find_place "$file" || continue
  [[ $component ]] || complain "$file includes the header <$header> of another library, and the list does not say which it needs"
done < <(xargs grep -H '#include <' <<<"$headers")

exit $problems
