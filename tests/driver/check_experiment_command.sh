#!/bin/bash
# Experiments of the paper on a small model: tables, what is kept, what fails.
#   check_experiment_command.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

write_cube >"$inputs/cube.off"
kept=$sandbox/kept
experiment() { expect_success experiment "$@" --input "$inputs/cube.off" --workers 1 --out "$kept"; }

# The table is on the terminal and in three files, and the runs are as mesh makes them.
experiment table2 --scale 20000
[[ $(ls "$kept") == $'runs\ntable2.csv\ntable2.json\ntable2.md' ]] || fault "other files than expected"
diff <(sed '$d' "$sandbox/stdout") "$kept/table2.md" >"$sandbox/stderr" || fault "another table on the terminal than in the file"
grep -qE '^\| Entire scheme \(s\) \| 102\.50 \| [0-9.]+ \| [0-9.]+ \| 341\.00 ' "$kept/table2.md" || fault "no times beside the paper's"
(($(grep -c ',paper,' "$kept/table2.csv") == 40 && $(grep -c ',measured,' "$kept/table2.csv") == 40 && \
  $(grep -c ',simulated,' "$kept/table2.csv") == 40)) || fault "other numbers than expected"
# Across the smallest cube go five elements, so that one layer more or less is a fifth of them.
for run in "F16-I 1400 20" "F16-II 6050 15" "F16-III 20600 15" "F16-IV 50000 15"; do
  read -r name asked percent <<<"$run"
  made=$(awk -F, -v run="$name" '$2 == "Tetrahedra" && $4 == run && $5 == "measured" { print $6 }' "$kept/table2.csv")
  ((made > asked * (100 - percent) / 100 && made < asked * (100 + percent) / 100)) || fault "$made tetrahedra for $run"
done
line=$(sed -n 's/^- F16-III: `dovetail \(.*\)`, mesh \([0-9a-f]*\)$/\1 \2/p' "$kept/table2.md")
read -ra words <<<"$line"
cp "$kept/runs/cube_20600_75_32/report.json" "$inputs/report.json"
expect_success "${words[@]:0:${#words[@]}-1}" --report report.json
grep -q "\"mesh_hash\": \"${words[-1]}\"" "$sandbox/work/report.json" || fault "mesh makes another mesh"
grep -q "\"mesh_hash\": \"${words[-1]}\"" "$inputs/report.json" || fault "the hash is of another run"

# What is there is not made again; what is not there, or was asked for otherwise, is.
cp "$kept/table2.csv" "$inputs/before.csv"
experiment table2 --scale 20000
(($(grep -c 'is there from before' "$sandbox/stderr") == 4)) || fault "runs are made again"
cmp -s "$kept/table2.csv" "$inputs/before.csv" || fault "other figures of the same runs"
rm "$kept/runs/cube_6050_75_32/run.json"
experiment table2 --scale 20000
(($(grep -c 'is there from before' "$sandbox/stderr") == 3)) || fault "an unfinished run is taken for a finished one"
sed -i 's/"--workers",/"--workers", "7",/' "$kept/runs/cube_1400_75_32/run.json"
experiment table2 --scale 20000
(($(grep -c 'is there from before' "$sandbox/stderr") == 3)) || fault "a run of another command line is taken"

