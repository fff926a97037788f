#!/bin/bash
# A process of a run on several ranks is killed, in any stage: a relay, a process that computes, or a worker. Of the first
# two one line tells, all ends soon, and the next run goes on with other ranks. A worker costs nothing but time.
#   check_rank_faults.sh <driver> <mpirun> [all]
# Each stage is tried with each victim, on 2, 4 and 7 ranks in turn, and a run goes on from what the one before has left;
# with "all" each on each number of ranks from the beginning to the end. Of 4 ranks two compute, of 7 three; the others wait.
driver=$1
mpirun=$2
all=${3:-}
source "$(dirname "$0")/expectations.sh"
cd "$sandbox" || exit 1
write_cube >"$inputs/cube.off"
mesh=(mesh "$inputs/cube.off" --size 0.05 --subdomains 8 --ranks 3 --redistribute by-elements --format pvtu,msh-ranks
  --report report.json)

# What has been shown of the progress when a stage has begun, since each line comes when its stage is over.
stages=(background partition lines skeleton intersection meshing redistribution finishing)
[[ $all ]] && stages+=(moving reading)
declare -A begin=(
  [background]="planning" [partition]="background volume" [lines]="partition" [skeleton]="partition*lines"
  [intersection]="skeleton" [meshing]="intersection" [redistribution]="redistributing elements"
  [moving]="cutting pieces" [finishing]="moving elements" [reading]="finishing")

figure() {
  sed -n "s/^ *\"$1\": \"\{0,1\}\([^\",]*\).*/\1/p" "$2/report.json" | head -n 1
}
files_of() {
  (cd "$1/out" && find . -type f ! -name finished_run.txt -exec sha256sum {} + | sort)
}
fresh() {
  rm -rf "${sandbox:?}/$1" && mkdir "$sandbox/$1"
}

