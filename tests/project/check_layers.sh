#!/bin/bash
# The folders of include/dovetail are layers. A file includes its own folder, lower layers and any role's concepts; a
# stage never includes another stage; third parties are included by adapters only. Within tier 2 executors come first:
# meshers run on them, and remeshers, since a mesher of surfaces is one.
set -euo pipefail
cd include/dovetail

declare -A tier=(
  [core]=10 [mesh]=10 [graph]=10 [geometry]=10 [sizing]=10
  [parallel]=20 [partition]=21 [remesh]=21 [mesher]=22 [improver]=21 [io]=21
  [background]=30 [simplification]=30 [decomposition]=30 [skeleton]=30 [intersection]=30
  [pipeline]=40
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
  [[ $target == */concepts.hpp ]] && continue
  ((other > own)) && complain "$file includes $target of a higher layer"
  ((own == other && own > 10)) && complain "$file includes $target of its own layer"
done < <(grep -H '#include "dovetail/' */*.hpp)

# Headers of the standard library have no slash and no dot; POSIX ones are listed. graph/ models Boost.Graph's concepts.
posix='^(sys|unistd\.h|fcntl\.h|signal\.h|pthread\.h|poll\.h|dirent\.h|errno\.h|malloc\.h|netinet|linux)'
adapters='^(partition/(metis|scotch|parmetis|spectral|greedy)|mesher/(tetgen|gmsh|hxt|netgen|cgal)|improver/(gmsh|netgen|cgal)|geometry/(occt|discrete|builtin_models)|parallel/mpi|io/(hdf5|zlib)|sizing/json|graph/)'
while IFS=: read -r file include; do
  header=${include#*<}
  header=${header%%>*}
  [[ $header =~ ^[a-z_0-9]+$ || $header =~ $posix ]] && continue
  [[ $file =~ $adapters ]] || complain "$file includes the third-party header <$header> and is no adapter"
done < <(grep -H '#include <' */*.hpp)

exit $problems
