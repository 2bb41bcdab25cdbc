#!/bin/sh
# Gives a job of the workflow to Slurm and prints its number there. Of a workflow that was killed jobs go on: such a one, of the same
# settings, is taken up again; one of other settings is let end first, since both write the same file.
#
# usage: submit.sh OUTPUT CPUS MEMORY_MB MINUTES JOBSCRIPT
set -eu
output=$1 cpus=$2 memory_mb=$3 minutes=$4 jobscript=$5
digest() { sha256sum | cut -c 1-16; }

name=fleet-$(echo "$PWD/$output" | digest)
settings=$(sed -n 's/"jobid": [0-9]*//; s/^# properties = //p' "$jobscript" | digest)
queued=$(squeue --me --noheader --states=PENDING,RUNNING --name="$name" --format='%i %k' |
  awk -v settings="$settings" '$2 == settings { print $1; exit }')
if [ -n "$queued" ]; then
  echo "$queued"
  exit
fi
mkdir -p .snakemake/slurm
number=$(sbatch --parsable --job-name="$name" --comment="$settings" --dependency=singleton --cpus-per-task="$cpus" --mem="$memory_mb" \
  --time="$minutes" --output=.snakemake/slurm/%j.log "$jobscript")
echo "${number%%;*}"     # without the cluster's name
