#!/bin/bash
# The folders of include/dovetail are layers. A file includes its own folder, its own tier's concepts and lower tiers;
# a stage never includes another stage; third parties are included by adapters only.
set -euo pipefail
cd include/dovetail

declare -A tier=(
  [core]=1 [mesh]=1 [graph]=1 [geometry]=1 [sizing]=1
  [partition]=2 [remesh]=2 [mesher]=2 [improver]=2 [parallel]=2 [io]=2
  [background]=3 [simplification]=3 [decomposition]=3 [skeleton]=3 [intersection]=3
  [pipeline]=4
)

problems=0
complain() {
  echo "$1"
  problems=1
}

while IFS=: read -r file include; do
  folder=${file%%/*}
  target=${include#*\"dovetail/}
  target=${target%%\"*}
  target_folder=${target%%/*}
  [[ $folder == "$target_folder" ]] && continue
  own=${tier[$folder]:?has no tier}
  other=${tier[$target_folder]:?has no tier}
  ((other > own)) && complain "$file includes $target of a higher tier"
  ((own == 3 && other == 3)) && complain "$file includes $target: a stage includes another stage"
  ((own == 2 && other == 2)) && [[ $target != */concepts.hpp ]] &&
    complain "$file includes $target of its own tier, which is not a concept"
done < <(grep -H '#include "dovetail/' */*.hpp)

# Headers of the standard library have no slash and no dot; POSIX ones are listed. graph/ models Boost.Graph's concepts.
posix='^(sys|unistd\.h|fcntl\.h|signal\.h|pthread\.h|poll\.h|dirent\.h|errno\.h|netinet|linux)'
adapters='^(partition/(metis|scotch|parmetis|spectral|greedy)|mesher/(tetgen|gmsh|hxt|netgen|cgal)|improver/(gmsh|netgen|cgal)|geometry/(occt|discrete|builtin_models)|parallel/mpi|io/hdf5|sizing/json|graph/)'
while IFS=: read -r file include; do
  header=${include#*<}
  header=${header%%>*}
  [[ $header =~ ^[a-z_0-9]+$ || $header =~ $posix ]] && continue
  [[ $file =~ $adapters ]] || complain "$file includes the third-party header <$header> and is no adapter"
done < <(grep -H '#include <' */*.hpp)

exit $problems
