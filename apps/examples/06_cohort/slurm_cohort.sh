#!/bin/sh
# Runs a cohort as a job array of Slurm, and collects it when the array has ended:
#   slurm_cohort.sh TEMPLATE MANIFEST OUTPUT [SHARDS [FLAG OF ed_cohort ...]]
# All paths must be on a disk that every node sees. Run it again to go on after a failure: what is done is skipped.
set -eu
template=$1 manifest=$2 output=$3 shards=${4:-4}
shift 3
if [ $# -gt 0 ]; then shift; fi
mkdir -p "$output"

# Each job of the array runs every n-th shape, as many at a time as it has cores. Exit code 3 says that some shapes
# have no result, and the summary says which: this is no reason to stop the others.
array=$(sbatch --parsable --job-name=cohort --array="1-$shards" --cpus-per-task="${CPUS_PER_JOB:-1}" \
  --output="$output/slurm_%a.log" <<END
#!/bin/sh
ed_cohort '$template' --manifest='$manifest' --output='$output' --shard="\$SLURM_ARRAY_TASK_ID/$shards" \
  --jobs="\${SLURM_CPUS_PER_TASK:-1}" $*
END
)
sbatch --parsable --job-name=cohort_collect --dependency="afterany:$array" --output="$output/slurm_collect.log" \
  --wrap="ed_cohort --collect '$output'"
