#!/bin/bash
# Every public name has a description in the reference, and one that has none, or a mistake in a comment, is a fault that
# names the place.
#   check_reference.sh <source directory> <work directory>
set -euo pipefail
source=$1
work=$2
"$source/scripts/reference" --check

rm -rf "$work"
mkdir -p "$work"
cp -r "$source/include" "$source/scripts" "$work"
ln -s "$source/tests" "$source/examples" "$work"
include=$work/include/dovetail
without() { # file, the begin of the line before which a comment ends, which is taken away
  awk -v line="$2" '/^ *\/\/\// { kept = kept $0 "\n"; next }
    index($0, line) == 1 { kept = "" }
    { printf "%s%s\n", kept, $0; kept = "" }' "$include/$1" >"$work/changed"
  ! cmp -s "$work/changed" "$include/$1" || { echo "$1 has no commented line '$2'"; exit 1; }
  mv "$work/changed" "$include/$1"
}
without graph/contraction.hpp 'csr_graph make_csr_graph('
without graph/csr_graph.hpp 'struct csr_graph {'
without sizing/concepts.hpp 'template <class H>'
without pipeline/parameters.hpp '  double limit_seconds'
sed -i 's|double weight = 1; *///<.*|double weight = 1;|' "$include/graph/contraction.hpp"
sed -i '1,/^#pragma/ s|^///.*||' "$include/core/ids.hpp"
sed -i 's|^/// An undirected edge|/// An <undirected> edge|' "$include/graph/contraction.hpp"

if said=$("$work/scripts/reference" --check 2>&1); then
  echo "a name without a description is no fault"
  exit 1
fi
for wanted in 'contraction.hpp:[0-9]*: dovetail::make_csr_graph has' 'csr_graph.hpp:[0-9]*: dovetail::csr_graph has' \
    'sizing/concepts.hpp:[0-9]*: dovetail::sizing_field has' 'parameters.hpp:[0-9]*: dovetail::generate_options::limit_seconds has' \
    'contraction.hpp:[0-9]*: dovetail::weighted_edge::weight has' 'core/ids.hpp: it does not say' \
    'contraction.hpp:[0-9]*: .*undirected'; do
  grep -q "$wanted" <<<"$said" || { echo "not said: $wanted, but:"; echo "$said"; exit 1; }
done
rm -rf "$work"
