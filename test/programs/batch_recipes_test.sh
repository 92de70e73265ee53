#!/bin/bash
# SPDX-License-Identifier: MIT
# The recipes of the cookbook for many meshes: GNU parallel, and a job array of Slurm, of which one node is started here on the
# loopback interface and stopped at the end. Needs Debian's packages parallel, munge, slurmctld, slurmd and slurm-client, and to be root.
# Usage: batch_recipes_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2
chmod 755 "$folder"
PATH=$(dirname "$program"):$PATH

mkdir meshes
for i in $(seq 60); do
  printf 'v 0 0 0\nv %d 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' "$i" >"meshes/$i.obj"
done
ls meshes/*.obj >list.txt
options='--packer rectangles --texture-size 64 --threads 1'
texture_atlas --batch list.txt -o whole $options >whole.jsonl 2>errors || fail "a run in one part: $(cat errors)"

# GNU parallel.
parallel --jobs 2 texture_atlas --batch list.txt -o parallel --shard {}/8 $options '>' part_{}.jsonl ::: 1 2 3 4 5 6 7 8 2>errors ||
  fail "parallel: $(cat errors)"
texture_atlas --batch list.txt -o parallel $options >parallel.jsonl 2>errors || fail "all lines: $(cat errors)"
grep -q '60 of 60 meshes: 0 now, 60 before, 0 failed' errors || fail "parallel: $(cat errors)"
diff -r whole parallel >/dev/null || fail "parallel makes other files"

# Slurm.
ports=$((20000 + $$ % 10000 * 2))
host=$(hostname -s)
mkdir munge state spool
head -c 1024 /dev/urandom >munge/key && chmod 600 munge/key
cat >slurm.conf <<CONF
ClusterName=atlas
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$ports
SlurmdPort=$((ports + 1))
SlurmUser=root
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
munged --force --foreground --key-file=munge/key --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
  --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" 2>munge/errors &
daemons=$!
slurmctld -D -i 2>slurmctld.errors &
daemons="$! $daemons"
slurmd -D -N "$host" 2>slurmd.errors &
daemons="$! $daemons"
trap 'kill $daemons 2>/dev/null; wait $daemons 2>/dev/null; rm -rf "$folder"' EXIT
for ((i = 0; i < 60; ++i)); do
  sinfo --noheader --format %T 2>/dev/null | grep -q idle && break
  sleep 0.5
done
cat >atlases.sh <<'JOB'
#!/bin/bash
#SBATCH --array=1-8
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm_%a.jsonl
#SBATCH --error=slurm_%a.txt
#SBATCH --requeue
exec texture_atlas --batch list.txt -o slurm --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
  --packer rectangles --texture-size 64 --threads "$SLURM_CPUS_PER_TASK"
JOB
timeout 120 sbatch --wait atlases.sh >submitted 2>errors || fail "sbatch: $(cat submitted errors slurm*.errors slurm_*.txt)"
texture_atlas --batch list.txt -o slurm $options >slurm.jsonl 2>errors || fail "all lines: $(cat errors)"
grep -q '60 of 60 meshes: 0 now, 60 before, 0 failed' errors || fail "Slurm: $(cat errors)"
diff -r whole slurm >/dev/null || fail "Slurm makes other files"
sed 's/"slurm/"whole/' slurm.jsonl | diff -q - whole.jsonl >/dev/null || fail "Slurm: other lines"
finish
