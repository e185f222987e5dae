#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Proves the Slurm profile on this machine: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/fleet/prove_slurm.sh
Starts a Slurm of one node on loopback (munged, slurmctld, slurmd, all in a temporary folder), runs
a small fleet on it by tools/fleet/slurm, kills the node in mid-run with all its jobs, brings it
back, and checks that the table is that of a fleet without Slurm. It takes four minutes, most of
them Slurm's own waits. Needs Debian's packages slurmctld, slurmd, slurm-client and munge, and what
tools/fleet.sh needs.
Environment: LIO_BUILD  build folder with the programs (build)
Exit codes: 0 nothing was lost, 1 something was, 77 a package is missing.
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for program in munged slurmctld slurmd sbatch snakemake; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || {
    echo "prove_slurm.sh: skipped: $program is missing; install slurmctld slurmd slurm-client" \
      "munge snakemake" >&2
    exit 77
  }
done
PATH=$PATH:/usr/sbin
base=$(mktemp -d)
fleet_pid='' pids=()

say() { echo "prove_slurm: $*"; }

# The processes below a process, itself last.
tree_of() { # PID
  local child
  for child in $(ps -o pid= --ppid "$1"); do tree_of "$child"; done
  echo "$1"
}

# A step's keeper, slurmstepd, leaves slurmd's tree, so it is known by its environment.
keeps_a_step_of_ours() { # PID
  tr '\0' '\n' <"/proc/$1/environ" | grep -qx "SLURM_CONF=$base/slurm.conf"
}

node_processes() {
  local process
  for process in $(ps -C slurmstepd -o pid=); do
    if keeps_a_step_of_ours "$process" 2>/dev/null; then tree_of "$process"; fi
  done
  cat "$base/slurmd.pid" 2>/dev/null || true
}

kill_all() { # PID...
  local process
  for process in "$@"; do kill -9 "$process" 2>/dev/null || true; done
}

