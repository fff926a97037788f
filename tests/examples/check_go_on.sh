#!/bin/bash
# A second run of the example finds all pieces that the first has made, and makes the same mesh.
#   check_go_on.sh <example>
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
first=$("$1" "$folder/spool")
second=$("$1" "$folder/spool")
printf '%s\n' "$first" "$second"
pattern='^([0-9]+ tetrahedra in ([0-9]+) pieces), of which ([0-9]+) had been made before$'
[[ $first =~ $pattern && ${BASH_REMATCH[3]} == 0 ]]
made=${BASH_REMATCH[1]}
[[ $second =~ $pattern && ${BASH_REMATCH[1]} == "$made" && ${BASH_REMATCH[3]} == "${BASH_REMATCH[2]}" ]]
