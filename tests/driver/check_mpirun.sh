#!/bin/bash
# The driver on several ranks: the mesh of one process, one progress, one message and one exit code, also when a process
# is killed; and a run that goes on with another number of ranks.
#   check_mpirun.sh <driver> <mpirun>
driver=$1
mpirun=$2
source "$(dirname "$0")/expectations.sh"
cd "$sandbox" || exit 1
write_cube >"$inputs/cube.off"
# Each rank computes by itself where nothing else is said, so that they have something to tell each other.
mesh=(mesh "$inputs/cube.off" --size 0.08 --subdomains 6 --report report.json --rank-group 1)

# on_ranks <number> <folder> <arguments...>: sets $status.
on_ranks() {
  local ranks=$1 folder=$2
  shift 2
  what="$ranks ranks: dovetail $*"
  (cd "$folder" && timeout 1000 "$mpirun" -n "$ranks" "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
}
figure() {
  sed -n "s/^ *\"$1\": \"\{0,1\}\([^\",]*\).*/\1/p" "$2/report.json" | head -n 1
}
fresh() {
  rm -rf "$sandbox/$1" && mkdir "$sandbox/$1"
}
# Files without the times and sizes of processes, and without what says how the run was made.
files_of() {
  (cd "$1/out" && find . -type f ! -name finished_run.txt -exec sha256sum {} + | sort)
}
no_process_left() {
  sleep 0.2
  pgrep -f "$driver mesh $inputs" >/dev/null && fault "processes are left: $(pgrep -af "$driver mesh $inputs" | head -n 3)"
}
nothing_left() {
  local left
  left=$(find "$1" -name '*.part' | head -n 3)
  [[ -z $left ]] || fault "left behind: $left"
  no_process_left
}

# 1. The same mesh, byte by byte, and one report.
fresh alone
on_ranks 1 alone "${mesh[@]}" --workers 2 --format vtu,msh
((status == 0)) || fault "exit code is $status"
for ranks in 2 4 7; do
  fresh several
  on_ranks $ranks several "${mesh[@]}" --format vtu,msh
  ((status == 0)) || fault "exit code is $status"
  [[ $(files_of several) == "$(files_of alone)" ]] || fault "other files than with one rank"
  [[ $(figure mesh_hash several) == "$(figure mesh_hash alone)" ]] || fault "another hash"
  [[ $(figure executor several) == ranks && $(figure workers several) == "$ranks" ]] || fault "the report tells of other workers"
  [[ $(grep -c "^The mesh is in" "$sandbox/stdout") == 1 ]] || fault "not one summary"
  [[ $(grep -c "^meshing  " "$sandbox/stderr") == 1 ]] || fault "not one line of progress for the meshing"
  nothing_left several
done
fresh several
on_ranks 2 several "${mesh[@]}" --format vtu,msh --workers 2
[[ $(figure workers several) == 4 && $(files_of several) == "$(files_of alone)" ]] || fault "not four workers, or other files"
fresh several
what="workers that are more than the processors of a rank"
(cd several && taskset -c 0 "$mpirun" -n 2 "$driver" "${mesh[@]}" --format vtu,msh --workers 2 >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
grep -q "the 2 workers of a rank have 1 processors: mpirun binds" several/report.json || fault "the report does not say so"
[[ $(files_of several) == "$(files_of alone)" ]] || fault "other files"
fresh several
on_ranks 3 several "${mesh[@]}" --format vtu,msh --executor serial
[[ $(files_of several) == "$(files_of alone)" ]] || fault "other files"
# By the other decomposition too.
fresh whole
on_ranks 1 whole "${mesh[@]}" --decomposition bisection --workers 2
((status == 0)) || fault "exit code is $status"
fresh several
on_ranks 3 several "${mesh[@]}" --decomposition bisection
[[ $status == 0 && $(files_of several) == "$(files_of whole)" ]] || fault "other files by bisection than with one rank"
# And the files for the ranks of a solver, of second order.
for_solver=("${mesh[@]}" --ranks 3 --ghosts --order 2 --format pvtu,msh-ranks,mfem)
if "$driver" mesh --help | grep -q "vtkhdf"; then
  for_solver[-1]+=,xdmf,vtkhdf
fi
fresh whole
on_ranks 1 whole "${for_solver[@]}" --workers 2
((status == 0)) || fault "exit code is $status"
fresh several
on_ranks 3 several "${for_solver[@]}"
[[ $status == 0 && $(files_of several) == "$(files_of whole)" ]] || fault "other files for a solver than with one rank"
# And of a solver's ranks, who share HDF5 files, whoever writes them.
if "$driver" mesh --help | grep -q "vtkhdf"; then
  fresh whole
  on_ranks 1 whole "${mesh[@]}" --ranks 4 --ghosts --format xdmf,vtkhdf
  ((status == 0)) || fault "exit code is $status"
  fresh several
  on_ranks 3 several "${mesh[@]}" --ranks 4 --ghosts --format xdmf,vtkhdf
  [[ $status == 0 && $(files_of several) == "$(files_of whole)" ]] || fault "other HDF5 files than with one rank"
  [[ ! -e $sandbox/several/out/unfinished ]] || fault "unfinished files are left"
fi

# As one group, and in groups: the first of each computes, the others wait.
own=${#mesh[@]}
for ranks_and_group in "3 0" "4 2" "7 3"; do
  read -r ranks group <<<"$ranks_and_group"
  fresh several
  on_ranks "$ranks" several "${mesh[@]:0:own-1}" "$group" --format vtu,msh
  ((status == 0)) || fault "exit code is $status"
  [[ $(files_of several) == "$(files_of alone)" ]] || fault "other files than with one rank"
  [[ $(figure executor several) == ranks ]] || fault "the report tells of another executor"
  [[ $(grep -c "^The mesh is in" "$sandbox/stdout") == 1 ]] || fault "not one summary"
  nothing_left several
done
fresh several
on_ranks 3 several "${mesh[@]:0:own-2}" --format vtu,msh # no more workers than processors
processors=$(nproc)
[[ $(figure workers several) == $((processors < 3 ? processors : 3)) ]] || fault "the report tells of other workers"
fresh several
on_ranks 3 several "${mesh[@]:0:own-2}" --format vtu,msh --workers $((processors + 1)) # unless one rank was given more
[[ $(figure workers several) == $((processors + 1)) ]] || fault "the report tells of other workers"
[[ $(files_of several) == "$(files_of alone)" ]] || fault "other files than with one rank"
what="two ranks of a group that are bound to a processor each"
if "$mpirun" --version | grep -q "(Open MPI) 4" && ((processors > 1)); then
  fresh several
  (cd several && "$mpirun" --bind-to core -n 2 "$driver" "${mesh[@]:0:own-2}" --format vtu,msh >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  [[ $(figure workers several) == 2 && $(files_of several) == "$(files_of alone)" ]] || fault "not two workers, or other files"
fi

# 2. An error that all meet is said once; other commands know nothing of ranks.
one_line() {
  ((status == $1)) || fault "exit code is $status, not $1"
  [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
  grep -q "^dovetail: .*$2" "$sandbox/stderr" || fault "the line does not match '$2'"
  grep -q "^dovetail: rank" "$sandbox/stderr" && fault "the line blames one rank"
}
fresh several
on_ranks 3 several mesh "$inputs/none.off"
one_line 1 "none.off: there is no such file"
on_ranks 3 several mesh "$inputs/none.off" --rank-group 1
one_line 1 "none.off: there is no such file"
on_ranks 3 several mesh --nonsense
one_line 2 "--nonsense"
on_ranks 3 several "${mesh[@]}" --executor threads
one_line 2 "--executor"
on_ranks 3 several "${mesh[@]:0:own-1}" 2 --executor serial
one_line 2 "--rank-group: with --executor serial"
on_ranks 3 several "${mesh[@]:0:own-1}" -1
one_line 2 "--rank-group: -1 is negative"
on_ranks 3 several "${mesh[@]}" --out /proc/none
one_line 1 "/proc/none"
on_ranks 2 several models
((status == 0)) && [[ $(grep -c "^orbiter" "$sandbox/stdout") == 2 ]] || fault "not each rank lists the models"

# Ranks that differ, and a program that another MPI has started.
for group in 1 2; do
  what="two ranks with different options, in groups of $group"
  (cd several && "$mpirun" -n 1 "$driver" "${mesh[@]:0:own-1}" $group : -n 1 "$driver" "${mesh[@]:0:own-1}" $group --force >"$sandbox/stdout" 2>"$sandbox/stderr")
  status=$?
  ((status == 1)) || fault "exit code is $status, not 1"
  grep -q "^dovetail: rank 1: this rank starts from '.*--force', and rank 0 from" "$sandbox/stderr" || fault "the line does not say what differs"
done
for variables in "PMI_RANK=0 PMI_SIZE=2" "SLURM_PROCID=0 SLURM_STEP_NUM_TASKS=2"; do
  what="$variables without mpirun"
  (cd several && timeout 1000 env $variables "$driver" "${mesh[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr")
  status=$?
  ((status == 1)) || fault "exit code is $status, not 1"
  grep -q "^dovetail: rank 0: mpirun says rank 0 of 2, and MPI rank 0 of 1" "$sandbox/stderr" || fault "the line does not say what is wrong"
done

# Libraries that partition on all ranks, called by the relays. Their parts hang on the number of ranks, and on nothing else.
cut=(mesh "$inputs/cube.off" --size 0.06 --subdomains 6 --ranks 3 --redistribute by-elements --improve-again=none --format pvtu
  --report report.json) # as one group, where the library does not need each rank
fresh gathered
on_ranks 3 gathered "${cut[@]}"
((status == 0)) || fault "exit code is $status"
for library in ptscotch parmetis; do
  if ! "$driver" mesh --help | grep -A 3 -e --rank-partitioner | grep -q $library; then
    echo "not tried, since the driver was built without it: $library"
    continue
  fi
  fresh several
  on_ranks 3 several "${cut[@]}" --rank-partitioner $library
  ((status == 0)) || fault "exit code is $status"
  grep -q "gives other parts on another number of ranks" "$sandbox/stdout" || fault "the summary does not say that the parts depend on it"
  [[ $(files_of several) != "$(files_of gathered)" ]] || fault "the files of the partitioner of one rank"
  expect_success check "$sandbox/several/out/ranks.pvtu"
  fresh again
  on_ranks 3 again "${cut[@]}" --rank-partitioner $library
  [[ $status == 0 && $(files_of again) == "$(files_of several)" ]] || fault "other files when it is done again"
  on_ranks 2 again "${cut[@]}" --rank-partitioner $library --resume
  ((status == 0)) || fault "exit code is $status"
  grep -q "this run is finished" "$sandbox/stdout" && fault "taken for the mesh of three ranks"
  expect_success check "$sandbox/again/out/ranks.pvtu"
  on_ranks 2 several "${cut[@]/%3/100000}" --rank-partitioner $library
  one_line 1 "cannot make 100000 parts"
  nothing_left several
done

# 3. A run that is killed goes on with another number of ranks.
long=(mesh "$inputs/cube.off" --size 0.028 --subdomains 8 --report report.json --rank-group 1)
fresh whole
on_ranks 1 whole "${long[@]}" --workers 2
((status == 0)) || fault "exit code is $status"

# started <number of ranks>, then waits for the beginning of a line of progress.
start_until() {
  local ranks=$1 stage=$2
  shift 2
  fresh several
  : >"$sandbox/stderr"
  what="$ranks ranks: $*, until $stage"
  (cd several && exec "$mpirun" -n "$ranks" "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null) &
  process=$!
  for ((tenths = 0; tenths < 10000; ++tenths)); do
    tr '\r' '\n' <"$sandbox/stderr" | grep -q "^$stage" && break
    kill -0 $process 2>/dev/null || break
    sleep 0.1
  done
  kill -0 $process 2>/dev/null || fault "it had ended before"
}
# The processes of a rank: its relay is mpirun's child, that one's child computes, whose children work.
relays() { pgrep -P "$process" -f "$driver"; }
computing() { for relay in $(relays); do pgrep -P "$relay"; done; }
resume_on() {
  on_ranks "$1" several "${long[@]}" --resume
  ((status == 0)) || fault "exit code is $status"
  [[ $(figure mesh_hash several) == "$(figure mesh_hash whole)" ]] || fault "another hash after resuming"
}

# Release candidates of Open MPI 6.0: ranks crash in MPI when another one is gone, and may be told of first; an mpirun that
# is asked to stop kills its ranks at once, so that they can neither say so nor take away what is unfinished.
mpi_is_unfinished=false
"$mpirun" --version | grep -q "(Open MPI) 6.0.0rc" && mpi_is_unfinished=true

# In one group (0) the first computes, and the last waits.
for victim in first last; do
  for stage in planning partition intersection; do
    group=$([[ $stage == partition ]] && echo 0 || echo 1)
    start_until 3 "$stage" "${long[@]:0:${#long[@]}-1}" "$group" # its line comes at its end
    if [[ $victim == first ]]; then
      kill -SEGV "$(computing | head -n 1)"
    else
      kill -SEGV "$(computing | tail -n 1)"
    fi
    wait_for_process 10
    ((status == 1)) || fault "exit code is $status, not 1"
    [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
    grep -q "^dovetail: .*ended by signal 11" "$sandbox/stderr" || fault "the line does not say what happened"
    $mpi_is_unfinished || [[ $victim == first ]] || grep -q "^dovetail: rank 2: " "$sandbox/stderr" || fault "the line does not name the rank"
    nothing_left several
  done
done
resume_on 7

start_until 2 intersection "${long[@]}"
kill -KILL "$(relays | tail -n 1)"
wait_for_process 10
((status != 0)) || fault "exit code is 0"
nothing_left several
resume_on 1

says_that_it_was_stopped() {
  ((status != 0)) || fault "exit code is 0"
  if $mpi_is_unfinished; then
    echo "not tried, since mpirun kills at once: what ranks say that are stopped"
    return
  fi
  [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
  grep -qE "^dovetail: (rank [0-9]: )?stopped; --resume goes on" "$sandbox/stderr" || fault "the line does not say that it was stopped"
  nothing_left several
}

# 4. A run that is stopped. An mpirun that is asked to stop waits a second before it asks the ranks to.
long[3]=0.016
fresh whole
on_ranks 1 whole "${long[@]}" --workers 2
((status == 0)) || fault "exit code is $status"
start_until 4 intersection "${long[@]}"
kill -TERM $process
wait_for_process 10
says_that_it_was_stopped
resume_on 2

# A rank that waits is asked to stop; its computing process is the one without children.
start_until 3 intersection "${long[@]:0:8}"
for waiting in $(computing); do
  [[ $(pgrep -P "$waiting") || $waiting == "$(computing | head -n 1)" ]] || break
done
kill -TERM "$waiting"
wait_for_process 10
((status != 0)) || fault "exit code is 0"
[[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
no_process_left
resume_on 3

# 5. Spools on disks that the other ranks do not see, of which one is lost.
disks=$sandbox/disks
fresh several
on_ranks 4 several "${mesh[@]}" --format vtu,msh --spool "$disks"
((status == 0)) || fault "exit code is $status"
[[ $(files_of several) == "$(files_of alone)" ]] || fault "other files than with one spool"
[[ -d $disks && -z $(find "$disks" -mindepth 1) && ! -e several/out/spool ]] || fault "the spools are not gone: $(find "$disks")"
start_until 3 intersection "${long[@]}" --spool "$disks"
kill -TERM $process
wait_for_process 10
says_that_it_was_stopped
for rank in 0 1 2; do
  [[ $(find "$disks/rank_$rank" -name '*.blob') ]] || fault "rank $rank has kept nothing"
done
rm -r "$disks/rank_1"
long+=(--spool "$disks")
resume_on 2
[[ -z $(find "$disks/rank_0" "$disks/rank_1" -type f 2>/dev/null) ]] || fault "the spools of the two ranks are not gone"

# Each rank has one, then they are a group: those that wait keep nothing. And the other way round.
rm -rf "$disks"
grouped=("${long[@]:0:8}" --spool "$disks" --rank-group)
for one_then in "1 0" "0 1" "2 1"; do
  read -r first then <<<"$one_then"
  start_until 3 intersection "${grouped[@]}" "$first"
  kill -TERM $process
  wait_for_process 10
  says_that_it_was_stopped
  on_ranks 3 several "${grouped[@]}" "$then" --resume
  ((status == 0)) || fault "exit code is $status"
  [[ $(figure mesh_hash several) == "$(figure mesh_hash whole)" ]] || fault "another hash after resuming"
  [[ -z $(find "$disks" -type f) ]] || fault "left in spools: $(find "$disks" -type f | head -n 3)"
done

finish