finish() {
  local code=$?
  if ((code != 0)); then tail -n 20 "$base"/*.log "$base/fleet.txt" >&2 2>/dev/null || true; fi
  # shellcheck disable=SC2046 # the numbers are words
  kill_all $fleet_pid $(node_processes) "${pids[@]}"
  rm -rf "$base"
}
trap finish EXIT

free_port() {
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0))
print(s.getsockname()[1])'
}

start_munge() {
  chmod 755 "$base" && mkdir -p "$base/munge" && chmod 755 "$base/munge"
  (umask 077 && head -c 1024 /dev/urandom >"$base/munge/key")
  munged --foreground --force --socket "$base/munge/socket" --key-file "$base/munge/key" \
    --pid-file "$base/munge/pid" --seed-file "$base/munge/seed" --num-threads 2 \
    >"$base/munged.log" 2>&1 &
  pids+=($!)
  disown # so that bash does not tell that it was killed
}

write_configuration() {
  local user memory_mb
  user=$(id -un)
  memory_mb=$(awk '/^MemTotal:/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
  cat >"$base/slurm.conf" <<CONF
ClusterName=fleet
SlurmctldHost=node(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$base/munge/socket
CredType=cred/munge
StateSaveLocation=$base/state
SlurmdSpoolDir=$base/spool
SlurmctldPidFile=$base/slurmctld.pid
SlurmdPidFile=$base/slurmd.pid
SlurmctldLogFile=$base/slurmctld.log
SlurmdLogFile=$base/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=2,batch_sched_delay=1
ReturnToService=2
SlurmdTimeout=10
KillWait=2
UnkillableStepTimeout=5
MpiDefault=none
NodeName=node NodeAddr=127.0.0.1 NodeHostname=$(hostname -s) CPUs=2 RealMemory=$memory_mb
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
CONF
  sed -i "s/^SlurmctldHost=node/SlurmctldHost=$(hostname -s)/" "$base/slurm.conf"
  export SLURM_CONF=$base/slurm.conf
}

start_controller() {
  mkdir -p "$base/state" "$base/spool"
  slurmctld -D >"$base/slurmctld.out.log" 2>&1 &
  pids+=($!)
  disown # so that bash does not tell that it was killed
}

start_node() {
  slurmd -D -N node >"$base/slurmd.out.log" 2>&1 &
  pids+=($!)
  disown # so that bash does not tell that it was killed
}

wait_until() { # SECONDS WORDS COMMAND...
  local end=$((SECONDS + $1)) words=$2
  shift 2
  until "$@"; do
    if [[ -n $fleet_pid ]] && ! kill -0 "$fleet_pid" 2>/dev/null; then
      say "the fleet ended before: $words" && exit 1
    fi
    ((SECONDS < end)) || { say "in time it did not come: $words" && exit 1; }
    sleep 0.2
  done
}

# shellcheck disable=SC2317 # wait_until calls these
node_is() { [[ $(sinfo -h -N -o %T 2>/dev/null) == "$1"* ]]; }
# shellcheck disable=SC2317
rows_are_there() { compgen -G "$base/slurm/runs/*/*/row.json" >/dev/null; }
# shellcheck disable=SC2317
program_runs() { [[ -n $(node_processes) ]] && pgrep_in_node 'lio-(sim|run)'; }
pgrep_in_node() { # PATTERN
  local process
  for process in $(node_processes); do
    if ps -o comm= -p "$process" | grep -Eq "$1"; then return; fi
  done
  return 1
}

write_fleet() {
  cat >"$base/proof.yaml" <<'YAML'
drives:
  - {name: street, sim: --scenario street --duration 5 --lidar vlp16, seeds: 1..3}
configurations:
  - {name: ndt}
  - {name: loam, set: pipeline.method=loam}
baseline: ndt
YAML
}

lose_the_node() {
  local lost
  mapfile -t lost < <(node_processes)
  say "kills slurmd, its steps and their jobs: ${#lost[@]} processes, with" \
    "$(find "$base/slurm" -path '*runs/*row.json' | wc -l) of 6 runs done"
  kill_all "${lost[@]}"
  wait_until 120 "the controller sees the node down" node_is down
  say "the controller has the node as down; the queue is: $(squeue -h -o '%i %T %r' | tr '\n' ';')"
  start_node
  wait_until 120 "the node is back" node_is_up
}
# shellcheck disable=SC2317
node_is_up() { node_is idle || node_is mixed || node_is allocated; }

# The columns that are the same whenever a run is made again.
steady_columns() { # TABLE
  awk -F '\t' '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i !~ /_(ms|mb|cpu_s|wall_s)$/) kept[++n] = i }
    { for (j = 1; j <= n; ++j) printf "%s\t", $kept[j]; print "" }' "$1"
}

start_munge
write_configuration
wait_until 20 "munge answers" munge -S "$base/munge/socket" -n -o /dev/null
start_controller
start_node
wait_until 60 "the node is up" node_is_up
write_fleet
say "runs the fleet without Slurm"
"$here/../fleet.sh" "$base/proof.yaml" --out "$base/local" --jobs 2 >"$base/fleet.txt" 2>&1
say "runs the fleet on Slurm"
"$here/../fleet.sh" "$base/proof.yaml" --out "$base/slurm" --jobs 4 --profile "$here/slurm" \
  >"$base/fleet.txt" 2>&1 &
fleet_pid=$!
wait_until 300 "a run is done" rows_are_there
wait_until 60 "a program runs on the node" program_runs
lose_the_node
wait "$fleet_pid" || { say "the fleet failed" && exit 1; }
fleet_pid=''
grep -i "requeu" "$base/slurmctld.log" || true
diff <(steady_columns "$base/local/table.tsv") <(steady_columns "$base/slurm/table.tsv")
say "nothing was lost: $(($(wc -l <"$base/slurm/table.tsv") - 1)) runs, the same table"
