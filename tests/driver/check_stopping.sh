#!/bin/bash
# SIGTERM and Ctrl-C in every stage, also while a library does not come back: the run ends soon and leaves nothing.
#   check_stopping.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
frozen=
prepared= # folders and files of an earlier run that was killed

# A file that is read for several seconds.
{
  printf '%s\n' "ISO-10303-21;" "HEADER;" "FILE_DESCRIPTION((''),'2;1');" "FILE_NAME('','',(''),(''),'','','');" \
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));" "ENDSEC;" "DATA;"
  seq 1000000 | sed "s/.*/#&=CARTESIAN_POINT('',(0.,0.,0.));/"
  printf '%s\n' "ENDSEC;" "END-ISO-10303-21;"
} >"$inputs/long.step"

# stop_after <condition> <signal> <arguments...>: starts a run, sends the signal when the condition holds (a number of
# seconds, or the beginning of a line that the run has written), and expects it to end within two seconds.
stop_after() {
  local condition=$1 signal=$2
  shift 2
  what="dovetail $*, SIG$signal after $condition"
  rm -rf "$sandbox/work"
  mkdir -p "$sandbox/work${prepared:+/out/unfinished}"
  ((prepared)) && touch "$sandbox/work/out/unfinished/mesh_0000.vtu.part" "$sandbox/work/report.json.part"
  cd "$sandbox/work" || exit 1
  : >"$sandbox/stderr" # or the lines of the run before would be taken for those of this one
  env DOVETAIL_TEST="$sandbox" "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null &
  local process=$!
  cd "$OLDPWD" || exit 1
  if [[ $condition =~ ^[0-9.]+$ ]]; then
    sleep "$condition"
  else
    for ((tenths = 0; tenths < 1200; ++tenths)); do
      grep -q "^$condition" "$sandbox/stderr" && break
      kill -0 $process 2>/dev/null || break
      sleep 0.1
    done
  fi
  kill -0 $process 2>/dev/null || fault "it had ended before"
  ((frozen)) && pkill -STOP -P $process
  local begin=${EPOCHREALTIME/./}
  kill -"$signal" $process
  wait $process 2>/dev/null
  status=$?
  local milliseconds=$(((${EPOCHREALTIME/./} - begin) / 1000))
  echo "$what: $milliseconds ms"
  ((status == 130)) || fault "exit code is $status"
  ((milliseconds < 2000)) || fault "it took $milliseconds ms"
  [[ $(grep -c '^dovetail: stopped' "$sandbox/stderr") == 1 ]] || fault "not one line says that it was stopped"
  local left
  left=$(cd "$sandbox/work" && find . -type f ! -path './out/spool/*' ! -path './out/unfinished/*')
  [[ -z $left ]] || fault "left behind: $left"
  [[ -z $(find "$sandbox/work" -name '*.part') ]] || fault "parts of files are left"
  [[ $prepared || ! -e $sandbox/work/out ]] || compgen -G "$sandbox/work/out/spool/piece_*" >/dev/null ||
    [[ -e $sandbox/work/out/unfinished ]] || fault "a folder without a finished piece is left"
  grep -qlz "DOVETAIL_TEST=$sandbox" /proc/[0-9]*/environ 2>/dev/null && fault "a process lives on"
}

for signal in TERM INT; do
  stop_after 0.7 $signal mesh "$inputs/long.step"
done
stop_after 0.3 TERM mesh --model aircraft
stop_after geometry TERM mesh --model aircraft
stop_after planning TERM mesh --model aircraft
stop_after "background surface" TERM mesh --model aircraft
stop_after "background volume" TERM mesh --model aircraft
stop_after skeleton TERM mesh --model aircraft
stop_after intersection TERM mesh --model aircraft
stop_after 1 TERM mesh --model aircraft --executor serial
stop_after planning TERM mesh --model combustor --dimension 2
stop_after 1 TERM plan --model combustor
# A run that reacts to nothing any more: what it began to write is removed all the same.
frozen=1
stop_after geometry INT mesh --model aircraft
prepared=1
stop_after geometry TERM mesh --model aircraft --report report.json
finish
