#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# slurm.sh CLI WORK: a benchmark on a Slurm cluster of two nodes of this machine, one of which is
# killed in the middle of a task. The cluster is its own: it listens on ports of its own and keeps
# all its files, munge's key included, below WORK. Exits with 77, saying so, without Slurm or root.
set -eu
cli=$1
work=$2

PATH=$PATH:/usr/sbin
for tool in slurmctld slurmd sbatch scontrol squeue munged; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (slurm-wlm, munge)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: a cluster of its own needs root"; exit 77; }

fail() { echo "failed: $*" >&2; tail -n 20 "$run"/*.log >&2 || true; exit 1; }
# until_true SECONDS COMMAND…: waits for what the command tests; the limit only ends what hangs.
until_true() {
  left=$(($1 * 10)); shift
  until "$@"; do
    left=$((left - 1))
    [ $left -gt 0 ] || fail "waited in vain for: $*"
    sleep 0.1
  done
}

rm -rf "$work"
mkdir -p "$work"
run=$(mktemp -d)  # short and safe: munge refuses sockets in folders that others may write
export SLURM_CONF="$run/slurm.conf"
stop() {
  for pid in "$run"/*.pid; do
    [ ! -f "$pid" ] || kill -9 "$(cat "$pid")" 2>/dev/null || true
  done
  rm -rf "$run"
}
trap stop EXIT
trap 'exit 1' INT TERM

# Free ports, so that tests beside this one and a real cluster do not matter.
port=$((20000 + $$ % 10000 * 4))
[ $port -lt 60000 ] || port=$((port - 20000))
dd if=/dev/urandom of="$run/key" bs=128 count=1 2>/dev/null
chmod 400 "$run/key"
chmod 755 "$run"
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=localhost
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$run/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=5
KillWait=1
SlurmUser=root
StateSaveLocation=$run/state
SlurmdSpoolDir=$run/%n
SlurmctldPidFile=$run/ctld.pid
SlurmdPidFile=$run/%n.pid
SlurmctldLogFile=$run/ctld.log
SlurmdLogFile=$run/%n.log
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1
PartitionName=p Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
mkdir "$run/state" "$run/n1" "$run/n2"
munged --force --key-file="$run/key" --socket="$run/munge.socket" --pid-file="$run/munge.pid" \
  --log-file="$run/munge.log" --seed-file="$run/seed" 2>"$run/munge_start.log"
slurmctld
slurmd -N n1
slurmd -N n2
nodes_are_idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; }
until_true 60 nodes_are_idle

cd "$work"
mkdir edge slant
for scene in edge slant; do
  "$cli" synthesize $scene -o $scene/lf.h5 --views 5x5 --size 96x96 --quiet
done
what="edge slant --methods epi_s,st_ch_l --search --quiet"
"$cli" benchmark $what -o one

"$cli" benchmark $what -o many --task-seconds 2 --slurm "--partition=p --time=1:00:00"

# The node of a task that has finished one run, but not all, is killed with all that runs there, as by
# a cut of its power. Stopped first, so that it cannot finish meanwhile.
descendants() {
  for child in $(pgrep -P "$1"); do
    descendants "$child"
    echo "$child"
  done
}
signal_all() {
  kill "-$1" $2 2>/dev/null || true
}
victim_is_caught() {
  victim=$(squeue -h -t running -w n1 -o "%A %K" | head -n 1)
  [ -n "$victim" ] || return 1
  job=${victim% *}
  task=${victim#* }
  [ -s "many/tasks/$task.jsonl" ] || return 1
  steps=$(pgrep -f "^slurmstepd: \[$job\.") || return 1
  all=$(for step in $steps; do descendants "$step"; echo "$step"; done)
  signal_all STOP "$all"
  "$cli" benchmark -o many --status --json | tr -d ' \n' |
    grep -q "\"unfinished\":\[\([0-9,]*,\)*$task[],]" && return 0
  signal_all CONT "$all"
  return 1
}
until_true 120 victim_is_caught
finished=$(wc -l <"many/tasks/$task.jsonl")
kill -9 "$(cat "$run/n1.pid")"
signal_all KILL "$all"
echo "killed node n1 in task $task, which had finished $finished runs"
node_is_down() { sinfo -h -n n1 -o %t | grep -q down; }
until_true 120 node_is_down
is_queued_again() { squeue -h -j "$job" -t pending -o %A | grep -q .; }
until_true 60 is_queued_again
scontrol update "JobId=$job" StartTime=now  # else two minutes later; n1 stays down

queue_is_empty() { [ -z "$(squeue -h)" ]; }
until_true 280 queue_is_empty
[ "$(wc -l <"many/tasks/$task.jsonl")" -gt "$finished" ] || fail "the killed task was not run again"
"$cli" benchmark -o many --status
"$cli" benchmark -o many --status --json | tr -d ' \n' >status.json
grep -q '"failed":0,"missing":0.*"unfinished":\[\]' status.json || fail "not all was done"
[ -f many/index.html ] || fail "the tables were not made"

# The same tables, but for the times; nothing was computed twice.
for folder in one many; do
  sed -E 's/(fast|medium|slow),[0-9.]+//' $folder/tables.csv >$folder.csv
done
cmp one.csv many.csv || fail "the tables differ"
cat many/tasks/*.jsonl | grep -o '"key":"[0-9a-f]*"' | sort | uniq -d >twice
[ ! -s twice ] || fail "computed twice: $(cat twice)"
[ "$(cat many/tasks/*.jsonl | wc -l)" = "$(wc -l <one/log.jsonl)" ] || fail "not every run is in the logs"

"$cli" benchmark $what -o many --task-seconds 2 --slurm "" | grep -q "^nothing to submit" ||
  fail "finished tasks were submitted again"
echo passed
