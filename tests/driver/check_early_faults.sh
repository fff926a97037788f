#!/bin/bash
# A relay is killed before all ranks speak MPI: one line tells it, and all ends. And what Open MPI leaves in memory when
# mpirun itself is killed is gone after the next run.
#   check_early_faults.sh <driver> <mpirun>
driver=$1
mpirun=$2
source "$(dirname "$0")/expectations.sh"
cd "$sandbox" || exit 1
# Not PMIx's store in shared memory: mpirun waits for ever for a lock in it that a process had when it was killed.
export PMIX_MCA_gds=hash
write_cube >"$inputs/cube.off"
mesh=(mesh "$inputs/cube.off" --size 0.05 --subdomains 8 --report report.json)

start() {
  rm -rf several && mkdir several
  (cd several && exec "$mpirun" -n "$1" "$driver" "${mesh[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null) &
  process=$!
  relays=()
}
# The relays that are there by now, by rank.
find_relays() {
  local relay rank
  children $process
  for relay in $found; do
    rank=$(tr '\0' '\n' 2>/dev/null <"/proc/$relay/environ" | sed -n 's/^OMPI_COMM_WORLD_RANK=//p')
    [[ $rank ]] && relays[rank]=$relay
  done
}
# How many relays the computing process of this one watches.
watched_by() {
  children "$1"
  readlink "/proc/${found%% *}/fd/"* 2>/dev/null | grep -c pidfd
}
await_others_of() {
  local rank begun=$SECONDS
  for ((rank = 0; rank < $1; ++rank)); do
    ((rank == $2)) && continue
    until [[ ${relays[rank]:-} && $(watched_by "${relays[rank]}") -eq $1 ]]; do
      kill -0 $process 2>/dev/null || { fault "it ends by itself" && return; }
      ((SECONDS - begun < 60)) || { fault "rank $rank does not watch the relays" && return; }
      find_relays
    done
  done
}
ends_in_one_line() {
  wait_for_process 60
  ((status != 0)) || fault "exit code is 0"
  [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
  grep -q "^dovetail: rank $1: .*killed.*signal 9" "$sandbox/stderr" || fault "the line does not say that rank $1 was killed"
  local left
  left=$(find several -mindepth 1)
  [[ -z $left ]] || fault "left behind: $left"
  pgrep -f "$driver mesh $inputs" >/dev/null && fault "processes are left: $(pgrep -af "$driver mesh $inputs" | head -n 3)"
}

# The others wait in MPI for one that does not go on.
for ranks in 2 4 7; do
  for ((victim = 0; victim < ranks; victim += ranks - 1)); do
    what="$ranks ranks: the relay of rank $victim killed before it speaks MPI"
    start $ranks
    until [[ ${relays[victim]:-} ]]; do
      find_relays
    done
    kill -STOP "${relays[victim]}"
    await_others_of $ranks $victim
    kill -KILL "${relays[victim]}"
    ends_in_one_line $victim

    what="$ranks ranks: the relay of rank $victim killed when it has a computing process"
    start $ranks
    found=
    until [[ $found ]]; do
      find_relays
      children "${relays[victim]:-none}"
    done
    kill -STOP "${relays[victim]}"
    await_others_of $ranks $victim
    kill -KILL "${relays[victim]}"
    ends_in_one_line $victim
  done
done

# Segments of shared memory, of which those of other programs' runs are no matter.
what="mpirun killed"
mesh[3]=0.01 # it takes long
[[ $("$mpirun" --version) == *OpenRTE* ]] || export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,sm # else from version 5 on there may be none
start 2
segments=()
until ((${#segments[@]} == 2)); do
  kill -0 $process 2>/dev/null || { fault "it ends by itself" && finish; }
  find_relays
  mapfile -t segments < <(for relay in "${relays[@]}"; do grep -ho '/dev/shm/\(vader\|sm\)_segment\..*' "/proc/$relay/maps"; done 2>/dev/null | sort -u)
done
kill -KILL $process
wait $process 2>/dev/null
while pgrep -f "$driver mesh $inputs" >/dev/null; do
  sleep 0.1
done
touch "${segments[@]}" # any run of another test removes them too
what="the next run"
"$mpirun" -n 2 "$driver" mesh "$inputs/none.off" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null
[[ ! -e ${segments[0]} && ! -e ${segments[1]} ]] || fault "left behind: ${segments[*]}"

finish
