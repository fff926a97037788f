#!/bin/bash
# Wrong command lines.
#   check_command_line.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

expect_success --help
expect_success --version
expect_success mesh --help
expect_success models
grep -q aircraft "$sandbox/stdout" || fault "the aircraft is not listed"

expect_error "required|subcommand"
expect_error "not expected|nonsense" nonsense
expect_error "nonsense" mesh --nonsense
expect_error "nonsense" mesh --model nonsense
expect_error "nonsense.*tetgen" mesh --model combustor --mesher nonsense
expect_error "nonsense.*native" mesh --model combustor --dimension 2 --mesher nonsense
expect_error "nonsense.*metis" mesh --model combustor --partitioner nonsense
expect_error "nonsense.*native" mesh --model combustor --improver nonsense
expect_error "nonsense.*processes" mesh --model combustor --executor nonsense
expect_error "nonsense.*vtu" mesh --model combustor --format nonsense
expect_error "tetgen.*threads" mesh --model combustor --executor threads
expect_error "--workers" mesh --model combustor --workers -1
expect_error "--workers" mesh --model combustor --workers two
expect_error "--subdomains" mesh --model combustor --subdomains 0
expect_error "--subdomains" mesh --model combustor --subdomains -4
expect_error "--files" mesh --model combustor --files -1
expect_error "--coarsening" mesh --model combustor --coarsening 0
expect_error "not both" mesh part.step --model combustor
expect_error "excludes|sizing" mesh --model combustor --size 1 --sizing sizing.json
expect_error "required|MESH" check
expect_error "required|MESH" stats
expect_error "required" improve
expect_error "required|--out" improve mesh.vtu

for size in 0 -1 nan -nan inf 1e-400; do
  expect_error "--size" mesh --model combustor --size=$size
  expect_error "--size" plan --model combustor --size=$size
done
expect_error "--size" mesh --model combustor --size large
expect_error "larger than the model" mesh --model combustor --size 1e9
expect_error "--size: 1e-20 is less" mesh --model combustor --size 1e-20

# The examples at the end of each help are command lines: what is missing are their files.
examples=0
for command in mesh plan check stats improve compare; do
  mapfile -t lines < <("$driver" $command --help | sed -n '/^Examples:/,$ s/^  dovetail //p')
  ((${#lines[@]})) || { what="$command --help"; fault "there is no example"; }
  for line in "${lines[@]}"; do
    expect_error 'wing|plate|sizes|mesh' $line
    ((status == 1)) || fault "the example is a wrong command line"
    examples=$((examples + 1))
  done
done
((examples >= 8)) || fault "there are $examples examples only"
finish
