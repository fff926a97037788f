#!/bin/bash
# Every public name has a description in the reference, every parameter of a function a type and a meaning, and what
# documents tell to call says what it throws and costs; what is missing, or a mistake in a comment, is a fault that names
# the place. So is a page that lacks a table or a link, as one does that is made by a broken script.
#   check_reference.sh <source directory> <work directory>
set -euo pipefail
source=$1
work=$2
"$source/scripts/reference" --check

rm -rf "$work"
mkdir -p "$work"
cp -r "$source/include" "$source/scripts" "$work"
ln -s "$source/tests" "$source/examples" "$source/docs" "$source/README.md" "$work"
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
sed -i '/param part_of_triangle/d; /^\/\/\/ Linear. Throws nothing.$/d' "$include/decomposition/extract_skeleton.hpp"
sed -i '/param cell /d' "$include/core/hilbert_curve.hpp"
sed -i 's|param rounding|param no_rounding|' "$include/models/implicit/shapes.hpp"
sed -i 's|^/// An undirected edge|/// An <undirected> edge|' "$include/graph/contraction.hpp"

if said=$("$work/scripts/reference" --check 2>&1); then
  echo "a name without a description is no fault"
  exit 1
fi
for wanted in 'contraction.hpp:[0-9]*: dovetail::make_csr_graph has' 'csr_graph.hpp:[0-9]*: dovetail::csr_graph has' \
    'sizing/concepts.hpp:[0-9]*: dovetail::sizing_field has' 'parameters.hpp:[0-9]*: dovetail::generate_options::limit_seconds has' \
    'contraction.hpp:[0-9]*: dovetail::weighted_edge::weight has' 'core/ids.hpp: it does not say' \
    'contraction.hpp:[0-9]*: .*undirected' \
    'dovetail::own_subdomains is to be called, and has no .param part_of_triangle' \
    'dovetail::own_subdomains is to be called, and does not say what it throws' \
    'dovetail::own_subdomains is to be called, and does not say its complexity' \
    'hilbert_curve.hpp:[0-9]*: dovetail::hilbert_place does not say what cell is' \
    'the table of dovetail::hilbert_place has not name, type and meaning of cell' 'hilbert_curve.md: an empty cell: .*`cell`' \
    "shapes.hpp:[0-9]*: .*'no_rounding' of command @param is not found"; do
  grep -q "$wanted" <<<"$said" || { echo "not said: $wanted, but:"; echo "$said"; exit 1; }
done

# Pages, where the headers are right and what makes them is not.
rm -rf "$include"
cp -r "$source/include" "$work"
for change in 's/text += self.parameters(name) +/text +=/' 's/ self.result_of(name) +//' \
    's/{self.declarations(name)}{self.description(name)}/{self.declarations(name)}/'; do
  cp "$work/scripts/reference" "$work/before"
  sed -i "$change" "$work/scripts/reference"
  ! cmp -s "$work/before" "$work/scripts/reference" || { echo "nothing in scripts/reference is changed by $change"; exit 1; }
done
if said=$("$work/scripts/reference" --check 2>&1); then
  echo "broken pages are no fault"
  exit 1
fi
for wanted in 'the table of dovetail::generate has not name, type and meaning of policies' \
    'the entry of dovetail::generate does not link to its result dovetail::generated' \
    'dovetail::cancelled has no entry in its page'; do
  grep -q "$wanted" <<<"$said" || { echo "not said: $wanted, but:"; head <<<"$said"; exit 1; }
done
rm -rf "$work"