# The processes of a rank: its relay is mpirun's child, that one's child computes, whose children work.
# find_processes: sets $relays and $computing, by rank.
find_processes() {
  local relay rank
  relays=() computing=()
  children $process
  for relay in $found; do
    rank=$(tr '\0' '\n' <"/proc/$relay/environ" | sed -n 's/^OMPI_COMM_WORLD_RANK=//p')
    children "$relay"
    relays[rank]=$relay
    computing[rank]=$found
  done
}
# kill_one <rank>: the victim; a worker is one of the first that are started from now on, of whatever rank.
kill_one() {
  local found pid before=" "
  case $victim in
  relay) kill -KILL "${relays[$1]}" || fault "there is no relay" ;;
  computing) kill -KILL "${computing[$1]}" || fault "there is no computing process" ;;
  worker)
    for pid in "${computing[@]}"; do
      children "$pid"
      before+="$found "
    done
    while kill -0 $process 2>/dev/null; do
      for pid in "${computing[@]}"; do
        children "$pid"
        found=${found%% *}
        [[ $found && $before != *" $found "* ]] && kill -KILL "$found" 2>/dev/null && return
      done
    done
    fault "there was no worker"
    ;;
  esac
}
# kill_in <ranks> <stage> <rank> <arguments...>: starts in the folder "several" and kills when the stage has begun.
kill_in() {
  local ranks=$1 stage=$2 rank=$3 line seen=
  shift 3
  what="$ranks ranks: $victim of rank $rank killed in stage $stage"
  : >"$sandbox/stderr"
  rm -f "$sandbox/progress" && mkfifo "$sandbox/progress"
  (cd several && exec "$mpirun" -n "$ranks" "$driver" "$@" --rank-group "${group[ranks]}" >"$sandbox/stdout" 2>"$sandbox/progress" </dev/null) &
  process=$!
  exec 9<"$sandbox/progress"
  while IFS= read -r -t 100 -u 9 line; do
    [[ $seen ]] || find_processes
    seen+=$line
    # shellcheck disable=SC2053
    [[ $seen == *${begin[$stage]}* ]] && break
    echo "$line" >>"$sandbox/stderr"
  done
  kill_one "$rank"
  # shellcheck disable=SC2053
  [[ $seen == *${begin[$stage]}* ]] || fault "the stage had not begun"
  echo "$line" >>"$sandbox/stderr"
  cat <&9 >>"$sandbox/stderr" &
  reader=$!
  exec 9<&-
}
# see_it_end <seconds>: sets $status.
see_it_end() {
  local tenths
  wait_for_process "$1"
  for ((tenths = 0; tenths < 300; ++tenths)); do # until all that was said is read
    kill -0 $reader 2>/dev/null || break
    sleep 0.1
  done
  pgrep -f "$driver mesh $inputs" >/dev/null && fault "processes are left: $(pgrep -af "$driver mesh $inputs" | head -n 3)"
  kill $reader 2>/dev/null
  wait $reader 2>/dev/null
}
# Only whole files are there, under their final names or in the folder of those that are not finished.
only_whole_files() {
  local file
  while IFS= read -r file; do
    cmp -s "$file" "whole/out/${file##*/}" || fault "not as it should be: $file"
  done < <(find several -type f ! -path '*/spool/*' ! -name finished_run.txt ! -name report.json)
  file=$(find several -name '*.part' | head -n 3)
  [[ -z $file ]] || fault "left behind: $file"
}
same_as_whole() {
  ((status == 0)) || fault "exit code is $status"
  # Killed when only the checksums were missing, it has no report.
  grep -q "this run is finished" "$sandbox/stdout" ||
    [[ $(figure mesh_hash several) == "$(figure mesh_hash whole)" ]] || fault "another hash"
  [[ $(files_of several) == "$(files_of whole)" ]] || fault "other files"
}
# go_on <ranks>: to the end.
go_on() {
  what="$1 ranks: dovetail ${mesh[*]} --resume, after: $what"
  (cd several && timeout 1000 "$mpirun" -n "$1" "$driver" "${mesh[@]}" --resume --rank-group $((going_on++ % 3)) >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
  same_as_whole
}
# try <ranks> <stage> <options...>
try() {
  local ranks=$1 stage=$2 rank=$((tried++ % $1)) begun=$SECONDS
  shift 2
  kill_in "$ranks" "$stage" $rank "${mesh[@]}" "$@"
  see_it_end $([[ $victim == worker ]] && echo 100 || echo 10)
  echo "$what: exit code $status after $((SECONDS - begun)) s; $(grep '^dovetail: ' "$sandbox/stderr")"
  if [[ $victim == worker ]]; then
    same_as_whole
    return
  fi
  ((status != 0)) || fault "exit code is 0"
  [[ $victim == relay ]] || ((status == 1)) || fault "exit code is $status"
  [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
  grep -q "^dovetail: rank $rank: " "$sandbox/stderr" || fault "the line does not name rank $rank"
  only_whole_files
}

fresh whole
what="one rank"
(cd whole && "$mpirun" -n 1 "$driver" "${mesh[@]}" --workers 2 >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
status=$?
((status == 0)) || fault "exit code is $status"
cat "$sandbox/stderr"

numbers=(2 4 7)
going_on=0
group=([2]=1 [3]=1 [4]=2 [7]=3)
tried=0
for victim in relay computing worker; do
  fresh several
  for stage in "${stages[@]}"; do
    [[ $victim == worker && ($stage == partition || $stage == reading) ]] && continue # without tasks, or with none long enough
    if [[ $all ]]; then
      for k in 0 1 2; do
        fresh several
        try "${numbers[k]}" "$stage"
        ((status == 0)) || go_on "${numbers[(k + 1) % 3]}"
      done
    else
      try "${numbers[tried % 3]}" "$stage" --resume
      # What rank 0 has kept of the background before it heard is not made again, and the next stage not seen.
      [[ $status == 0 || $stage == background ]] && fresh several
    fi
  done
  [[ $all ]] || go_on "${numbers[tried % 3]}"
done

# Each rank looks after a spool of its own, here for what a worker might have left.
victim=computing
own=(--spool "$sandbox/spools")
fresh several
tried=2
try 3 meshing "${own[@]}"
touch "$sandbox/spools/rank_2/piece_begun.blob.part"
tried=2
try 3 finishing "${own[@]}" --resume
[[ ! -e $sandbox/spools/rank_2/piece_begun.blob.part ]] || fault "left in the spool of rank 2"
mesh+=("${own[@]}")
go_on 3
[[ -z $(find "$sandbox/spools" -type f) ]] || fault "left in spools: $(find "$sandbox/spools" -type f | head -n 3)"
finish
