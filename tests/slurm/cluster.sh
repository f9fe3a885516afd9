# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# A Slurm cluster of one node on loopback, with all that it has in one folder; source it. As root.

# free_port: a number that no program listens at.
free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# write_settings FOLDER: a task starts as soon as it may.
write_settings() {
  cat >"$1/slurm.conf" <<END
ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$1/run/munge.socket
CryptoType=crypto/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/linux
MpiDefault=none
AccountingStorageType=accounting_storage/none
ReturnToService=2
KillWait=2
MaxArraySize=100001
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,bf_interval=1
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmctldPidFile=$1/run/slurmctld.pid
SlurmdPidFile=$1/run/slurmd.pid
SlurmctldLogFile=$1/log/slurmctld
SlurmdLogFile=$1/log/slurmd
StateSaveLocation=$1/state
SlurmdSpoolDir=$1/spool
NodeName=localhost NodeAddr=127.0.0.1 NodeHostname=$(hostname) CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
END
}

# wait_for SECONDS COMMAND...: whether the command succeeds before that.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.02
  done
}

node_is_idle() { sinfo --noheader --format=%T | grep -q '^idle$'; }

start_cluster() {
  local d=$1
  mkdir -m 755 "$d/run"
  mkdir "$d/spool" "$d/state" "$d/log"
  chmod 755 "$d"
  (umask 377 && head -c 1024 /dev/urandom >"$d/munge.key")
  munged --force --key-file="$d/munge.key" --socket="$d/run/munge.socket" \
    --pid-file="$d/run/munged.pid" --log-file="$d/log/munged" --seed-file="$d/munge.seed"
  write_settings "$d"
  export SLURM_CONF=$d/slurm.conf
  slurmctld -f "$SLURM_CONF"
  wait_for 300 scontrol ping || return 1
  slurmd -f "$SLURM_CONF" -N localhost
  wait_for 300 node_is_idle
}

# stop_cluster FOLDER: also one that did not come up.
stop_cluster() {
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$1/run/$daemon.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || continue
    wait_for 300 eval "! kill -0 $pid" || kill -9 "$pid"
  done
}
