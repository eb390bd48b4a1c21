#!/usr/bin/env bash
# Runs the examples of cohorts on engines that are really there, and compares their results with those of one run:
#   test_slurm.sh [BUILD FOLDER (build/release)]
# GNU parallel, Snakemake, Dask, and a Slurm of one node that this script starts (slurmctld, slurmd and munged, with
# files in a temporary folder; nothing of the system is changed), as a job array and by Snakemake. Needs root and
# Debian's slurm-wlm, munge, parallel, snakemake and python3-distributed; what is missing is left out, and named.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=$(realpath "${1:-build/release}")
export PATH="$build/apps:$PATH"
examples=$PWD/apps/examples/06_cohort
work=$(mktemp -d)
started=()
stop() {
  local process
  for process in "${started[@]}"; do kill "$process" 2>/dev/null || true; done
  rm -rf "$work"
}
trap stop EXIT

# Six shapes, and what one run makes of them.
"$build/data/make_shapes" "$work/family" 6 1000
family=$work/family
ed_cohort "$family/template.ply" --manifest="$family/shapes.csv" --output="$work/whole" --pages=false --quiet

# compare NAME: holds the arrays of work/NAME to those of one run.
compare() {
  local file
  for file in correspondences.npy aligned.npy mean.ply components.npy scores.csv rows.csv; do
    cmp "$work/whole/$file" "$work/$1/$file" || { echo "$1: $file differs" >&2; exit 1; }
  done
  echo "$1: same bytes as one run"
}

# has COMMAND NAME: whether a command is there; says what is left out otherwise.
has() {
  command -v "$1" >/dev/null || { echo "$2: left out, there is no $1"; return 1; }
}

if has parallel parallel; then
  sed 's/--jobs=1/--jobs=1 --pages=false/' "$examples/parallel_cohort.sh" >"$work/parallel.sh"
  sh "$work/parallel.sh" "$family/template.ply" "$family/shapes.csv" "$work/parallel" 3 >/dev/null
  compare parallel
fi

# run_snakemake NAME FLAG ...: runs the workflow into work/NAME.
run_snakemake() {
  local name=$1
  shift
  (cd "$work" && snakemake --snakefile "$examples/Snakefile" "$@" --quiet --config template="$family/template.ply" \
    manifest="$family/shapes.csv" output="$work/$name" shards=3 flags=--pages=false) >"$work/$name.log" 2>&1 ||
    { cat "$work/$name.log" >&2; exit 1; }
  compare "$name"
}

if has snakemake snakemake; then run_snakemake snakemake --cores 2; fi

if [[ -d $build/python/ceres_ed ]] && /usr/bin/python3 -c "import distributed" 2>/dev/null; then
  PYTHONPATH=$build/python /usr/bin/python3 "$examples/dask_cohort.py" "$family/template.ply" "$family/shapes" >"$work/dask.log" 2>&1 ||
    { cat "$work/dask.log" >&2; exit 1; }
  grep '6 shapes' "$work/dask.log" | sed 's/^/dask: /'
else
  echo "dask: left out, there is no python3-distributed or no Python package in $build"
fi

has slurmctld slurm && has munged slurm || exit 0
[[ $EUID -eq 0 ]] || { echo "slurm: left out, it is started by root only"; exit 0; }

# A Slurm of one node, whose files are in the temporary folder.
slurm=$work/slurm
mkdir -p "$slurm/state" "$slurm/spool"
chmod 755 "$work" "$slurm"
dd if=/dev/urandom of="$slurm/key" bs=128 count=1 status=none
chmod 400 "$slurm/key"
munged --foreground --force --key-file="$slurm/key" --socket="$slurm/munge.socket" --pid-file="$slurm/munge.pid" \
  --log-file="$slurm/munge.log" --seed-file="$slurm/munge.seed" >/dev/null 2>&1 &
started+=($!)
host=$(hostname -s)
cpus=$(nproc)
cat >"$slurm/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$((20000 + RANDOM % 10000))
SlurmdPort=$((30000 + RANDOM % 10000))
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
MailProg=/bin/true
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$slurm/slurm.conf
slurmctld -D >/dev/null 2>&1 &
started+=($!)
slurmd -D >/dev/null 2>&1 &
started+=($!)
for _ in $(seq 60); do
  if sinfo --noheader --format=%T 2>/dev/null | grep -q idle; then break; fi
  sleep 1
done
sinfo --noheader --format='slurm: %D node, %T' || { tail -5 "$slurm"/*.log >&2; exit 1; }

"$examples/slurm_cohort.sh" "$family/template.ply" "$family/shapes.csv" "$work/array" 3 --pages=false >/dev/null
for _ in $(seq 300); do
  if [[ -z $(squeue --noheader) ]]; then break; fi
  sleep 1
done
[[ -f $work/array/summary.csv ]] || { tail -5 "$slurm"/slurm*.log "$work"/array/slurm*.log >&2; exit 1; }
compare array
if has snakemake slurm_snakemake; then
  run_snakemake slurm_snakemake --jobs 3 --latency-wait 20 \
    --cluster "sbatch --cpus-per-task={threads} --output=$slurm/job_%j.log"
fi
