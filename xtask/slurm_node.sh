#!/bin/sh
# Runs a one-node Slurm cluster on this machine from Debian's packages slurm-wlm and munge, without systemd, as any user.
#
#   xtask/slurm_node.sh FOLDER [SLURMCTLD_PORT SLURMD_PORT]
#
# Keeps everything in FOLDER, which must not exist, and leaves /etc/slurm and a running Slurm alone. Prints `ready` when it
# accepts jobs: SLURM_CONF=FOLDER/slurm.conf sbatch ... When its standard input closes, and at SIGINT, SIGTERM or SIGHUP, it
# stops jobs and daemons and removes FOLDER, so it does not outlive the process that started it.
set -eu

folder=${1:?"usage: xtask/slurm_node.sh FOLDER [SLURMCTLD_PORT SLURMD_PORT]"}
slurmctld_port=${2:-26817}
slurmd_port=${3:-26818}
# The folders with daemons are not on every user's path.
PATH=$PATH:/usr/sbin:/sbin
SLURM_CONF=$folder/slurm.conf
export PATH SLURM_CONF

mkdir "$folder"
folder=$(cd "$folder" && pwd)
SLURM_CONF=$folder/slurm.conf
# Users who submit jobs must reach the socket in this folder.
chmod 755 "$folder"
mkdir "$folder/state" "$folder/spool"
(umask 077 && dd if=/dev/urandom of="$folder/munge.key" bs=128 count=1 2>"$folder/dd.log")

node=$(uname -n)
user=$(id -un)
# The node claims four processors and 4 GB on any machine, so that four shards run at once. There is no accounting, no
# cgroup and no prolog. A job has 5 s to stop when it is cancelled or requeued.
cat >"$SLURM_CONF" <<END
ClusterName=dashpot
SlurmctldHost=$node(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$slurmctld_port
SlurmdPort=$slurmd_port
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge.socket,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
KillWait=5
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=4 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=$node Default=YES MaxTime=INFINITE State=UP
END

# Runs a daemon in its own session: Ctrl-C must reach only this script, which stops jobs first.
daemons=
reader=
start() {
    name=$1
    shift
    setsid "$@" </dev/null >"$folder/$name.out" 2>&1 &
    daemons="$! $daemons"
}

end() {
    trap '' INT TERM HUP
    trap - EXIT
    # The node's daemon would leave jobs running.
    if scancel --me 2>/dev/null; then
        tries=0
        while [ -n "$(squeue --noheader 2>/dev/null)" ] && [ $tries -lt 100 ]; do
            tries=$((tries + 1))
            sleep 0.1
        done
    fi
    [ -z "$reader" ] || kill "$reader" 2>/dev/null || :
    # munge, which Slurm's daemons use, stops last.
    for daemon in $daemons; do
        kill "$daemon" 2>/dev/null || :
        wait "$daemon" 2>/dev/null || :
    done
    rm -rf "$folder"
}
trap end EXIT
trap 'exit 1' INT TERM HUP

# Waits up to 30 s until a command succeeds.
wait_until() {
    tries=0
    until "$@" >/dev/null 2>&1; do
        tries=$((tries + 1))
        if [ $tries -ge 300 ]; then
            echo "slurm_node.sh: \`$*\` still fails after 30 s:" >&2
            tail -n 5 "$folder"/*.out "$folder"/*.log >&2
            exit 1
        fi
        sleep 0.1
    done
}

start munged munged --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munged.pid" --seed-file="$folder/munged.seed"
wait_until munge --no-input --socket="$folder/munge.socket"
start slurmctld slurmctld -D -f "$SLURM_CONF" -L "$folder/slurmctld.log"
start slurmd slurmd -D -f "$SLURM_CONF" -L "$folder/slurmd.log"
idle() { [ "$(sinfo --noheader --format=%T)" = idle ]; }
wait_until idle
echo ready
# A background command can read standard input only through another descriptor. Signals interrupt `wait`, but not `cat`.
exec 3<&0
cat <&3 >/dev/null &
reader=$!
wait $reader
