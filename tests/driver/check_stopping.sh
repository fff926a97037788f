#!/bin/bash
# SIGTERM and Ctrl-C in every stage, also while a library does not come back: the run ends soon, keeps what another one
# can go on from, and leaves nothing else.
#   check_stopping.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
frozen=
prepared= # folders and files of an earlier run that was killed, and of others
foreign=(out/downloads/film.mkv.part out/spool/cron_jobs out/failed/notes.off.part out/film.mkv.part)

# A file that is read for several seconds.
{
  printf '%s\n' "ISO-10303-21;" "HEADER;" "FILE_DESCRIPTION((''),'2;1');" "FILE_NAME('','',(''),(''),'','','');" \
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));" "ENDSEC;" "DATA;"
  seq 1000000 | sed "s/.*/#&=CARTESIAN_POINT('',(0.,0.,0.));/"
  printf '%s\n' "ENDSEC;" "END-ISO-10303-21;"
} >"$inputs/long.step"

# What is written under temporary names, and files of others whose names are much like these.
prepare() {
  local file
  for file in out/unfinished/0/mesh_0000.vtu.part out/mesh.msh.part report.json.part "${foreign[@]}"; do
    mkdir -p "$sandbox/work/$(dirname "$file")" && touch "$sandbox/work/$file"
  done
}

# Takes the files of others away again, which must all be there.
remove_foreign() {
  local file
  for file in "${foreign[@]}"; do
    rm "$sandbox/work/$file" || fault "$file is gone"
  done
  rmdir "$sandbox/work/out/"{downloads,spool,failed}
}

# stop_after <condition> <signal> <arguments...>: starts a run, sends the signal when the condition holds (a number of
# seconds since it began to work, or the beginning of a line that it has written), and expects it to end within two
# seconds.
stop_after() {
  local condition=$1 signal=$2
  shift 2
  what="dovetail $*, SIG$signal after $condition"
  rm -rf "$sandbox/work"
  mkdir -p "$sandbox/work"
  ((prepared)) && prepare
  cd "$sandbox/work" || exit 1
  : >"$sandbox/stderr" # or the lines of the run before would be taken for those of this one
  env DOVETAIL_TEST="$sandbox" "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null &
  local process=$!
  cd "$OLDPWD" || exit 1
  if [[ $condition =~ ^[0-9.]+$ ]]; then
    until pgrep -P $process >/dev/null || ! kill -0 $process 2>/dev/null; do
      sleep 0.05 # on a busy machine it takes its time to start
    done
    sleep "$condition"
  else
    for ((tenths = 0; tenths < 10000; ++tenths)); do
      grep -q "^$condition" "$sandbox/stderr" && break
      kill -0 $process 2>/dev/null || break
      sleep 0.1
    done
  fi
  kill -0 $process 2>/dev/null || fault "it had ended before"
  ((frozen)) && pkill -STOP -P $process
  local begin
  begin=$(now)
  kill -"$signal" $process
  wait $process 2>/dev/null
  status=$?
  local milliseconds=$(($(now) - begin))
  echo "$what: $milliseconds ms"
  ((status == 130)) || fault "exit code is $status"
  expect_soon $milliseconds 2000
  [[ $(grep -c '^dovetail: stopped' "$sandbox/stderr") == 1 ]] || fault "not one line says that it was stopped"
  ((prepared)) && remove_foreign
  local left kept
  left=$(cd "$sandbox/work" && find . -type f ! -path './out/spool/*' ! -path './out/unfinished/*')
  [[ -z $left ]] || fault "left behind: $left"
  [[ -z $(find "$sandbox/work" -name '*.part') ]] || fault "parts of files are left"
  kept=$(compgen -G "$sandbox/work/out/spool/*.blob")
  [[ $prepared || $kept || ! -e $sandbox/work/out ]] || fault "a folder is left with nothing to go on from"
  [[ ! -e $sandbox/work/out/unfinished || $kept ]] || fault "unfinished files are left"
  if grep -q -- "--resume" "$sandbox/stderr"; then
    [[ $kept ]] || fault "there is nothing to go on from"
  else
    [[ ! $kept ]] || fault "that another run can go on is not said"
  fi
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
compgen -G "$sandbox/work/out/spool/background_*" >/dev/null || fault "what was made before the first piece is not kept"
stop_after intersection TERM mesh --model aircraft
stop_after 1 TERM mesh --model aircraft --executor serial
stop_after planning TERM mesh --model combustor --dimension 2
stop_after 1 TERM plan --model combustor
# A run that reacts to nothing any more: what it began to write is removed all the same.
frozen=1
stop_after geometry INT mesh --model aircraft
stop_after skeleton INT mesh --model aircraft
compgen -G "$sandbox/work/out/spool/background_*" >/dev/null || fault "what was made before the first piece is not kept"
prepared=1
stop_after geometry TERM mesh --model aircraft --report report.json

# Started by a process that does not want to hear of the end of its children.
what="dovetail models, with SIGCHLD ignored"
timeout -s KILL 1000 perl -e '$SIG{CHLD} = "IGNORE"; exec @ARGV' "$driver" models >"$sandbox/stdout" 2>"$sandbox/stderr"
status=$?
((status == 0)) || fault "exit code is $status"
finish
