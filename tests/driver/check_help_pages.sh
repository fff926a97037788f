#!/bin/bash
# Completion and man pages, made when the driver was built, against the help: no command, option or choice is missing.
#   check_help_pages.sh <driver> <folder of the pages>
driver=$1
pages=$2
source "$(dirname "$0")/expectations.sh"
source "$pages/dovetail.bash"

complete_words() { # the words of a command line, the last one unfinished: sets COMPREPLY
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  what="completion of $*"
  _dovetail
}
expect_offered() { # words that must be among those offered
  local word
  for word in "$@"; do
    printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$word" || fault "$word is not offered"
  done
}
: >"$sandbox/stdout"
: >"$sandbox/stderr"

mapfile -t commands < <("$driver" --help | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z]*\) .*/\1/p')
((${#commands[@]} >= 7)) || fault "there are ${#commands[@]} commands in the help"
complete_words dovetail ""
expect_offered "${commands[@]}"
checked=0
for command in "" "${commands[@]}"; do
  page=$pages/man1/dovetail${command:+-$command}.1
  mapfile -t options < <("$driver" $command --help | grep -E '^  -' | grep -oE '^  [^ ]+' | tr -d ' ' | sed 's/{.*//' | tr ',' '\n')
  complete_words dovetail $command -
  expect_offered "${options[@]}"
  what=$page
  [[ -s $page ]] || { fault "there is no such page"; continue; }
  if command -v groff >/dev/null; then
    groff -ww -man -Tascii -P-cbou -rLL=1000n "$page" >"$sandbox/page" 2>"$sandbox/stderr" || fault "it is not set"
    [[ ! -s $sandbox/stderr ]] || fault "groff warns"
  else
    sed 's/\\-/-/g' "$page" >"$sandbox/page"
  fi
  for option in "${options[@]}"; do
    grep -qE -- "(^|[ ,B])$option([ ,\\]|$)" "$sandbox/page" || fault "$option is not on the page"
    grep -A 900 -E "^    ${command:--}\)" "$pages/_dovetail" | sed '/;;/q' | grep -qF -- "$option[" ||
      fault "$option is not in the completion for zsh"
    checked=$((checked + 1))
  done
done
what="all commands"
((checked > 60)) || fault "only $checked options were checked"
grep -q "EXIT STATUS" "$pages/man1/dovetail.1" || fault "no exit codes on the page of the driver"

# What is offered for an option are the names that the driver takes.
complete_words dovetail mesh --partitioner ""
expect_offered metis greedy
complete_words dovetail mesh --improver h
expect_offered hard
((${#COMPREPLY[@]} == 1)) || fault "more than what begins so"
complete_words dovetail mesh --improve-again = lo
expect_offered loehner
complete_words dovetail compare --partitioners metis,gr
expect_offered metis,greedy
complete_words dovetail mesh --unit = f
expect_offered file
complete_words dovetail mesh --size ""
((${#COMPREPLY[@]} == 0)) || fault "offered: ${COMPREPLY[*]}"
: >"$sandbox/part.step"
complete_words dovetail mesh "$sandbox/pa"
expect_offered "$sandbox/part.step"
finish
