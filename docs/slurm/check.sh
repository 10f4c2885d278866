#!/bin/bash
# Checks scan.sbatch on a Slurm of one node, this machine: submits it as an array, merges, and compares every byte with
# the scan of one process. Needs Debian or Ubuntu; as root it installs what is missing (slurm-wlm, munge), else it must
# be there. No systemd. Everything else lies in a temporary folder; an installed Slurm is not touched.
#
#   docs/slurm/check.sh [PROGRAM]       # PROGRAM: the motiform to use; without it that of target/release, or on the path

set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=${1:-}
if [ -z "$program" ]; then
    program=$here/../../target/release/motiform
    [ -x "$program" ] || program=$(command -v motiform) || { echo "build motiform first: cargo build --release"; exit 2; }
fi
MOTIFORM=$(realpath "$program")
export MOTIFORM
export PATH=$PATH:/usr/sbin:/sbin

if ! command -v slurmctld slurmd munged sbatch > /dev/null; then
    [ "$(id -u)" = 0 ] || { echo "slurm-wlm and munge are not installed, and only root can install them"; exit 2; }
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge > /dev/null
fi
echo "$(slurmctld -V), $(nproc) cores"

root=$(mktemp -d)
daemons=()
clean() {
    code=$?
    trap - EXIT
    for ((place = ${#daemons[@]} - 1; place >= 0; place--)); do
        kill "${daemons[place]}" 2> /dev/null || true
        wait "${daemons[place]}" 2> /dev/null || true
    done
    if [ "$code" = 0 ]; then
        rm -rf "$root"
    else
        echo "FAILED; logs are in $root" >&2
        tail -n 5 "$root"/log/*.log >&2 || true
    fi
    exit "$code"
}
trap clean EXIT
mkdir -p "$root"/{log,munge,state,spool,plain,shards}
chmod 755 "$root"

# munge: a key, a socket
(umask 077; dd if=/dev/urandom of="$root/munge/key" bs=1024 count=1 status=none)
munged --foreground --force --key-file="$root/munge/key" --socket="$root/munge/socket" --pid-file="$root/munge/pid" \
    --log-file="$root/log/munged.log" --seed-file="$root/munge/seed" 2> /dev/null &
daemons+=($!)

# Slurm: one node, this machine; no cgroups, no accounting
free_port() { for port in $(seq "$1" $(($1 + 99))); do (: < "/dev/tcp/127.0.0.1/$port") 2> /dev/null || { echo "$port"; return; }; done; }
node=$(hostname -s)
user=$(id -un)
export SLURM_CONF=$root/slurm.conf
cat > "$SLURM_CONF" <<CONF
ClusterName=check
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$(free_port 16817)
SlurmdPort=$(free_port 16917)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$root/munge/socket
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
StateSaveLocation=$root/state
SlurmdSpoolDir=$root/spool
SlurmctldPidFile=$root/slurmctld.pid
SlurmdPidFile=$root/slurmd.pid
SlurmctldLogFile=$root/log/slurmctld.log
SlurmdLogFile=$root/log/slurmd.log
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(($(awk '/^MemTotal/ {print $2}' /proc/meminfo) / 1024 - 100)) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
# Slurm 23.11 and newer can do without cgroups; older ones use what they find
case $(slurmctld -V) in
    *" 22."* | *" 21."* | *" 20."* | *" 23.02"*) echo "CgroupPlugin=cgroup/v1" > "$root/cgroup.conf" ;;
    *) echo "CgroupPlugin=disabled" > "$root/cgroup.conf" ;;
esac

soon() { for _ in $(seq 300); do if "$@" > /dev/null 2>&1; then return; fi; sleep 0.1; done; echo "waited for: $*"; exit 1; }
soon test -S "$root/munge/socket"
slurmctld -D -c > /dev/null 2>&1 &
daemons+=($!)
soon scontrol ping
slurmd -D -N "$node" > /dev/null 2>&1 &
daemons+=($!)
soon sh -c "sinfo -h -o %T | grep -qE '^(idle|mixed|allocated)'"
sinfo

# The scan twice: as an array of jobs, and in one process. 1, as the exit code of motiform, says that some motions are
# undetermined, and nothing worse.
cd "$root/shards"
job=$(sbatch --parsable "$here/scan.sbatch")
echo "job $job: $(sbatch --test-only "$here/scan.sbatch" 2>&1 | grep -o 'using.*' || true)"
while squeue -h -j "$job" 2> /dev/null | grep -q .; do sleep 0.5; done
tasks=$(sed -n 's/^shards=\([0-9]*\).*/\1/p' "$here/scan.sbatch")
for task in $(seq "$tasks"); do
    echo "task $task: $(grep -c . "motiform-${job}_$task.log") lines in its log, $(find "part-$task" -name 'part-*.parquet' | wc -l) parts"
done
"$MOTIFORM" merge part-* --out diagram > "$root/log/merge.log" || [ $? = 1 ]

cd "$root/plain"
# the script's own scan, without its share
scan=$(sed -n '/^"\$motiform" scan/,/[^\\]$/p' "$here/scan.sbatch" | sed 's/--shard.*--resume/--out diagram/')
motiform=$MOTIFORM bash -c "$scan" > "$root/log/plain.log" || [ $? = 1 ]

# A share that was cut short goes on when its task is submitted again
cd "$root/shards"
rm -r diagram
lost=$(find part-2 -name 'part-*.parquet' | sort | head -n 1)
rm "$lost"
again=$(sbatch --parsable --array=2 "$here/scan.sbatch")
while squeue -h -j "$again" 2> /dev/null | grep -q .; do sleep 0.5; done
"$MOTIFORM" merge part-* --out diagram > "$root/log/merge.log" || [ $? = 1 ]

parts=0
for part in "$root"/plain/diagram/part-*.parquet; do
    cmp "$part" "diagram/$(basename "$part")"
    parts=$((parts + 1))
done
[ "$parts" = "$(find diagram -name 'part-*.parquet' | wc -l)" ]
[ "$parts" -gt 0 ]
echo "the same bytes: $parts Parquet parts of $tasks tasks and of one process"