# So is what another build has made, whatever its version; a copy of the same is the same.
cp "$driver" "$sandbox/copied"
cp "$driver" "$sandbox/rebuilt"
echo >>"$sandbox/rebuilt"
for build in "copied 4" "rebuilt 0" "rebuilt 4"; do
  driver="$sandbox/${build% *}" experiment table2 --scale 20000
  (($(grep -c 'is there from before' "$sandbox/stderr") == ${build#* })) || fault "other runs taken than ${build#* } by a $build"
done

# All of them, and runs that several share are made once. A plot is made, or a line says how.
experiment all --scale 50000 # some hundred runs
for name in table{2..10} fig10 fig{13..16}; do
  for ending in md csv json; do
    [[ -s $kept/$name.$ending ]] || fault "no $name.$ending"
  done
done
(($(grep -c ': made$' "$sandbox/stderr") == $(ls "$kept/runs" | wc -l) - 4)) || fault "shared runs are made again"
for name in fig10 fig{13..16}; do
  [[ -s $kept/$name.png ]] || grep -q "$name.png is not made: \(matplotlib is not there\|.*python3\)" "$sandbox/stderr" ||
    fault "neither a plot nor a word on $name"
done
! grep -q failed "$sandbox/stderr" || fault "runs fail"

# The seconds of each are told and kept, and those of all; they add up.
for name in table{2..10} fig10 fig{13..16} thresholds rules interfaces; do
  seconds=$(sed -n "s/^$name: \([0-9.]*\) s$/\1/p" "$sandbox/stderr")
  kept_seconds=$(sed -n 's/^  "seconds": \([0-9.e-]*\),$/\1/p' "$kept/$name.json")
  echo "$name ${seconds:-none} ${kept_seconds:-none}"
done >"$inputs/seconds"
all=$(sed -n 's/^all 17 experiments: \([0-9.]*\) s$/\1/p' "$sandbox/stderr")
awk -v all="${all:--1}" '$2 == "none" || $3 == "none" || ($2 - $3)^2 > 0.01 { bad = 1 } { sum += $2 }
  END { exit bad || sum == 0 || sum > all + 1 }' "$inputs/seconds" || fault "no seconds, or of another time than all took"

# Runs beside others are in their columns: bisection, and what improvers do that go back to the interfaces.
for label in "Algorithm 2: domain decomposition" "Performance gap" "Entire improvement" "Second pass" "Improvement of Algorithm 1"; do
  for source in measured simulated; do
    grep -qE ",$label,[^,]*,[^,]*,$source,-?[0-9.]*[1-9]" "$kept"/table{7,10}.csv || fault "no $label, $source"
  done
done
for line in 'F16-I, Algorithm 2: `dovetail mesh .*--decomposition bisection' 'Ito: `dovetail mesh .*--improve-again=ito'; do
  grep -qE "^- $line.*, mesh [0-9a-f]{16}$" "$kept"/table{7,10}.md || fault "no line of a run: $line"
done
mkdir "$sandbox/bin"
printf '#!/bin/bash\necho no such colour >&2\nexit 1\n' >"$sandbox/bin/python3"
chmod +x "$sandbox/bin/python3"
PATH="$sandbox/bin:$PATH" experiment fig16 --scale 50000
grep -q "fig16.png is not made: no such colour" "$sandbox/stderr" || fault "not the message of the script that plots"
experiment fig16 --scale 50000 --quiet
grep -q "Every run is of .*cube.off" "$kept/fig16.md" || fault "the table does not say that the model is another"
! grep -q 'is there\|: [0-9.]* s$' "$sandbox/stderr" || fault "not quiet"

# A run that fails is a result: nothing holds so many elements.
run_driver experiment table5 --input "$inputs/cube.off" --scale 1e-12 --workers 1 --out "$sandbox/failing"
((status == 1)) || fault "exit code is $status where runs of our own method fail"
grep -qE '^dovetail: 3 of 3 runs failed: cube_[^ ]*: .*; cube_' "$sandbox/stderr" || fault "no word on runs that failed"
grep -qE '^cube_[^ ]*: failed: [^ ]+ ' "$sandbox/stderr" || fault "failed runs are not told as they fail"
grep -q '`, failed: ' "$sandbox/failing/table5.md" || fault "the table does not say why runs failed"

run_driver experiment table3 fig16 --input "$inputs/cube.off" --scale 1e-12 --workers 1 --out "$sandbox/failing"
(($(grep -c '^cube_.*: failed: ' "$sandbox/stderr") == 4 && $(grep -c '^cube_.*: failed before: ' "$sandbox/stderr") == 4)) ||
  fault "runs that fail are made again for another table"

# So is that of a baseline, which is told by its own message everywhere, and no failure of ours.
run_driver experiment table10 --input "$inputs/cube.off" --scale 4e6 --workers 1 --out "$sandbox/baseline"
((status == 0)) || fault "exit code is $status where baselines fail"
reason="cannot make 128 parts of a graph with [0-9]* nodes"
grep -qE "^dovetail: 2 of 3 runs failed: cube_[^ ]*=ito: $reason.*; cube_[^ ]*=loehner: $reason" "$sandbox/stderr" ||
  fault "failed baselines are not counted and named"
grep -qE "^cube_[^ ]*=ito: failed: $reason" "$sandbox/stderr" || fault "a baseline's message is not told"
grep -qE "^- Ito: .*, failed: $reason" "$sandbox/baseline/table10.md" || fault "no message in the table"
grep -qE "^table10,failure,,Loehner,measured,\"?$reason" "$sandbox/baseline/table10.csv" || fault "no message in the CSV"
grep -qE "\"failure\": \"$reason" "$sandbox/baseline/table10.json" || fault "no message in the JSON"

# A stop leaves what is finished.
(
  cd "$sandbox/work" || exit
  exec "$driver" experiment table2 --scale 500 --input "$inputs/cube.off" --workers 1 --out "$sandbox/stopped" \
    >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null
) &
job=$!
for ((tenths = 0; tenths < 10000; ++tenths)); do
  grep -q 'cube_56000_3000_32: made' "$sandbox/stderr" && break
  sleep 0.1
done
kill -TERM "$job"
wait "$job"
status=$?
what="a stopped experiment"
((status == 130)) || fault "exit code is $status"
grep -q "the same command goes on" "$sandbox/stderr" || fault "no word on going on"
[[ -s $sandbox/stopped/runs/cube_56000_3000_32/run.json ]] || fault "the finished run is lost"
[[ -z $(find "$sandbox/stopped" -name '*.md') ]] || fault "a table of a part"

expect_usage_error "there is no experiment 'table1'; there are: table2, .*all" experiment table1
expect_usage_error "NAME is required" experiment
expect_usage_error "--scale" experiment table2 --scale 0
expect_usage_error "--scale: 1e.08 leaves 0.28 elements of a mesh" experiment table2 --scale 1e8 --out "$sandbox/too_small"
expect_error "nowhere.step" experiment table2 --input nowhere.step

finish
