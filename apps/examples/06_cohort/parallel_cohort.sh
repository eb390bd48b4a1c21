#!/bin/sh
# Runs a cohort with GNU parallel, on this machine or on several (--sshlogin), and collects it:
#   parallel_cohort.sh TEMPLATE MANIFEST OUTPUT [SHARDS]
set -eu
shards=${4:-4}
parallel --will-cite --quote ed_cohort "$1" --manifest="$2" --output="$3" --shard={}/"$shards" --jobs=1 ::: $(seq "$shards") || true
ed_cohort --collect "$3"
