#!/bin/sh
# Runs a study with GNU parallel, one shard per job, on this machine or on many by ssh. Copy the file, adapt it, then run
#
#   sh study.sh
#
# Repeat the command to run failed and unstarted shards; an interrupted shard resumes from its rows.
# When all are done:
#
#   dashpot merge paper results/rows-*-of-8.csv --output results
#
set -eu

# A shipped study or a file.
STUDY=${STUDY:-paper}
SHARDS=${SHARDS:-8}
OUTPUT=${OUTPUT:-results}
# Concurrent shards per machine, and threads per shard.
JOBS=${JOBS:-2}
THREADS=${THREADS:-4}

mkdir -p "$OUTPUT"
# For many machines add: --sshloginfile FILE --workdir .
# They need dashpot on their PATH and this folder under the same path. parallel identifies jobs only by their numbers, so the
# log is named after SHARDS; for another study remove it, or use another folder.
seq 0 $((SHARDS - 1)) |
    parallel --quote --jobs "$JOBS" --joblog "$OUTPUT/jobs-of-$SHARDS.log" --resume-failed \
        dashpot sweep "$STUDY" --shard {} --shards "$SHARDS" --threads "$THREADS" --no-page --output "$OUTPUT"
