#!/bin/sh
# A study by GNU parallel: a shard a job, on this machine, or on many by way of ssh. Copy it, set the lines below, then
#
#   sh study.sh
#
# The same command again runs the shards that failed and those that were not begun; a shard that was ended goes on with its rows.
# When all are done:
#
#   dashpot merge paper results/rows-*-of-8.csv --output results
#
set -eu

# A study that ships, or a file.
STUDY=${STUDY:-paper}
SHARDS=${SHARDS:-8}
OUTPUT=${OUTPUT:-results}
# Shards at once on a machine, and threads of each.
JOBS=${JOBS:-2}
THREADS=${THREADS:-4}

mkdir -p "$OUTPUT"
# For many machines add: --sshloginfile FILE --workdir .
# They need dashpot on their path and this folder at the same place. parallel tells jobs apart by their numbers alone, so the log is
# named after SHARDS; for another study remove it, or take another folder.
seq 0 $((SHARDS - 1)) |
    parallel --quote --jobs "$JOBS" --joblog "$OUTPUT/jobs-of-$SHARDS.log" --resume-failed \
        dashpot sweep "$STUDY" --shard {} --shards "$SHARDS" --threads "$THREADS" --no-page --output "$OUTPUT"
